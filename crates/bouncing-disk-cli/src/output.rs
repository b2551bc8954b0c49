//! Where results go: lines on a terminal, tables, files.

pub(crate) mod files;
pub(crate) mod json;
pub(crate) mod lines;
pub(crate) mod numbers;
pub(crate) mod report;
pub(crate) mod table;

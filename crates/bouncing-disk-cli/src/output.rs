//! Where results go: lines on a terminal, tables, files.

pub(crate) mod files;
pub(crate) mod json;
pub(crate) mod lines;
pub(crate) mod report;
pub(crate) mod table;

pub(crate) use files::OutputArgs;
pub(crate) use report::{Report, provenance, stored};
pub(crate) use table::{Columns, Quantities};

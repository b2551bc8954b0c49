//! Parameters: from a file, a preset of the paper, and single values on the command line.

pub(crate) mod motor;
pub(crate) mod source;
pub(crate) mod system;

//! One module per figure or table of the paper, named as its identifier (`fig06`, `table2`).
//!
//! A new module is declared here and listed once in [`crate::registry::all`].

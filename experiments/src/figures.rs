//! One module per figure or table of the paper, named as its identifier (`fig06`, `table2`).
//!
//! A new module is declared here and listed once in [`crate::registry::all`].

pub mod fig04;
pub mod fig06;
pub mod fig07;
pub mod fig10;
pub mod table2;
mod toss_case;

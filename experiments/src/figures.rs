//! One module per figure or table of the paper, named as its identifier (`fig06`, `table2`).
//!
//! A new module is declared here and listed once in [`crate::registry::all`].

pub mod fig01;
pub mod fig02;
pub mod fig03;
pub mod fig04;
pub mod fig05;
pub mod fig06;
pub mod fig07;
pub mod fig08;
pub mod fig09;
pub mod fig10;
pub mod fig11;
pub mod fig12;
pub mod fig13;
pub mod fig14;
mod shared;
pub mod table1;
pub mod table2;
pub mod table3;

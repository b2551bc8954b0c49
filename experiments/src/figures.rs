//! One module per figure or table of the paper, named as its identifier (`fig06`, `table2`).
//!
//! A new module is declared here and listed once in [`crate::registry::all`].

pub(crate) mod fig01;
pub(crate) mod fig02;
pub(crate) mod fig03;
pub(crate) mod fig04;
pub(crate) mod fig05;
pub(crate) mod fig06;
pub(crate) mod fig07;
pub(crate) mod fig08;
pub(crate) mod fig09;
pub(crate) mod fig10;
pub(crate) mod fig11;
pub(crate) mod fig12;
pub(crate) mod fig13;
pub(crate) mod fig14;
mod shared;
pub(crate) mod table1;
pub(crate) mod table2;
pub(crate) mod table3;

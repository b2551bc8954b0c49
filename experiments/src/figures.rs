//! One module per figure or table of the paper, named as its identifier (`fig06`, `table2`), and one per
//! figure beyond it, named with underscores (`extra_torque_speed`).
//!
//! A new module is declared here and listed once in [`crate::registry::paper`] or
//! [`crate::registry::extras`].

pub mod extra_branches;
pub mod extra_cascade;
pub mod extra_contact;
pub mod extra_crisis;
pub mod extra_design;
pub mod extra_drives;
pub mod extra_efficiency;
pub mod extra_fit;
pub mod extra_lyapunov;
pub mod extra_manifolds;
pub mod extra_regimes;
pub mod extra_restitution_law;
pub mod extra_torque_speed;
pub mod extra_traps;
pub mod extra_yielding;
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

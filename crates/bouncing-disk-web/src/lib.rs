//! The model in a browser's page: requests in JSON, answers as JSON and flat arrays.
//!
//! The page (`page/`) runs this crate as WebAssembly in workers. Each request is one call of the library, whose
//! results it passes on in SI units; its own are the branches in a window of a diagram
//! ([`branches_over_forcing`]) and whether a column has settled. The same request is
//! answered natively by the same code with the same bits (`examples/respond.rs`): the page's tests compare them.
//!
//! ```
//! use bouncing_disk_web::Explorer;
//!
//! let request = r#"{"call": "orbit", "map": {"axial_forcing": 0.45, "restitution": 0.5},
//!                   "start": {"impact_phase": 1.2, "normalised_speed": 1.3}}"#;
//! let reply = Explorer::new().respond(request);
//! assert!(!reply.refused && reply.json.contains("\"kind\":\"periodic\""));
//! ```

mod branches;
mod diagram;
mod explorer;
mod motion;
mod motor;
mod orbit;
mod reply;
mod request;
mod settling;
mod shared_basins;

pub use branches::{BranchInRange, branches_over_forcing};
pub use explorer::Explorer;
pub use reply::Reply;

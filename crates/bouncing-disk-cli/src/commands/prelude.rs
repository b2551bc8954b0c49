//! Items that most commands need.

pub(super) use std::io::Write;

pub(super) use bouncing_disk_plot::pictures;
pub(super) use clap::Args;
pub(super) use serde_json::json;

pub(super) use crate::context::Context;
pub(super) use crate::failure::{Failure, Result};
pub(super) use crate::grid::{self, GridArgs, GridJob, Rows};
pub(super) use crate::output::{Columns, OutputArgs, Quantities, Report, json, provenance, stored};
pub(super) use crate::parameters::motor::MotorArgs;
pub(super) use crate::parameters::system::{DrivenDisk, SystemArgs};
pub(super) use crate::range::{Range, Words, assignment, interval, one_of};

/// Heading of a command's own options.
pub(super) const OWN: &str = "Computation";

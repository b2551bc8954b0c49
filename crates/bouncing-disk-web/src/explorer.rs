//! The one who answers.

use crate::refusal::Refusal;
use crate::reply::Reply;
use crate::request::Request;
use crate::shared_basins::SharedAttractors;
use crate::{branches, diagram, motion, motor, orbit, summary};

/// Answers requests. It keeps the attractors of the last map, whose basins are asked for row by row.
#[derive(Debug, Default)]
pub struct Explorer {
    attractors: SharedAttractors,
}

impl Explorer {
    /// One that knows nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The answer to a request in JSON: the calls of `page/src/protocol.ts`. Whatever is wrong with a request is told in the
    /// answer ([`Reply::refused`]).
    pub fn respond(&mut self, request: &str) -> Reply {
        serde_json::from_str(request)
            .map_err(|error| Refusal::of_request(&error))
            .and_then(|request| self.answer(request))
            .unwrap_or_else(|refusal| Reply::refusal(&refusal))
    }

    fn answer(&mut self, request: Request) -> Result<Reply, Refusal> {
        match request {
            Request::Check { system } => summary::answer(&system.build()?),
            Request::Motion { system, start, periods, samples_per_period } => {
                motion::answer(&system.build()?, start, periods, samples_per_period)
            }
            Request::Diagram(request) => diagram::answer(&request),
            Request::Orbit { axial_forcing, restitution, start } => {
                orbit::answer(axial_forcing, restitution, start)
            }
            Request::Branches { restitution, axial_forcing } => branches::answer(restitution, axial_forcing),
            Request::Attractors { axial_forcing, restitution } => {
                self.attractors.told(axial_forcing, restitution)
            }
            Request::Basins(request) => self.attractors.rows(&request),
            Request::MotorReport { sheet } => motor::report(sheet),
            Request::MotorTransient { sheet, members, rise_times, points, seed } => {
                motor::transient(sheet, members, rise_times, points, seed)
            }
            Request::MotorLoads(request) => motor::loads(&request),
            Request::MotorStall { sheet, relative_error, seed } => motor::stall(sheet, relative_error, seed),
            Request::SheetWrite { sheet } => motor::write(sheet),
            Request::SheetRead { text } => motor::read(&text),
            Request::SheetOfSystem { system, mass } => motor::of_system(&system.build()?, mass),
        }
    }
}

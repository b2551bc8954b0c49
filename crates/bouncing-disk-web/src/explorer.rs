//! The answers to the requests of the page.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::wasm_bindgen;

use crate::reply::{Refusal, Reply};
use crate::request::Request;
use crate::shared_basins::SharedAttractors;
use crate::{branches, diagram, motion, motor, orbit};

/// Answers requests. It keeps the attractors of the last map, because the page requests basins row by row.
#[cfg_attr(target_arch = "wasm32", wasm_bindgen)]
#[derive(Debug, Default)]
pub struct Explorer {
    attractors: SharedAttractors,
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen)]
impl Explorer {
    /// One that knows nothing yet.
    #[cfg_attr(target_arch = "wasm32", wasm_bindgen(constructor))]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The answer to a request in JSON (`request.rs`). The answer also states faults of a request.
    pub fn respond(&mut self, request: &str) -> Reply {
        serde_json::from_str(request)
            .map_err(|error| Refusal::of_request(&error))
            .and_then(|request| self.answer(request))
            .unwrap_or_else(|refusal| Reply::refusal(&refusal))
    }
}

impl Explorer {
    fn answer(&mut self, request: Request) -> Result<Reply, Refusal> {
        match request {
            Request::Check { system, mass } => orbit::summary(&system.build()?, mass),
            Request::Motion { system, start, periods, samples_per_period } => {
                motion::answer(&system.build()?, start, periods, samples_per_period)
            }
            Request::Toss { system } => orbit::toss(&system.build()?),
            Request::Diagram(request) => diagram::answer(&request),
            Request::Orbit { map, start } => orbit::verdict(&map.build()?, start),
            Request::Branches { restitution, axial_forcing } => branches::answer(restitution, axial_forcing),
            Request::Attractors { map } => self.attractors.list(map.build()?),
            Request::Basins(request) => self.attractors.rows(&request),
            Request::MotorReport { sheet } => motor::report(sheet),
            Request::MotorTransient(request) => motor::transient(&request),
            Request::MotorLoads(request) => motor::loads(&request),
            Request::MotorStall { sheet, relative_error, seed } => motor::stall(sheet, relative_error, seed),
            Request::SheetRead { text } => motor::read(&text),
            Request::SheetOfSystem { system, mass, stator } => {
                motor::of_system(&system.build()?.with_stator(stator)?, mass)
            }
        }
    }
}

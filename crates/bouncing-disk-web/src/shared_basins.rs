//! The attractors of a map, and rows of their basins.

use bouncing_disk::core::{
    Attractor, AttractorKind, AttractorSearch, Attractors, Axis, BasinSettings, Grid, Unobserved,
};
use serde::Serialize;

use crate::refusal::Refusal;
use crate::reply::Reply;
use crate::request::{BasinsRequest, ImpactStart, map};

/// The attractors of the map that was asked about last: the rows of its basins follow.
#[derive(Debug, Default)]
pub(crate) struct SharedAttractors(Option<Attractors>);

#[derive(Debug, Serialize)]
struct AttractorsJson {
    attractors: Vec<AttractorJson>,
    undecided: f64,
    /// The sample of starts that the shares are of: how many, over all phases, and the largest normalised speed among them.
    starts: u32,
    fastest_start: f64,
}

#[derive(Debug, Serialize)]
struct AttractorJson {
    label: Option<u8>,
    kind: &'static str,
    text: String,
    share: f64,
    interval: (f64, f64),
    lasts: bool,
    leads_to: Option<usize>,
    impact: Option<ImpactStart>,
}

impl SharedAttractors {
    /// The attractors, searched for where they are not those of the last map.
    fn of(&mut self, axial_forcing: f64, restitution: f64) -> Result<&Attractors, Refusal> {
        let map = map(axial_forcing, restitution)?;
        let found = match self.0.take() {
            Some(found) if *found.map() == map => found,
            _ => map.attractors(&AttractorSearch::default(), &Unobserved)?,
        };
        Ok(self.0.insert(found))
    }

    pub(crate) fn told(&mut self, axial_forcing: f64, restitution: f64) -> Result<Reply, Refusal> {
        let found = self.of(axial_forcing, restitution)?;
        let attractors = found.all().iter().enumerate();
        let attractors = attractors.map(|(number, attractor)| told(found.label(number), attractor)).collect();
        Reply::short(&AttractorsJson {
            attractors,
            undecided: found.undecided().value(),
            starts: found.search().starts(),
            fastest_start: found.map().impact_speed_bound() / std::f64::consts::PI,
        })
    }

    pub(crate) fn rows(&mut self, request: &BasinsRequest) -> Result<Reply, Refusal> {
        let ([low, high], [slow, fast]) = (request.phase_periods, request.normalised_speed);
        let grid = Grid::new(Axis::new(low, high, request.phases)?, Axis::new(slow, fast, request.speeds)?)?;
        let [from, to] = request.rows;
        if from > to || to > request.speeds {
            return Err(Refusal::out_of_range("rows", to as f64, "from the first to the number of speeds"));
        }
        let found = self.of(request.axial_forcing, request.restitution)?;
        let basins = found.basins_of_rows(grid, from..to, BasinSettings::default(), &Unobserved)?;
        Reply::new(&(), Vec::new(), basins.labels().to_vec())
    }
}

fn told(label: Option<u8>, attractor: &Attractor) -> AttractorJson {
    let (mut impact, mut leads_to) = (None, None);
    let kind = match &attractor.kind {
        AttractorKind::Rest(after) => {
            leads_to = after.leads_to();
            "rest"
        }
        AttractorKind::Periodic(known) => {
            impact = known.orbit().states.first().map(ImpactStart::from);
            "periodic"
        }
        AttractorKind::Marginal(orbit) => {
            impact = orbit.states.first().map(ImpactStart::from);
            "marginal"
        }
        AttractorKind::Chaotic { .. } => "chaotic",
        _ => "unclassified",
    };
    AttractorJson {
        label,
        kind,
        text: attractor.kind.to_string(),
        share: attractor.starts.value(),
        interval: attractor.starts.interval(),
        lasts: attractor.kind.lasts(),
        leads_to,
        impact,
    }
}

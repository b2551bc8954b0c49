//! The attractors of a map, and rows of their basins.

use bouncing_disk::core::attractors::{
    Attractor, AttractorKind, AttractorSearch, Attractors, Axis, BasinSettings, Grid,
};
use bouncing_disk::core::numerics::fraction::Fraction;
use bouncing_disk::core::{ImpactMap, Unobserved};
use serde_json::{Value, json};

use crate::reply::{Refusal, Reply};
use crate::request::{BasinsRequest, ImpactStart};

/// A search that takes a second where there is chaos: it follows 1,024 orbits for a tenth of the impacts of the default,
/// and says for how many.
fn quick_search() -> Result<AttractorSearch, Refusal> {
    Ok(AttractorSearch::default().with_impacts(2_000, 10_000)?)
}

/// The attractors of the map that was asked about last: the rows of its basins follow.
#[derive(Debug, Default)]
pub(crate) struct SharedAttractors(Option<Attractors>);

impl SharedAttractors {
    fn of(&mut self, map: ImpactMap) -> Result<&Attractors, Refusal> {
        let found = match self.0.take() {
            Some(found) if *found.map() == map => found,
            _ => map.attractors(&quick_search()?, &Unobserved)?,
        };
        Ok(self.0.insert(found))
    }

    /// All attractors of a map with the shares of a sample of starts that end on them, and their 95 %
    /// intervals. A label is what `rows` has in its cells, null beyond the 251 that a byte holds; an
    /// attractor that does not last may lead to another one; a periodic one has one of its impacts. The
    /// sample has so many starts, evenly over all phases and the speeds up to the bound that no attractor
    /// exceeds at that phase; `fastest_start` is the largest of that bound. `kinds` has the share, and its interval,
    /// of the starts that rest, are periodic or chaotic for good: where a rest leads to another attractor, that counts.
    pub(crate) fn list(&mut self, map: ImpactMap) -> Result<Reply, Refusal> {
        let found = self.of(map)?;
        let attractors = found.all().iter().enumerate();
        let attractors: Vec<_> =
            attractors.map(|(number, one)| described(found.label(number), one)).collect();
        Reply::short(&json!({
            "attractors": attractors,
            "kinds": kinds(found)?,
            "undecided": found.undecided().value(),
            "starts": found.search().starts(),
            "fastest_start": found.map().impact_speed_bound() / std::f64::consts::PI,
        }))
    }

    /// Bytes: the labels of rows of a grid of starts, with the phase along a row, from the lowest speed up.
    pub(crate) fn rows(&mut self, request: &BasinsRequest) -> Result<Reply, Refusal> {
        let map = request.map.build()?;
        let ([low, high], [slow, fast]) = (request.phase_periods, request.normalised_speed);
        let grid = Grid::new(Axis::new(low, high, request.phases)?, Axis::new(slow, fast, request.speeds)?)?;
        let [from, to] = request.rows;
        if from > to || to > request.speeds {
            return Err(Refusal::out_of_range(
                "rows",
                to as f64,
                "at least the first row and at most the number of speeds",
            ));
        }
        let found = self.of(map)?;
        let basins = found.basins_of_rows(grid, from..to, BasinSettings::default(), &Unobserved)?;
        Reply::new(&(), Vec::new(), basins.labels().to_vec())
    }
}

fn kinds(found: &Attractors) -> Result<Value, Refusal> {
    let end = |one| &leads_to(one).and_then(|last| found.all().get(last)).unwrap_or(one).kind;
    let share = |name: &str| {
        let own = found.all().iter().filter(|one| end(one).lasts() && end(one).name() == name);
        let count = own.map(|one| one.starts.count()).sum();
        let share = Fraction::new(count, u64::from(found.search().starts()))?;
        let (low, high) = share.interval();
        Ok::<_, Refusal>(json!({ "value": share.value(), "low": low, "high": high }))
    };
    Ok(json!({ "rest": share("rest")?, "periodic": share("periodic")?, "chaotic": share("chaotic")? }))
}

/// The number of the attractor on which a rest ends, where it ends on another one.
fn leads_to(attractor: &Attractor) -> Option<usize> {
    match &attractor.kind {
        AttractorKind::Rest(after) => after.leads_to(),
        _ => None,
    }
}

fn described(label: Option<u8>, attractor: &Attractor) -> Value {
    let impact = attractor.kind.orbit().and_then(|orbit| orbit.states.first()).map(ImpactStart::from);
    json!({
        "label": label,
        "kind": attractor.kind.name(),
        "text": attractor.kind.to_string(),
        "share": attractor.starts.value(),
        "interval": attractor.starts.interval(),
        "lasts": attractor.kind.lasts(),
        "leads_to": leads_to(attractor),
        "impact": impact,
    })
}

//! The computation of the figure.

use bouncing_disk::core::{
    ChatterPolicy, CrisisSearch, ImpactMap, ImpactState, ManifoldKind, ManifoldSettings, NoCrisis,
    NoTangency, PeriodicOrbit, Unobserved, Vibration, orbit_diagram,
};

use super::data::{ExtraCrisisData, Spot};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::manifold_lines::lines;
use crate::paper;
use crate::progress::Progress;

/// Γ between which the crisis is sought.
const RANGE: (f64, f64) = (0.5595, 0.5615);
/// The largest distance in Γ at which lives are counted; each next one is half of it.
const FARTHEST: f64 = 1.0e-3;

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraCrisisData, ExperimentError> {
    let restitution = paper::section_four()?.restitution;
    progress.start(4, "parts");
    let model = ExperimentError::model;
    let search = CrisisSearch::new(restitution, RANGE).map_err(model)?;
    let none = || ExperimentError::NoData { quantity: "a crisis".to_owned() };
    let crisis = search.crisis(None, &Unobserved).map_err(model)?.map_err(|_| none())?;
    let tangency = crisis.tangency.clone().map_err(|_| none())?;
    let below = map(0.5 * (RANGE.0 + RANGE.1), restitution)?;
    let node = below.period_one(1).ok_or_else(none)?;
    let node = below.refine(&[node]).map_err(model)?;
    let midst = search.crisis(Some((&node, &tangency.touched)), &Unobserved).map_err(model)?;
    let midst_forcing = match midst {
        Ok(midst) => midst.forcing,
        Err(NoCrisis::OtherReason { reason: NoTangency::Elsewhere { forcing }, .. }) => forcing,
        Err(_) => return Err(none()),
    };
    progress.advance(1);
    let at = map(crisis.forcing, restitution)?;
    let recorded = quality.choose(4_000, 40_000);
    let middle = tangency.orbit.len() / 2;
    let start = *tangency.orbit.get(middle).ok_or_else(none)?;
    let attractor =
        orbit_diagram(&[at.orbit(start, ChatterPolicy::Complete)], 200, recorded).map_err(model)?;
    progress.advance(1);
    let grown = |kind: ManifoldKind, arclength: f64| {
        let settings = ManifoldSettings::new(arclength, 100_000)?.with_resolution(0.03, 0.1)?;
        at.manifold(&tangency.touched, kind, &settings)
    };
    let (stable, unstable) = quality.choose((30.0, 6.0), (120.0, 16.0));
    let stable = lines(&grown(ManifoldKind::Stable, stable).map_err(model)?, spot);
    let unstable = lines(&grown(ManifoldKind::Unstable, unstable).map_err(model)?, spot);
    progress.advance(1);
    let (orbits, most_impacts, halvings) = quality.choose((60, 2_000_000, 12), (300, 20_000_000, 14));
    let mut beyond = vec![FARTHEST];
    for _ in 0..halvings {
        beyond.extend(beyond.last().map(|last| 0.5 * last));
    }
    let lives = crisis.lives(&beyond, orbits, most_impacts).map_err(model)?;
    progress.advance(1);
    Ok(ExtraCrisisData {
        midst_forcing,
        attractor: attractor.iter().flatten().map(|state| spot(*state)).collect(),
        stable,
        unstable,
        saddle: tangency.touched.states.iter().map(|state| spot(*state)).collect(),
        tangency: tangency.orbit.iter().map(|state| spot(*state)).collect(),
        magnified: magnified(&tangency.orbit, &tangency.touched).ok_or_else(none)?,
        lives,
        orbits,
        most_impacts,
        expected_exponent: crisis.life_exponent(),
        contact: tangency,
        crisis,
    })
}

fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, ExperimentError> {
    let vibration = Vibration::from_axial_forcing(axial_forcing).map_err(ExperimentError::model)?;
    ImpactMap::new(vibration, restitution).map_err(ExperimentError::model)
}

fn spot(state: ImpactState) -> Spot {
    let cycles = state.phase().cycles();
    (if cycles < 0.5 { cycles } else { cycles - 1.0 }, state.normalised_speed())
}

/// The impact of the tangency that lies farthest from the saddle: where the manifold folds.
fn magnified(orbit: &[ImpactState], saddle: &PeriodicOrbit) -> Option<Spot> {
    let distance = |state: &ImpactState| {
        let (phase, speed) = spot(*state);
        saddle
            .states
            .iter()
            .map(|own| spot(*own))
            .fold(f64::INFINITY, |least, own| least.min((phase - own.0).abs().max((speed - own.1).abs())))
    };
    let farthest = (0..orbit.len()).max_by(|&i, &j| distance(&orbit[i]).total_cmp(&distance(&orbit[j])))?;
    // The first impact after it that is back at the edge.
    orbit[farthest..].iter().find(|state| distance(state) < 0.02).map(|state| spot(*state))
}

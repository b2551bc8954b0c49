//! Stable and unstable manifolds of the saddles of the impact map (docs/numerics-dynamics.md, "Invariant
//! manifolds of saddles").

use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, not_negative, within};
use crate::numerics::stored::read_checked;
use crate::orbits::periodic::{Multipliers, PeriodicOrbit};
use crate::run::{Observer, Watch};

pub(crate) mod grower;
pub(crate) mod saddle;

use grower::Grower;
use saddle::Saddle;

/// One of the two kinds of manifold of a saddle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum ManifoldKind {
    /// The states that tend to the saddle: it grows by [`ImpactMap::step_back`].
    Stable,
    /// The states that come from the saddle: it grows by [`ImpactMap::step`].
    Unstable,
}

/// The side of the saddle on which a branch of its manifold begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// The side of later phases, or of slower impacts if the phase is constant along the manifold.
    Later,
    /// The side of earlier phases, or of faster impacts.
    Earlier,
}

/// The settings for growing a manifold: its length and resolution.
///
/// Lengths are measured in the plane of impact phase (rad) and impact velocity in units of 1 + P.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct ManifoldSettings {
    arclength: f64,
    max_points: usize,
    chord: f64,
    turn: f64,
    max_generations: u32,
    launch_speed: Option<f64>,
}

read_checked!(ManifoldSettings as UncheckedSettings {
    arclength: f64,
    max_points: usize,
    chord: f64,
    turn: f64,
    max_generations: u32,
    launch_speed: Option<f64>,
});

impl ManifoldSettings {
    /// The largest number of points of a branch.
    pub const MAX_POINTS: usize = 10_000_000;

    /// Settings that grow each branch up to this `arclength` in (0, 1e6] and `max_points` in [16, 1e7].
    /// Neighbouring points are at most 0.05 apart, the polygon turns by at most 0.2 rad, and there are at
    /// most 200 generations.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for either number.
    pub fn new(arclength: f64, max_points: usize) -> Result<Self, Error> {
        let settings =
            Self { arclength, max_points, chord: 0.05, turn: 0.2, max_generations: 200, launch_speed: None };
        settings.check().map(|()| settings)
    }

    /// The same settings with neighbouring points at most `chord` in [1e-6, 1] apart and turns of at most
    /// `turn` in [1e-3, 1] rad. Turns between parts of a fiftieth of a chord are not resolved.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for either number.
    pub fn with_resolution(self, chord: f64, turn: f64) -> Result<Self, Error> {
        let settings = Self { chord, turn, ..self };
        settings.check().map(|()| settings)
    }

    /// The same settings with at most `max_generations` in [1, 10,000], the number of times the first piece
    /// is mapped.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the number.
    pub fn with_generations(self, max_generations: u32) -> Result<Self, Error> {
        let settings = Self { max_generations, ..self };
        settings.check().map(|()| settings)
    }

    /// The same settings with another limit up to which a stable manifold is followed: the disk's own speed
    /// after an impact, |P cos tau - r v| (units of g/omega), finite and >= 0. The default is
    /// [`ImpactMap::launch_speed_bound`]; smaller values count as that bound.
    ///
    /// No state within the limit is lost: backwards in time, a disk faster than the bound becomes ever
    /// faster.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the speed.
    pub fn with_launch_speed(self, launch_speed: f64) -> Result<Self, Error> {
        let settings = Self { launch_speed: Some(launch_speed), ..self };
        settings.check().map(|()| settings)
    }

    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        within("arclength of a manifold", self.arclength, f64::MIN_POSITIVE, 1.0e6, "(0, 1e6]")?;
        let most = Self::MAX_POINTS as f64;
        within("points of a manifold", self.max_points as f64, 16.0, most, "[16, 10000000]")?;
        within("chord of a manifold", self.chord, 1.0e-6, 1.0, "[1e-6, 1]")?;
        within("turn of a manifold", self.turn, 1.0e-3, 1.0, "[1e-3, 1] rad")?;
        within("generations of a manifold", f64::from(self.max_generations), 1.0, 1.0e4, "[1, 10000]")?;
        if let Some(speed) = self.launch_speed {
            not_negative("launch speed of a manifold", speed)?;
        }
        Ok(())
    }
}

/// The reason why a piece of a manifold begins or ends at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum PieceEnd {
    /// It is at the saddle.
    Saddle,
    /// The map jumps: a flight on the way grazes the platform, and beyond this point another impact comes
    /// first.
    Graze,
    /// Beyond this point the disk provably chatters to rest.
    Rest,
    /// Beyond this point the disk was faster than the settings allow.
    TooFast,
    /// The branch is cut off here: see its [`ManifoldEnd`].
    Cut,
}

/// A part of a manifold without a jump.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ManifoldPiece {
    /// Its impacts in order, at least one; between neighbours the phase may pass 2 pi.
    pub states: Vec<ImpactState>,
    /// The reason why it does not begin earlier.
    pub start: PieceEnd,
    /// The reason why it ends.
    pub end: PieceEnd,
}

/// Why a branch of a manifold ends where it does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum ManifoldEnd {
    /// It is as long as requested.
    Arclength,
    /// It has the largest allowed number of points, or the next generation would exceed it.
    Points,
    /// Its first piece was mapped as often as allowed.
    Generations,
    /// It ends in an attracting orbit: the last generation was too short to resolve, and shrinking.
    Attracted,
    /// Every point of the last generation came to rest or was too fast.
    Lost,
}

/// A branch of a manifold, on one side of one impact of the saddle.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ManifoldBranch {
    /// The impact of the saddle at which it begins.
    pub impact: usize,
    /// The side on which it begins.
    pub side: Side,
    /// Its pieces in the order in which they grow from the saddle.
    pub pieces: Vec<ManifoldPiece>,
    /// Their total length (see [`ManifoldSettings`]).
    pub arclength: f64,
    /// The number of times the first piece was mapped.
    pub generations: u32,
    /// The reason why it is not longer.
    pub end: ManifoldEnd,
}

/// A manifold of a saddle.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Manifold {
    /// The kind of the manifold.
    pub kind: ManifoldKind,
    /// The Floquet multiplier that belongs to it.
    pub multiplier: f64,
    /// Two branches for each impact of the saddle, in the order of the impacts.
    pub branches: Vec<ManifoldBranch>,
}

impl Manifold {
    /// The pieces of all branches.
    pub fn pieces(&self) -> impl Iterator<Item = &ManifoldPiece> {
        self.branches.iter().flat_map(|branch| &branch.pieces)
    }
}

impl ImpactMap {
    /// The stable or the unstable manifold of the saddle `orbit` of this map: an orbit with one real
    /// multiplier inside the unit circle and one outside.
    ///
    /// Every branch grows from a short straight piece near the saddle, which is mapped repeatedly. Points are
    /// inserted where neighbours separate or the polygon turns; the curve is broken where the map jumps
    /// ([`PieceEnd`]). An inserted point is mapped all the way from the first piece, so no interpolation
    /// error grows.
    ///
    /// The items of `observer` are the allowed points of all branches.
    ///
    /// ```
    /// # use bouncing_disk_core::chaos::{ManifoldKind, ManifoldSettings};
    /// # use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let saddle = map.period_one_pair(1).expect("it exists").saddle.orbit(&map)?.expect("an orbit");
    /// let settings = ManifoldSettings::new(5.0, 1_000)?;
    /// // One branch of the unstable manifold ends in the orbit that attracts.
    /// let manifold = map.manifold(&saddle, ManifoldKind::Unstable, &settings, &Unobserved)?;
    /// let node = map.period_one(1).expect("it exists");
    /// let near = |state: &bouncing_disk_core::ImpactState| {
    ///     (state.phase().angle() - node.phase().angle()).abs() < 0.01
    /// };
    /// assert!(manifold.branches.iter().any(|branch| {
    ///     branch.pieces.last().and_then(|piece| piece.states.last()).is_some_and(near)
    /// }));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the orbit is not a saddle, or for a stable manifold and restitution 0;
    /// [`Error::NotAnOrbit`] if it is not an orbit of this map; errors of
    /// [`Vibration::first_impact`](crate::Vibration::first_impact).
    pub fn manifold(
        &self,
        orbit: &PeriodicOrbit,
        kind: ManifoldKind,
        settings: &ManifoldSettings,
        observer: &dyn Observer,
    ) -> Result<Manifold, Error> {
        settings.check()?;
        orbit.check()?;
        let branches = 2 * orbit.period() as u64;
        let total = branches.saturating_mul(settings.max_points as u64);
        let watch = Watch::begin(observer, 0, total)?;
        let mut work = watch.work();
        let mut grown = Vec::new();
        let mut multiplier = f64::NAN;
        for impact in 0..orbit.period() {
            let saddle = Saddle::of(self, orbit, impact)?;
            multiplier = saddle.multiplier(kind);
            for side in [Side::Later, Side::Earlier] {
                let mut grower = Grower::new(self, &saddle, kind, side, settings)?;
                grown.push(grower.grow(impact, &mut |flights| work.spend(flights))?);
                watch.finish(settings.max_points as u64);
            }
        }
        watch.end();
        Ok(Manifold { kind, multiplier, branches: grown })
    }
}

/// The multipliers of a saddle, larger one first; an error for another orbit.
pub(crate) fn of_saddle(multipliers: Multipliers) -> Result<(f64, f64), Error> {
    let legal = "one of two real multipliers, one inside the unit circle and one outside";
    match multipliers {
        Multipliers::Real(large, small) if large.abs() > 1.0 && small.abs() < 1.0 => Ok((large, small)),
        Multipliers::Real(large, small) => {
            // The multiplier at fault.
            let value = if large.abs() > 1.0 { small } else { large };
            Err(Error::OutOfRange { field: "multiplier of a saddle", value, legal })
        }
        Multipliers::Complex { real, .. } => {
            Err(Error::OutOfRange { field: "real part of a multiplier of a saddle", value: real, legal })
        }
    }
}

#[cfg(test)]
mod tests;

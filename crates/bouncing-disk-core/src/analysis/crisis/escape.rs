//! Whether any point of an unstable manifold comes to rest.

use super::CrisisSearch;
use crate::analysis::manifold::grower::Grower;
use crate::analysis::manifold::saddle::Saddle;
use crate::analysis::manifold::{ManifoldKind, ManifoldSettings};
use crate::analysis::periodic::PeriodicOrbit;
use crate::error::Error;
use crate::map::impact_map::ImpactMap;
use crate::observer::WorkCount;

impl CrisisSearch {
    /// The first piece of the unstable manifold of an orbit of `map`.
    pub(super) fn first_piece<'m>(
        &self,
        map: &'m ImpactMap,
        inside: &PeriodicOrbit,
    ) -> Result<Grower<'m>, Error> {
        let saddle = Saddle::of(map, inside, 0)?;
        Grower::new(map, &saddle, ManifoldKind::Unstable, self.side, &ManifoldSettings::new(1.0, 16)?)
    }

    /// After how many impacts a sample of the first piece is proven to chatter to rest, the first one of
    /// which it is; `None` if it is of none within the impacts that are allowed.
    pub(super) fn first_rest(
        &self,
        inside: &PeriodicOrbit,
        forcing: f64,
        work: &mut WorkCount<'_>,
    ) -> Result<Option<u32>, Error> {
        let map = self.map(forcing)?;
        let own = map.refine(&inside.states)?;
        let piece = self.first_piece(&map, &own)?;
        for sample in 0..self.samples {
            let share = f64::from(sample) / f64::from(self.samples);
            work.finish(1)?;
            let Some((mut state, _)) = piece.first_piece(share)? else { return Ok(Some(0)) };
            for impact in 0..self.impacts {
                if map.chatters_to_rest(map.rebound(state)) {
                    return Ok(Some(impact));
                }
                state = map.step(state)?.into();
            }
            work.spend(u64::from(self.impacts))?;
        }
        Ok(None)
    }
}

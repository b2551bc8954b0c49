//! The uncertainty exponent of a basin boundary and its dimension, from the share of cells with an uncertain
//! fate as a function of the accuracy of a start (S. W. McDonald, C. Grebogi, E. Ott, J. A. Yorke, Physica D
//! 17, 125 (1985)).
//!
//! Tests: a straight boundary, alternately coloured gaps of Cantor's set (1 + ln 2/ln 3, found to 0.02),
//! and random cells (2).

use std::collections::VecDeque;

use super::{Basins, Label};
use crate::numerics::elementary::ln;
use crate::numerics::error::{Error, within};
use crate::numerics::fraction::Fraction;
use crate::run::{Observer, Watch};

/// Smallest number of distances for fitting a power law.
const FEWEST: usize = 3;

/// Approximate number of labels read in the time of one flight.
const CELLS_OF_FLIGHT: usize = 16;

/// The largest difference between the slopes from one distance to the next that still counts as a power law:
/// a fixed part, plus a share of their mean. Near saturation, where most cells are uncertain, slopes fall to
/// zero and differ by more.
const SPREAD: f64 = 0.05;
const SPREAD_OF_SLOPE: f64 = 0.2;

/// The share of cells whose fate is uncertain if a start is known only to within some distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct UncertainShare {
    /// The distance, in cells along each axis.
    pub distance: usize,
    /// The share of cells with a differently labelled cell within this distance along both axes.
    pub uncertain: Fraction,
}

/// Whether the share of uncertain cells is a power of the distance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum BoundaryFit {
    /// The share follows a power law over the distances of the fit.
    PowerLaw {
        /// The uncertainty exponent alpha: the share grows like distance^alpha.
        exponent: f64,
        /// Its standard error, from the scatter about the line on logarithmic axes.
        standard_error: f64,
        /// The boundary's dimension 2 - alpha, from 1 (a smooth curve) to 2.
        dimension: f64,
        /// The smallest slope from one distance to the next, and the largest.
        slopes: (f64, f64),
    },
    /// There is no power law: the slopes from one distance to the next differ by more than 0.05 plus a fifth
    /// of their mean. This also happens on a grid so coarse that most of its cells are uncertain.
    NoPowerLaw {
        /// The smallest and the largest slope.
        slopes: (f64, f64),
    },
    /// Cells are uncertain at fewer than three distances, too few for a fit.
    TooFew {
        /// The number of distances with uncertain cells.
        distances: usize,
    },
}

/// How the share of uncertain cells depends on the distance.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BoundaryScaling {
    /// One share for each distance, in rising order, all counted over the same cells.
    pub shares: Vec<UncertainShare>,
    /// The line fitted to the logarithms of the non-zero shares over the logarithms of the distances.
    pub fit: BoundaryFit,
}

impl Basins {
    /// The share of cells whose fate is uncertain if a start is known only to within a distance in cells, and
    /// the power law of this share: its exponent and the dimension of the basin boundary.
    ///
    /// A cell is uncertain if a cell with another label lies within that distance along both axes. For all
    /// `distances` (such as 1, 2, 4, 8, ... or 1, 3, 9, ...) the same cells count: all that are farther from
    /// the edges of the grid than the largest distance. Undecided cells count as a basin of their own.
    ///
    /// The items of `observer` are the counted rows of cells, once for each distance.
    ///
    /// ```
    /// use bouncing_disk_core::attractors::{AttractorSearch, Axis, BasinSettings, BoundaryFit, Grid};
    /// use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    ///
    /// // The basin of the period-1 orbit just beyond its birth has a smooth boundary.
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.34)?, 0.5)?;
    /// let found = map.attractors(&AttractorSearch::default(), &Unobserved)?;
    /// let settings = BasinSettings { max_impacts: 20_000, ..BasinSettings::default() };
    /// let grid = Grid::new(Axis::new(0.0, 1.0, 120)?, Axis::new(0.0, 3.0, 120)?)?;
    /// let scaling = found.basins(grid, settings, &Unobserved)?.boundary_scaling(&[1, 2, 4], &Unobserved)?;
    /// assert!(matches!(scaling.fit, BoundaryFit::PowerLaw { dimension, .. } if dimension < 1.2));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the distances do not increase from at least 1, or no cell is far enough from
    /// the edges.
    pub fn boundary_scaling(
        &self,
        distances: &[usize],
        observer: &dyn Observer,
    ) -> Result<BoundaryScaling, Error> {
        let mut least = 1;
        let most = (self.columns().min(self.rows()) - 1) / 2;
        for distance in distances {
            let legal = "at least 1, greater than the distance before it, and less than half the shorter side of \
                         the grid";
            within("distance of cells", *distance as f64, least as f64, most as f64, legal)?;
            least = distance + 1;
        }
        let margin = distances.last().copied().unwrap_or(0);
        let rows = (self.rows() - 2 * margin) as u64;
        let watch = Watch::begin(observer, 0, distances.len() as u64 * rows)?;
        let shares = distances.iter().map(|distance| {
            let uncertain = self.uncertain(*distance, margin, &watch)?;
            Ok(UncertainShare { distance: *distance, uncertain })
        });
        let shares = shares.collect::<Result<Vec<_>, Error>>()?;
        watch.end();
        let points = shares.iter().filter(|share| share.uncertain.count() > 0);
        let points: Vec<_> =
            points.map(|share| (ln(share.distance as f64), ln(share.uncertain.value()))).collect();
        Ok(BoundaryScaling { fit: fit(&points), shares })
    }

    /// The share of cells with a differently labelled cell within this distance along both axes, of all cells
    /// farther than `margin` from the edges.
    fn uncertain(&self, distance: usize, margin: usize, watch: &Watch<'_>) -> Result<Fraction, Error> {
        let inner = margin..self.columns() - margin;
        let mut work = watch.work();
        let spent = (inner.len() * distance / CELLS_OF_FLIGHT) as u64 + 1;
        // First the smallest and the largest label along each row: the square has one label if both agree.
        let extent = |labels: &[Label]| {
            labels
                .iter()
                .fold((Label::MAX, Label::MIN), |(least, most), own| (least.min(*own), most.max(*own)))
        };
        let mut along = |row: usize| -> Result<Vec<(Label, Label)>, Error> {
            work.spend(spent)?;
            let row = self.row(row);
            Ok(inner.clone().map(|column| extent(&row[column - distance..=column + distance])).collect())
        };
        let (mut uncertain, mut all) = (0, 0);
        let mut rows =
            (margin - distance..margin + distance).map(&mut along).collect::<Result<VecDeque<_>, _>>()?;
        for row in margin..self.rows() - margin {
            rows.push_back(along(row + distance)?);
            for column in 0..inner.len() {
                let (least, most) = rows.iter().fold((Label::MAX, Label::MIN), |(least, most), own| {
                    (least.min(own[column].0), most.max(own[column].1))
                });
                all += 1;
                uncertain += u64::from(least != most);
            }
            rows.pop_front();
            watch.finish(1);
        }
        Fraction::new(uncertain, all)
    }
}

/// The line fitted to points on logarithmic axes, with increasing abscissas.
fn fit(points: &[(f64, f64)]) -> BoundaryFit {
    if points.len() < FEWEST {
        return BoundaryFit::TooFew { distances: points.len() };
    }
    let slopes = points.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0));
    let slopes =
        slopes.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), own| (low.min(own), high.max(own)));
    let ends = (points[0], points[points.len() - 1]);
    let mean = (ends.1.1 - ends.0.1) / (ends.1.0 - ends.0.0);
    if slopes.1 - slopes.0 > SPREAD + SPREAD_OF_SLOPE * mean.abs() {
        return BoundaryFit::NoPowerLaw { slopes };
    }
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|point| of(point.0 - x, point.1 - y)).sum::<f64>();
    let square = sum(&|x, _| x * x);
    let exponent = sum(&|x, y| x * y) / square;
    let scatter = sum(&|x, y| (y - exponent * x) * (y - exponent * x));
    let standard_error = (scatter / ((count - 2.0) * square)).sqrt();
    BoundaryFit::PowerLaw { exponent, standard_error, dimension: 2.0 - exponent, slopes }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::SplitMix64;
    use crate::run::Unobserved;

    fn basins(columns: usize, rows: usize, label: impl Fn(usize, usize) -> Label) -> Basins {
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        Basins::of_labels(cells.map(|(row, column)| label(row, column)).collect(), columns).expect("legal")
    }

    fn dimension(basins: &Basins, distances: &[usize]) -> (f64, f64) {
        match basins.boundary_scaling(distances, &Unobserved).expect("fits").fit {
            BoundaryFit::PowerLaw { dimension, standard_error, .. } => (dimension, standard_error),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_scaling_tells_its_rows() {
        use core::ops::ControlFlow;
        use core::sync::atomic::{AtomicU64, Ordering};

        use crate::run::Progress;

        let halves = basins(3_000, 100, |row, _| if row < 50 { 1 } else { 2 });
        let last = AtomicU64::new(0);
        let told = |progress: Progress| {
            assert_eq!(progress.total, 3 * 92);
            last.store(progress.done, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        let found = halves.boundary_scaling(&[1, 2, 4], &told);
        assert_eq!(
            (found, last.load(Ordering::Relaxed)),
            (halves.boundary_scaling(&[1, 2, 4], &Unobserved), 3 * 92)
        );
    }

    #[test]
    fn a_straight_boundary_has_dimension_one() {
        let slanted = basins(300, 200, |row, column| if 2 * row > column + 60 { 1 } else { 2 });
        let (found, error) = dimension(&slanted, &[1, 2, 4, 8, 16]);
        assert!((found - 1.0).abs() < 0.02 && error < 0.02, "{found} {error}");
        let upright = basins(300, 200, |_, column| Label::from(column > 150));
        let (found, error) = dimension(&upright, &[1, 2, 4, 8, 16]);
        assert!((found - 1.0).abs() < 1e-13 && error < 1e-13, "{found} {error}");
    }

    /// The gaps of Cantor's set belong to two basins alternately, by size: the boundary is that set along the
    /// columns, and a line along the rows.
    #[test]
    fn a_cantor_set_has_its_dimension() {
        let digits = 7;
        let label = |column: usize| {
            let level = (0..digits).find(|level| column / 3_usize.pow(digits - 1 - level) % 3 == 1);
            level.map_or(0, |level| 1 + (level % 2) as Label)
        };
        let cantor = basins(3_usize.pow(digits), 60, |_, column| label(column));
        let (found, error) = dimension(&cantor, &[1, 3, 9, 27]);
        let expected = 1.0 + ln(2.0) / ln(3.0);
        assert!((found - expected).abs() < 0.02, "{found} and not {expected}");
        assert!(error < 0.02, "{error}");
    }

    #[test]
    fn chance_fills_the_plane() {
        let mut random = SplitMix64::new(1);
        let labels = (0..300 * 300).map(|_| (random.next_number() >> 40) as Label % 2).collect();
        let (found, _) = dimension(&Basins::of_labels(labels, 300).expect("legal"), &[1, 2, 4, 8, 16]);
        assert!((found - 2.0).abs() < 0.01, "{found}");
    }

    #[test]
    fn what_is_no_power_law_says_so() {
        // Stripes: beyond half their width everything is uncertain.
        let stripes = basins(200, 200, |_, column| Label::from(column / 8 % 2 == 0));
        let scaling = stripes.boundary_scaling(&[1, 2, 4, 8, 16], &Unobserved).expect("fits");
        assert!(matches!(scaling.fit, BoundaryFit::NoPowerLaw { slopes } if slopes.1 - slopes.0 > 0.3));
        // Nearly all cells are uncertain: 0.5, 0.75, 0.94 and 1 of them.
        let mut random = SplitMix64::new(2);
        let sparse = (0..300 * 300).map(|_| Label::from(random.unit() < 0.08)).collect();
        let sparse = Basins::of_labels(sparse, 300).expect("legal");
        let sparse = sparse.boundary_scaling(&[1, 2, 4, 8], &Unobserved).expect("fits");
        assert!(matches!(sparse.fit, BoundaryFit::NoPowerLaw { slopes } if slopes.0 < 0.01), "{sparse:?}");
        let one = basins(50, 50, |_, _| 1).boundary_scaling(&[1, 2, 4, 8], &Unobserved).expect("fits");
        assert_eq!(one.fit, BoundaryFit::TooFew { distances: 0 });
        assert!(
            one.shares.iter().all(|share| share.uncertain.count() == 0 && share.uncertain.of() == 34 * 34)
        );
        let two = basins(50, 50, |row, _| Label::from(row > 20))
            .boundary_scaling(&[1, 2], &Unobserved)
            .expect("fits");
        assert_eq!(two.fit, BoundaryFit::TooFew { distances: 2 });
        assert_eq!(two.shares[1].uncertain.count(), 4 * 46);
        // A single cell of another kind makes the square about it uncertain.
        let one = basins(50, 50, |row, column| Label::from((row, column) == (20, 30)));
        let one = one.boundary_scaling(&[1, 2, 5], &Unobserved).expect("fits");
        assert_eq!(one.shares.iter().map(|share| share.uncertain.count()).collect::<Vec<_>>(), [9, 25, 121]);
    }
}

//! The entropy of basins: the uncertainty of the fate of a start known only to within a box (A. Daza, A.
//! Wagemakers, B. Georgeot, D. Guery-Odelin, M. A. F. Sanjuan, Sci. Rep. 6, 31416 (2016)).

use super::{Basins, Label, UNDECIDED};
use crate::numerics::elementary::ln;
use crate::numerics::error::{Error, within};

/// The entropy of basins, in natural units.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BasinEntropy {
    /// Cells along each side of a box.
    pub box_side: usize,
    /// Boxes that lie completely within the grid.
    pub boxes: u64,
    /// Boxes with more than one label.
    pub boundary_boxes: u64,
    /// Undecided cells in the boxes. They count as a label of their own.
    pub undecided_cells: u64,
    /// Labels that occur in the boxes.
    pub labels: u64,
    /// S_b, the mean over the boxes of -sum p ln p with the shares p of the labels in a box: 0 if each box
    /// has one label, at most the logarithm of the number of labels.
    pub entropy: f64,
    /// S_bb, the same mean over the boxes with more than one label; `None` if there is no such box. A box cut
    /// by a smooth curve between two basins contributes at most ln 2. So a larger mean over boxes much
    /// smaller than the basins shows that the boundary is not smooth; a smaller mean shows nothing.
    pub boundary_entropy: Option<f64>,
}

impl Basins {
    /// The entropy over boxes of `box_side` x `box_side` cells in [2, 100 000]; incomplete boxes at the upper
    /// ends of the axes are omitted. Boxes of 5 x 5 cells are usual.
    ///
    /// ```
    /// use bouncing_disk_core::attractors::{Axis, BasinSettings, Grid};
    /// use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    ///
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.2)?, 0.5)?;
    /// let grid = Grid::new(Axis::new(0.0, 1.0, 20)?, Axis::new(0.0, 2.0, 20)?)?;
    /// // Under a weak forcing every disk comes to rest: nothing is uncertain.
    /// let entropy = map.basins(grid, &[], BasinSettings::default(), &Unobserved)?.entropy(5)?;
    /// assert_eq!((entropy.boxes, entropy.boundary_entropy), (16, None));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a side outside its range or above a side of the grid.
    pub fn entropy(&self, box_side: usize) -> Result<BasinEntropy, Error> {
        let shorter = self.columns().min(self.rows()) as f64;
        let side = box_side as f64;
        within(
            "cells along a box",
            side,
            2.0,
            100_000.0_f64.min(shorter),
            "[2, the shorter side of the grid]",
        )?;
        let cells = (box_side * box_side) as f64;
        let (mut sum, mut boundary_boxes, mut boxes) = (0.0, 0, 0);
        let mut totals = [0_u64; 256];
        for row in (0..=self.rows() - box_side).step_by(box_side) {
            for column in (0..=self.columns() - box_side).step_by(box_side) {
                let counts = self.counts((row, column), box_side);
                let present = counts.iter().filter(|count| **count > 0).count();
                let entropy = counts.iter().filter(|count| **count > 0).fold(0.0, |entropy, count| {
                    let share = f64::from(*count) / cells;
                    entropy - share * ln(share)
                });
                boxes += 1;
                if present > 1 {
                    boundary_boxes += 1;
                    sum += entropy;
                }
                for (total, count) in totals.iter_mut().zip(&counts) {
                    *total += u64::from(*count);
                }
            }
        }
        Ok(BasinEntropy {
            box_side,
            boxes,
            boundary_boxes,
            undecided_cells: totals[usize::from(UNDECIDED)],
            labels: totals.iter().filter(|total| **total > 0).count() as u64,
            entropy: sum / boxes as f64,
            boundary_entropy: (boundary_boxes > 0).then(|| sum / boundary_boxes as f64),
        })
    }

    /// The number of cells of a box with each label.
    fn counts(&self, (row, column): (usize, usize), side: usize) -> [u32; Label::MAX as usize + 1] {
        let mut counts = [0; Label::MAX as usize + 1];
        for line in row..row + side {
            for label in &self.row(line)[column..column + side] {
                counts[usize::from(*label)] += 1;
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::SplitMix64;

    fn basins(columns: usize, rows: usize, label: impl Fn(usize, usize) -> Label) -> Basins {
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        Basins::of_labels(cells.map(|(row, column)| label(row, column)).collect(), columns).expect("legal")
    }

    /// By hand: four boxes of 2 x 2, of which one has two labels in equal parts, and one has a single cell
    /// with another label.
    #[test]
    fn the_entropy_of_four_boxes_is_that_by_hand() {
        let basins = basins(5, 4, |row, column| match (row, column) {
            (0 | 1, 1) | (3, 3) | (_, 4) => 2,
            _ => 1,
        });
        let entropy = basins.entropy(2).expect("fits");
        assert_eq!((entropy.boxes, entropy.boundary_boxes, entropy.labels), (4, 2, 2));
        let sum = ln(2.0) - (0.75 * ln(0.75) + 0.25 * ln(0.25));
        assert!((entropy.entropy - sum / 4.0).abs() < 1e-15, "{entropy:?}");
        assert!(entropy.boundary_entropy.is_some_and(|own| (own - sum / 2.0).abs() < 1e-15));
    }

    /// Random cells of three kinds have nearly the largest possible entropy, and a straight boundary stays
    /// below ln 2.
    #[test]
    fn the_limits_are_those_of_order_and_of_chance() {
        let mut random = SplitMix64::new(1);
        let chance: Vec<_> = (0..200 * 200).map(|_| (random.next_number() % 3) as Label).collect();
        let chance = Basins::of_labels(chance, 200).expect("legal").entropy(20).expect("fits");
        assert!(chance.entropy < ln(3.0) && chance.entropy > ln(3.0) - 0.01, "{chance:?}");
        assert_eq!(chance.boundary_boxes, chance.boxes);
        assert!(chance.undecided_cells > 13_000 && chance.undecided_cells < 13_700);
        let straight = basins(200, 200, |row, column| if row > column + 13 { 2 } else { 1 });
        let straight = straight.entropy(20).expect("fits");
        assert!(straight.boundary_entropy.is_some_and(|own| own < ln(2.0)), "{straight:?}");
        let one = basins(200, 200, |_, _| 7).entropy(200).expect("fits");
        assert_eq!((one.entropy.to_bits(), one.boundary_entropy, one.labels, one.boxes), (0, None, 1, 1));
    }
}

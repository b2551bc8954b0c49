//! The cells of a grid that an orbit has visited. They represent an aperiodic attractor.

use core::f64::consts::TAU;

use crate::map::impact_map::ImpactState;
use crate::numerics::error::{Error, not_negative, within};
use crate::numerics::stored::read_checked;

/// Cells that contain impacts of an orbit, in a grid with the same number of cells along both axes: the phase
/// from 0 to 2 pi, and the impact speed from 0 to `top`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedCells"))]
pub struct VisitedCells {
    side: u32,
    top: f64,
    visited: Vec<u32>,
}

read_checked!(VisitedCells as UncheckedCells {
    side: u32,
    top: f64,
    visited: Vec<u32>,
});

impl VisitedCells {
    /// The fewest and the most cells along an axis.
    pub const SIDES: (u32, u32) = (8, 4_096);

    /// Checks deserialised cells: cells of the grid, in increasing order.
    fn check(&self) -> Result<(), Error> {
        let (least, most) = Self::SIDES;
        within("cells along an axis", self.side.into(), least.into(), most.into(), "[8, 4096]")?;
        not_negative("largest impact speed", self.top)?;
        let cells = self.side * self.side;
        if let Some(beyond) = self.visited.last().filter(|last| **last >= cells) {
            let (found, expected) = (u64::from(*beyond), u64::from(cells - 1));
            return Err(Error::Unfitting { what: "visited cell", found, expected });
        }
        if let Some(pair) = self.visited.windows(2).find(|pair| pair[0] >= pair[1]) {
            let (found, expected) = (u64::from(pair[0]), u64::from(pair[1].saturating_sub(1)));
            return Err(Error::Unfitting { what: "visited cell, out of order", found, expected });
        }
        Ok(())
    }

    /// Cells along each axis.
    #[must_use]
    pub const fn side(&self) -> u32 {
        self.side
    }

    /// The upper end of the axis of impact speeds (units of g/omega).
    #[must_use]
    pub const fn top(&self) -> f64 {
        self.top
    }

    /// The visited cells in increasing order: slowest impacts first, each row by phase.
    #[must_use]
    pub fn visited(&self) -> &[u32] {
        &self.visited
    }

    /// Whether the cell of this impact has been visited; false beyond the top.
    #[must_use]
    pub fn contains(&self, state: ImpactState) -> bool {
        cell(self.side, self.top, state).is_some_and(|cell| self.visited.binary_search(&cell).is_ok())
    }

    /// The centres of the visited cells, in the same order: phase (rad) and impact velocity (units of
    /// g/omega, < 0).
    pub fn centres(&self) -> impl Iterator<Item = (f64, f64)> {
        let side = f64::from(self.side);
        self.visited.iter().map(move |cell| {
            let (row, column) = (cell / self.side, cell % self.side);
            (TAU * (f64::from(column) + 0.5) / side, -self.top * (f64::from(row) + 0.5) / side)
        })
    }
}

/// The number of the cell of an impact; `None` beyond the top.
fn cell(side: u32, top: f64, state: ImpactState) -> Option<u32> {
    let along = |share: f64| ((f64::from(side) * share) as u32).min(side - 1);
    let speed = -state.velocity();
    if speed > top {
        return None;
    }
    let row = if top > 0.0 { along(speed / top) } else { 0 };
    Some(row * side + along(state.phase().angle() / TAU))
}

/// Marks cells as an orbit visits them.
#[derive(Debug, Clone)]
pub(super) struct CellMarks {
    side: u32,
    top: f64,
    marks: Vec<bool>,
}

impl CellMarks {
    pub(super) fn new(side: u32, top: f64) -> Self {
        Self { side, top, marks: vec![false; side as usize * side as usize] }
    }

    /// Marks the cell of an impact, and returns whether it was marked before. An impact beyond the top has no
    /// cell.
    pub(super) fn visit(&mut self, state: ImpactState) -> bool {
        let cell = cell(self.side, self.top, state);
        cell.is_some_and(|cell| core::mem::replace(&mut self.marks[cell as usize], true))
    }

    /// Forgets all visits.
    pub(super) fn clear(&mut self) {
        self.marks.fill(false);
    }

    pub(super) fn into_cells(self) -> VisitedCells {
        let visited = (0_u32..).zip(&self.marks).filter_map(|(cell, mark)| mark.then_some(cell)).collect();
        VisitedCells { side: self.side, top: self.top, visited }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::platform::phase::Phase;
    use crate::numerics::testing::stored;

    fn state(angle: f64, speed: f64) -> ImpactState {
        ImpactState::of_impact(Phase::of_angle(angle), -speed)
    }

    #[test]
    fn every_impact_up_to_the_top_has_a_cell_and_none_beyond() {
        let edges = [
            (0.0, 0.0),
            (TAU.next_down(), 0.0),
            (0.0, 3.0),
            (TAU.next_down(), 3.0),
            (1.0, 3.0_f64.next_down()),
            (3.0, f64::from_bits(1)),
        ];
        let mut marks = CellMarks::new(16, 3.0);
        for (angle, speed) in edges {
            marks.visit(state(angle, speed));
        }
        marks.visit(state(1.0, 3.0_f64.next_up()));
        let cells = stored(&marks.clone().into_cells());
        assert!(edges.iter().all(|&(angle, speed)| cells.contains(state(angle, speed))));
        assert!(!cells.contains(state(1.0, 3.0_f64.next_up())) && !cells.contains(state(1.0, 1.5)));
        assert_eq!(cells.visited(), [0, 7, 15, 15 * 16, 15 * 16 + 2, 16 * 16 - 1]);
        // The centre of a cell lies in it.
        assert!(cells.centres().all(|(angle, velocity)| cells.contains(state(angle, -velocity))));
        marks.clear();
        assert!(marks.into_cells().visited().is_empty());
    }

    #[test]
    fn a_platform_at_rest_has_one_row() {
        let mut marks = CellMarks::new(8, 0.0);
        marks.visit(state(1.0, 0.0));
        marks.visit(state(1.0, 1e-300));
        assert_eq!(marks.into_cells().visited().len(), 1);
    }

    #[cfg(feature = "serde")]
    #[test]
    fn stored_cells_that_are_none_are_refused() {
        let read = |text: &str| serde_json::from_str::<VisitedCells>(text);
        assert!(read(r#"{"side":8,"top":1.0,"visited":[0,63]}"#).is_ok());
        for text in [
            r#"{"side":8,"top":1.0,"visited":[0,64]}"#,
            r#"{"side":8,"top":1.0,"visited":[5,5]}"#,
            r#"{"side":8,"top":1.0,"visited":[6,5]}"#,
            r#"{"side":7,"top":1.0,"visited":[]}"#,
            r#"{"side":4097,"top":1.0,"visited":[]}"#,
            r#"{"side":8,"top":-1.0,"visited":[]}"#,
            r#"{"side":8,"top":1.0,"visited":[],"more":1}"#,
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}

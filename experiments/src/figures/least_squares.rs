//! Dense least squares with bounds, solved by faer.
//!
//! The last bits of faer's numbers depend on the processor, and data have digests. Whoever takes numbers from
//! here therefore rounds them to what they mean before anything is computed from them.

use faer::linalg::solvers::SolveLstsq;
use faer::{Col, Mat, MatRef};

/// Share of the product of two vectors' lengths below which their product counts as 0.
const ROUNDING: f64 = 1e-12;

/// normal · x <= limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bound<const N: usize> {
    pub(crate) normal: [f64; N],
    pub(crate) limit: f64,
}

/// The shortest vector within all bounds, `None` if there is none: least distance programming by non-negative
/// least squares (Lawson and Hanson, *Solving Least Squares Problems*, 1974, chapter 23).
pub(crate) fn shortest<const N: usize>(bounds: &[Bound<N>]) -> Option<[f64; N]> {
    let columns = Mat::from_fn(N + 1, bounds.len(), |row, index| {
        -bounds[index].normal.get(row).copied().unwrap_or(bounds[index].limit)
    });
    let last = Col::from_fn(N + 1, |row| f64::from(u8::from(row == N)));
    let multipliers = non_negative_least_squares(columns.as_ref(), &last);
    let rest = &last - &columns * multipliers;
    // Nothing is left where the bounds exclude each other.
    (rest[N] > ROUNDING).then(|| std::array::from_fn(|index| -rest[index] / rest[N]))
}

/// The x >= 0 for which |columns · x − right| is least.
fn non_negative_least_squares(columns: MatRef<'_, f64>, right: &Col<f64>) -> Col<f64> {
    let count = columns.ncols();
    let mut x = Col::<f64>::zeros(count);
    let mut free: Vec<usize> = Vec::new();
    // Each set of free unknowns comes at most once; in practice there are few. Rounding alone could go on.
    for _ in 0..10 * count {
        let rest = right - columns * &x;
        // What a unit of each unknown that is held at 0 would gain, over the most that it could.
        let gain = |index: usize| {
            let column = columns.col(index);
            (column.transpose() * &rest) / (column.norm_l2() * right.norm_l2())
        };
        let held = (0..count).filter(|index| !free.contains(index)).map(|index| (gain(index), index));
        let best = held.filter(|(gain, _)| *gain > ROUNDING).max_by(|one, other| one.0.total_cmp(&other.0));
        let Some((_, index)) = best else { break };
        free.push(index);
        // The solution without bounds, or as far towards it as no unknown becomes negative.
        while !free.is_empty() {
            let chosen = Mat::from_fn(columns.nrows(), free.len(), |row, place| columns[(row, free[place])]);
            let goal = chosen.qr().solve_lstsq(right);
            let share = |place: usize| {
                let now = x[free[place]];
                if now > 0.0 { now / (now - goal[place]) } else { 0.0 }
            };
            let first = (0..free.len())
                .filter(|&place| goal[place] <= 0.0)
                .min_by(|&one, &other| share(one).total_cmp(&share(other)));
            let step = first.map_or(1.0, share);
            for (place, &index) in free.iter().enumerate() {
                x[index] += step * (goal[place] - x[index]);
            }
            let Some(place) = first else { break };
            x[free.swap_remove(place)] = 0.0;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::synthetic::Noise;

    fn dot<const N: usize>(one: &[f64; N], other: &[f64; N]) -> f64 {
        one.iter().zip(other).map(|(one, other)| one * other).sum()
    }

    #[test]
    fn the_shortest_vector_lies_on_the_bounds_that_exclude_the_origin() {
        let bounds = [
            Bound { normal: [-1.0, -1.0, 0.0, 0.0, 0.0], limit: -2.0 },
            Bound { normal: [-1.0, 0.0, 0.0, 0.0, 0.0], limit: -1.5 },
            Bound { normal: [0.0, 0.0, 1.0, 0.0, 0.0], limit: 7.0 },
        ];
        let vector = shortest(&bounds).expect("the bounds leave room");
        let expected = [1.5, 0.5, 0.0, 0.0, 0.0];
        assert!(vector.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-12), "{vector:?}");
        assert_eq!(shortest(&bounds[2..]), Some([0.0; 5]), "nothing excludes the origin");
    }

    #[test]
    fn bounds_that_exclude_each_other_leave_no_vector() {
        let bounds = [Bound { normal: [1.0, 1.0], limit: -1.0 }, Bound { normal: [-1.0, -1.0], limit: 0.5 }];
        assert_eq!(shortest(&bounds), None);
    }

    /// No vector within the bounds lies on the near side of the plane through the shortest one and across it.
    #[test]
    fn every_vector_within_the_bounds_lies_beyond_the_shortest() {
        let mut noise = Noise::new(5);
        let mut noise = || 2.0 * noise.even() - 1.0;
        let mut excluded = 0;
        for _ in 0..200 {
            let normals: [[f64; 4]; 9] = std::array::from_fn(|_| std::array::from_fn(|_| noise()));
            // Room for one vector at least, and often not for the origin.
            let inside: [f64; 4] = std::array::from_fn(|_| 2.0 * noise());
            let bounds =
                normals.map(|normal| Bound { normal, limit: dot(&normal, &inside) + 0.2 * noise().abs() });
            let vector = shortest(&bounds).expect("there is room");
            for bound in &bounds {
                assert!(dot(&bound.normal, &vector) <= bound.limit + 1e-12, "{bound:?} {vector:?}");
            }
            excluded += u32::from(dot(&vector, &vector) > 0.0);
            // On the way from one vector to the other as far as the bounds allow.
            for _ in 0..50 {
                let aim: [f64; 4] = std::array::from_fn(|_| 3.0 * noise());
                let way: [f64; 4] = std::array::from_fn(|index| aim[index] - inside[index]);
                let reach = bounds.iter().fold(1.0_f64, |reach, bound| {
                    let pace = dot(&bound.normal, &way);
                    if pace > 0.0 {
                        reach.min((bound.limit - dot(&bound.normal, &inside)) / pace)
                    } else {
                        reach
                    }
                });
                let other: [f64; 4] = std::array::from_fn(|index| inside[index] + reach * way[index]);
                assert!(dot(&vector, &other) >= dot(&vector, &vector) - 1e-11, "{vector:?} {other:?}");
            }
        }
        assert!(excluded > 100, "{excluded}");
    }
}

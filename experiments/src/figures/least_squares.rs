//! Dense least squares with bounds, solved by faer.
//!
//! The last bits of faer's numbers depend on the processor, and data have digests. Whoever takes numbers from
//! here therefore rounds them to what they mean before anything is computed from them.

use faer::linalg::solvers::SolveLstsq;
use faer::{Col, Mat, MatRef};

/// Rounding of a product of unit vectors, one of which comes out of a linear system: some dozens of units in the last
/// place. Gains below it count as none, and columns that are no more independent than that as dependent.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Bounds that exclude each other once each of them is changed by this share of itself count as excluding each
/// other: see [`shortest`]. Nearer to that than [`ROUNDING`] nothing could be told, and between the two the vector
/// would have few digits.
const EXCLUSION: f64 = 1e-12;

/// Steps for each unknown after which the search is given up. Lawson and Hanson allow three; it needs about one
/// for each unknown that ends above 0.
const STEPS_PER_UNKNOWN: usize = 10;

/// normal · x <= limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bound<const N: usize> {
    pub(crate) normal: [f64; N],
    pub(crate) limit: f64,
}

/// Why there is no shortest vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum NoShortest {
    /// No vector lies within all bounds.
    #[error("the bounds exclude each other")]
    Exclusive,
    /// Whether there is one is not known.
    #[error("the search among {bounds} bounds did not settle within {steps} steps")]
    Unsettled { bounds: usize, steps: usize },
    /// A normal, a limit or the distance of the plane from the origin is infinite or not a number.
    #[error("bound {index} is not finite")]
    NotFinite { index: usize },
}

/// The shortest vector within all bounds: least distance programming by non-negative least squares (Lawson and
/// Hanson, *Solving Least Squares Problems*, 1974, chapter 23).
///
/// # When bounds count as excluding each other
///
/// What the bounds mean depends neither on the lengths of their normals nor on the unit of x, so neither may the
/// answer. Each is therefore divided by the length of its normal, which leaves the distance of its plane from the
/// origin as its limit, and all distances by the largest of those that exclude the origin. Of these numbers each
/// bound makes a column (−normal, −limit) of length 1. Multipliers u >= 0 of the columns that sum up to
/// (0, ..., 0, 1) prove that no vector lies within all bounds (Farkas), and as far as the best sum is away from
/// that, |rest|, the columns have to be changed for such a proof: by |rest| / Σ u, as a share of each. Where this
/// share is below [`EXCLUSION`], the bounds count as excluding each other. A limit on the length of the vector would
/// not do: it may be long because the bounds are far away, or because they leave room only far off, where two nearly
/// opposite ones meet. The first has no influence here, and the second up to 1e12 times the distance of the farthest.
///
/// A bound that the vector breaks by no more than [`ROUNDING`] of its length counts as kept.
///
/// # Errors
/// [`NoShortest`] says whether the bounds exclude each other or nothing was found.
pub(crate) fn shortest<const N: usize>(bounds: &[Bound<N>]) -> Result<[f64; N], NoShortest> {
    shortest_within(bounds, STEPS_PER_UNKNOWN * bounds.len())
}

fn shortest_within<const N: usize>(bounds: &[Bound<N>], steps: usize) -> Result<[f64; N], NoShortest> {
    let mut planes = Vec::with_capacity(bounds.len());
    for (index, bound) in bounds.iter().enumerate() {
        if !bound.normal.iter().chain([&bound.limit]).all(|number| number.is_finite()) {
            return Err(NoShortest::NotFinite { index });
        }
        // A bound without a direction holds everywhere or nowhere.
        match Plane::of(bound) {
            Some(plane) if plane.distance == f64::INFINITY => return Err(NoShortest::NotFinite { index }),
            Some(plane) => planes.push(plane),
            None if bound.limit < 0.0 => return Err(NoShortest::Exclusive),
            None => {}
        }
    }
    let farthest = planes.iter().fold(0.0_f64, |farthest, plane| farthest.max(plane.distance));
    if farthest == 0.0 {
        return Ok([0.0; N]);
    }
    for plane in &mut planes {
        // What is so far away on the other side is not reached, however far.
        plane.distance = (plane.distance / farthest).max(-f64::MAX);
    }
    let nearest = nearest_within(&planes, steps)?;
    Ok(nearest.map(|part| farthest * part))
}

/// The vectors with inward · x >= distance.
struct Plane<const N: usize> {
    /// Has length 1.
    inward: [f64; N],
    /// From the origin, negative where the origin lies within.
    distance: f64,
}

impl<const N: usize> Plane<N> {
    /// Of a finite bound; none has no direction.
    fn of(bound: &Bound<N>) -> Option<Self> {
        let size = length(&bound.normal);
        (size > 0.0)
            .then(|| Self { inward: bound.normal.map(|part| -part / size), distance: -bound.limit / size })
    }
}

/// The length of a vector, whose squares may be beyond what a double holds.
fn length(vector: &[f64]) -> f64 {
    let largest = vector.iter().fold(0.0_f64, |largest, part| largest.max(part.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    largest * vector.iter().map(|part| (part / largest) * (part / largest)).sum::<f64>().sqrt()
}

/// The shortest vector on all these planes, whose directions are independent.
fn nearest_on<const N: usize>(planes: &[&Plane<N>]) -> [f64; N] {
    let decomposition = Mat::from_fn(N, planes.len(), |row, place| planes[place].inward[row]).qr();
    let (basis, triangle) = (decomposition.compute_thin_Q(), decomposition.thin_R());
    let mut parts: Vec<f64> = Vec::with_capacity(planes.len());
    for (place, plane) in planes.iter().enumerate() {
        let known: f64 = parts.iter().enumerate().map(|(row, part)| triangle[(row, place)] * part).sum();
        parts.push((plane.distance - known) / triangle[(place, place)]);
    }
    std::array::from_fn(|row| parts.iter().enumerate().map(|(place, part)| basis[(row, place)] * part).sum())
}

/// The shortest vector on the far side of all planes, of which the farthest from the origin has the distance 1: by the
/// multipliers u >= 0 for which the columns sum up to (0, ..., 0, 1) as nearly as they can. What is missing there, the
/// rest, is the vector itself times -1, and 1 below it, both times a common factor.
fn nearest_within<const N: usize>(planes: &[Plane<N>], steps: usize) -> Result<[f64; N], NoShortest> {
    let count = planes.len();
    let columns = Mat::from_fn(N + 1, count, |row, index| {
        let Plane { inward, distance } = &planes[index];
        inward.get(row).unwrap_or(distance) / length(&[length(inward), *distance])
    });
    let last = Col::from_fn(N + 1, |row| f64::from(u8::from(row == N)));
    let mut multipliers = Col::<f64>::zeros(count);
    let mut free: Vec<usize> = Vec::new();
    // Multipliers that were refused since the others have last changed.
    let mut refused: Vec<usize> = Vec::new();
    // Each set of free multipliers comes at most once, as each is better than the one before; in practice there are
    // few. Rounding alone could go on.
    for _ in 0..steps {
        let rest = &last - &columns * &multipliers;
        // More independent columns than x has components sum up to anything.
        if free.len() > N || rest.norm_l2() <= EXCLUSION * multipliers.sum() {
            return Err(NoShortest::Exclusive);
        }
        // The vector lies on the planes with multipliers. From these it has more digits than from the rest, which is the
        // shorter the longer the vector.
        let vector = nearest_on(&free.iter().map(|&index| &planes[index]).collect::<Vec<_>>());
        let size = length(&[length(&vector), 1.0]);
        if !size.is_finite() {
            break;
        }
        let direction = Col::from_fn(N + 1, |row| vector.get(row).map_or(1.0, |part| -part) / size);
        // What a unit of each multiplier that is held at 0 would gain: how far the vector is from the plane.
        let gain = |index: usize| columns.col(index).transpose() * &direction;
        let best = (0..count)
            .filter(|index| !free.contains(index) && !refused.contains(index))
            .map(|index| (gain(index), index))
            .filter(|(gain, _)| *gain > ROUNDING)
            .max_by(|one, other| one.0.total_cmp(&other.0));
        let Some((_, index)) = best else { return Ok(vector) };
        free.push(index);
        let mut goal = solution(columns.as_ref(), &free, &last);
        // What is freed has to grow, and its column to be independent of the others. Else the gain was rounding, and
        // it would be chosen again and again.
        if !goal.as_ref().is_some_and(|goal| goal[free.len() - 1] > 0.0) {
            free.pop();
            refused.push(index);
            continue;
        }
        refused.clear();
        // As far towards the solution as no multiplier becomes negative; those that end at 0 are held again.
        while let Some(aim) = &goal {
            let share = |place: usize| {
                let now = multipliers[free[place]];
                now / (now - aim[place])
            };
            let first = (0..free.len())
                .filter(|&place| aim[place] <= 0.0)
                .min_by(|&one, &other| share(one).total_cmp(&share(other)));
            let step = first.map_or(1.0, share);
            for (place, &index) in free.iter().enumerate() {
                multipliers[index] += step * (aim[place] - multipliers[index]);
            }
            let Some(place) = first else { break };
            multipliers[free[place]] = 0.0;
            free.retain(|&index| multipliers[index] > 0.0);
            goal = solution(columns.as_ref(), &free, &last);
        }
        for index in (0..count).filter(|index| !free.contains(index)) {
            multipliers[index] = 0.0;
        }
    }
    Err(NoShortest::Unsettled { bounds: count, steps })
}

/// The least squares solution by these columns, `None` if they depend on each other.
fn solution(columns: MatRef<'_, f64>, free: &[usize], right: &Col<f64>) -> Option<Col<f64>> {
    if free.is_empty() || free.len() > columns.nrows() {
        return None;
    }
    let decomposition =
        Mat::from_fn(columns.nrows(), free.len(), |row, place| columns[(row, free[place])]).qr();
    let triangle = decomposition.thin_R();
    let independent = (0..free.len()).all(|place| triangle[(place, place)].abs() > ROUNDING);
    independent.then(|| decomposition.solve_lstsq(right))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::synthetic::Noise;

    fn dot<const N: usize>(one: &[f64; N], other: &[f64; N]) -> f64 {
        one.iter().zip(other).map(|(one, other)| one * other).sum()
    }

    fn size<const N: usize>(vector: &[f64; N]) -> f64 {
        dot(vector, vector).sqrt()
    }

    fn bound<const N: usize>(normal: [f64; N], limit: f64) -> Bound<N> {
        Bound { normal, limit }
    }

    /// As if the unit of x were smaller by `unit`, and each bound multiplied by one of `weights` in turn.
    fn scaled<const N: usize>(bounds: &[Bound<N>], unit: f64, weights: &[f64]) -> Vec<Bound<N>> {
        let weighted = |(bound, weight): (&Bound<N>, &f64)| Bound {
            normal: bound.normal.map(|part| part * weight),
            limit: bound.limit * weight * unit,
        };
        bounds.iter().zip(weights.iter().cycle()).map(weighted).collect()
    }

    /// The multipliers of these normals that sum up to `goal`: Gauss's elimination of the normal equations, `None` where
    /// the normals depend on each other.
    fn multipliers<const N: usize>(normals: &[[f64; N]], goal: &[f64; N]) -> Option<Vec<f64>> {
        let count = normals.len();
        let mut rows: Vec<Vec<f64>> = normals
            .iter()
            .map(|one| normals.iter().map(|other| dot(one, other)).chain([dot(one, goal)]).collect())
            .collect();
        for step in 0..count {
            let pivot = (step..count).max_by(|&a, &b| rows[a][step].abs().total_cmp(&rows[b][step].abs()))?;
            rows.swap(step, pivot);
            if rows[step][step].abs() < 1e-30 {
                return None;
            }
            let chosen = rows[step].clone();
            for (_, row) in rows.iter_mut().enumerate().filter(|(row, _)| *row != step) {
                let share = row[step] / chosen[step];
                row.iter_mut().zip(&chosen).skip(step).for_each(|(part, own)| *part -= share * own);
            }
        }
        Some((0..count).map(|row| rows[row][count] / rows[row][row]).collect())
    }

    /// The conditions of Karush, Kuhn and Tucker, which only the shortest vector within all bounds meets: it keeps
    /// the bounds, and is minus a sum of normals of those that it lies on, no multiplier negative. By Caratheodory N of
    /// these are enough, so that all choices are tried.
    fn is_shortest<const N: usize>(bounds: &[Bound<N>], x: &[f64; N]) -> bool {
        let planes: Vec<([f64; N], f64)> = bounds
            .iter()
            .filter(|bound| size(&bound.normal) > 0.0)
            .map(|bound| {
                (bound.normal.map(|part| part / size(&bound.normal)), bound.limit / size(&bound.normal))
            })
            .collect();
        let farthest = planes.iter().fold(0.0_f64, |farthest, (_, limit)| farthest.max(-limit));
        let tolerance = 1e-12 * (farthest + size(x));
        let room = |(normal, limit): &([f64; N], f64)| limit - dot(normal, x);
        if planes.iter().any(|plane| room(plane) < -tolerance) {
            return false;
        }
        if size(x) == 0.0 {
            return true;
        }
        let on: Vec<[f64; N]> =
            planes.iter().filter(|plane| room(plane) <= tolerance).map(|plane| plane.0).collect();
        let outward = x.map(|part| -part / size(x));
        assert!(on.len() < 16, "too many choices");
        (1..1_usize << on.len()).filter(|choice| choice.count_ones() as usize <= N).any(|choice| {
            let chosen: Vec<[f64; N]> =
                (0..on.len()).filter(|place| choice >> place & 1 == 1).map(|place| on[place]).collect();
            multipliers(&chosen, &outward).is_some_and(|shares| {
                let most = shares.iter().fold(1.0_f64, |most, share| most.max(share.abs()));
                let off: [f64; N] = std::array::from_fn(|row| {
                    let sum: f64 =
                        chosen.iter().zip(&shares).map(|(normal, share)| share * normal[row]).sum();
                    outward[row] - sum
                });
                shares.iter().all(|share| *share >= -1e-9 * most) && size(&off) <= 1e-9 * most
            })
        })
    }

    const UNITS: [f64; 3] = [1e-8, 1.0, 1e8];
    const WEIGHTS: [f64; 5] = [1.0, 1e8, 3.0, 1e-8, 0.7];

    fn random<const N: usize>(noise: &mut Noise) -> [f64; N] {
        std::array::from_fn(|_| 2.0 * noise.even() - 1.0)
    }

    #[test]
    fn the_conditions_hold_for_the_shortest_vector_only() {
        let bounds = [bound([-1.0, -1.0], -2.0), bound([-1.0, 0.0], -1.5), bound([0.0, 1.0], 3.0)];
        assert!(is_shortest(&bounds, &[1.5, 0.5]));
        for other in [[1.0, 1.0], [1.5, 0.6], [2.0, 0.0], [1.5, 0.4], [0.0, 0.0], [-1.0, 3.0]] {
            assert!(!is_shortest(&bounds, &other), "{other:?}");
        }
        assert!(is_shortest(&bounds[2..], &[0.0, 0.0]) && !is_shortest(&bounds[2..], &[0.0, 3.0]));
    }

    #[test]
    fn the_shortest_vector_lies_on_the_bounds_that_exclude_the_origin() {
        let bounds = [
            bound([-1.0, -1.0, 0.0, 0.0, 0.0], -2.0),
            bound([-1.0, 0.0, 0.0, 0.0, 0.0], -1.5),
            bound([0.0, 0.0, 1.0, 0.0, 0.0], 7.0),
        ];
        let vector = shortest(&bounds).expect("the bounds leave room");
        let expected = [1.5, 0.5, 0.0, 0.0, 0.0];
        assert!(vector.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-14), "{vector:?}");
        assert_eq!(shortest(&bounds[2..]), Ok([0.0; 5]), "nothing excludes the origin");
        assert_eq!(shortest::<5>(&[]), Ok([0.0; 5]));
    }

    /// A slab between two planes: as thin as may be there is room in it, and none as soon as they change places.
    #[test]
    fn planes_that_face_each_other_leave_room_or_not_by_their_gap_in_any_unit() {
        let direction = [0.6, 0.0, -0.8];
        let opposite = direction.map(|part: f64| -part);
        for unit in UNITS {
            for gap in [0.0, 1e-15, 1e-12, 1e-9, 1e-3, 1.0, 1e9] {
                let slab = [bound(opposite, -1.0), bound(direction, 1.0 + gap)];
                let slab = scaled(&slab, unit, &WEIGHTS);
                let vector = shortest(&slab).expect("there is room");
                assert!(is_shortest(&slab, &vector), "{unit} {gap} {vector:?}");
                assert!((size(&vector) / unit - 1.0).abs() < 1e-14, "{unit} {gap} {vector:?}");
            }
            for gap in [1e-12, 1e-9, 1e-3, 0.5, 1.0, 3.0] {
                let slab = [bound(opposite, -1.0), bound(direction, 1.0 - gap), bound([1.0, 0.0, 0.0], 9.0)];
                assert_eq!(
                    shortest(&scaled(&slab, unit, &WEIGHTS)),
                    Err(NoShortest::Exclusive),
                    "{unit} {gap}"
                );
            }
        }
    }

    /// Two planes that are nearly opposite meet far away: the shortest vector goes there, however long it is, as
    /// long as the angle is more than rounding.
    #[test]
    fn room_that_is_left_only_far_off_is_found() {
        for unit in UNITS {
            for angle in [1.0, 1e-3, 1e-5, 1e-6, 1e-7, 1e-9, 1e-11] {
                let wedge = [bound([0.0, -1.0, 0.0], -1.0), bound([-angle, 1.0, 0.0], 0.0)];
                let bounds = scaled(&wedge, unit, &WEIGHTS);
                let vector = shortest(&bounds).expect("there is room");
                // The normal equations of the check square the angle.
                assert!(angle < 1e-8 || is_shortest(&bounds, &vector), "{unit} {angle} {vector:?}");
                let expected = [unit / angle, unit, 0.0];
                let off =
                    vector.iter().zip(expected).all(|(part, right)| (part - right).abs() <= 1e-4 * right);
                assert!(off, "{unit} {angle} {vector:?}");
                // A plane across the wedge before its end, and one behind it.
                let cut = |reach: f64| {
                    let across = bound([1.0, 0.0, 0.0], reach / angle);
                    shortest(&scaled(&[wedge[0], wedge[1], across], unit, &WEIGHTS))
                };
                assert_eq!(cut(0.9), Err(NoShortest::Exclusive), "{unit} {angle}");
                assert!(cut(1.1).is_ok(), "{unit} {angle}");
            }
            let shut = [bound([0.0, -1.0, 0.0], -1.0), bound([-1e-13, 1.0, 0.0], 0.0)];
            assert_eq!(shortest(&scaled(&shut, unit, &WEIGHTS)), Err(NoShortest::Exclusive), "{unit}");
        }
    }

    #[test]
    fn a_bound_without_direction_holds_everywhere_or_nowhere() {
        let plane = bound([-1.0, 0.0], -2.0);
        for limit in [0.0, -0.0, 1.0, 1e300] {
            assert_eq!(shortest(&[bound([0.0, -0.0], limit), plane]), Ok([2.0, 0.0]), "{limit}");
            assert_eq!(shortest(&[bound([0.0, 0.0], limit)]), Ok([0.0, 0.0]), "{limit}");
        }
        for limit in [-1.0, -1e-300] {
            assert_eq!(shortest(&[plane, bound([0.0, 0.0], limit)]), Err(NoShortest::Exclusive), "{limit}");
        }
    }

    #[test]
    fn normals_of_any_length_are_directions() {
        for weight in [1e-290, 1e-160, 1e160, 1e290] {
            let vector =
                shortest(&[bound([-3.0 * weight, -4.0 * weight], -5.0 * weight)]).expect("there is room");
            assert!((vector[0] - 0.6).abs() < 1e-14 && (vector[1] - 0.8).abs() < 1e-14, "{vector:?}");
        }
        let slack = bound([0.0, 1.0], 1e300);
        assert_eq!(shortest(&[bound([-1.0, 0.0], -1e-300), slack]), Ok([1e-300, 0.0]));
    }

    #[test]
    fn what_is_not_finite_is_named() {
        let plane = bound([-1.0, 0.0], -2.0);
        for bad in [
            bound([f64::NAN, 0.0], 1.0),
            bound([0.0, f64::INFINITY], 1.0),
            bound([1.0, 0.0], f64::NAN),
            bound([1.0, 0.0], f64::NEG_INFINITY),
            bound([-1e-300, 0.0], -1e300),
        ] {
            assert_eq!(shortest(&[plane, bad]), Err(NoShortest::NotFinite { index: 1 }), "{bad:?}");
        }
    }

    /// Each bound many times, with other weights, and some times almost: columns that depend on each other.
    #[test]
    fn bounds_that_stand_there_twice_change_nothing() {
        let mut noise = Noise::new(3);
        for _ in 0..200 {
            let inside: [f64; 3] = random::<3>(&mut noise).map(|part| 2.0 * part);
            let once: Vec<Bound<3>> = (0..4)
                .map(|_| {
                    let normal = random(&mut noise);
                    bound(normal, dot(&normal, &inside) + 0.1 * noise.even())
                })
                .collect();
            let vector = shortest(&once).expect("there is room");
            for moved in [0.0, 1e-16, 1e-13] {
                let mut again = |bound: &Bound<3>| Bound {
                    normal: bound.normal.map(|part| part * (1.0 + moved * noise.even())),
                    limit: bound.limit,
                };
                let twice: Vec<Bound<3>> = once.iter().copied().chain(once.iter().map(&mut again)).collect();
                let twice = scaled(&[twice.clone(), once.clone()].concat(), 1.0, &WEIGHTS);
                let same = shortest(&twice).expect("there is room");
                assert!((0..3).all(|row| (same[row] - vector[row]).abs() < 1e-9), "{same:?} {vector:?}");
                assert!(is_shortest(&twice, &same), "{twice:?} {same:?}");
            }
        }
    }

    /// Copies that differ by less than can be told have a gain and no room to grow: a search that frees the same one
    /// again and again would never settle.
    #[test]
    fn near_copies_do_not_send_the_search_round() {
        let planes =
            [bound([0.0, -1.0, 0.1], -1.0), bound([-1e-6, 1.0, 0.0], 0.0), bound([-0.3, 0.2, -0.5], -0.5)];
        let mut noise = Noise::new(11);
        let mut moved = || 3e-14 * (noise.even() - 0.5);
        for _ in 0..2000 {
            let near = [planes; 3].concat().into_iter().map(|plane: Bound<3>| Bound {
                normal: plane.normal.map(|part| part * (1.0 + moved()) + moved()),
                limit: plane.limit * (1.0 + moved()),
            });
            let near: Vec<Bound<3>> = near.collect();
            let vector = shortest_within(&near, 3 * near.len());
            assert!(vector.is_ok_and(|vector| is_shortest(&near, &vector)), "{near:?} {vector:?}");
        }
    }

    /// Many planes through one point, which is the shortest vector or not: more of them than unknowns can be free.
    #[test]
    fn a_corner_of_many_planes_is_found() {
        let mut noise = Noise::new(8);
        for round in 0..300 {
            let corner: [f64; 3] = random(&mut noise);
            let bounds: Vec<Bound<3>> = (0..10)
                .map(|_| random(&mut noise))
                .map(|normal: [f64; 3]| {
                    let push = if dot(&normal, &corner) > 0.0 { -1.0 } else { 1.0 };
                    normal.map(|part| push * part)
                })
                .map(|normal| bound(normal, dot(&normal, &corner)))
                .collect();
            let bounds = scaled(&bounds, UNITS[round % 3], &WEIGHTS);
            let vector = shortest(&bounds).expect("the corner is within");
            assert!(is_shortest(&bounds, &vector), "{bounds:?} {vector:?}");
            assert!(
                shortest_within(&bounds, 3 * bounds.len()).is_ok(),
                "as many steps as Lawson and Hanson allow"
            );
        }
    }

    #[test]
    fn random_bounds_with_room_have_a_shortest_vector_and_without_have_none() {
        let mut noise = Noise::new(5);
        let mut excluded = 0;
        for round in 0..600 {
            let unit = UNITS[round % 3];
            let normals: [[f64; 4]; 9] = std::array::from_fn(|_| random(&mut noise));
            // Room for one vector at least, and often not for the origin.
            let inside: [f64; 4] = random::<4>(&mut noise).map(|part| 2.0 * part);
            let bounds = normals.map(|normal| bound(normal, dot(&normal, &inside) + 0.2 * noise.even()));
            let bounds = scaled(&bounds, unit, &WEIGHTS);
            let vector = shortest(&bounds).expect("there is room");
            assert!(is_shortest(&bounds, &vector), "{bounds:?} {vector:?}");
            excluded += u32::from(size(&vector) > 0.0);
            // One more, against a sum of others with positive multipliers: beyond what these leave there is none.
            let shares: [f64; 4] = std::array::from_fn(|_| noise.even());
            let sum = |value: &dyn Fn(&Bound<4>) -> f64| -> f64 {
                shares
                    .iter()
                    .zip(&bounds)
                    .zip(&WEIGHTS)
                    .map(|((share, one), weight)| share * value(one) / weight)
                    .sum()
            };
            let against: [f64; 4] = std::array::from_fn(|row| -sum(&|one| one.normal[row]));
            let limit = -sum(&|one| one.limit);
            for beyond in [1e-9, 1e-3, 1.0] {
                let shut = [bounds.clone(), vec![bound(against, limit - beyond * unit)]].concat();
                assert_eq!(shortest(&shut), Err(NoShortest::Exclusive), "{beyond} {shut:?}");
                // On the other side a simplex is left of which these bounds are the faces.
                let open = [&bounds[..4], &[bound(against, limit + beyond * unit)]].concat();
                let vector = shortest(&open);
                assert!(
                    vector.is_ok_and(|vector| is_shortest(&open, &vector)),
                    "{beyond} {vector:?} {open:?}"
                );
            }
        }
        assert!(excluded > 300, "{excluded}");
    }

    #[test]
    fn a_search_that_is_broken_off_says_so() {
        let bounds = [bound([-1.0, -1.0], -2.0), bound([-1.0, 0.0], -1.5)];
        for steps in 0..3 {
            assert_eq!(shortest_within(&bounds, steps), Err(NoShortest::Unsettled { bounds: 2, steps }));
        }
        assert!(shortest_within(&bounds, 3).is_ok_and(|vector| is_shortest(&bounds, &vector)));
    }
}

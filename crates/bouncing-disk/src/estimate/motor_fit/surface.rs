//! Emulators of all measured points over the parameter ranges, and the values that the measurements exclude.
//!
//! Along each parameter the deviance is minimised over all others by damped Gauss-Newton steps within the
//! ranges, at 21 evenly spaced points and more closely about the minima. Accepted ranges closer to each other
//! than a twentieth of half the range are merged. The first computed points are a lattice of powers of the
//! generalised golden ratio. Further points are profile points within 1.5 times the threshold at which the
//! emulator's variance v exceeds a quarter of the sum of the known and the rough variance. They are chosen one
//! after the other, as if the previous ones were known (kriging believer). With few points the rough variance
//! is left out, because a steep response may look rough.
//!
//! For the roughness q, each computed point is left out in turn, and its differences from the prediction by the
//! others are treated as measured. The part of their squares that the parameters imitate is the amount by which
//! such a motor would move the fit. One point in twenty exceeds q. The points are those within half of half the
//! ranges of the best one if there are at least 12, and otherwise all.

use bouncing_disk_core::numerics::elementary::ln;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::estimate::motor_fit::emulator::{Emulator, Response};
use crate::estimate::motor_fit::{ERRORS, SETTLED};

/// The 95 % quantile of chi-squared with one degree of freedom.
pub(crate) const THRESHOLD: f64 = 3.841_458_820_694_124;

/// Number of evenly spaced points of a profile, and of bisections between them and the best point.
const EVEN: usize = 21;
const HALVINGS: i32 = 9;

/// Computed points within this share of half the ranges determine the roughness of the responses near the
/// best point, if there are enough.
const NEAR: f64 = 0.5;
const LEAST_NEAR: usize = 12;

/// The roughness of the responses is known from this number of points times one plus the number of coordinates.
const ENOUGH: usize = 20;

/// Accepted ranges closer to each other than this share of half the range are merged.
const GAP: f64 = 0.05;

/// Largest number of steps to a minimum.
const STEPS: usize = 30;

/// The profile along one parameter: its points, and the least deviance over all other coordinates there.
pub(crate) struct Profile {
    pub(crate) nodes: Vec<(f64, f64, DVector<f64>)>,
    /// The accepted ranges; an end at -1 or 1 is the range's own end.
    pub(crate) accepted: Vec<[f64; 2]>,
}

pub(crate) struct Surface {
    parameters: usize,
    coordinates: usize,
    /// Value and variance of each point.
    measured: Vec<(f64, f64)>,
    /// The coordinates on which each point depends.
    own: Vec<Vec<usize>>,
    emulators: Vec<Emulator>,
    nodes: Vec<DVector<f64>>,
    /// The minima reached from the nodes.
    minima: Vec<DVector<f64>>,
    /// The most likely among the points of least deviance.
    pub(crate) best: DVector<f64>,
    /// Largest excess at which a point is accepted.
    pub(crate) threshold: f64,
}

impl Surface {
    /// `None` if values are not finite.
    pub(crate) fn new(
        parameters: usize,
        measured: Vec<(f64, f64)>,
        own: Vec<Vec<usize>>,
        nodes: &[DVector<f64>],
        values: &[Vec<Response>],
        earlier: Option<&Self>,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let of_point = |point: usize| {
            let places = nodes.iter().map(|node| selected(node, &own[point])).collect();
            let values: Vec<Response> = values.iter().map(|values| values[point]).collect();
            Emulator::of(places, &values, earlier.map(|earlier| &earlier.emulators[point]), goes_on)
        };
        let emulators = bouncing_disk_core::run::in_parallel(measured.len(), of_point);
        let emulators = emulators.into_iter().collect::<Option<Vec<_>>>()?;
        let coordinates = nodes.first()?.len();
        let best = DVector::zeros(coordinates);
        let mut surface = Self {
            parameters,
            coordinates,
            measured,
            own,
            emulators,
            nodes: nodes.to_vec(),
            minima: Vec::new(),
            best,
            threshold: THRESHOLD,
        };
        let minimum = |node: usize| surface.minimum(&nodes[node..=node], None).1;
        surface.minima = bouncing_disk_core::run::in_parallel(nodes.len(), minimum);
        surface.best = surface.likeliest(surface.minima.clone())?;
        surface.threshold = THRESHOLD + surface.roughest();
        Some(surface)
    }

    /// The emulated value of each measured point at a point of the ranges, and its variance: measured,
    /// emulated, and rough.
    pub(crate) fn fitted(&self, place: &DVector<f64>) -> Vec<(f64, f64)> {
        let points = self.emulators.iter().zip(&self.own).zip(&self.measured);
        points
            .map(|((emulator, own), (_, variance))| {
                let place = selected(place, own);
                let (value, doubt) = emulator.at(&place);
                let known = variance + emulator.scatter(&place);
                (value, known + doubt + emulator.bias(&place) + emulator.roughness(&place))
            })
            .collect()
    }

    /// Weighted differences of the speeds from the measurements and of the conditions from their given values,
    /// and the weights.
    fn residuals(&self, place: &DVector<f64>) -> (DVector<f64>, Vec<f64>) {
        let fitted = self.fitted(place);
        let weights: Vec<f64> = fitted.iter().map(|(_, variance)| 1.0 / variance.sqrt()).collect();
        let points = fitted.iter().zip(&self.measured).zip(&weights);
        let points = points.map(|(((value, _), (measured, _)), weight)| (value - measured) * weight);
        let conditions = place.iter().skip(self.parameters).map(|place| ERRORS * place);
        let count = fitted.len() + self.coordinates - self.parameters;
        (DVector::from_iterator(count, points.chain(conditions)), weights)
    }

    pub(crate) fn deviance(&self, place: &DVector<f64>) -> f64 {
        self.residuals(place).0.norm_squared()
    }

    /// Deviance, and the logarithm of the product of the variances, which is large where little is known.
    fn deviance_and_doubt(&self, place: &DVector<f64>) -> (f64, f64) {
        let (rest, weights) = self.residuals(place);
        (rest.norm_squared(), weights.iter().map(|weight| -2.0 * ln(*weight)).sum())
    }

    /// The excess of the deviance over its value at the best point, or the drop of the likelihood if that is
    /// less: a point is not excluded merely because the best one is less well known.
    pub(crate) fn excess(&self, place: &DVector<f64>) -> f64 {
        let ((own, doubt), (least, known)) =
            (self.deviance_and_doubt(place), self.deviance_and_doubt(&self.best));
        own - least + (doubt - known).min(0.0)
    }

    /// The most likely of the points; the deviance alone would select the least well-known one.
    fn likeliest(&self, places: Vec<DVector<f64>>) -> Option<DVector<f64>> {
        let all = places.into_iter().map(|place| {
            let (deviance, doubt) = self.deviance_and_doubt(&place);
            (deviance + doubt, place)
        });
        all.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, place)| place)
    }

    fn jacobian(&self, place: &DVector<f64>, weights: &[f64]) -> DMatrix<f64> {
        let points = self.emulators.len();
        let mut jacobian = DMatrix::zeros(points + self.coordinates - self.parameters, self.coordinates);
        for (point, (emulator, own)) in self.emulators.iter().zip(&self.own).enumerate() {
            let slopes = emulator.slopes(&selected(place, own));
            for (slope, coordinate) in slopes.iter().zip(own) {
                jacobian[(point, *coordinate)] = slope * weights[point];
            }
        }
        for condition in 0..self.coordinates - self.parameters {
            jacobian[(points + condition, self.parameters + condition)] = ERRORS;
        }
        jacobian
    }

    /// Nodes near this position of one coordinate at which the deviance is small.
    fn starts(&self, index: usize, at: f64) -> Vec<DVector<f64>> {
        let away = |node: &DVector<f64>| 10.0 * (node[index] - at).abs();
        let mut all: Vec<(f64, &DVector<f64>)> =
            self.nodes.iter().map(|node| (self.deviance(node).min(1e3) + away(node), node)).collect();
        all.sort_by(|one, other| one.0.total_cmp(&other.0));
        all.iter().take(2).map(|(_, node)| (*node).clone()).collect()
    }

    /// The least deviance from several starts, with one coordinate held: damped Gauss-Newton steps within the
    /// ranges.
    fn minimum(&self, starts: &[DVector<f64>], held: Option<usize>) -> (f64, DVector<f64>) {
        let mut best = (f64::INFINITY, self.best.clone());
        for start in starts {
            let (mut place, mut damping) = (start.clone(), 1e-2);
            let (mut rest, mut weights) = self.residuals(&place);
            for _ in 0..STEPS {
                let jacobian = self.jacobian(&place, &weights);
                let mut gradient = jacobian.transpose() * &rest;
                let mut curvature = jacobian.transpose() * &jacobian;
                for index in 0..self.coordinates {
                    let is_at_end = place[index].abs() >= 1.0 && gradient[index] * place[index] < 0.0;
                    if held == Some(index) || is_at_end {
                        gradient[index] = 0.0;
                        curvature.row_mut(index).fill(0.0);
                        curvature.column_mut(index).fill(0.0);
                        curvature[(index, index)] = 1.0;
                    }
                    curvature[(index, index)] += damping * (1.0 + curvature[(index, index)]);
                }
                let Some(step) = curvature.cholesky().map(|root| root.solve(&gradient)) else { break };
                let next = (&place - step).map(|place| place.clamp(-1.0, 1.0));
                let (next_rest, next_weights) = self.residuals(&next);
                let gain = rest.norm_squared() - next_rest.norm_squared();
                if gain > 0.0 {
                    (place, rest, weights, damping) = (next, next_rest, next_weights, 0.2 * damping);
                    if gain < 1e-4 {
                        break;
                    }
                } else {
                    damping *= 8.0;
                    if damping > 1e4 {
                        break;
                    }
                }
            }
            if rest.norm_squared() < best.0 {
                best = (rest.norm_squared(), place);
            }
        }
        best
    }

    /// The profiles along all parameters; incomplete if `goes_on` returns false.
    pub(crate) fn profiles(&mut self, goes_on: &(dyn Fn() -> bool + Sync)) -> Vec<Profile> {
        let all = bouncing_disk_core::run::in_parallel(self.parameters, |index| self.profile(index, goes_on));
        // A profile may find a more likely one.
        let nodes = all.iter().flat_map(|profile| &profile.nodes).map(|node| node.2.clone());
        if let Some(start) = self.likeliest(nodes.collect()) {
            let found = self.minimum(&[start], None).1;
            self.best = self.likeliest(vec![self.best.clone(), found]).unwrap_or_else(|| self.best.clone());
        }
        let own: &Self = self;
        let of = |(index, mut profile): (usize, Profile)| {
            for place in std::iter::once(&own.best).chain(&own.minima) {
                own.add(index, &mut profile.nodes, place);
            }
            own.accepted(index, profile)
        };
        all.into_iter().enumerate().map(of).collect()
    }

    /// Adds a point that is not excluded, and bisections of the interval about it, unless both neighbours are
    /// accepted.
    fn add(&self, index: usize, nodes: &mut Vec<(f64, f64, DVector<f64>)>, place: &DVector<f64>) {
        let at = place[index];
        let after = nodes.partition_point(|node| node.0 < at);
        let near = &nodes[after.saturating_sub(1)..(after + 1).min(nodes.len())];
        let is_shown = near.iter().all(|node| self.excess(&node.2) <= self.threshold);
        if is_shown || self.excess(place) > self.threshold {
            return;
        }
        let [low, high] = [near[0].0, near[near.len() - 1].0];
        nodes.push((at, self.deviance(place), place.clone()));
        for halving in 2..=HALVINGS {
            let distance = 1.0 / f64::from(1 << halving);
            for beside in [at - distance, at + distance].into_iter().filter(|at| *at > low && *at < high) {
                let mut start = place.clone();
                start[index] = beside;
                let (deviance, place) = self.minimum(&[start], Some(index));
                nodes.push((beside, deviance, place));
            }
        }
        nodes.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
        nodes.dedup_by(|one, other| one.0.total_cmp(&other.0).is_eq());
    }

    fn profile(&self, index: usize, goes_on: &(dyn Fn() -> bool + Sync)) -> Profile {
        let mut places: Vec<f64> = (0..EVEN).map(|k| 2.0 * k as f64 / (EVEN - 1) as f64 - 1.0).collect();
        let best = self.best[index];
        for halving in 2..=HALVINGS {
            let distance = 1.0 / f64::from(1 << halving);
            places.extend([best - distance, best + distance].iter().filter(|place| place.abs() < 1.0));
        }
        places.push(best);
        places.sort_by(f64::total_cmp);
        places.dedup();
        let mut nodes: Vec<_> =
            places.iter().map(|place| (*place, f64::INFINITY, self.best.clone())).collect();
        // From the best point outwards, each from its neighbour, and back.
        let middle = places.iter().position(|place| *place >= best).unwrap_or(0);
        let out = (middle..nodes.len()).chain((0..middle).rev());
        let back = (middle..nodes.len()).rev().chain(0..middle);
        for (pass, order) in [out.collect::<Vec<_>>(), back.collect()].into_iter().enumerate() {
            let mut start = self.best.clone();
            for node in order {
                if !goes_on() {
                    break;
                }
                if node + 1 == middle && pass == 0 {
                    start = self.best.clone();
                }
                start[index] = nodes[node].0;
                let mut starts = vec![start];
                if pass == 0 {
                    starts.extend(self.starts(index, nodes[node].0));
                    starts.iter_mut().for_each(|start| start[index] = nodes[node].0);
                }
                let found = self.minimum(&starts, Some(index));
                if found.0 < nodes[node].1 {
                    (nodes[node].1, nodes[node].2) = found;
                }
                start = nodes[node].2.clone();
            }
        }
        Profile { nodes, accepted: Vec::new() }
    }

    /// The ranges that are not excluded, with their ends interpolated between nodes.
    fn accepted(&self, index: usize, mut profile: Profile) -> Profile {
        let nodes = &profile.nodes;
        let mut open = None;
        let mut accepted = Vec::new();
        for (k, (place, _, all)) in nodes.iter().enumerate() {
            let is_in = self.excess(all) <= self.threshold;
            if is_in && open.is_none() {
                open = Some(if k == 0 { *place } else { self.crossing(index, [&nodes[k], &nodes[k - 1]]) });
            }
            if let (false, Some(from)) = (is_in, open) {
                accepted.push([from, self.crossing(index, [&nodes[k - 1], &nodes[k]])]);
                open = None;
            }
        }
        if let (Some(from), Some((last, ..))) = (open, nodes.last()) {
            accepted.push([from, *last]);
        }
        // A gap between two ranges of a rough response is no wider than its grain.
        accepted.dedup_by(|next, own| {
            let is_near = next[0] - own[1] < GAP;
            if is_near {
                own[1] = next[1];
            }
            is_near
        });
        profile.accepted = accepted;
        profile
    }

    /// The place at which the least deviance crosses the threshold, between an accepted node and an excluded
    /// one.
    fn crossing(&self, index: usize, [inside, outside]: [&(f64, f64, DVector<f64>); 2]) -> f64 {
        let (mut near, mut far, mut start) = (inside.0, outside.0, inside.2.clone());
        for _ in 0..5 {
            let middle = 0.5 * (near + far);
            start[index] = middle;
            let (_, place) = self.minimum(std::slice::from_ref(&start), Some(index));
            if self.excess(&place) <= self.threshold {
                (near, start) = (middle, place);
            } else {
                far = middle;
            }
        }
        far
    }

    /// Whether the uncertainty of the computed values hardly affects the accepted points.
    pub(crate) fn is_settled(&self, profiles: &[Profile]) -> bool {
        let is_known = |place: &DVector<f64>| {
            self.emulators.iter().zip(&self.own).zip(&self.measured).all(
                |((emulator, own), (_, variance))| {
                    let place = selected(place, own);
                    let known = variance + emulator.scatter(&place) + emulator.roughness(&place);
                    emulator.at(&place).1 + emulator.bias(&place) <= 2.0 * SETTLED * known
                },
            )
        };
        let nodes = profiles.iter().flat_map(|profile| &profile.nodes);
        nodes.filter(|node| self.excess(&node.2) <= self.threshold).all(|node| is_known(&node.2))
    }

    /// At most this number of points that are accepted, or nearly so, and at which the emulators are
    /// uncertain.
    pub(crate) fn doubtful(&self, profiles: &[Profile], most: usize) -> Vec<DVector<f64>> {
        let plausible = |node: &&(f64, f64, DVector<f64>)| self.excess(&node.2) <= 1.5 * self.threshold;
        let candidates: Vec<&DVector<f64>> = profiles
            .iter()
            .flat_map(|profile| profile.nodes.iter().filter(plausible))
            .map(|node| &node.2)
            .collect();
        // With few points, a steep response may seem rough.
        let are_few = self.nodes.len() < ENOUGH * (1 + self.coordinates);
        let mut emulators = self.emulators.clone();
        let mut chosen = Vec::new();
        while chosen.len() < most {
            let doubt = |place: &DVector<f64>| {
                let points = emulators.iter().zip(&self.own).zip(&self.measured);
                let share = points.map(|((emulator, own), (_, variance))| {
                    let place = selected(place, own);
                    let rough = if are_few { 0.0 } else { emulator.roughness(&place) };
                    emulator.at(&place).1 / (variance + emulator.scatter(&place) + rough)
                });
                share.fold(0.0, f64::max)
            };
            let Some((share, place)) = candidates
                .iter()
                .map(|place| (doubt(place), *place))
                .max_by(|one, other| one.0.total_cmp(&other.0))
            else {
                break;
            };
            if share <= SETTLED {
                break;
            }
            chosen.push(place.clone());
            let believing = emulators
                .iter()
                .zip(&self.own)
                .map(|(emulator, own)| emulator.believing(&selected(place, own)));
            let Some(next) = believing.collect() else { break };
            emulators = next;
        }
        chosen
    }

    /// How far deviations from a smooth response may move the parameters. Computed points near the best one are
    /// treated as if they had been measured; the result is the deviance that parameters can imitate and that
    /// one point in twenty exceeds. If a response is rough (motions lock to cycles), a measured motor deviates
    /// from it as much as these points do, and the deviations are not normally distributed.
    fn roughest(&self) -> f64 {
        let is_near = |node: &&DVector<f64>| (*node - &self.best).amax() <= NEAR;
        let near = self.nodes.iter().filter(is_near).count();
        let counts = |node: &usize| near < LEAST_NEAR || is_near(&&self.nodes[*node]);
        let mut all: Vec<f64> =
            (0..self.nodes.len()).filter(counts).map(|node| self.imitated(node)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() * 19 / 20).copied().unwrap_or(0.0)
    }

    fn imitated(&self, node: usize) -> f64 {
        let place = &self.nodes[node];
        let points = self.emulators.iter().zip(&self.own).zip(&self.measured);
        let each = points.map(|((emulator, own), (_, variance))| {
            let place = selected(place, own);
            let (off, doubt) = emulator.left_out[node];
            let own = 1.0 / (variance + doubt + emulator.scatter(&place) + emulator.bias(&place)).sqrt();
            (own, own * off)
        });
        let (weights, mut rest): (Vec<f64>, Vec<f64>) = each.unzip();
        rest.resize(weights.len() + self.coordinates - self.parameters, 0.0);
        let rest = DVector::from_vec(rest);
        let jacobian = self.jacobian(place, &weights);
        let gradient = jacobian.transpose() * &rest;
        let inverse = (jacobian.transpose() * &jacobian).cholesky();
        inverse.map_or_else(|| rest.norm_squared(), |root| gradient.dot(&root.solve(&gradient)))
    }

    /// The deviations of a point's values from their predictions by all other points.
    pub(crate) fn left_out(&self, node: usize) -> DVector<f64> {
        DVector::from_iterator(self.emulators.len(), self.emulators.iter().map(|own| own.left_out[node].0))
    }

    /// The estimated amount of an effect, beyond the part that the fitted parameters can imitate, and its
    /// standard error. A unit of the effect changes the measured values by `along`.
    pub(crate) fn amount(&self, along: &DVector<f64>) -> (f64, f64) {
        let (rest, weights) = self.residuals(&self.best);
        let jacobian = self.jacobian(&self.best, &weights);
        let along = DVector::from_iterator(
            rest.len(),
            (0..rest.len()).map(|index| along.get(index).map_or(0.0, |own| own * weights[index])),
        );
        let information = jacobian.transpose() * &jacobian;
        let imitated = information
            .pseudo_inverse(1e-9)
            .map(|inverse| &jacobian * (inverse * (jacobian.transpose() * &along)));
        let open = imitated.map_or_else(|_| along.clone(), |imitated| &along - imitated);
        let square = open.norm_squared();
        // The remainder is the fitted minus the measured values.
        (-open.dot(&rest) / square, 1.0 / square.sqrt())
    }

    /// Undetermined directions of the parameters near the best point, with their standard errors.
    pub(crate) fn directions(&self) -> Vec<Open> {
        let (_, weights) = self.residuals(&self.best);
        let jacobian = self.jacobian(&self.best, &weights);
        let all = jacobian.transpose() * &jacobian;
        let (p, q) = (self.parameters, self.coordinates - self.parameters);
        let mut information = all.view((0, 0), (p, p)).into_owned();
        // The conditions take their best values.
        if let Some(inverse) = all.view((p, p), (q, q)).into_owned().try_inverse() {
            let mixed = all.view((0, p), (p, q));
            information -= mixed * inverse * mixed.transpose();
        }
        undetermined(information)
    }
}

/// The largest standard error of a determined direction, as a share of half the ranges: its 95 % interval is
/// then as wide as the ranges.
const LARGEST_ERROR: f64 = 0.5;

/// An undetermined direction and its standard error.
pub(crate) type Open = (DVector<f64>, f64);

/// The directions that an information matrix leaves undetermined, with their standard errors; the least
/// uncertain first.
fn undetermined(information: DMatrix<f64>) -> Vec<Open> {
    let eigen = SymmetricEigen::new(information);
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let all = order.into_iter().map(|index| {
        let value = eigen.eigenvalues[index];
        let error = if value > 0.0 { 1.0 / value.sqrt() } else { f64::INFINITY };
        (eigen.eigenvectors.column(index).into_owned(), error)
    });
    all.filter(|(_, error)| *error > LARGEST_ERROR).collect()
}

fn selected(place: &DVector<f64>, coordinates: &[usize]) -> DVector<f64> {
    DVector::from_iterator(coordinates.len(), coordinates.iter().map(|index| place[*index]))
}

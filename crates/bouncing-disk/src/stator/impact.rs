//! The impact of a disk on a compliant stator, where friction and normal force may act on the same mode.
//!
//! Routh's method: the normal impulse p grows from 0. The disk slides by Coulomb's law until its slip ends, and
//! then sticks if friction holds it, or slides the other way. Between these changes the relative speeds are
//! linear in p. The impact ends when the normal force has returned the share e^2 of its work during compression
//! (Stronge's energetic restitution). An impact cannot create energy, because the normal force loses the share
//! 1 - e^2 and friction always opposes the slip. If no mode couples normal motion and rotation, this is
//! Newton's law, w' = -e w.

/// The result of an impact, for unit mass and moment of inertia of the disk.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Impulse {
    /// Normal impulse and friction impulse on the disk.
    pub(super) normal: f64,
    pub(super) friction: f64,
    /// Relative velocity and slip after the impact.
    pub(super) velocity: f64,
    pub(super) slip: f64,
    /// Whether the slip ended during the impact and friction held.
    pub(super) capped: bool,
    /// Energy lost by the normal force and by friction.
    pub(super) normal_loss: f64,
    pub(super) friction_loss: f64,
    /// Normal impulse and friction impulse at the end of the slip, if it ended: the joint of two lines.
    pub(super) joint: [f64; 2],
}

/// The impact with relative velocity `velocity` <= 0 and this slip.
pub(super) fn impact(
    [[normal, cross], [turn, rotary]]: [[f64; 2]; 2],
    friction: f64,
    restitution: f64,
    [velocity, slip]: [f64; 2],
) -> Impulse {
    let side = |value: f64| {
        if value > 0.0 {
            1.0
        } else if value < 0.0 {
            -1.0
        } else {
            0.0
        }
    };
    let direction = side(slip);
    // Torque of friction per unit of force, before and after the slip ends, and whether friction holds then.
    let first = -direction * friction;
    let holds = turn.abs() <= friction * rotary;
    let then = if holds { -turn / rotary } else { -side(turn) * friction };
    let [before, after] = [first, then].map(|torque| normal + cross * torque);
    let slope = turn + rotary * first;
    let joint = match direction != 0.0 && slip * slope < 0.0 {
        true => -slip / slope,
        false if direction == 0.0 => 0.0,
        false => f64::INFINITY,
    };
    let whole = if cross == 0.0 {
        (1.0 + restitution) * -velocity / normal
    } else {
        // The impulse after which, starting at speed w, this energy has been taken or given.
        let given =
            |w: f64, slope: f64, energy: f64| 2.0 * energy / (w + (w * w + 2.0 * slope * energy).sqrt());
        let at_joint = velocity + before * joint;
        if joint.is_finite() && at_joint < 0.0 {
            let taken = -0.5 * (velocity + at_joint) * joint + 0.5 * at_joint * at_joint / after;
            let back = restitution * (2.0 * taken * after).sqrt();
            joint + (back - at_joint) / after
        } else {
            let taken = 0.5 * velocity * velocity / before;
            let back = restitution * restitution * taken;
            let turned = -velocity / before;
            let until = 0.5 * before * (joint - turned) * (joint - turned);
            if joint.is_finite() && back > until {
                joint + given(at_joint, after, back - until)
            } else {
                turned + restitution * -velocity / before
            }
        }
    };
    let ended = whole > joint || direction == 0.0;
    let (early, late) = if ended { (joint, whole - joint) } else { (whole, 0.0) };
    let at_joint = [early, first * early];
    let impulse = first * early + then * late;
    let capped = ended && holds;
    let middle = slip + slope * early;
    let end = if capped { 0.0 } else { slip + turn * whole + rotary * impulse };
    let rebound =
        if cross == 0.0 { restitution * -velocity } else { velocity + before * early + after * late };
    let [w0, w1, w2] = [velocity, velocity + before * early, rebound];
    let middle = if ended { 0.0 } else { middle };
    Impulse {
        normal: whole,
        friction: impulse,
        velocity: rebound,
        slip: end,
        capped,
        normal_loss: -0.5 * ((w0 + w1) * early + (w1 + w2) * late),
        friction_loss: -0.5
            * ((slip + middle) * first * early + if capped { 0.0 } else { end * then * late }),
        joint: at_joint,
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::numerics::random::SplitMix64;

    use super::*;

    /// The impact in small steps of the normal impulse, by Coulomb's law at each step, and the work of the
    /// normal force.
    fn in_steps(b: [[f64; 2]; 2], friction: f64, restitution: f64, [w, u]: [f64; 2], step: f64) -> [f64; 4] {
        let (mut w, mut u, mut p, mut t) = (w, u, 0.0, 0.0);
        let (mut taken, mut given) = (0.0, 0.0);
        while w < 0.0 || given < restitution * restitution * taken {
            // The torque that would end the slip within the step, within Coulomb's bounds.
            let torque = (-(u + b[1][0] * step) / b[1][1]).clamp(-friction * step, friction * step);
            let next = w + b[0][0] * step + b[0][1] * torque;
            let work = 0.5 * (w + next) * step;
            if next <= 0.0 {
                taken -= work
            } else {
                given += work
            }
            u += b[1][0] * step + b[1][1] * torque;
            (w, p, t) = (next, p + step, t + torque);
        }
        [p, t, w, u]
    }

    #[test]
    fn impacts_are_those_in_small_steps_and_create_no_energy() {
        let mut random = SplitMix64::new(3);
        let mut kinds = [0; 4];
        for _ in 0..2000 {
            let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
            let (h, angle, arm) = (between(0.0, 4.0), between(-3.0, 3.0), between(0.2, 2.0));
            let l = arm * angle * h;
            let b = [[1.0 + h, l], [angle * h, 1.0 + angle * l]];
            let (friction, restitution) = (between(0.0, 1.0), between(0.0, 1.0));
            if friction * l.abs() > 0.9 * b[0][0] {
                continue;
            }
            let (w, u) = (-between(0.01, 1.0), between(-1.0, 1.0));
            let done = impact(b, friction, restitution, [w, u]);
            let step = 1e-4 * done.normal;
            let [p, t, rebound, slip] = in_steps(b, friction, restitution, [w, u], step);
            let (size, turn) = (done.normal, 1.0 + u.abs() + b[1][1]);
            assert!(
                (done.normal - p).abs() < 2e-3 * size,
                "{b:?} {friction} {restitution} {w} {u} {done:?} {p}"
            );
            assert!((done.friction - t).abs() < 2e-3 * size * turn, "{b:?} {friction} {w} {u} {done:?} {t}");
            assert!(
                (done.velocity - rebound).abs() < 4e-3 * (w.abs() + b[0][0] * size),
                "{done:?} {rebound}"
            );
            assert!((done.slip - slip).abs() < 4e-3 * turn, "{done:?} {slip}");
            // Energy of the relative motion before, after and lost.
            let determinant = b[0][0] * b[1][1] - b[0][1] * b[1][0];
            let energy = |w: f64, u: f64| {
                0.5 * (b[1][1] * w * w + arm * b[0][0] * u * u - 2.0 * b[0][1] * w * u) / determinant
            };
            let (before, after) = (energy(w, u), energy(done.velocity, done.slip));
            let lost = done.normal_loss + arm * done.friction_loss;
            assert!((before - after - lost).abs() < 1e-12 * (before + lost), "{before} {after} {lost}");
            assert!(done.normal_loss >= -1e-14 && done.friction_loss >= -1e-14 * turn, "{done:?}");
            let reversed = done.slip * u < 0.0;
            let ended = done.joint[0] < done.normal;
            kinds[usize::from(done.capped) + 2 * usize::from(reversed)] += 1;
            assert!(ended || !done.capped && !reversed, "{done:?}");
        }
        assert!(kinds[0] > 100 && kinds[1] > 100 && kinds[2] > 100, "{kinds:?}");
    }

    #[test]
    fn without_a_coupling_it_is_newtons_law() {
        for (slip, friction) in [(0.0, 0.3), (0.1, 0.0), (-0.2, 0.3), (5.0, 0.3)] {
            let done = impact([[1.5, 0.0], [0.0, 2.0]], friction, 0.5, [-1.0, slip]);
            assert!((done.normal - 1.0).abs() < 1e-15 && (done.velocity - 0.5).abs() < 1e-15);
            let most = friction * done.normal;
            assert!((done.friction - (-slip / 2.0).clamp(-most, most)).abs() < 1e-15, "{done:?}");
        }
    }
}

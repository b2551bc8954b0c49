//! The impact of a disk on a stator that yields, where friction and normal force may act on one mode.
//!
//! Routh's method: the normal impulse p grows from 0; the disk slides by Coulomb's law until its slip ends, and then
//! sticks if friction holds it, or slides the other way. Relative speeds are lines in p between these. The impact ends
//! when the normal force has given back the share e^2 of the work that it took in compression (Stronge's energetic
//! restitution): it can create no energy, because the normal force loses the share 1 - e^2 and friction always opposes
//! the slip. Where no mode couples the two, that is Newton's law, w' = -e w.

/// What an impact does, for unit mass and moment of inertia of the disk.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Impulse {
    /// Normal impulse and impulse of friction on the disk.
    pub(super) normal: f64,
    pub(super) friction: f64,
    /// Relative velocity and slip after it.
    pub(super) velocity: f64,
    pub(super) slip: f64,
    /// Whether the slip ended within it and friction held.
    pub(super) capped: bool,
    /// Lost by the normal force, and by friction.
    pub(super) normal_loss: f64,
    pub(super) friction_loss: f64,
    /// Normal impulse and impulse of friction when the slip ended, if it did: the joint of two lines.
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
    // Torque of friction for one unit of force, before and after the slip ends; whether it holds then.
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
        // From speed w on, how much impulse takes or gives this energy.
        let given =
            |w: f64, slope: f64, energy: f64| 2.0 * energy / (w + (w * w + 2.0 * slope * energy).sqrt());
        let at_joint = velocity + before * joint;
        if joint.is_finite() && at_joint < 0.0 {
            let taken = -0.5 * (velocity + at_joint) * joint + 0.5 * at_joint * at_joint / after;
            let back = restitution * (2.0 * taken / after).sqrt();
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

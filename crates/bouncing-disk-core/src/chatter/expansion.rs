//! The expansion of a chatter in its launch speed: its flights, their sum to the fourth order, and the error
//! bound of the sum. It is used in `accumulation.rs`.

/// Largest expansion parameter of the series; its majorant needs it below 1/16.
const LARGEST_EXPANSION_PARAMETER: f64 = 1.0 / 32.0;

/// Factor of the majorant of the series' remainder.
pub(super) const MAJORANT: f64 = 32.0;

/// Share of the first launch speed at which the impacts of a chatter are no longer counted.
pub(super) const LAST_SHARE: f64 = 1.0e-17;

/// Largest restitution, and smallest launch speed, of a chatter whose impacts are computed one by one. There
/// are at most 7,600 impacts because, by the proof of [`window_holds_all`], every launch is slower than 1 -
/// (2/3)(1 - r) times the previous one.
pub(super) const LARGEST_COUNTED_RESTITUTION: f64 = 1.0 - 1.0 / 128.0;
pub(super) const SMALLEST_COUNTED_SPEED: f64 = f64::MIN_POSITIVE / LAST_SHARE;

/// The power series in the launch speed, about an impact with pull a = 1 - P sin tau and drift b = P cos tau.
#[derive(Clone, Copy)]
pub(super) struct Expansion {
    pub(super) pull: f64,
    pub(super) drift: f64,
    pub(super) restitution: f64,
}

impl Expansion {
    /// Duration of the next flight and its impact speed, to the fourth order.
    pub(super) fn flight(&self, speed: f64) -> (f64, f64) {
        let (a, b, w) = (self.pull, self.drift, speed);
        let x = w / a;
        let beta = b / a;
        let gamma = (a - 1.0) / a;
        let h = 2.0
            * x
            * (1.0
                + x * ((2.0 / 3.0) * beta
                    + x * ((3.0 * gamma + 8.0 * beta * beta) / 9.0
                        + x * beta * (2.0 / 135.0) * ((66.0 * a - 75.0) / a + 100.0 * beta * beta))));
        let u = w
            * (1.0
                - x * ((2.0 / 3.0) * beta
                    + x * ((2.0 / 9.0) * (3.0 * gamma + 4.0 * beta * beta)
                        + x * beta * (2.0 / 135.0) * ((93.0 * a - 120.0) / a + 100.0 * beta * beta))));
        (h, u)
    }

    /// Time to the accumulation point, to the fourth order.
    pub(super) fn duration(&self, speed: f64) -> f64 {
        let r = self.restitution;
        let a = self.pull;
        let x = speed / (a * (1.0 - r));
        let beta = self.drift / a;
        let gamma = (a - 1.0) / a;
        let beta2 = beta * beta;
        let three = 1.0 + r * (1.0 + r);
        let third =
            (3.0 * gamma * (1.0 + r) * (1.0 + r) + beta2 * (8.0 + r * (12.0 + 8.0 * r))) / (9.0 * three);
        // The fourth-order coefficient is a polynomial in r whose terms in a^2, a and b^2 are symmetric.
        let symmetric =
            |ends: f64, next: f64, middle: f64| ends + r * (next + r * (middle + r * (next + r * ends)));
        let fourth = beta
            * (symmetric(66.0, 204.0, 60.0) - symmetric(75.0, 240.0, 60.0) / a
                + beta2 * symmetric(100.0, 260.0, 120.0))
            * (2.0 / 135.0)
            / ((1.0 + r * r) * three);
        2.0 * x * (1.0 + x * ((2.0 / 3.0) * beta + x * (third + x * fourth)))
    }

    /// Bound on the remainder of [`Self::duration`]: a majorant of the terms from the fifth order on, or
    /// `None` if the expansion parameter is too large for the majorant.
    pub(super) fn error_bound(&self, x: f64) -> Option<f64> {
        let beta = (self.drift / self.pull).abs();
        let gamma = ((self.pull - 1.0) / self.pull).abs();
        let kappa = 1.0 + beta + gamma.sqrt();
        if x * kappa > LARGEST_EXPANSION_PARAMETER {
            return None;
        }
        let x2 = x * x;
        Some(MAJORANT * (beta + gamma) * (kappa * kappa * kappa) * (x2 * x2 * x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arithmetic of 160 bits: the expansion's remainder is far above its rounding, and far below the
    /// rounding of doubles.
    type High = dashu_float::FBig<dashu_float::round::mode::HalfEven, 2>;

    fn high(x: f64) -> High {
        High::try_from(x).expect("finite").with_precision(160).value()
    }

    fn low(x: &High) -> f64 {
        x.to_f64().value()
    }

    /// 1 - cos h and h - sin h of a short h, as their power series.
    fn versine_and_deficit(h: &High) -> (High, High) {
        let square = h * h;
        let (mut term, mut versine, mut deficit) = (high(1.0), high(0.0), high(0.0));
        for k in 1..10 {
            term = -(term * &square) / high(f64::from((2 * k - 1) * (2 * k)));
            versine -= &term;
            deficit -= &term * h / high(f64::from(2 * k + 1));
        }
        (versine, deficit)
    }

    /// A chatter followed flight by flight in high precision, from the gap itself: it does not use the
    /// expansion.
    struct Bounces {
        /// P sin and P cos of the phase of the last impact.
        sine: High,
        cosine: High,
    }

    impl Bounces {
        fn from(expansion: &Expansion) -> Self {
            Self { sine: high(1.0) - high(expansion.pull), cosine: high(expansion.drift) }
        }

        /// Duration and impact speed of the flight after a launch with this speed.
        fn fly(&mut self, launch: &High) -> (High, High) {
            let pull = high(1.0) - &self.sine;
            let mut h = high(2.0) * launch / pull;
            loop {
                let (versine, deficit) = versine_and_deficit(&h);
                let gap = &h * (launch - &h / high(2.0)) + &self.sine * &versine + &self.cosine * &deficit;
                let slope = launch - &h + &self.cosine * &versine + &self.sine * (&h - &deficit);
                let ratio = &gap / &h;
                // Newton's step on gap/h.
                let step = &gap / (&slope - &ratio);
                if low(&step).abs() <= 1e-36 * low(&h) {
                    let sin_h = &h - &deficit;
                    let sine = &self.sine - &self.sine * &versine + &self.cosine * &sin_h;
                    self.cosine = &self.cosine - &self.cosine * &versine - &self.sine * &sin_h;
                    self.sine = sine;
                    return (h, -slope);
                }
                h -= step;
            }
        }

        /// Time to the accumulation point after a launch with this speed.
        fn duration(mut self, speed: f64, restitution: f64) -> High {
            let (mut launch, mut time) = (high(speed), high(0.0));
            while low(&launch) > 1e-20 * speed {
                let (flight, impact_speed) = self.fly(&launch);
                time += flight;
                launch = impact_speed * high(restitution);
            }
            // The remaining time, to first order.
            time + high(2.0) * launch / ((high(1.0) - self.sine) * (high(1.0) - high(restitution)))
        }
    }

    /// Pulls about 1 (the platform in the middle of its stroke), weak and strong ones, and drifts of both
    /// signs.
    fn expansions() -> impl Iterator<Item = Expansion> {
        [
            (1.0, 0.75),
            (1.0, -1.5),
            (0.5, 0.5),
            (0.625, -1.0),
            (2.5, 1.25),
            (3.0, -4.0),
            (1.75, 0.0),
            (0.0625, 3.0),
            (0.001_953_125, 32.0),
        ]
        .into_iter()
        .flat_map(|(pull, drift)| {
            [0.125, 0.5, 0.8125].map(|restitution| Expansion { pull, drift, restitution })
        })
    }

    /// 1 + |b|/a + sqrt(|a - 1|/a): the growth of the coefficients from one order to the next.
    fn growth(expansion: &Expansion) -> f64 {
        let Expansion { pull, drift, .. } = *expansion;
        1.0 + (drift / pull).abs() + ((pull - 1.0) / pull).abs().sqrt()
    }

    /// The remainder of a fourth-order series is of fifth order: at half the speed it is one thirty-second as
    /// large. An error of one unit in one coefficient would leave one sixteenth.
    #[test]
    fn the_sum_is_exact_to_the_fourth_order() {
        for expansion in expansions() {
            let restitution = expansion.restitution;
            let x = libm::ldexp(1.0, -10) / growth(&expansion);
            let speed = x * (expansion.pull * (1.0 - restitution));
            let left = |speed: f64| {
                low(&(Bounces::from(&expansion).duration(speed, restitution)
                    - high(expansion.duration(speed))))
            };
            let bound = expansion.error_bound(x).expect("small");
            let (whole, half) = (left(speed), left(0.5 * speed));
            let odd = (whole - 32.0 * half) / bound;
            assert!(odd.abs() <= 1e-3, "{odd} of the bound");
        }
    }

    #[test]
    fn a_flight_is_exact_to_the_fourth_order() {
        for expansion in expansions() {
            let x = libm::ldexp(1.0, -9) / growth(&expansion);
            let left = |speed: f64| {
                let (flight, impact_speed) = Bounces::from(&expansion).fly(&high(speed));
                let (own_flight, own_speed) = expansion.flight(speed);
                [low(&(flight - high(own_flight))), low(&(impact_speed - high(own_speed))) / expansion.pull]
            };
            let bound = expansion.error_bound(x).expect("small");
            let (whole, half) = (left(x * expansion.pull), left(0.5 * x * expansion.pull));
            for (whole, half) in whole.into_iter().zip(half) {
                let odd = (whole - 32.0 * half) / bound;
                assert!(odd.abs() <= 1e-3, "{odd} of the bound");
            }
        }
    }

    /// The majorant holds up to the largest expansion parameter, and is tight: the remainder comes near it.
    #[test]
    fn the_error_bound_is_above_the_error_and_of_its_size() {
        let mut largest = 0.0_f64;
        for expansion in expansions() {
            let growth = growth(&expansion);
            let x = (1.0 - 1e-9) / (32.0 * growth);
            assert!(expansion.error_bound(x * (1.0 + 2e-9)).is_none(), "too large for the majorant");
            for x in [x, 0.5 * x] {
                let speed = x * (expansion.pull * (1.0 - expansion.restitution));
                let exact = Bounces::from(&expansion).duration(speed, expansion.restitution);
                let left = low(&(exact - high(expansion.duration(speed)))).abs();
                let share = left / expansion.error_bound(x).expect("small enough");
                assert!(share <= 1.0, "{share}");
                largest = largest.max(share);
            }
        }
        assert!(largest > 0.3, "{largest}");
    }
}

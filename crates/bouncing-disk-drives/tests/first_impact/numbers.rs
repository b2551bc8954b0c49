//! The numbers of the oracles: double-doubles for all cases, 256 bits for a share of them.

use std::ops::{Add, Div, Mul, Neg, Sub};

use bouncing_disk_core::numerics::double_double::DoubleDouble;

use crate::oracle::{self, High, high, low};

pub type Dd = DoubleDouble;

pub fn dd(x: f64) -> Dd {
    Dd::from(x)
}

pub trait Number:
    Clone
    + PartialOrd
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// Relative size below which a change of a time has no effect.
    const ROUNDING: f64;
    /// Orders of the Taylor series of sines over half a radian: the remainder is below the rounding.
    const ORDERS: usize;
    fn of(value: f64) -> Self;
    fn two_pi() -> Self;
    /// Sine and cosine.
    fn turn(&self) -> (Self, Self);
    fn dd(&self) -> Dd;
    /// The double nearest to it.
    fn rounded(&self) -> f64;

    fn abs(&self) -> Self {
        if *self < Self::of(0.0) { -self.clone() } else { self.clone() }
    }
}

impl Number for Dd {
    const ROUNDING: f64 = 1e-30;
    const ORDERS: usize = 24;

    fn of(value: f64) -> Self {
        dd(value)
    }

    fn two_pi() -> Self {
        Self::PI + Self::PI
    }

    fn turn(&self) -> (Self, Self) {
        self.sin_cos()
    }

    fn dd(&self) -> Dd {
        *self
    }

    fn rounded(&self) -> f64 {
        self.high()
    }
}

impl Number for High {
    const ROUNDING: f64 = 1e-50;
    const ORDERS: usize = 36;

    fn of(value: f64) -> Self {
        high(value)
    }

    fn two_pi() -> Self {
        oracle::two_pi().clone()
    }

    fn turn(&self) -> (Self, Self) {
        oracle::sin_cos(self)
    }

    fn dd(&self) -> Dd {
        let head = low(self);
        dd(head) + dd(low(&(self.clone() - high(head))))
    }

    fn rounded(&self) -> f64 {
        low(self)
    }
}

//! Real numbers of more than one precision: the operations of algorithms that run in doubles and in
//! double-doubles.

use core::fmt::{Debug, Display};
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::numerics::elementary;

/// A floating-point number with the same bits everywhere: `f64` or
/// [`DoubleDouble`](crate::numerics::double_double::DoubleDouble).
pub trait Real:
    Copy
    + Debug
    + Display
    + PartialOrd
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// The distance from 1 to the next number.
    const EPSILON: f64;
    /// Half a period of the platform (rad).
    const PI: Self;

    /// The exact value of a double.
    fn of(value: f64) -> Self;

    /// The nearest double.
    fn value(self) -> f64;

    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// The square root of a number >= 0.
    fn sqrt(self) -> Self;

    /// The magnitude.
    fn magnitude(self) -> Self {
        if self < Self::of(0.0) { -self } else { self }
    }
}

impl Real for f64 {
    const EPSILON: Self = Self::EPSILON;
    const PI: Self = core::f64::consts::PI;

    fn of(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }

    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
}

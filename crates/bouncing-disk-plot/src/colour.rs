//! Colours that stay apart for colour-blind readers and in print.

use std::fmt;

/// An opaque sRGB colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red.
    pub red: u8,
    /// Green.
    pub green: u8,
    /// Blue.
    pub blue: u8,
}

impl Colour {
    /// Black.
    pub const BLACK: Self = Self::rgb(0, 0, 0);
    /// White.
    pub const WHITE: Self = Self::rgb(255, 255, 255);
    /// Dark grey, for main curves that the paper prints in dark gray.
    pub const DARK_GREY: Self = Self::rgb(70, 70, 70);
    /// Mid grey.
    pub const GREY: Self = Self::rgb(128, 128, 128);
    /// Light grey, for secondary curves that the paper prints in light gray.
    pub const LIGHT_GREY: Self = Self::rgb(190, 190, 190);
    /// A grey that only tints an area.
    pub const PALE_GREY: Self = Self::rgb(228, 228, 228);
    /// Blue of the Okabe-Ito palette.
    pub const BLUE: Self = Self::rgb(0, 114, 178);
    /// Vermilion of the Okabe-Ito palette, used as red.
    pub const VERMILION: Self = Self::rgb(213, 94, 0);
    /// Bluish green of the Okabe-Ito palette.
    pub const GREEN: Self = Self::rgb(0, 158, 115);
    /// Orange of the Okabe-Ito palette.
    pub const ORANGE: Self = Self::rgb(230, 159, 0);
    /// Reddish purple of the Okabe-Ito palette.
    pub const PURPLE: Self = Self::rgb(204, 121, 167);
    /// Sky blue of the Okabe-Ito palette.
    pub const SKY: Self = Self::rgb(86, 180, 233);

    /// A colour from its components.
    pub const fn rgb(red: u8, green: u8, blue: u8) -> Self {
        Self { red, green, blue }
    }

    /// The `index`-th colour for curves of one panel; repeats after seven.
    pub fn cycle(index: usize) -> Self {
        const CURVES: [Colour; 7] = [
            Colour::BLACK,
            Colour::BLUE,
            Colour::VERMILION,
            Colour::GREEN,
            Colour::PURPLE,
            Colour::ORANGE,
            Colour::SKY,
        ];
        CURVES[index % CURVES.len()]
    }

    /// The colour of a map of one quantity, from low (0) over pale yellow, green and blue to high (1).
    pub fn scale(share: f64) -> Self {
        const COLOURS: [Colour; 4] = [
            Colour::rgb(253, 231, 160),
            Colour::rgb(120, 198, 140),
            Colour::rgb(35, 120, 150),
            Colour::rgb(50, 25, 95),
        ];
        let place = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
        let index = (place as usize).min(COLOURS.len() - 2);
        COLOURS[index].mixed(COLOURS[index + 1], place - index as f64)
    }

    /// The colour a `share` of the way from `self` (0) to `other` (1).
    #[must_use]
    pub fn mixed(self, other: Self, share: f64) -> Self {
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
        let mix = |from: u8, to: u8| {
            let value = f64::from(from) + share * (f64::from(to) - f64::from(from));
            (value + 0.5) as u8
        };
        Self::rgb(mix(self.red, other.red), mix(self.green, other.green), mix(self.blue, other.blue))
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "#{:02x}{:02x}{:02x}", self.red, self.green, self.blue)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixing_and_writing() {
        assert_eq!(Colour::BLACK.mixed(Colour::WHITE, 0.5), Colour::rgb(128, 128, 128));
        assert_eq!(Colour::BLUE.mixed(Colour::WHITE, f64::NAN), Colour::BLUE);
        assert_eq!(Colour::VERMILION.to_string(), "#d55e00");
    }
}

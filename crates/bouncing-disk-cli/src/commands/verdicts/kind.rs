//! The kind of a verdict, as files and pictures have it.

use bouncing_disk::core::attractors::Verdict;

/// What the disk does for good, without the evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    AtRest,
    ExactCycle,
    LongCycle,
    PeriodOne,
    PeriodTwo,
    PeriodThree,
    LongerPeriod,
    Chaotic,
    Undecided,
    /// There is no such start.
    NoStart,
}

impl Kind {
    pub(crate) const ALL: [Self; 10] = [
        Self::AtRest,
        Self::ExactCycle,
        Self::LongCycle,
        Self::PeriodOne,
        Self::PeriodTwo,
        Self::PeriodThree,
        Self::LongerPeriod,
        Self::Chaotic,
        Self::Undecided,
        Self::NoStart,
    ];

    pub(crate) fn of(verdict: Option<&Verdict>) -> Self {
        match verdict {
            None => Self::NoStart,
            Some(Verdict::AtRest { .. }) => Self::AtRest,
            Some(Verdict::Chattering { cycle, .. }) if cycle.is_exact() => Self::ExactCycle,
            Some(Verdict::Chattering { .. }) => Self::LongCycle,
            Some(Verdict::Periodic { impacts: 1, .. }) => Self::PeriodOne,
            Some(Verdict::Periodic { impacts: 2, .. }) => Self::PeriodTwo,
            Some(Verdict::Periodic { impacts: 3, .. }) => Self::PeriodThree,
            Some(Verdict::Periodic { .. }) => Self::LongerPeriod,
            Some(Verdict::Chaotic { .. }) => Self::Chaotic,
            Some(_) => Self::Undecided,
        }
    }

    /// Its place in [`Self::ALL`], as a letter.
    pub(super) fn digit(self) -> char {
        char::from(b'0' + self as u8)
    }

    pub(super) fn of_digit(letter: char) -> Option<Self> {
        Self::ALL.get(letter.to_digit(10)? as usize).copied()
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::AtRest => "at rest",
            Self::ExactCycle => "cycle with rest",
            Self::LongCycle => "cycle with rest, chosen by rounding",
            Self::PeriodOne => "period 1",
            Self::PeriodTwo => "period 2",
            Self::PeriodThree => "period 3",
            Self::LongerPeriod => "period 4 or longer",
            Self::Chaotic => "chaotic",
            Self::Undecided => "undecided",
            Self::NoStart => "no such start",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_have_a_digit_each() {
        for kind in Kind::ALL {
            assert_eq!(Kind::of_digit(kind.digit()), Some(kind));
        }
        assert_eq!([':', '/', 'a'].map(Kind::of_digit), [None; 3]);
    }
}

//! Seeded random streams.

/// The splitmix64 generator (S. Vigna): a documented, reproducible stream for each seed, the same on every
/// machine.
///
/// ```
/// use bouncing_disk_core::numerics::random::SplitMix64;
///
/// let mut random = SplitMix64::new(2009);
/// assert!((0.0..1.0).contains(&random.unit()));
/// assert_eq!(SplitMix64::new(0).next_number(), 0xe220_a839_7b1d_cdaf);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// The stream of a seed.
    #[must_use]
    #[inline]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The seed of one of many related streams, numbered from 0.
    ///
    /// If streams had consecutive seeds from `seed`, all but one would also belong to `seed + 1`: means over
    /// the two sets would be nearly the same and could not check each other.
    ///
    /// ```
    /// use bouncing_disk_core::numerics::random::SplitMix64;
    ///
    /// assert_ne!(SplitMix64::seed_of_stream(1, 1), SplitMix64::seed_of_stream(2, 0));
    /// ```
    #[must_use]
    pub const fn seed_of_stream(seed: u64, stream: u64) -> u64 {
        let first = Self::new(seed).next_number();
        Self::new(first.wrapping_add(stream)).next_number()
    }

    /// The next number of the stream.
    #[inline]
    pub const fn next_number(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// The next number, uniform in [0, 1).
    #[inline]
    pub fn unit(&mut self) -> f64 {
        (self.next_number() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbouring seeds, as users choose them, have no stream in common.
    #[test]
    fn seeds_share_no_stream() {
        let mut all = std::collections::BTreeSet::new();
        for seed in (0..100).chain([u64::MAX - 1, u64::MAX]) {
            for stream in 0..200 {
                assert!(all.insert(SplitMix64::seed_of_stream(seed, stream)), "{seed} {stream}");
            }
        }
    }

    #[test]
    fn the_generator_is_splitmix64() {
        let mut generator = SplitMix64::new(1_234_567);
        let published = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(published.map(|_| generator.next_number()), published);
        // The highest 53 bits, as a share of one.
        let mut generator = SplitMix64::new(1_234_567);
        for bits in published {
            assert_eq!((generator.unit() * (1_u64 << 53) as f64) as u64, bits >> 11);
        }
    }
}

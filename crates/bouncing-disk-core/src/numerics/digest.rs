//! A digest of results that is the same on every machine.

/// The 64-bit FNV-1a hash of bytes and doubles: identifies the bits of a result by sixteen digits.
///
/// ```
/// use bouncing_disk_core::numerics::digest::Digest;
///
/// let mut digest = Digest::new();
/// digest.bytes(b"foobar");
/// assert_eq!(digest.to_string(), "85944171f73967e8");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self::new()
    }
}

impl Digest {
    /// The digest of no bytes.
    #[must_use]
    pub const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// The digest of these bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let mut digest = Self::new();
        digest.bytes(bytes);
        digest
    }

    /// Adds bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Adds the bits of a number, lowest byte first.
    pub fn number(&mut self, number: f64) {
        self.bytes(&number.to_bits().to_le_bytes());
    }

    /// The hash.
    #[must_use]
    pub const fn value(&self) -> u64 {
        self.0
    }
}

/// Sixteen hexadecimal digits.
impl core::fmt::Display for Digest {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(formatter, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of the authors (Fowler, Noll, Vo).
    #[test]
    fn the_digest_is_fnv_1a() {
        assert_eq!(Digest::of(b"").value(), 0xcbf2_9ce4_8422_2325);
        assert_eq!(Digest::of(b"a").value(), 0xaf63_dc4c_8601_ec8c);
        let mut digest = Digest::new();
        digest.number(1.0);
        assert_eq!(digest, Digest::of(&[0, 0, 0, 0, 0, 0, 0xf0, 0x3f]));
    }
}

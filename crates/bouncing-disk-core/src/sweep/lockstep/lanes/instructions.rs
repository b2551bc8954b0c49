//! The vector instructions of the processor, chosen at run time.

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
use pulp::Simd;
use pulp::WithSimd;

/// The vector instructions that compute the lanes. The results have the same bits with each of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstructionSet {
    /// The instructions of every processor of the compilation target (SSE2 on x86-64).
    Baseline,
    /// The fixed-width vectors of WebAssembly, if it is compiled for them: two lanes at once.
    Simd128,
    /// AVX2: four lanes at once.
    Avx2,
    /// AVX-512: eight lanes at once.
    Avx512,
}

impl InstructionSet {
    /// All sets that this processor supports, best last.
    #[must_use]
    pub fn available() -> Vec<Self> {
        #[cfg_attr(
            not(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128"))),
            expect(unused_mut, reason = "there is one set")
        )]
        let mut sets = vec![Self::Baseline];
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        if pulp::wasm::Simd128::try_new().is_some() {
            sets.push(Self::Simd128);
        }
        #[cfg(target_arch = "x86_64")]
        {
            if pulp::x86::V3::try_new().is_some() {
                sets.push(Self::Avx2);
            }
            if pulp::x86::V4::try_new().is_some() {
                sets.push(Self::Avx512);
            }
        }
        sets
    }

    /// The best set that this processor supports.
    #[must_use]
    pub fn best() -> Self {
        Self::available().last().copied().unwrap_or(Self::Baseline)
    }
}

/// Runs an operation compiled for an instruction set that was found available.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Dispatch {
    Baseline,
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    Simd128(pulp::wasm::Simd128),
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
}

impl Dispatch {
    /// The functions for `set`, or for the next lower set that this processor supports.
    pub(crate) fn new(set: InstructionSet) -> Self {
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        if set != InstructionSet::Baseline
            && let Some(level) = pulp::wasm::Simd128::try_new()
        {
            return Self::Simd128(level);
        }
        #[cfg(target_arch = "x86_64")]
        {
            if set == InstructionSet::Avx512
                && let Some(level) = pulp::x86::V4::try_new()
            {
                return Self::Avx512(level);
            }
            if matches!(set, InstructionSet::Avx2 | InstructionSet::Avx512)
                && let Some(level) = pulp::x86::V3::try_new()
            {
                return Self::Avx2(level);
            }
        }
        let _ = set;
        Self::Baseline
    }

    #[inline(always)]
    pub(crate) fn run(self, operation: impl WithSimd<Output = ()>) {
        match self {
            Self::Baseline => operation.with_simd(pulp::Scalar::new()),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Self::Simd128(level) => Simd::vectorize(level, operation),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(level) => Simd::vectorize(level, operation),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(level) => Simd::vectorize(level, operation),
        }
    }
}

//! Numbers that belong to a place in a tree: the same whenever it is come to.

/// A seed for every place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seed(pub(super) u64);

impl Seed {
    /// The seed of what lies below, `number` of it (SplitMix64, Steele, Lea and
    /// Flood 2014).
    pub(super) fn below(self, number: u64) -> Self {
        let step = 0x9e37_79b9_7f4a_7c15u64.wrapping_mul(number.wrapping_add(1));
        let mut bits = self.0.wrapping_add(step);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        Self(bits ^ (bits >> 31))
    }

    /// An even number in 0..1; `number` tells those of one seed apart.
    pub(super) fn unit(self, number: u64) -> f32 {
        (self.below(number).0 >> 40) as f32 / (1u64 << 24) as f32
    }
}

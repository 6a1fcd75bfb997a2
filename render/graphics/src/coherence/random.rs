//! Random numbers for the nodes of a tree. A node has the same numbers at every visit.

/// The random seed of one node of a tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seed(pub(super) u64);

impl Seed {
    /// The seed of the node's child `number` (SplitMix64, Steele, Lea and Flood 2014).
    pub(super) fn child(self, number: u64) -> Self {
        let step = 0x9e37_79b9_7f4a_7c15u64.wrapping_mul(number.wrapping_add(1));
        let mut bits = self.0.wrapping_add(step);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        Self(bits ^ (bits >> 31))
    }

    /// A uniform number in 0..1; each `number` gives an independent one.
    pub(super) fn unit(self, number: u64) -> f32 {
        (self.child(number).0 >> 40) as f32 / (1u64 << 24) as f32
    }
}

//! How often the parts of a sample were used, so that none is repeated too often.

use graphics::field::Field;

use super::level::Level;

/// Number of patches laid from each block of a sample.
#[derive(Debug)]
pub(crate) struct Usage {
    counts: Field<u32>,
    block: usize,
    patch: usize,
    /// Number of patches that a block would give if all were used alike.
    fair: f32,
    uniformity: f32,
}

impl Usage {
    /// Of a sample from which `patches` patches of `patch` x `patch` texels will be laid.
    pub(crate) fn new(level: &Level, patch: usize, patches: usize, uniformity: f32) -> Self {
        let block = (patch / 2).max(1);
        let width = level.mask.width();
        let height = level.mask.height();
        let counts = Field::filled(width.div_ceil(block), height.div_ceil(block), 0);
        let inside = level.mask.values().iter().filter(|&&inside| inside).count().max(1);
        let fair = (patches * patch * patch) as f32 / inside as f32;
        Self { counts, block, patch, fair, uniformity }
    }

    /// Factor on the cost of a patch: 1 for an unused one, growing with its use.
    pub(crate) fn penalty(&self, place: [u16; 2]) -> f32 {
        let [x, y] = place.map(|first| (usize::from(first) + self.patch / 2) / self.block);
        1.0 + self.uniformity * self.counts[(x, y)] as f32 / self.fair.max(1.0)
    }

    /// Notes that a patch was laid.
    pub(crate) fn note(&mut self, place: [u16; 2]) {
        let blocks = |first: u16| {
            let first = usize::from(first);
            first / self.block..=(first + self.patch - 1) / self.block
        };
        for y in blocks(place[1]) {
            for x in blocks(place[0]) {
                self.counts[(x, y)] += 1;
            }
        }
    }
}

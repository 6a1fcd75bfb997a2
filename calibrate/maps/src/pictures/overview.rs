//! Maps at the size of a screen: means over squares of pixels.

use std::ops::Range;

use crate::pixel_maps::{BlockMaps, Mask, PixelCounts};

/// Means of maps over squares of pixels. Values are NaN where no pixel of a square is mapped.
#[derive(Debug, Clone, PartialEq)]
pub struct Overview {
    /// Pixels of the scan along each side of a square.
    pub step: usize,
    /// Squares in a row.
    pub width: usize,
    /// Rows of squares.
    pub height: usize,
    /// Names of the pigments.
    pub pigments: Vec<String>,
    /// Mean share of each pigment: one field of squares a pigment.
    pub share: Vec<Vec<f32>>,
    /// Mean probability of each pigment.
    pub presence: Vec<Vec<f32>>,
    /// Mean chi-square of each square, also of pixels out of gamut.
    pub chi2: Vec<f32>,
    /// Mean residual of each square, also of pixels out of gamut.
    pub rms: Vec<f32>,
    /// Mean share of each pigment over all mapped pixels.
    pub mean_share: Vec<f64>,
    /// Part of the mapped pixels where a pigment is more likely present than not.
    pub present: Vec<f64>,
    /// Number of pixels by mask.
    pub pixels: PixelCounts,
}

/// Sums of the values of each square, to which maps are added block by block.
#[derive(Debug, Clone, PartialEq)]
pub struct OverviewSums {
    step: usize,
    width: usize,
    height: usize,
    pigments: Vec<String>,
    share: Vec<Vec<f64>>,
    presence: Vec<Vec<f64>>,
    chi2: Vec<f64>,
    rms: Vec<f64>,
    /// Mapped pixels of each square.
    counts: Vec<u32>,
    /// Pixels of each square that have a chi-square.
    compared: Vec<u32>,
    /// Pixels where each pigment is more likely present than not.
    present: Vec<u64>,
    pixels: PixelCounts,
}

impl OverviewSums {
    /// Empty sums for maps of `pigments` with these rows and columns, with at most `longest` squares
    /// along the longer side.
    #[must_use]
    pub fn new(pigments: &[String], (rows, columns): (usize, usize), longest: usize) -> Self {
        let step = rows.max(columns).div_ceil(longest.max(1)).max(1);
        let width = columns.div_ceil(step);
        let height = rows.div_ceil(step);
        let field = || vec![0.0; width * height];
        Self {
            step,
            width,
            height,
            pigments: pigments.to_vec(),
            share: vec![field(); pigments.len()],
            presence: vec![field(); pigments.len()],
            chi2: field(),
            rms: field(),
            counts: vec![0; width * height],
            compared: vec![0; width * height],
            present: vec![0; pigments.len()],
            pixels: PixelCounts::default(),
        }
    }

    /// Adds the maps `block` of the pixels in `rows` and `columns`, counted from the first of the maps. Pixels
    /// outside the maps are passed over.
    pub fn add(&mut self, rows: Range<usize>, columns: Range<usize>, block: &BlockMaps) {
        self.pixels.add(&block.mask);
        let count = self.pigments.len();
        for (pixel, mask) in block.mask.iter().enumerate() {
            let row = rows.start + pixel / columns.len();
            let column = columns.start + pixel % columns.len();
            let square = row / self.step * self.width + column / self.step;
            if !mask.is_compared() || square >= self.compared.len() {
                continue;
            }
            self.compared[square] += 1;
            self.chi2[square] += f64::from(block.chi2[pixel]);
            self.rms[square] += f64::from(block.rms[pixel]);
            if *mask != Mask::Mapped {
                continue;
            }
            self.counts[square] += 1;
            for (pigment, present) in self.present.iter_mut().enumerate() {
                let at = pixel * count + pigment;
                self.share[pigment][square] += f64::from(block.share[at]);
                self.presence[pigment][square] += f64::from(block.presence[at]);
                *present += u64::from(block.presence[at] > 0.5);
            }
        }
    }

    /// Means of all that was added.
    #[must_use]
    pub fn finish(self) -> Overview {
        let mapped = self.pixels.of(Mask::Mapped);
        let means_of = |field: Vec<f64>, counts: &[u32]| -> Vec<f32> {
            let pairs = field.iter().zip(counts);
            // No pixel gives 0 / 0, which is NaN.
            pairs.map(|(sum, count)| (sum / f64::from(*count)) as f32).collect()
        };
        let part = |pixels: u64| pixels as f64 / mapped.max(1) as f64;
        Overview {
            step: self.step,
            width: self.width,
            height: self.height,
            pigments: self.pigments,
            mean_share: self
                .share
                .iter()
                .map(|field: &Vec<f64>| field.iter().sum::<f64>() / mapped.max(1) as f64)
                .collect(),
            present: self.present.into_iter().map(part).collect(),
            // One field after another, so that sums and means of all never lie side by side.
            share: self.share.into_iter().map(|field| means_of(field, &self.counts)).collect(),
            presence: self.presence.into_iter().map(|it| means_of(it, &self.counts)).collect(),
            chi2: means_of(self.chi2, &self.compared),
            rms: means_of(self.rms, &self.compared),
            pixels: self.pixels,
        }
    }
}

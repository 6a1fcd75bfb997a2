//! Maps at the size of a screen: means over squares of pixels.

use crate::blocks::PixelCounts;
use crate::pixel_maps::Mask;
use crate::store::{StoreError, StoredMaps};

/// Rows and columns that are read at once, so that wide scans take no more memory than others.
const ROWS: usize = 256;
const COLUMNS: usize = 2048;

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

/// Sum of the values of each square.
struct Sums {
    share: Vec<Vec<f64>>,
    presence: Vec<Vec<f64>>,
    chi2: Vec<f64>,
    rms: Vec<f64>,
    /// Mapped pixels of each square.
    counts: Vec<u32>,
    /// Pixels of each square that have a chi-square.
    compared: Vec<u32>,
}

impl Overview {
    /// Reads all of `maps`, with at most `longest` squares along the longer side.
    ///
    /// # Errors
    /// [`StoreError`] if a shard cannot be read.
    pub fn of(maps: &StoredMaps, longest: usize) -> Result<Self, StoreError> {
        let (rows, columns) = (maps.rows(), maps.columns());
        let step = rows.len().max(columns.len()).div_ceil(longest.max(1)).max(1);
        let (width, height) = (columns.len().div_ceil(step), rows.len().div_ceil(step));
        let count = maps.pigments().len();
        let field = || vec![0.0; width * height];
        let mut sums = Sums {
            share: vec![field(); count],
            presence: vec![field(); count],
            chi2: field(),
            rms: field(),
            counts: vec![0; width * height],
            compared: vec![0; width * height],
        };
        let mut pixels = PixelCounts::default();
        let mut present = vec![0_u64; count];
        for start in rows.clone().step_by(ROWS) {
            let end = (start + ROWS).min(rows.end);
            for left in columns.clone().step_by(COLUMNS) {
                let across = left..(left + COLUMNS).min(columns.end);
                let block = maps.read(start..end, across.clone())?;
                pixels.add(&block.mask);
                for (pixel, mask) in block.mask.iter().enumerate() {
                    if !mask.is_compared() {
                        continue;
                    }
                    let row = start - rows.start + pixel / across.len();
                    let column = left - columns.start + pixel % across.len();
                    let square = row / step * width + column / step;
                    sums.compared[square] += 1;
                    sums.chi2[square] += f64::from(block.chi2[pixel]);
                    sums.rms[square] += f64::from(block.rms[pixel]);
                    if *mask != Mask::Mapped {
                        continue;
                    }
                    sums.counts[square] += 1;
                    for (pigment, present) in present.iter_mut().enumerate() {
                        let at = pixel * count + pigment;
                        sums.share[pigment][square] += f64::from(block.share[at]);
                        sums.presence[pigment][square] += f64::from(block.presence[at]);
                        *present += u64::from(block.presence[at] > 0.5);
                    }
                }
            }
        }
        let mapped = pixels.of(Mask::Mapped);
        let means_of = |field: &Vec<f64>, counts: &[u32]| -> Vec<f32> {
            let pairs = field.iter().zip(counts);
            // No pixel gives 0 / 0, which is NaN.
            pairs.map(|(sum, count)| (sum / f64::from(*count)) as f32).collect()
        };
        let means = |field: &Vec<f64>| means_of(field, &sums.counts);
        let of_all = |field: &Vec<f64>| field.iter().sum::<f64>() / mapped.max(1) as f64;
        Ok(Self {
            step,
            width,
            height,
            pigments: maps.pigments().to_vec(),
            mean_share: sums.share.iter().map(of_all).collect(),
            present: present.into_iter().map(|n| n as f64 / mapped.max(1) as f64).collect(),
            share: sums.share.iter().map(means).collect(),
            presence: sums.presence.iter().map(means).collect(),
            chi2: means_of(&sums.chi2, &sums.compared),
            rms: means_of(&sums.rms, &sums.compared),
            pixels,
        })
    }
}

//! Textures of pigment, water and paper, which change the density of paint.
//!
//! We compute them once on the processor, from seeds or scans. Values lie in 0..1 with a mean of
//! about 0.5.

mod noise;
mod back_runs;
mod paper;

use graphics::compute::{Compute, GreyImage};
use graphics::field::Field;
use graphics::gpu::DeviceError;

use crate::settings::Settings;

pub use back_runs::back_runs;
pub use noise::{Quantiles, dispersion, turbulent_flow};
pub use paper::{BrushTouch, FineHeights, PaperTexture, PaperTextureError};

/// The textures of a picture, in the processor's memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Textures {
    /// Clouds of pigment, 0 to 1.
    pub flow: Field<f32>,
    /// Grains of pigment, 0 to 1.
    pub dispersion: Field<f32>,
    /// Heights and measures of the paper.
    pub paper: PaperTexture,
    /// Touch of the dry brush. If this is `None`, the heights of the paper decide.
    pub touch: Option<BrushTouch>,
    /// Change of density by back-runs, 0 to 1, with 0.5 for none.
    pub back_runs: Option<Field<f32>>,
}

/// Longer side in pixels of the smallest picture with pixels fine enough for the grain of paper.
const PAPER_SCALE_PX: usize = 1000;

/// Most cells of finer heights along each side of a pixel.
const MOST_CELLS: usize = 8;

impl Textures {
    /// Computes the textures of a picture of `width` x `height` pixels. You pass the `settings` for
    /// this size ([`Settings::for_size`]).
    ///
    /// # Errors
    /// [`PaperTextureError`] if the paper's scan cannot be read or the paper cannot be made.
    pub fn new(
        width: usize,
        height: usize,
        settings: &Settings,
    ) -> Result<Self, PaperTextureError> {
        let paper = PaperTexture::new(width, height, &settings.paper)?;
        Ok(Self {
            flow: turbulent_flow(width, height, &settings.flow),
            dispersion: dispersion(width, height, &settings.dispersion),
            touch: BrushTouch::new(&paper, &settings.dry_brush, &settings.paper),
            paper,
            back_runs: None,
        })
    }

    /// Textures of a picture of a photograph. This is [`Self::new`] with back-runs, and with finer
    /// heights of the paper in pictures too small for its grain (below 1000 pixels). `wash` has the
    /// colours that back-runs flow into ([`back_runs`]).
    ///
    /// # Errors
    /// [`PaperTextureError`] if the paper's scan cannot be read or the paper cannot be made.
    pub fn of_photograph(
        wash: &Field<[f32; 4]>,
        settings: &Settings,
    ) -> Result<Self, PaperTextureError> {
        let width = wash.width();
        let height = wash.height();
        let mut textures = Self::new(width, height, settings)?;
        if settings.back_runs.strength > 0.0 {
            textures.back_runs = Some(back_runs(wash, &settings.back_runs));
        }
        let factor = PAPER_SCALE_PX.div_ceil(width.max(height).max(1)).min(MOST_CELLS);
        textures.paper = textures.paper.with_fine_heights(factor, &settings.paper)?;
        Ok(textures)
    }

    /// Copies the textures into the memory of `compute`.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn upload(self, compute: &mut Compute) -> Result<TextureImages, DeviceError> {
        let heights = compute.upload(&self.paper.heights)?;
        self.with_heights(heights, compute)
    }

    /// Moves the textures into the memory of `compute`: [`Self::upload`] without a second copy
    /// of the heights, which [`PaperImage::texture`] then lacks.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub(crate) fn give(mut self, compute: &mut Compute) -> Result<TextureImages, DeviceError> {
        let heights = std::mem::replace(&mut self.paper.heights, Field::filled(0, 0, 0.0));
        let heights = compute.give(heights)?;
        self.with_heights(heights, compute)
    }

    fn with_heights(
        self,
        heights: GreyImage,
        compute: &mut Compute,
    ) -> Result<TextureImages, DeviceError> {
        let fine = self.paper.fine().map(|fine| compute.upload(&fine.heights)).transpose()?;
        let touch = match self.touch {
            Some(BrushTouch { touch, quantiles }) => Some((compute.give(touch)?, quantiles)),
            None => None,
        };
        let back_runs = self.back_runs.map(|field| compute.give(field)).transpose()?;
        Ok(TextureImages {
            flow: compute.give(self.flow)?,
            dispersion: compute.give(self.dispersion)?,
            paper: PaperImage { heights, fine, texture: self.paper },
            touch,
            back_runs,
        })
    }
}

/// [`Textures`] in the memory of a [`Compute`].
#[derive(Debug, Clone)]
pub struct TextureImages {
    /// Clouds of pigment, 0 to 1.
    pub flow: GreyImage,
    /// Grains of pigment, 0 to 1.
    pub dispersion: GreyImage,
    /// Heights and measures of the paper.
    pub paper: PaperImage,
    /// Touch of the dry brush. If this is `None`, the heights of the paper decide.
    pub touch: Option<(GreyImage, Quantiles)>,
    /// Change of density by back-runs, 0 to 1, with 0.5 for none.
    pub back_runs: Option<GreyImage>,
}

/// A paper with its heights in the memory of a [`Compute`].
#[derive(Debug, Clone)]
pub struct PaperImage {
    /// Heights of the paper, 0 to 1.
    pub heights: GreyImage,
    /// Heights on a finer grid, if the paper has them.
    pub fine: Option<GreyImage>,
    /// Heights and measures of the paper in the processor's memory.
    pub texture: PaperTexture,
}

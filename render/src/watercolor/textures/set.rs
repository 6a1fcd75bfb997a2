//! All textures of a picture together.

use super::{PaperTexture, PaperTextureError, dispersion, turbulent_flow};
use crate::watercolor::settings::Settings;
use graphics::compute::{Compute, GreyImage};
use graphics::field::Field;
use graphics::gpu::DeviceError;

/// The textures of a picture, in the processor's memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Textures {
    /// Clouds of pigment, 0 to 1.
    pub flow: Field<f32>,
    /// Grains of pigment, 0 to 1.
    pub dispersion: Field<f32>,
    /// Heights and measures of the paper.
    pub paper: PaperTexture,
}

impl Textures {
    /// Computes the textures of a picture of `width` x `height` pixels. `settings` are those
    /// for this size ([`Settings::for_size`]).
    ///
    /// # Errors
    /// [`PaperTextureError`] if the paper's scan cannot be read or the paper cannot be made.
    pub fn new(
        width: usize,
        height: usize,
        settings: &Settings,
    ) -> Result<Self, PaperTextureError> {
        Ok(Self {
            flow: turbulent_flow(width, height, &settings.flow),
            dispersion: dispersion(width, height, &settings.dispersion),
            paper: PaperTexture::new(width, height, &settings.paper)?,
        })
    }

    /// Copies the textures into the memory of `compute`.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    pub fn upload(self, compute: &mut Compute) -> Result<TextureImages, DeviceError> {
        Ok(TextureImages {
            flow: compute.upload(&self.flow)?,
            dispersion: compute.upload(&self.dispersion)?,
            paper: PaperImage {
                heights: compute.upload(&self.paper.heights)?,
                texture: self.paper,
            },
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
}

/// A paper whose heights are in the memory of a [`Compute`].
#[derive(Debug, Clone)]
pub struct PaperImage {
    /// Heights of the paper, 0 to 1.
    pub heights: GreyImage,
    /// Heights and measures of the paper in the processor's memory.
    pub texture: PaperTexture,
}

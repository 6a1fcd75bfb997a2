//! All textures of a picture together.

use super::{PaperTexture, PaperTextureError, dispersion, turbulent_flow};
use crate::watercolor::Settings;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::image::Backend;

/// The textures of a picture that stands still.
#[derive(Debug, Clone, PartialEq)]
pub struct Textures {
    /// Clouds.
    pub flow: Field<f32>,
    /// Grains.
    pub dispersion: Field<f32>,
    /// Paper.
    pub paper: PaperTexture,
}

impl Textures {
    /// Those of `settings`, told for this size (see [`Settings::for_size`]).
    ///
    /// # Errors
    /// [`PaperTextureError`] if there is no such paper.
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

    /// Puts them where pictures are worked on.
    ///
    /// # Errors
    /// As [`Backend::grey_of`].
    pub fn on<B: Backend>(self, backend: &mut B) -> Result<TexturesOn<B>, DeviceError> {
        Ok(TexturesOn {
            flow: backend.grey_of(&self.flow)?,
            dispersion: backend.grey_of(&self.dispersion)?,
            paper: PaperOn { heights: backend.grey_of(&self.paper.heights)?, texture: self.paper },
        })
    }
}

/// The same with a backend.
#[derive(Debug)]
pub struct TexturesOn<B: Backend> {
    /// Clouds.
    pub flow: B::Grey,
    /// Grains.
    pub dispersion: B::Grey,
    /// Paper.
    pub paper: PaperOn<B>,
}

/// Paper with a backend.
#[derive(Debug)]
pub struct PaperOn<B: Backend> {
    /// Its heights.
    pub heights: B::Grey,
    /// What is known of it.
    pub texture: PaperTexture,
}

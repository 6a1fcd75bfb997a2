//! Pictures and paintings of a scene with its volumes, from any camera.

use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::encoding::encode;
use graphics::field::Field;
use graphics::mesh::Mesh;
use paint::document::Document;

use super::drawer::Drawer;
use super::error::PaintingError;
use super::films::{Films, VolumePigments};
use super::in_sight;
use crate::script::RegionStyle;
use crate::settings::Settings;
use crate::world::World;

/// Paints one scene with its volumes. You can then take pictures from any camera.
#[derive(Debug)]
pub struct VolumePainter {
    pub(super) drawer: Drawer,
    pub(super) films: Option<Films>,
}

impl VolumePainter {
    /// A painter of `scene` on the processor. Pass a style for each region of its volumes
    /// ([`crate::script::Script::region_styles`]).
    ///
    /// # Errors
    /// [`PaintingError`] for a mesh with a fault, settings out of range, and shells or tints that
    /// cannot be used.
    pub fn new(
        scene: &Mesh,
        settings: &Settings,
        styles: &[RegionStyle],
    ) -> Result<Self, PaintingError> {
        Ok(Self { drawer: Drawer::new(scene, settings, styles)?, films: None })
    }

    /// Makes pictures on another device. They agree with the processor's to rounding, except for
    /// outlines within a pixel. Films of pigments stay on the processor. If the device cannot
    /// count volumes with their gates, the processor does this too ([`Self::counts_elsewhere`]).
    ///
    /// # Errors
    /// [`PaintingError::Device`] if the device cannot hold the scene.
    pub fn on(self, compute: Compute) -> Result<Self, PaintingError> {
        Ok(Self { drawer: self.drawer.on(compute)?, ..self })
    }

    /// Shows the scene in measured pigments, and volumes as films if their regions ask for this.
    /// It takes seconds.
    ///
    /// # Errors
    /// [`PaintingError::Films`] for pigments, a ground or a light that cannot be used.
    pub fn with_pigments(self, pigments: VolumePigments) -> Result<Self, PaintingError> {
        let films = Films::new(pigments, &self.drawer.settings, &self.drawer.regions)?;
        Ok(Self { films: Some(films), ..self })
    }

    /// Draws with other settings of light, grey, hatching, paper, gate and films from now on.
    ///
    /// # Errors
    /// [`PaintingError::Drawing`] for a setting out of its range.
    pub fn set_drawing(&mut self, settings: &Settings) -> Result<(), PaintingError> {
        self.drawer.set(settings)
    }

    /// Name of the device that makes its pictures.
    #[must_use]
    pub fn compute_name(&self) -> &str {
        self.drawer.compute_name()
    }

    /// Whether the processor counts the volumes though a device makes the pictures. This happens
    /// if the fragments of the device cannot write to buffers. Without it you would see paint on
    /// both sides of thin walls.
    #[must_use]
    pub fn counts_elsewhere(&self) -> bool {
        self.drawer.counts_elsewhere()
    }

    /// Whether it shows the scene in measured pigments.
    #[must_use]
    pub fn has_pigments(&self) -> bool {
        self.films.is_some()
    }

    /// The picture of the scene as `camera` sees it, in `width` x `height` pixels. You get encoded
    /// sRGB with the fourth value at 1, and the same bits for any number of threads.
    ///
    /// # Errors
    /// [`PaintingError`] for a picture without pixels or with too many, for a volume of a region
    /// that has no style, and for a device that fails.
    pub fn paint(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        let Self { drawer, films } = self;
        if let Some(films) = films {
            let parts = drawer.parts(films, world, camera, size)?;
            let mut picture = films.view.picture(&films.painter, &parts.drawing())?;
            encode(&mut picture);
            return Ok(picture);
        }
        let sight = drawer.sight(world, camera, size)?;
        let regions = drawer.regions_of(&sight);
        let paper = in_sight::paper(&drawer.settings);
        drawer.revealed(&sight, &regions, Some(paper))
    }

    /// The painting of the scene as `camera` sees it: a ground and dry layers of whole quanta, one
    /// cell for each pixel. You can save it, relight it and give it other pigments.
    ///
    /// # Errors
    /// This fails like [`Self::paint`]. If you did not call [`Self::with_pigments`], you get
    /// [`PaintingError::NoPigments`].
    pub fn painting(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
        title: &str,
    ) -> Result<Document, PaintingError> {
        let Self { drawer, films } = self;
        let films = films.as_mut().ok_or(PaintingError::NoPigments)?;
        let parts = drawer.parts(films, world, camera, size)?;
        Ok(films.painter.document(title, &parts.drawing())?)
    }
}

//! Single pictures of a world, and their files.

use graphics::camera::Camera;
use graphics::encoding::{linear_from_encoded, over_white};
use graphics::export::{PictureFormat, picture_file};
use paint::document::Lighting;
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;
use spectra::{Observer, Viewing, light_from_text};
use volumes::painter::{Show, VolumePainter};
use volumes::world::World;

use super::outputs::PictureFiles;
use crate::console::Console;
use crate::failure::Result;
use crate::output::Output;
use crate::pictures::OpenExports;
use crate::plain_picture::PX_MM;
use crate::progress::waited;
use crate::stages::StageFolder;

/// A world at one time, seen by the first camera.
pub(super) struct Stills<'a> {
    pub(super) painter: &'a mut VolumePainter,
    pub(super) world: &'a World,
    pub(super) camera: &'a Camera,
    pub(super) size: (usize, usize),
    pub(super) show: Show,
    /// Light of a painting, if it is one.
    pub(super) lighting: Option<&'a Lighting>,
    pub(super) title: &'a str,
}

impl Stills<'_> {
    /// Writes all files that are wanted.
    pub(super) fn write(&mut self, files: PictureFiles, console: &mut Console<'_>) -> Result<()> {
        let PictureFiles { exports, passes, mask, stages } = files;
        if exports.any() {
            self.exports(exports, console)?;
        }
        if let Some(output) = mask {
            self.mask(output, console)?;
        }
        if let Some(output) = passes {
            self.passes(output, console)?;
        }
        if let Some(folder) = stages {
            self.stages(&folder, console)?;
        }
        Ok(())
    }

    /// Writes the picture, and the painting with its layers.
    fn exports(&mut self, exports: OpenExports, console: &mut Console<'_>) -> Result<()> {
        match self.lighting.filter(|_| self.show == Show::Final) {
            Some(lighting) => {
                let mut painting = waited("painting", console, || self.painting(lighting))?;
                exports.write(&mut painting, console)
            }
            None => {
                let Self { world, camera, size, show, .. } = *self;
                let picture =
                    waited("drawing", console, || self.painter.shown(world, camera, size, show))?;
                let linear = linear_from_encoded(&over_white(&picture));
                exports.write_picture(&linear, PX_MM, console)
            }
        }
    }

    /// The painting under the light that it is viewed in.
    fn painting(&mut self, lighting: &Lighting) -> Result<Painting> {
        let document = self.painter.painting(self.world, self.camera, self.size, self.title)?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        let viewing = Viewing {
            illuminant: light_from_text(&lighting.illuminant)?,
            observer: Observer::named(&lighting.observer)?,
        };
        let light = Light::new(&document.library, &viewing)?;
        Ok(Painting::open_under(document, light, engine, 0)?)
    }

    fn mask(&mut self, output: Output, console: &mut Console<'_>) -> Result<()> {
        let mask = self.painter.shown(self.world, self.camera, self.size, Show::Mask)?;
        let format = PictureFormat::from_path(output.path()).unwrap_or_default();
        output.write(picture_file(&linear_from_encoded(&mask), PX_MM, format)?.bytes, console)
    }

    fn passes(&mut self, output: Output, console: &mut Console<'_>) -> Result<()> {
        output.write(self.painter.passes(self.world, self.camera, self.size, PX_MM)?, console)
    }

    fn stages(&mut self, folder: &StageFolder, console: &mut Console<'_>) -> Result<()> {
        let stages = self.painter.stages(self.world, self.camera, self.size)?.into_iter();
        folder.write(&stages.map(|stage| (stage.name, stage.picture)).collect::<Vec<_>>(), console)
    }
}

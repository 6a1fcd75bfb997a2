//! What a scene shows: pictures, its painting, what is at a place, and its script.

use graphics::camera::Camera;
use graphics::encoding::{linear_from_encoded, over_white};
use graphics::export::frame_of;
use graphics::field::Field;
use paint::document::Document;
use volumes::pigments::FilmProfile;

use super::event::{Here, SceneRecording};
use super::header::{camera_table, recorded_camera};
use super::image::SceneImage;
use super::inspect::{color_at, found_at, told};
use super::painters::{Quality, Sight};
use super::scene::Scene;
use crate::failure::FileFailure;

impl Scene {
    /// A camera as the recording keeps it, by which pictures are drawn.
    pub(super) fn recorded_camera(&self, camera: &Camera) -> Camera {
        recorded_camera(camera, &self.mesh)
    }

    /// The picture with all samples, as it is exported.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn image(&mut self, sight: &Sight) -> Result<SceneImage, FileFailure> {
        // Asked for while the moment is sought, it is that of the moment.
        self.reach_moment()?;
        if self.painters.paints(&self.look) {
            return SceneImage::of_painting(self.painting(sight)?);
        }
        Ok(SceneImage::drawing(self.picture(sight)?))
    }

    /// The picture with all samples, in linear sRGB.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn picture(&mut self, sight: &Sight) -> Result<Field<[f32; 4]>, FileFailure> {
        let world = self.timeline.now().world();
        let picture = self.painters.picture(world, sight, &self.look, Quality::BEST)?;
        // As the command line writes it, to the bit.
        Ok(linear_from_encoded(&over_white(&picture)))
    }

    /// The painting that the scene makes.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn painting(&mut self, sight: &Sight) -> Result<Document, FileFailure> {
        self.reach_moment()?;
        let world = self.timeline.now().world();
        let title = &self.recorded.base().title;
        self.painters.painting(world, sight, &self.look, title)
    }

    /// The bytes of the picture.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn pixels(
        &mut self,
        sight: &Sight,
        quality: Quality,
    ) -> Result<Vec<[u8; 4]>, FileFailure> {
        let world = self.timeline.now().world();
        let picture = self.painters.picture(world, sight, &self.look, quality)?;
        let frame = frame_of(&picture);
        self.shown = Some(picture);
        Ok(frame.values().iter().map(|&[red, green, blue]| [red, green, blue, 255]).collect())
    }

    /// Surface, paint and colour at a place of the picture.
    pub(super) fn here(&self, sight: &Sight, at: [f32; 2]) -> Here {
        let srgb = self.shown.as_ref().map_or([0; 3], |shown| color_at(shown, at));
        let drawing = &self.settings.drawing;
        let profile = FilmProfile { rim: drawing.rim, edge: drawing.edge, gate: drawing.gate };
        let found = self.hit(sight, at).map(|hit| {
            let found = found_at(self.timeline.now().world(), &hit, profile);
            (hit.place, found)
        });
        told(found, srgb, self.materials.slots, &self.recorded.base().regions)
    }

    /// The script as it would be saved, seen by `camera`.
    ///
    /// # Errors
    /// [`FileFailure`] if the script is longer than one can be.
    pub(super) fn recording(&self, camera: Option<Camera>) -> Result<SceneRecording, FileFailure> {
        let mut script = self.script();
        script.camera = camera.map(|camera| camera_table(&camera)).or(script.camera);
        let text = script.to_text().map_err(|error| FileFailure::explained(&error))?;
        let folder = self.folder.clone();
        let subject = self.file.clone();
        let library = self.materials.file.clone();
        let revision = self.recorded.revision();
        Ok(SceneRecording { text: text.into(), folder, subject, library, revision })
    }
}

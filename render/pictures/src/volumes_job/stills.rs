//! Single pictures of a world with their files: the picture or painting, a mask, layers for compositing,
//! and the intermediate stages of the picture.

use std::path::PathBuf;

use documents::{
    Task,
    file::{Output, refuse_same},
};
use graphics::{
    camera::Camera,
    encoding::{linear_from_encoded, over_white},
    export::{PictureFormat, picture_file},
};
use paint::{
    document::Lighting, engine::PaintEngine, light::Light, painting::Painting, technique::Technique,
};
use spectra::Viewing;
use volumes::painter::{Show, View, VolumePainter};
use volumes::world::World;

use crate::animation::Animation;
use crate::error::PictureError;
use crate::exports::{FrameFolder, Listener, OpenExports, PX_MM, StageFolder, opened, write};
use crate::request::{PictureRequest, VolumesRequest};

/// Files of single pictures. We have checked that you can write them.
#[derive(Debug)]
pub(super) struct PictureFiles {
    exports: OpenExports,
    passes: Option<Output>,
    mask: Option<Output>,
    stages: Option<StageFolder>,
}

/// All files of a job. We have checked that you can write them.
#[derive(Debug)]
pub(super) struct Outputs {
    pub(super) animation: Option<Animation>,
    pub(super) pictures: PictureFiles,
    pub(super) script: Option<Output>,
    pub(super) volumes: Option<FrameFolder>,
}

impl Outputs {
    /// Checks that all files can be written, with `frames` frames, but does not create them. They must not
    /// replace `inputs`.
    pub(super) fn open(
        request: &PictureRequest,
        own: &VolumesRequest,
        frames: usize,
        inputs: &[PathBuf],
    ) -> Result<Self, PictureError> {
        let animation = request.animation.open(inputs)?;
        let passes = opened(own.passes.as_ref(), &["exr"], inputs)?;
        let mask = opened(own.mask.as_ref(), &["png", "exr"], inputs)?;
        let script = opened(own.script_out.as_ref(), &["toml"], inputs)?;
        let film = animation.as_ref().and_then(Animation::file);
        let files = [passes.as_ref(), mask.as_ref(), script.as_ref(), film];
        refuse_same(&files)?;
        let exports = request.exports.clone().open(inputs)?;
        if let Some(twice) = files.into_iter().flatten().find(|output| exports.writes(output)) {
            return Err(twice.used_twice().into());
        }
        let volumes = own.volumes.as_deref();
        let volumes =
            volumes.map(|folder| FrameFolder::open(folder, "ply", frames, inputs)).transpose()?;
        let stages = request.stages.as_deref();
        let stages = stages.map(|folder| StageFolder::open(folder, inputs)).transpose()?;
        let pictures = PictureFiles { exports, passes, mask, stages };
        Ok(Self { animation, pictures, script, volumes })
    }
}

/// A world at one time, seen by the first camera.
pub(super) struct Stills<'a> {
    pub(super) painter: &'a mut VolumePainter,
    pub(super) world: &'a World,
    pub(super) camera: &'a Camera,
    pub(super) size: (usize, usize),
    pub(super) show: Show,
    /// Light of the painting, if the picture is a painting.
    pub(super) lighting: Option<&'a Lighting>,
    pub(super) title: &'a str,
}

impl<'a> Stills<'a> {
    /// Writes all files that the request asks for.
    pub(super) fn write(
        &mut self,
        files: PictureFiles,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<(), PictureError> {
        let PictureFiles { exports, passes, mask, stages } = files;
        if exports.any() {
            self.exports(exports, task, listener)?;
        }
        if let Some(output) = mask {
            task.check()?;
            self.mask(&output, listener)?;
        }
        if let Some(output) = passes {
            task.check()?;
            let passes = self.painter.passes(self.world, self.camera, self.size, PX_MM)?;
            write(&output, passes, listener)?;
        }
        if let Some(folder) = stages {
            let view = self.view();
            folder.write(&Technique::stages(self.painter, view, task)?, listener)?;
        }
        Ok(())
    }

    /// Writes the picture, and the painting with its layers.
    fn exports(
        &mut self,
        exports: OpenExports,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<(), PictureError> {
        match self.lighting.filter(|_| self.show == Show::Final) {
            Some(lighting) => {
                task.stage("painting");
                task.check()?;
                exports.write(&mut self.painting(lighting)?, task, listener)
            }
            None => {
                let view = self.view();
                let picture = Technique::paint(self.painter, view, task)?;
                let linear = linear_from_encoded(&over_white(&picture));
                exports.write_picture(&linear, PX_MM, listener)
            }
        }
    }

    fn view(&self) -> View<'a> {
        let Self { world, camera, size, show, .. } = *self;
        View { world, camera, size, show }
    }

    /// The painting under the light that it is viewed in.
    fn painting(&mut self, lighting: &Lighting) -> Result<Painting, PictureError> {
        let document = self.painter.painting(self.world, self.camera, self.size, self.title)?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        let viewing = Viewing::named(&lighting.illuminant, &lighting.observer)?;
        let light = Light::new(&document.library, &viewing)?;
        Ok(Painting::open_under(document, light, engine, 0)?)
    }

    fn mask(&mut self, output: &Output, listener: &mut Listener<'_>) -> Result<(), PictureError> {
        let mask = self.painter.shown(self.world, self.camera, self.size, Show::Mask)?;
        let format = PictureFormat::from_path(output.path()).unwrap_or_default();
        let file = picture_file(&linear_from_encoded(&mask), PX_MM, format)?;
        write(output, file.bytes, listener)
    }
}

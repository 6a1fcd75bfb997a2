//! A scene, its regions and its pigments as the subject of the technique of paint volumes.

use documents::Task;
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::mesh::Mesh;
use paint::technique::{Stage, Technique};

use super::error::PaintingError;
use super::films::VolumePigments;
use super::stages::Show;
use super::volume_painter::VolumePainter;
use crate::script::RegionStyle;
use crate::settings::{Preset, Settings};
use crate::world::World;

/// A scene with a style for each region of its volumes, its pigments, and the device that makes its
/// pictures.
#[derive(Debug)]
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a Mesh,
    /// A style for each region ([`crate::script::Script::region_styles`]).
    pub styles: &'a [RegionStyle],
    /// Measured pigments, if the scene is painted in them ([`VolumePainter::with_pigments`]).
    pub pigments: Option<VolumePigments>,
    /// Where pictures are made ([`VolumePainter::on`]).
    pub compute: Compute,
}

/// The volumes at one moment, and how you see them.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// The volumes.
    pub world: &'a World,
    /// The camera.
    pub camera: &'a Camera,
    /// Width and height of the picture in pixels.
    pub size: (usize, usize),
    /// Contents of the picture.
    pub show: Show,
}

impl Technique for VolumePainter {
    const NAME: &'static str = "volumes";
    const EXAMPLES: &'static [&'static str] = &["motion.microstructure=0.3"];

    type Settings = Settings;
    type Preset = Preset;
    type Subject<'a> = Subject<'a>;
    type View<'a> = View<'a>;
    type Picture = Field<[f32; 4]>;
    type Error = PaintingError;

    fn prepare(
        subject: Subject<'_>,
        settings: &Settings,
        task: &Task,
    ) -> Result<Self, PaintingError> {
        let Subject { scene, styles, pigments, compute } = subject;
        task.stage("preparing the scene");
        task.check()?;
        let painter = Self::new(scene, settings, styles)?.on(compute)?;
        task.check()?;
        match pigments {
            Some(pigments) => painter.with_pigments(pigments),
            None => Ok(painter),
        }
    }

    fn paint(&mut self, view: View<'_>, task: &Task) -> Result<Field<[f32; 4]>, PaintingError> {
        task.stage("drawing");
        task.check()?;
        self.shown(view.world, view.camera, view.size, view.show)
    }

    fn stages(&mut self, view: View<'_>, task: &Task) -> Result<Vec<Stage>, PaintingError> {
        task.stage("drawing the steps");
        task.check()?;
        Self::stages(self, view.world, view.camera, view.size)
    }
}

//! A model or a picture, and the maps that it is painted with, as the subject of the technique.

use documents::Task;
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::mesh::{Guide, Mesh};
use graphics::picture::Photograph;
use paint::technique::{Stage, Technique};

use super::painter::{Brushwork, Painter, PainterError};
use super::passes::PaintedPicture;
use super::picture::PictureForm;
use super::settings::{Preset, Settings};

/// A model with guides for its strokes, or a picture with its form.
#[derive(Debug)]
pub enum Form {
    /// A mesh, and guides on it.
    Model(Box<Mesh>, Vec<Guide>),
    /// A picture with its depth and directions.
    Picture(Photograph, PictureForm),
}

/// A form, the maps that it is painted with, and the device of its pictures.
#[derive(Debug)]
pub struct Subject<'a> {
    /// The model or picture that is painted.
    pub form: &'a Form,
    /// The maps, and the regions that they are for.
    pub brushwork: &'a Brushwork<'a>,
    /// Where we make pictures ([`Painter::on`]).
    pub compute: Compute,
}

/// How you see a subject.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// The camera.
    pub camera: &'a Camera,
    /// Width and height of the picture in pixels.
    pub size: (usize, usize),
    /// Time in seconds, for strokes that flow.
    pub seconds: f64,
}

impl Technique for Painter {
    const NAME: &'static str = "painterly";
    const EXAMPLES: &'static [&'static str] = &["overlap.sharpness=8", "colour.from=model"];

    type Settings = Settings;
    type Preset = Preset;
    type Subject<'a> = Subject<'a>;
    type View<'a> = View<'a>;
    type Picture = PaintedPicture;
    type Error = PainterError;

    fn prepare(
        subject: Subject<'_>,
        settings: &Settings,
        task: &Task,
    ) -> Result<Self, PainterError> {
        let Subject { form, brushwork, compute } = subject;
        task.stage("laying out strokes");
        task.check()?;
        let painter = match form {
            Form::Model(mesh, guides) => Self::of_model_with(mesh, brushwork, guides, settings),
            Form::Picture(photograph, form) => {
                Self::of_picture_with(photograph, brushwork, form, settings)
            }
        }?;
        task.check()?;
        painter.on(compute)
    }

    fn paint(&mut self, view: View<'_>, task: &Task) -> Result<PaintedPicture, PainterError> {
        task.stage("painting");
        task.check()?;
        Self::paint(self, view.camera, view.size, view.seconds)
    }

    fn stages(&mut self, view: View<'_>, task: &Task) -> Result<Vec<Stage>, PainterError> {
        task.stage("painting the steps");
        task.check()?;
        Self::stages(self, view.camera, view.size, view.seconds)
    }
}

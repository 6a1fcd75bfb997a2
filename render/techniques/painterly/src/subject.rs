//! A model or a picture, and the maps that it is painted with, as the subject of a painter and of
//! the technique.

use artmap::map::ArtMap;
use documents::Task;
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::mesh::{Guide, Mesh};
use graphics::picture::Photograph;
use paint::technique::{Stage, Technique};

use super::model;
use super::painter::{Brushwork, Painter, PainterError};
use super::passes::PaintedPicture;
use super::picture::{self, PictureForm};
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

impl Painter {
    /// Paints a mesh, from any camera, in the brushwork of an art map. This lays the map out and
    /// finds the strokes, since neither depends on the view. For example:
    ///
    /// ```
    /// use artmap::map::ArtMap;
    /// use graphics::camera::Framing;
    /// use graphics::mesh::Mesh;
    /// use painterly::{Painter, Settings};
    /// # fn example(map: &ArtMap) -> Result<(), Box<dyn std::error::Error>> {
    /// let mesh = Mesh::torus_knot(5000);
    /// let camera = Framing::default().fit(&mesh.positions);
    /// let mut painter = Painter::of_model(&mesh, map, &Settings::default())?;
    /// let painted = painter.paint(&camera, (320, 240), 0.0)?;
    /// assert_eq!(painted.color.width(), 320);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`PainterError`] for a mesh that cannot be drawn, a map without tiles, and settings out
    /// of their ranges.
    pub fn of_model(mesh: &Mesh, map: &ArtMap, settings: &Settings) -> Result<Self, PainterError> {
        Self::of_model_with(mesh, &Brushwork::of(map), &[], settings)
    }

    /// Paints a mesh with several maps, each for some materials of the mesh, and with directions
    /// that strokes must have.
    ///
    /// # Errors
    /// The errors of [`Self::of_model`], [`PainterError::Regions`] for regions that the mesh does
    /// not have, and [`PainterError::Directions`] for guides that do not lie on the mesh.
    pub fn of_model_with(
        mesh: &Mesh,
        brushwork: &Brushwork<'_>,
        guides: &[Guide],
        settings: &Settings,
    ) -> Result<Self, PainterError> {
        settings.valid()?;
        mesh.check()?;
        brushwork.check()?;
        let subject = model::subject(mesh, brushwork, guides, settings)?;
        Self::new(subject, &brushwork.art_maps(), settings)
    }

    /// Paints a photograph or another picture in the brushwork of an art map. This lays the map out
    /// and finds the strokes. For example:
    ///
    /// ```
    /// use artmap::map::ArtMap;
    /// use graphics::camera::PictureView;
    /// use painterly::{Painter, Settings};
    /// use graphics::picture::Photograph;
    /// # fn example(map: &ArtMap, photograph: &Photograph) -> Result<(), Box<dyn std::error::Error>> {
    /// let mut painter = Painter::of_picture(photograph, map, &Settings::default())?;
    /// let camera = PictureView::of(photograph.size()).camera();
    /// let painted = painter.paint(&camera, (640, 480), 0.0)?;
    /// assert_eq!(painted.color.width(), 640);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`PainterError`] for a map without tiles and settings out of their ranges.
    pub fn of_picture(
        photograph: &Photograph,
        map: &ArtMap,
        settings: &Settings,
    ) -> Result<Self, PainterError> {
        Self::of_picture_with(photograph, &Brushwork::of(map), &PictureForm::default(), settings)
    }

    /// Paints a picture with several maps, each for some regions of the picture, and with a form.
    /// You can give, for example, depth, flow or guides.
    ///
    /// # Errors
    /// The errors of [`Self::of_picture`], and [`PainterError::Regions`] for regions that pictures
    /// cannot have.
    pub fn of_picture_with(
        photograph: &Photograph,
        brushwork: &Brushwork<'_>,
        form: &PictureForm,
        settings: &Settings,
    ) -> Result<Self, PainterError> {
        settings.valid()?;
        brushwork.check()?;
        let subject = picture::subject(photograph, brushwork, form, settings)?;
        Self::new(subject, &brushwork.art_maps(), settings)
    }
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

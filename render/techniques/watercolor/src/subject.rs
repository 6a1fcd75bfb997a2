//! A photograph or a model as the subject of watercolour, and the painter of both.

use std::path::Path;

use documents::hint::Explain;
use documents::settings::{self, SettingsError};
use documents::{Cancelled, Task};
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::mesh::Mesh;
use graphics::picture::Photograph;
use paint::document::Document;
use paint::technique::{self, Technique};

use super::glaze::{GlazeError, GlazePainter};
use super::model_painter::{ModelPainter, ModelPainterError};
use super::photograph_painter::{PhotographPainter, PhotographPainterError, PreparedPhotograph};
use super::pipeline::{Masks, Stage};
use super::settings::{Preset, Settings};

/// A photograph or a model, with the size of its pictures.
#[derive(Debug)]
pub enum Form {
    /// A photograph, and the width of its picture in pixels.
    Photograph(Photograph, usize),
    /// A mesh, and width and height of its pictures in pixels.
    Model(Box<Mesh>, (usize, usize)),
}

/// A photograph or a model, where effects are weaker, and the device of the pictures.
#[derive(Debug)]
pub struct Subject {
    /// The photograph or model that is painted.
    pub form: Form,
    /// Masks, which are stretched over each picture.
    pub masks: Masks,
    /// Where pictures are made.
    pub compute: Compute,
}

/// Paints a photograph or a model in watercolour. [`PhotographPainter`] and [`ModelPainter`] do the work.
#[derive(Debug)]
pub struct WatercolorPainter(Work);

#[derive(Debug)]
enum Work {
    Photograph(Box<PhotographInWork>),
    Model(Box<ModelPainter>),
}

#[derive(Debug)]
struct PhotographInWork {
    photograph: Photograph,
    painter: PhotographPainter,
    /// Painting a picture uses up this memory.
    prepared: Option<PreparedPhotograph>,
    /// The picture at the end of the stages.
    painted: Option<Field<[f32; 4]>>,
    regions: usize,
    px_mm: f64,
}

impl PhotographInWork {
    fn new(
        photograph: Photograph,
        mut painter: PhotographPainter,
    ) -> Result<Self, PhotographPainterError> {
        let prepared = painter.prepare(&photograph)?;
        let regions = prepared.regions;
        let px_mm = prepared.textures.paper.px_mm;
        Ok(Self { photograph, painter, prepared: Some(prepared), painted: None, regions, px_mm })
    }

    /// Takes the prepared photograph. After each picture we prepare it again.
    fn take_prepared(&mut self) -> Result<PreparedPhotograph, PhotographPainterError> {
        match self.prepared.take() {
            Some(prepared) => Ok(prepared),
            None => self.painter.prepare(&self.photograph),
        }
    }

    fn paint(&mut self) -> Result<Field<[f32; 4]>, WatercolorError> {
        if let Some(painted) = self.painted.take() {
            return Ok(painted);
        }
        let prepared = self.take_prepared()?;
        Ok(self.painter.finish(prepared)?)
    }

    fn stages(&mut self) -> Result<Vec<technique::Stage>, WatercolorError> {
        let prepared = self.take_prepared()?;
        let (width, height) = self.painter.picture_size(&self.photograph);
        let mut stages = vec![
            stage("photograph", self.photograph.with_opacity(width, height)),
            stage("regions", prepared.flat_regions()),
        ];
        let painted = self.painter.paint_prepared(
            &prepared,
            Some(&mut |step: Stage, picture| stages.push(stage(step.name(), picture))),
        )?;
        self.painted = Some(painted);
        self.prepared = Some(prepared);
        Ok(stages)
    }
}

fn stage(name: &str, picture: Field<[f32; 4]>) -> technique::Stage {
    technique::Stage { name: name.to_owned(), picture }
}

/// The camera of a model.
fn of_model(view: Option<&Camera>) -> Result<&Camera, WatercolorError> {
    view.ok_or(WatercolorError::NoCamera)
}

impl WatercolorPainter {
    /// Name of the device that computes: `cpu`, or the name of a graphics adapter.
    #[must_use]
    pub fn compute_name(&self) -> &str {
        match &self.0 {
            Work::Photograph(work) => work.painter.compute_name(),
            Work::Model(painter) => painter.compute_name(),
        }
    }

    /// Width and height of the pictures in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        match &self.0 {
            Work::Photograph(work) => work.painter.picture_size(&work.photograph),
            Work::Model(painter) => painter.size(),
        }
    }

    /// Number of regions of a photograph.
    #[must_use]
    pub fn regions(&self) -> Option<usize> {
        match &self.0 {
            Work::Photograph(work) => Some(work.regions),
            Work::Model(_) => None,
        }
    }

    /// Width of a pixel of the paper in mm.
    #[must_use]
    pub fn px_mm(&self) -> f64 {
        match &self.0 {
            Work::Photograph(work) => work.px_mm,
            Work::Model(painter) => painter.paper().px_mm,
        }
    }

    /// Chooses the pigments of `glazes` for this view, so that all later paintings have the same
    /// pigments. Call this before the first frame, for example.
    ///
    /// # Errors
    /// The errors of [`Self::painting`].
    pub fn choose_pigments(
        &mut self,
        view: Option<&Camera>,
        glazes: &mut GlazePainter,
    ) -> Result<(), WatercolorError> {
        match &mut self.0 {
            Work::Photograph(work) => {
                let prepared = work.take_prepared()?;
                glazes.choose(&prepared.wash)?;
                work.prepared = Some(prepared);
            }
            Work::Model(painter) => {
                glazes.choose(&painter.wash(of_model(view)?)?.0)?;
            }
        }
        Ok(())
    }

    /// The picture as a painting of glazes.
    ///
    /// # Errors
    /// [`WatercolorError`] for a model without a camera, glazes that the library does not allow, a device that
    /// fails, and if `task` is cancelled.
    pub fn painting(
        &mut self,
        view: Option<&Camera>,
        (glazes, title): (&mut GlazePainter, &str),
        task: &Task,
    ) -> Result<Document, WatercolorError> {
        task.stage("mixing glazes");
        task.check()?;
        match &mut self.0 {
            Work::Photograph(work) => {
                let prepared = work.take_prepared()?;
                let PreparedPhotograph { wash, textures, settings, .. } = &prepared;
                let document = glazes.paint(title, wash, textures, settings)?;
                work.prepared = Some(prepared);
                Ok(document)
            }
            Work::Model(painter) => {
                let (wash, textures) = painter.wash(of_model(view)?)?;
                Ok(glazes.paint(title, &wash, &textures, painter.settings())?)
            }
        }
    }
}

impl Technique for WatercolorPainter {
    const NAME: &'static str = "watercolor";
    const EXAMPLES: &'static [&'static str] = &["edges.strength=2", "paper.kind=rough"];

    type Settings = Settings;
    type Preset = Preset;
    type Subject<'a> = Subject;
    /// The camera of a model. A photograph is seen from the front.
    type View<'a> = Option<&'a Camera>;
    /// Encoded sRGB, covered everywhere.
    type Picture = Field<[f32; 4]>;
    type Error = WatercolorError;

    fn changed_by_file(
        settings: &Settings,
        file: &Path,
        text: &str,
    ) -> Result<Settings, SettingsError> {
        let mut bare = settings.clone();
        (bare.paper.scan, bare.toon.greys) = (None, None);
        let mut changed = settings::changed(&bare, &file.display().to_string(), text)?;
        let folder = file.parent().unwrap_or(Path::new(""));
        for (named, before) in [
            (&mut changed.paper.scan, &settings.paper.scan),
            (&mut changed.toon.greys, &settings.toon.greys),
        ] {
            *named = match named.take() {
                Some(picture) => Some(folder.join(picture).display().to_string()),
                None => before.clone(),
            };
        }
        Ok(changed)
    }

    fn prepare(
        subject: Subject,
        settings: &Settings,
        task: &Task,
    ) -> Result<Self, WatercolorError> {
        let Subject { form, masks, compute } = subject;
        task.check()?;
        Ok(Self(match form {
            Form::Photograph(photograph, width) => {
                task.stage("finding regions");
                let painter = PhotographPainter::new(settings.clone())
                    .with_compute(compute)
                    .with_width_px(width)
                    .with_masks(masks);
                Work::Photograph(Box::new(PhotographInWork::new(photograph, painter)?))
            }
            Form::Model(mesh, size) => {
                task.stage("preparing the model");
                let mut painter = ModelPainter::new(compute, *mesh, settings, size)?;
                painter.set_controls(masks.controls(size.0, size.1));
                Work::Model(Box::new(painter))
            }
        }))
    }

    fn paint(
        &mut self,
        view: Option<&Camera>,
        task: &Task,
    ) -> Result<Field<[f32; 4]>, WatercolorError> {
        task.stage("painting");
        task.check()?;
        match &mut self.0 {
            Work::Photograph(work) => work.paint(),
            Work::Model(painter) => Ok(painter.paint(of_model(view)?)?),
        }
    }

    fn stages(
        &mut self,
        view: Option<&Camera>,
        task: &Task,
    ) -> Result<Vec<technique::Stage>, WatercolorError> {
        task.stage("painting the steps");
        task.check()?;
        match &mut self.0 {
            Work::Photograph(work) => work.stages(),
            Work::Model(painter) => {
                let camera = of_model(view)?;
                let mut stages = vec![stage("surface", painter.unlit(camera)?)];
                painter.paint_stages(
                    camera,
                    Some(&mut |step: Stage, picture| stages.push(stage(step.name(), picture))),
                )?;
                Ok(stages)
            }
        }
    }
}

/// A subject cannot be painted in watercolour.
#[derive(Debug, thiserror::Error, Explain)]
pub enum WatercolorError {
    /// A photograph cannot be painted.
    #[error(transparent)]
    Photograph(#[from] PhotographPainterError),
    /// A model cannot be painted.
    #[error(transparent)]
    Model(#[from] ModelPainterError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The pigments give no glazes.
    #[error(transparent)]
    Glaze(#[from] GlazeError),
    /// There is no camera that sees the model.
    #[error("a model is painted as a camera sees it, and there is none")]
    #[hint("give a [camera]")]
    #[fault(Setting)]
    NoCamera,
    /// The work was asked to end.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

#[cfg(test)]
mod tests {
    use graphics::camera::Framing;
    use graphics::export::frame_png;

    use super::*;

    fn photograph() -> Subject {
        let png = frame_png(&Field::filled(24, 16, [200, 90, 60])).unwrap();
        let photograph = Photograph::from_bytes("a.png", &png).unwrap();
        let form = Form::Photograph(photograph, 24);
        Subject { form, masks: Masks::default(), compute: Compute::cpu() }
    }

    fn model() -> Subject {
        let form = Form::Model(Box::new(Mesh::torus_knot(500)), (32, 24));
        Subject { form, masks: Masks::default(), compute: Compute::cpu() }
    }

    #[test]
    fn pictures_are_the_same_before_and_after_their_stages() {
        let task = Task::default();
        let settings = Preset::Landscape.settings();
        let camera = Framing::default().fit(&Mesh::torus_knot(500).positions);
        for (subject, view, first) in
            [(photograph(), None, "photograph"), (model(), Some(&camera), "surface")]
        {
            let mut painter = WatercolorPainter::prepare(subject, &settings, &task).unwrap();
            let picture = painter.paint(view, &task).unwrap();
            let stages = painter.stages(view, &task).unwrap();
            assert_eq!(stages[0].name, first);
            assert_eq!(stages[stages.len() - 1].picture, picture);
            for _ in 0..2 {
                assert_eq!(painter.paint(view, &task).unwrap(), picture);
            }
        }
    }

    #[test]
    fn a_model_needs_a_camera_and_cancelled_work_ends() {
        let task = Task::default();
        let settings = Settings::default();
        let mut painter = WatercolorPainter::prepare(model(), &settings, &task).unwrap();
        let error = painter.paint(None, &task).unwrap_err();
        assert_eq!(error.hint().unwrap().to_string(), "give a `camera`");
        task.cancel();
        let error = painter.paint(None, &task).unwrap_err();
        assert!(matches!(error, WatercolorError::Cancelled(_)), "{error}");
        let prepared = WatercolorPainter::prepare(photograph(), &settings, &task);
        assert!(matches!(prepared, Err(WatercolorError::Cancelled(_))));
    }

    #[test]
    fn pictures_of_a_file_of_settings_lie_beside_it() {
        let mut settings = Settings::default();
        settings.toon.greys = Some("mine/greys.png".to_owned());
        let file = Path::new("styles/rough.toml");
        let text = "[paper]\nscan = \"scan.png\"";
        let changed = WatercolorPainter::changed_by_file(&settings, file, text).unwrap();
        let beside = Path::new("styles").join("scan.png").display().to_string();
        assert_eq!((changed.paper.scan, changed.toon.greys), (Some(beside), settings.toon.greys));
    }
}

//! A photograph or a mesh painted in watercolour, with the files that were asked for.

use std::path::{Path, PathBuf};

use calibrate::{backing_from_text, library::PigmentLibrary};
use documents::{Task, file::NamedFiles};
use graphics::{
    camera::Camera,
    compute::Compute,
    encoding::{encoded_from_linear, linear_from_encoded},
    export::frame_of,
    picture::Photograph,
};
use paint::{
    document::{Document, Lighting},
    engine::PaintEngine,
    light::Light,
    painting::Painting,
    technique::Technique,
};
use spectra::Viewing;
use watercolor::{Form, GlazePainter, Masks, Settings, WatercolorPainter};

use crate::animation::FramesDigest;
use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note};
use crate::request::{OpenOutputs, PictureRequest, Summary, TechniqueOutcome, WatercolorRequest};
use crate::style::{StyleRequest, palette};
use crate::subject::{PictureViews, Subject};

/// A subject with settings, pigments and outputs that were checked.
#[derive(Debug)]
pub(crate) struct WatercolorJob {
    subject: Subject,
    title: String,
    settings: Settings,
    glazes: Option<GlazePainter>,
    masks: [Option<PathBuf>; 2],
    outputs: OpenOutputs,
}

impl WatercolorJob {
    /// Checks the whole request and reads its files.
    pub(crate) fn open(
        request: &PictureRequest,
        own: &WatercolorRequest,
        listener: &mut Listener<'_>,
    ) -> Result<Self, PictureError> {
        let PictureRequest { exports, animation, pigments, .. } = request;
        if !exports.any() && request.stages.is_none() && !animation.any() {
            let hint = "add [picture=watercolor.png], [stages=FOLDER], or [animation=turning.gif]";
            return Err(SettingError::whole("nothing would be written", hint).into());
        }
        let settings = request.style.settings::<WatercolorPainter>()?;
        let pictures = settings.paper.scan.iter().chain(&settings.toon.greys);
        let pictures: Vec<PathBuf> = pictures.map(PathBuf::from).collect();
        check_pictures(&pictures, request)?;
        let mut inputs: Vec<PathBuf> = request.style.settings.iter().cloned().collect();
        inputs.extend(pictures);
        inputs.extend(pigments.library.clone());
        let read = request.view.subject(&request.subject, PictureViews::Front)?;
        let subject = read.subject;
        inputs.extend(read.inputs);
        inputs.extend(pigments.measured_files(own.over.as_deref()));
        inputs.extend(own.dry_brush_mask.iter().chain(&own.density_mask).cloned());
        let still = match &subject {
            Subject::Photograph(..) => true,
            Subject::Mesh(_, cameras, _) => cameras.len() < 2,
        };
        if still && animation.any() {
            let hint = "add [turntable=60], or [camera=path.toml] with keyframes";
            let error = SettingError::of("animation", "", hint)
                .naming("and [frames] need a mesh and a camera that moves");
            return Err(error.into());
        }
        check_pigments(request, own)?;
        let glazes = match &pigments.library {
            Some(path) => Some(glaze_painter(path, request, own, &settings, listener)?),
            None => None,
        };
        let outputs = request.open_outputs(&inputs)?;
        let masks = [own.dry_brush_mask.clone(), own.density_mask.clone()];
        let title = request.title();
        Ok(Self { subject, title, settings, glazes, masks, outputs })
    }

    /// Paints the subject. The picture and the stages show a mesh from the first camera, the animation from
    /// all cameras.
    pub(crate) fn paint(
        self,
        compute: Compute,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<Summary, PictureError> {
        let Self { subject, title, settings, mut glazes, masks, outputs } = self;
        let OpenOutputs { exports, stages, animation } = outputs;
        let [dry_brush, density] =
            masks.map(|path| path.as_deref().map(Photograph::open).transpose());
        let masks = Masks { dry_brush: dry_brush?, density: density? };
        let mut digest = FramesDigest::default().with(&env!("CARGO_PKG_VERSION")).with(&settings);
        let (form, cameras, size) = match subject {
            Subject::Photograph(photograph, width) => {
                (Form::Photograph(photograph, width), None, None)
            }
            Subject::Mesh(mesh, cameras, size) => {
                digest = digest.with(&cameras);
                if animation.is_some() {
                    digest = digest.with(&mesh).with(&compute.name()).with(&glazes);
                    // The settings hold only the paths of these pictures, so add their content.
                    digest = digest.with(&settings.paper.scan.as_ref().map(std::fs::read));
                    digest = digest.with(&settings.toon.greys.as_ref().map(std::fs::read));
                    digest = digest.with(&masks.controls(size.0, size.1));
                }
                (Form::Model(mesh, size), Some(cameras), Some(size))
            }
        };
        let subject = watercolor::Subject { form, masks, compute };
        let mut painter = WatercolorPainter::prepare(subject, &settings, task)?;
        let size = size.unwrap_or_else(|| painter.size());
        let view = match &cameras {
            None => None,
            Some(cameras) => Some(cameras.first().ok_or_else(PictureError::no_frames)?),
        };
        let count = cameras.as_ref().map_or(1, Vec::len);
        let recording = match animation {
            Some(animation) => Some(animation.begin(digest, count, size)?),
            None => None,
        };
        if let Some(folder) = &stages {
            folder.write(&painter.stages(view, task)?, listener)?;
        }
        if exports.any() {
            match &mut glazes {
                None => {
                    let picture = linear_from_encoded(&painter.paint(view, task)?);
                    exports.write_picture(&picture, painter.px_mm(), listener)?;
                }
                Some(glazes) => {
                    let document = painter.painting(view, (glazes, &title), task)?;
                    exports.write(&mut open_painting(document, glazes)?, task, listener)?;
                }
            }
        }
        let mut frames = None;
        if let Some(recording) = recording {
            if let Some(glazes) = &mut glazes {
                // Pigments are chosen from the first camera, so that a resumed run chooses the same.
                painter.choose_pigments(view, glazes)?;
            }
            let quiet = task.quiet();
            let found = recording.paint(task, listener, |index| -> Result<_, PictureError> {
                let view: Option<&Camera> = cameras.as_ref().map(|cameras| &cameras[index]);
                let picture = match &mut glazes {
                    None => painter.paint(view, &quiet)?,
                    Some(glazes) => {
                        let document = painter.painting(view, (glazes, "frame"), &quiet)?;
                        encoded_from_linear(&open_painting(document, glazes)?.picture()?)
                    }
                };
                Ok(frame_of(&picture))
            })?;
            frames = Some((count, found));
        }
        let pigments = glazes.iter().flat_map(|glazes| glazes.pigments()).map(str::to_owned);
        Ok(Summary {
            size,
            backend: painter.compute_name().to_owned(),
            technique: TechniqueOutcome::Watercolor { regions: painter.regions() },
            frames,
            pigments: pigments.collect(),
        })
    }
}

/// Checks the pictures that the file of settings names. They must be regular files, and lie in its folder or below.
fn check_pictures(pictures: &[PathBuf], request: &PictureRequest) -> Result<(), PictureError> {
    let Some(file) = &request.style.settings else { return Ok(()) };
    // Changes of single settings come from the user, who may name any file.
    let of_file = StyleRequest { set: Vec::new(), ..request.style.clone() };
    let named = of_file.settings::<WatercolorPainter>()?;
    let mut files = NamedFiles::of(file, request.view.outside());
    for (key, path) in [("paper.scan", named.paper.scan), ("toon.greys", named.toon.greys)] {
        let Some(path) = path.map(PathBuf::from).filter(|path| pictures.contains(path)) else {
            continue;
        };
        // The path already begins with the folder of the file.
        let folder = file.parent().unwrap_or(Path::new(""));
        let named = path.strip_prefix(folder).unwrap_or(&path);
        files.find(key, &named.to_string_lossy())?;
    }
    Ok(())
}

/// Refuses keys that need pigments if the picture is painted without them.
fn check_pigments(request: &PictureRequest, own: &WatercolorRequest) -> Result<(), SettingError> {
    let pigments = &request.pigments;
    if pigments.library.is_some() {
        return Ok(());
    }
    let key = [
        ("palette", !pigments.palette.is_empty()),
        ("over", own.over.is_some()),
        ("illuminant", pigments.light() != "D65"),
    ];
    let key = key.into_iter().find(|(_, given)| *given).map(|(key, _)| key);
    match request.exports.key_of_layers().or(key) {
        None => Ok(()),
        Some(key) => Err(SettingError::of(
            key,
            "needs pigments, but no library is given",
            "name a [library] after the subject, such as oils.json; for a linear picture [picture=FILE.exr]",
        )),
    }
}

/// A painter of glazes with the pigments of the library at `path`.
fn glaze_painter(
    path: &Path,
    request: &PictureRequest,
    own: &WatercolorRequest,
    settings: &Settings,
    listener: &mut Listener<'_>,
) -> Result<GlazePainter, PictureError> {
    let pigments = &request.pigments;
    let library = PigmentLibrary::open(path)?;
    let palette = match pigments.palette.is_empty() {
        true => None,
        false => Some(palette(&pigments.palette, &library)?),
    };
    let paper = match &own.over {
        Some(text) => {
            let mut remarks = Vec::new();
            let backing = backing_from_text(text, &mut remarks);
            remarks.into_iter().for_each(|remark| listener(Note::Remark(remark)));
            let (paper, remark) = backing?.on_grid(library.grid)?;
            remark.into_iter().for_each(|remark| listener(Note::Remark(remark)));
            paper
        }
        None => GlazePainter::paper_of_settings(settings, &library)?,
    };
    let illuminant = pigments.light().to_owned();
    let lighting = Lighting { illuminant, ..Lighting::default() };
    let light = Light::new(&library, &Viewing::named(&lighting.illuminant, &lighting.observer)?)?;
    let painter = GlazePainter::new(library, paper, light, lighting);
    Ok(match palette {
        Some(palette) => painter.with_palette(palette),
        None => painter,
    })
}

/// Opens a painting of glazes under the light that they were matched under.
fn open_painting(document: Document, glazes: &GlazePainter) -> Result<Painting, PictureError> {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Ok(Painting::open_under(document, glazes.light().clone(), engine, 0)?)
}

//! A photograph painted in strokes of calibrated pigments, or separated into them, with the files that were
//! asked for.

use std::path::PathBuf;

use documents::{
    Task,
    file::{Output, OutputFolder},
};
use graphics::{compute::Compute, picture::Photograph};
use paint::{
    engine::PaintEngine, export::save_files, separation::ColorErrors, technique::Technique,
};
use strokes::{StrokePainter, StrokePainterError, StrokeSettings, Subject};

use crate::animation::AnimationRequest;
use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note, OpenExports, engine_of, write};
use crate::request::{
    Device, PictureRequest, PigmentRequest, StrokesRequest, Summary, TechniqueOutcome,
};
use crate::style::{StyleRequest, canvas_of, library_of, pigment_names};
use crate::subject::ViewRequest;

/// A photograph on its canvas, with pigments and outputs that were checked.
#[derive(Debug)]
pub(crate) struct StrokesJob {
    painter: StrokePainter,
    /// The library as the request names it, for the script of the strokes.
    library: Option<PathBuf>,
    separate: Option<OutputFolder>,
    strokes_out: Option<Output>,
    exports: OpenExports,
    device: Device,
}

impl StrokesJob {
    /// Checks the whole request, reads its files, and chooses the pigments.
    pub(crate) fn open(
        request: &PictureRequest,
        own: &StrokesRequest,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<Self, PictureError> {
        let PictureRequest { subject, pigments, exports, device, .. } = request;
        check_other_keys(request)?;
        let ground = canvas_of(&own.ground)?;
        let library = library_of(pigments.library.as_deref(), listener)?;
        let paints = exports.any() || own.strokes_out.is_some();
        if !paints && own.separate.is_none() {
            let hint = "add [picture=painting.png], [output=painting.exr], or [separate=FOLDER]";
            return Err(SettingError::whole("nothing would be written", hint).into());
        }
        let settings = StrokeSettings {
            title: request.title(),
            width_mm: own.width_mm,
            cell_mm: own.cell_mm,
            ground,
            palette: pigment_names(&pigments.palette, &library),
            brushes_mm: own.brushes_mm.clone(),
            tolerance: own.tolerance,
            seed: own.seed,
            hides: !own.thin,
        };
        settings.check()?;
        if paints && own.thin {
            let hint = "leave [thin] out, or separate first and paint in a second run";
            let error = SettingError::of("thin", "", hint)
                .naming("works only with [separate]: strokes overlap and must hide");
            return Err(error.into());
        }
        let photograph = Photograph::open(subject)?;
        settings.canvas(photograph.size())?;
        let inputs: Vec<PathBuf> =
            [subject].into_iter().chain(&pigments.library).cloned().collect();
        let exports = exports.clone().open(&inputs)?;
        let strokes_out = own.strokes_out.as_deref();
        let strokes_out = strokes_out.map(|path| Output::open(path, &inputs)).transpose()?;
        if let Some(output) = strokes_out.as_ref().filter(|output| exports.writes(output)) {
            return Err(output.used_twice().into());
        }
        let separate = own.separate.as_deref();
        let separate = separate.map(|folder| OutputFolder::open(folder, &inputs)).transpose()?;
        let subject = Subject { photograph: &photograph, library: &library };
        let painter = StrokePainter::prepare(subject, &settings, task)?;
        let library = pigments.library.clone();
        Ok(Self { painter, library, separate, strokes_out, exports, device: *device })
    }

    /// Whether strokes are painted. If not, the photograph is only separated.
    pub(crate) fn paints(&self) -> bool {
        self.exports.any() || self.strokes_out.is_some()
    }

    /// Writes the maps of the pigments, then paints the photograph if a file of it was asked for.
    pub(crate) fn paint(
        self,
        compute: Compute,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<Summary, PictureError> {
        let paints = self.paints();
        let Self { mut painter, library, separate, strokes_out, exports, device } = self;
        let pigments = painter.pigments().to_vec();
        let separation_error = match &separate {
            None => None,
            Some(folder) => Some(write_separation(&painter, folder, task, listener)?),
        };
        if !paints {
            let target = painter.target();
            let technique = TechniqueOutcome::Strokes {
                strokes: 0,
                levels: Vec::new(),
                error: None,
                separation_error,
            };
            let size = (target.width(), target.height());
            let backend = compute.name().to_owned();
            return Ok(Summary { size, backend, technique, frames: None, pigments });
        }
        let floor = &painter.ground().height;
        let opened = PaintEngine::open_on(compute.into_device(), device.into(), floor)?;
        let engine = engine_of(opened, listener);
        let mut painted = Technique::paint(&mut painter, engine, task)?;
        if let Some(path) = library {
            painted.script.library = Some(path.display().to_string());
        }
        if let Some(output) = strokes_out {
            let script = painted.script.to_json().map_err(StrokePainterError::from)?;
            write(&output, script.into_bytes(), listener)?;
        }
        exports.write(painted.painting_mut(), task, listener)?;
        let canvas = painted.session.canvas();
        let bounds = canvas.bounds();
        Ok(Summary {
            size: (bounds.width, bounds.height),
            backend: canvas.backend(),
            technique: TechniqueOutcome::Strokes {
                strokes: painted.levels.iter().map(|level| level.strokes).sum(),
                levels: painted.levels,
                error: Some(painted.error),
                separation_error,
            },
            frames: None,
            pigments,
        })
    }
}

/// Writes the maps of the pigments into `folder` and returns the colour error of the picture that they make.
fn write_separation(
    painter: &StrokePainter,
    folder: &OutputFolder,
    task: &Task,
    listener: &mut Listener<'_>,
) -> Result<ColorErrors, PictureError> {
    task.stage("separating");
    task.check()?;
    let separated = painter.separate()?;
    folder.check(separated.files.iter().map(|file| file.name.clone()))?;
    save_files(folder.path(), &separated.files)?;
    listener(Note::Wrote(folder.path().to_owned()));
    Ok(separated.error)
}

/// Refuses the keys that only other techniques take.
fn check_other_keys(request: &PictureRequest) -> Result<(), SettingError> {
    let PictureRequest { view, style, pigments, stages, animation, .. } = request;
    let ViewRequest { width, height, camera, turntable, allow_outside: _ } = view;
    let StyleRequest { preset, settings, set } = style;
    let AnimationRequest { animation, frames, rate: _ } = animation;
    let pixels = "give [width_mm] and [cell_mm], and [supersample] for more pixels a cell";
    let still = "leave it out: strokes show a photograph from the front";
    let keys = "give the keys of strokes themselves, such as [tolerance=3]";
    let script = "save the strokes with [strokes_out], and paint a timelapse of that script";
    for (key, given, hint) in [
        ("width", width.is_some(), pixels),
        ("height", height.is_some(), pixels),
        ("camera", camera.is_some(), still),
        ("turntable", turntable.is_some(), still),
        ("preset", preset.is_some(), keys),
        ("settings", settings.is_some(), keys),
        ("set", !set.is_empty(), keys),
        ("stages", stages.is_some(), script),
        ("animation", animation.is_some(), script),
        ("frames", frames.is_some(), script),
    ] {
        if given {
            let reason = "is for other techniques than strokes";
            return Err(SettingError::of(key, reason, hint));
        }
    }
    let illuminant = pigments.light();
    if illuminant != PigmentRequest::USUAL_LIGHT {
        let reason = format!("takes D65 for strokes, found `{illuminant}`");
        let hint = "leave it out, and relight the painting afterwards";
        return Err(SettingError::of("illuminant", reason, hint));
    }
    Ok(())
}

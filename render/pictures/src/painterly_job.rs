//! A model or picture painted in the brushwork of art maps, with the files that were asked for.

use std::sync::Arc;

use calibrate::library::PigmentLibrary;
use documents::{Task, text::is_toml};
use graphics::{
    camera::{Camera, PictureView},
    compute::Compute,
    encoding::{linear_from_encoded, over_white},
    export::frame_of,
    mesh::{Guide, Mesh},
};
use paint::{
    document::{Lighting, Slots},
    engine::PaintEngine,
    ground::GroundSpec,
    layer::LayerRef,
    light::Light,
    painting::Painting,
    technique::Technique,
};
use painterly::{
    FlowPicture, Form, Painter, PictureForm, Preset, Settings, Subject, View, guides::Guides,
};
use spectra::Viewing;

use crate::animation::FramesDigest;
use crate::brushwork::Maps;
use crate::error::{PictureError, SettingError};
use crate::exports::{FrameFolder, Listener, PX_MM};
use crate::request::{OpenOutputs, PainterlyRequest, PictureRequest, Summary, TechniqueOutcome};
use crate::style::{canvas_of, library_of, palette};
use crate::subject::{self, MOST_FRAMES, OpenSubject, PictureViews, check_range};

/// A subject with brushwork, materials and outputs that were checked.
#[derive(Debug)]
pub(crate) struct PainterlyJob {
    settings: Settings,
    scene: Scene,
    maps: Maps,
    /// Title, ground and pigments, if it is a painting.
    painting: Option<Materials>,
    outputs: OpenOutputs,
    exr_frames: Option<FrameFolder>,
}

/// A subject, with the cameras and the size of its pictures.
#[derive(Debug)]
struct Scene {
    form: Form,
    /// The cameras of all frames, at least one.
    cameras: Vec<Camera>,
    /// Width and height of a picture in pixels.
    size: (usize, usize),
}

/// Title, ground, pigments and light of a painting.
#[derive(Debug)]
struct Materials {
    title: String,
    ground: GroundSpec,
    /// Pigments for the colours of the subject, if they were chosen.
    pigments: Option<(Arc<PigmentLibrary>, Option<Slots>)>,
    illuminant: String,
}

impl PainterlyJob {
    /// Checks the whole request, reads its files, and makes the maps of its styles.
    pub(crate) fn open(
        request: &PictureRequest,
        own: &PainterlyRequest,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<Self, PictureError> {
        let PictureRequest { exports, animation, .. } = request;
        let single = exports.any() || request.stages.is_some();
        if !single && !animation.any() && own.exr_frames.is_none() {
            let hint = "add [picture=painted.png], or [turntable=60] [animation=turning.gif]";
            return Err(SettingError::whole("nothing would be written", hint).into());
        }
        let settings = request.style.settings::<Painter>()?;
        let views = match own.depth {
            Some(_) => PictureViews::Turned,
            None => PictureViews::Front,
        };
        let OpenSubject { subject, mut inputs, .. } =
            request.view.subject(&request.subject, views)?;
        let regions = own.open_regions(request.view.outside())?;
        inputs.extend(own.map_files());
        inputs.extend(regions.files().cloned());
        inputs.extend(request.pigments.measured_files(None));
        inputs.extend(own.directions.iter().chain(&own.depth).cloned());
        inputs.extend(request.style.settings.iter().chain(&request.pigments.library).cloned());
        let scene = scene(subject, request, own, &settings)?;
        let painting = materials(request, own, listener)?;
        let outputs = request.open_outputs(&inputs)?;
        let exr_frames = own.exr_frames.as_deref();
        let exr_frames = exr_frames
            .map(|folder| FrameFolder::open(folder, "exr", scene.cameras.len(), &inputs))
            .transpose()?;
        let preset = request.style.preset::<Painter>()?.unwrap_or(Preset::Impressionist);
        let maps = own.maps(regions, preset.style(), task)?;
        Ok(Self { settings, scene, maps, painting, outputs, exr_frames })
    }

    /// Paints the subject. The picture and the stages show it from the first camera, frames from all cameras.
    pub(crate) fn paint(
        self,
        compute: Compute,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<Summary, PictureError> {
        let Self { settings, scene, maps, painting, outputs, exr_frames } = self;
        let OpenOutputs { exports, stages, animation } = outputs;
        let Scene { form, cameras, size } = scene;
        let brushwork = maps.brushwork();
        let backend = compute.name().to_owned();
        let subject = Subject { form: &form, brushwork: &brushwork, compute };
        let mut painter = Painter::prepare(subject, &settings, task)?;
        let recording = match animation {
            None => None,
            Some(animation) => {
                let digest = FramesDigest::default()
                    .with(&env!("CARGO_PKG_VERSION"))
                    .with(&settings)
                    .with(&cameras)
                    .with(&form)
                    .with(&brushwork)
                    .with(&backend);
                Some(animation.begin(digest, cameras.len(), size)?)
            }
        };
        let first = View { camera: &cameras[0], size, seconds: 0.0 };
        let strokes = painter.splats(&cameras[0], size, 0.0)?.1;
        let layers: Vec<usize> = strokes.iter().map(Vec::len).collect();
        if let Some(folder) = stages {
            folder.write(&Technique::stages(&mut painter, first, task)?, listener)?;
        }
        let mut pigments = Vec::new();
        match painting {
            _ if !exports.any() => {}
            Some(materials) => {
                task.stage("painting");
                task.check()?;
                let mut painting = materials.painting(&mut painter, first)?;
                pigments = pigments_of(&painting);
                exports.write(&mut painting, task, listener)?;
            }
            None => {
                let picture = Technique::paint(&mut painter, first, task)?;
                let linear = linear_from_encoded(&over_white(&picture.color));
                exports.write_picture(&linear, PX_MM, listener)?;
            }
        }
        // One loop of the flow over all frames.
        let count = cameras.len();
        let loop_s = f64::from(settings.flow.loop_seconds);
        if let Some(folder) = exr_frames {
            folder.write(task, listener, |index| {
                let seconds = loop_s * index as f64 / count as f64;
                Ok(painter.exr_frame(&cameras[index], size, seconds)?)
            })?;
        }
        let mut frames = None;
        if let Some(recording) = recording {
            let found = recording.paint(task, listener, |index| -> Result<_, PictureError> {
                let seconds = loop_s * index as f64 / count as f64;
                let painted = painter.paint(&cameras[index], size, seconds)?;
                Ok(frame_of(&over_white(&painted.color)))
            })?;
            frames = Some((count, found));
        }
        let technique = TechniqueOutcome::Painterly {
            strokes: layers.iter().sum(),
            layers,
            matched: painter.matched(),
            maps: brushwork.maps.len(),
            regions: brushwork.regions.list.len(),
        };
        Ok(Summary { size, backend, technique, frames, pigments })
    }
}

impl Materials {
    /// The first picture as a painting under its light.
    fn painting(self, painter: &mut Painter, view: View<'_>) -> Result<Painting, PictureError> {
        let Self { title, ground, pigments, illuminant } = self;
        if let Some((library, palette)) = pigments {
            painter.set_pigments(library, palette);
        }
        let mut document = painter.painting(view.camera, view.size, 0.0, (&title, &ground))?;
        document.lighting = Lighting { illuminant, ..document.lighting };
        let Lighting { illuminant, observer, .. } = &document.lighting;
        let light = Light::new(&document.library, &Viewing::named(illuminant, observer)?)?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Ok(Painting::open_under(document, light, engine, 0)?)
    }
}

/// Names of the pigments of a painting.
fn pigments_of(painting: &Painting) -> Vec<String> {
    let library = painting.library();
    let wet = painting.slots(LayerRef::Wet).unwrap_or_default();
    wet.iter().flatten().map(|&pigment| library[pigment].name.clone()).collect()
}

/// The subject with the cameras of all frames.
fn scene(
    subject: subject::Subject,
    request: &PictureRequest,
    own: &PainterlyRequest,
    settings: &Settings,
) -> Result<Scene, PictureError> {
    let (form, cameras, size) = match subject {
        subject::Subject::Mesh(mesh, cameras, size) => {
            let guides = guides_of_model(own, &mesh)?;
            (Form::Model(mesh, guides), cameras, size)
        }
        subject::Subject::Photograph(photograph, width) => {
            let (own_width, own_height) = photograph.size();
            let rows = (width as f64 * own_height as f64 / own_width as f64).round() as usize;
            let size = (width, rows.max(1));
            let form = form_of_picture(own)?;
            let view = PictureView::of(photograph.size());
            let turns = request.view.picture_turns()?;
            let cameras = turns.into_iter().map(|[right, up]| view.turned(right, up));
            (Form::Picture(photograph, form), cameras.collect(), size)
        }
    };
    Ok(Scene { form, cameras: frames(cameras, request, own, settings)?, size })
}

/// The cameras of all frames.
fn frames(
    cameras: Vec<Camera>,
    request: &PictureRequest,
    own: &PainterlyRequest,
    settings: &Settings,
) -> Result<Vec<Camera>, PictureError> {
    let Some(&first) = cameras.first() else { return Err(PictureError::no_frames()) };
    check_range("loop", own.loop_frames, [1, MOST_FRAMES])?;
    let Some(frames) = own.loop_frames else {
        if cameras.len() < 2 && request.animation.any() {
            let hint = "add [turntable=60], [camera=path.toml] with keyframes, or [loop=48]";
            let error = SettingError::of("animation", "", hint)
                .naming("and [frames] need a camera or strokes that move");
            return Err(error.into());
        }
        return Ok(cameras);
    };
    if cameras.len() > 1 {
        let hint = "leave out [loop]: strokes flow while the camera moves too";
        return Err(SettingError::of("loop", "needs a camera that stands still", hint).into());
    }
    let still = settings.flow.periods == 0 && settings.flow.twinkle == 0.0;
    if still && own.regions.is_none() {
        let message = "strokes do not flow with these settings";
        let hint = "add [set=flow.periods=1], or [set=flow.twinkle=0.2]";
        return Err(SettingError::whole(message, hint).into());
    }
    Ok(vec![first; frames as usize])
}

/// The form of a picture.
fn form_of_picture(own: &PainterlyRequest) -> Result<PictureForm, PictureError> {
    let depth = own.depth.as_deref().map(PictureForm::depth_of).transpose()?;
    let mut form = PictureForm { depth, ..PictureForm::default() };
    match &own.directions {
        Some(path) if is_toml(path) => form.guides = PictureForm::guides_of(path)?,
        Some(path) => form.flow = Some(FlowPicture::open(path)?),
        None => {}
    }
    Ok(form)
}

/// The guides of a model.
fn guides_of_model(own: &PainterlyRequest, mesh: &Mesh) -> Result<Vec<Guide>, PictureError> {
    if let Some(path) = &own.depth {
        let reason = format!("{} is for pictures, and this is a model", path.display());
        let hint = "leave out [depth]: a model has its own";
        return Err(SettingError::of("depth", reason, hint).into());
    }
    let Some(path) = &own.directions else { return Ok(Vec::new()) };
    if !is_toml(path) {
        let reason = format!("{} is for pictures, and this is a model", path.display());
        let hint = "draw guides over a view of the model: guides.toml";
        return Err(SettingError::of("directions", reason, hint).into());
    }
    let guides = Guides::open(path)?;
    let Some(camera) = guides.camera_around(&mesh.positions) else {
        let message =
            format!("{}: the guides do not tell the camera of their view", path.display());
        let hint = "add camera = [30.0, 20.0, 30.0] with the degrees of [camera]";
        return Err(PictureError::Data { message, hint });
    };
    Ok(guides.on_mesh(mesh, &camera)?)
}

/// Title, ground and pigments, if the picture is a painting.
fn materials(
    request: &PictureRequest,
    own: &PainterlyRequest,
    listener: &mut Listener<'_>,
) -> Result<Option<Materials>, PictureError> {
    let chosen = &request.pigments;
    let is_chosen = chosen.library.is_some() || !chosen.palette.is_empty();
    if !(request.exports.key_of_layers().is_some() || own.with_pigments || is_chosen) {
        return Ok(None);
    }
    let pigments = match is_chosen {
        false => None,
        true => {
            let library = library_of(chosen.library.as_deref(), listener)?;
            let slots = match chosen.palette.is_empty() {
                true => None,
                false => Some(palette(&chosen.palette, &library)?),
            };
            Some((Arc::new(library), slots))
        }
    };
    let ground = canvas_of(&own.ground)?.spec(1);
    let illuminant = chosen.light().to_owned();
    Ok(Some(Materials { title: request.title(), ground, pigments, illuminant }))
}

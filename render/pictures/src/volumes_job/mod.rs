//! Plays the script of a scene with paint volumes, and writes the files that you ask for. The script
//! pours, pushes, lifts and dries paint.

mod script;
mod scene;
mod film;
mod stills;

use std::path::{Path, PathBuf};

use calibrate::{Remark, library::PigmentLibrary};
use documents::Task;
use graphics::compute::Compute;
use paint::technique::Technique;
use volumes::painter::{Show, Subject, VolumePainter, VolumePigments};
use volumes::performance::Performance;
use volumes::settings::Settings;
use volumes::world::{StepDevice, World};

use crate::animation::FramesDigest;
use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note, write};
use crate::request::{PaintAmounts, PictureRequest, Summary, TechniqueOutcome, VolumesRequest};
use crate::style::file_in;
use film::{Film, Snapshots};
use scene::{Scene, Times};
use script::{OpenScript, needs_pigments};
use stills::{Outputs, Stills};

/// A scene with its script, pigments and outputs. All of them were checked.
#[derive(Debug)]
pub(crate) struct VolumesJob {
    script: OpenScript,
    settings: Settings,
    scene: Scene,
    /// The script before its first step.
    beginning: Performance,
    pigments: Option<VolumePigments>,
    show: Show,
    times: Times,
    title: String,
    /// Text of `script_out`.
    script_text: String,
    outputs: Outputs,
}

impl VolumesJob {
    /// Checks the whole request and reads its files.
    pub(crate) fn open(
        request: &PictureRequest,
        own: &VolumesRequest,
        listener: &mut Listener<'_>,
    ) -> Result<Self, PictureError> {
        check_outputs(request, own)?;
        let show = show_of(&own.show)?;
        let path = request.subject.as_path();
        let library = request.pigments.library.as_deref();
        let library = library.map(PigmentLibrary::open).transpose()?;
        let mut script = OpenScript::open(request, own, library.as_ref(), listener)?;
        let rate = request.animation.rate;
        let frames = Times::frames(&script, rate).map_err(|fault| script.located(fault))?;
        let scene = script.scene(path, &request.view, frames)?;
        if scene.photograph {
            script.script.light_of_its_own();
        }
        let settings = script.script.settings().map_err(|fault| script.located(fault))?;
        let frames = if scene.cameras.len() > 1 { scene.cameras.len() } else { frames };
        let times = Times::of(script.script.seconds, own.at, rate, frames)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let pigments = (&request.pigments, own);
        let pigments = script.materials(&settings, pigments, (library, folder))?;
        check_layers(request, show, pigments.is_some())?;
        let library = request
            .pigments
            .library
            .clone()
            .or_else(|| script.script.library_file(folder).filter(|_| pigments.is_some()));
        let mut inputs: Vec<PathBuf> = scene.inputs.clone();
        inputs.extend(request.style.settings.iter().chain(&library).cloned());
        inputs.extend(request.pigments.measured_files(own.over.as_deref()));
        inputs.extend(script.light(&request.pigments, folder).and_then(|light| file_in(&light)));
        if scene.origin != [0.0; 3] {
            let [x, y, z] = scene.origin;
            listener(Note::Remark(Remark::note(format!(
                "{}: this model lies far from the origin; places of the script, of passes and of volumes count from \
                 ({x}, {y}, {z})",
                path.display()
            ))));
        }
        let own_title = Some(script.script.title.clone()).filter(|title| !title.is_empty());
        let title = own_title.unwrap_or_else(|| request.title());
        let script_text = match &own.script_out {
            None => String::new(),
            Some(file) => {
                let to = file.parent().unwrap_or(Path::new(""));
                let light = script.light(&request.pigments, folder);
                script.text(&scene, &title, to, (library.as_deref(), light.as_deref()))?
            }
        };
        let beginning = script.performance_at_start(&scene, &settings)?;
        let outputs = Outputs::open(request, own, frames, &inputs)?;
        Ok(Self {
            script,
            settings,
            scene,
            beginning,
            pigments,
            show,
            times,
            title,
            script_text,
            outputs,
        })
    }

    /// Plays the script and writes everything.
    pub(crate) fn paint(
        mut self,
        compute: Compute,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<Summary, PictureError> {
        let backend = compute.name().to_owned();
        let size = self.scene.size;
        let materials = self.pigments.as_ref();
        let lighting = materials.map(|own| own.lighting.clone());
        let pigments = materials.map_or_else(Vec::new, pigment_names);
        let animation = self.outputs.animation.take();
        let digest = animation.as_ref().map(|_| self.digest(&backend));
        let device = StepDevice::beside(&compute);
        let mut snapshots = match (&animation, &digest) {
            (Some(animation), Some(digest)) => {
                let digest = digest.clone().text();
                Snapshots::find(animation.folder(), digest, (&self.beginning, device), listener)
            }
            _ => Snapshots::none(device),
        };
        let subject = Subject {
            scene: &self.scene.mesh,
            styles: &self.script.script.region_styles(&self.settings),
            pigments: self.pigments.take(),
            compute,
        };
        let mut painter = VolumePainter::prepare(subject, &self.settings, task)?;
        if painter.counts_elsewhere() {
            listener(Note::Remark(Remark::warning(format!(
                "{backend} writes no buffers from fragments; volumes are counted on the processor"
            ))));
        }
        let still = self.rehearsed(animation.is_some(), &mut snapshots, task)?;
        let recording = match (animation, digest) {
            (Some(animation), Some(digest)) => {
                Some(animation.begin(digest, self.times.frames.len(), size)?)
            }
            _ => None,
        };
        let Outputs { pictures, script, volumes, .. } = self.outputs;
        let mut stills = Stills {
            painter: &mut painter,
            world: still.world(),
            camera: &self.scene.cameras[0],
            size,
            show: self.show,
            lighting: lighting.as_ref(),
            title: &self.title,
        };
        stills.write(pictures, task, listener)?;
        if let Some(output) = script {
            write(&output, self.script_text.into_bytes(), listener)?;
        }
        let mut film = Film {
            script: &self.script,
            scene: &self.scene,
            beginning: &self.beginning,
            steps: &self.times.frames,
            snapshots: &mut snapshots,
            task,
        };
        if let Some(folder) = volumes {
            film.write_volumes(folder, listener)?;
        }
        let mut frames = None;
        if let Some(recording) = recording {
            let found = film.record(recording, &mut painter, self.show, listener)?;
            frames = Some((self.times.frames.len(), found));
        }
        let technique = outcome(still.world(), &snapshots);
        Ok(Summary { size, backend, technique, frames, pigments })
    }

    /// Everything that the frames depend on.
    fn digest(&self, backend: &str) -> FramesDigest {
        FramesDigest::default()
            .with(&env!("CARGO_PKG_VERSION"))
            .with(&self.script.script)
            .with(&self.settings)
            .with(&(&self.scene.cameras, &self.times.frames, self.show))
            .with(&self.scene.mesh)
            .with(&self.pigments)
            .with(&backend)
    }

    /// Plays the script to the time of the single pictures, and returns it there. If frames are wanted,
    /// this also plays a copy to the last step, so that it reports an impossible event before anything
    /// is written. If an earlier run left snapshots, that run has checked this already.
    fn rehearsed(
        &self,
        has_frames: bool,
        snapshots: &mut Snapshots,
        task: &Task,
    ) -> Result<Performance, PictureError> {
        task.stage("spreading the paint");
        let mut play = self.beginning.clone();
        snapshots.advance(&mut play, self.times.still, &self.script, task)?;
        let still = play.clone();
        if (has_frames || self.outputs.volumes.is_some()) && !snapshots.any() {
            snapshots.advance(&mut play, self.times.last(), &self.script, task)?;
        }
        Ok(still)
    }
}

/// Figures of the world that single pictures show, and of the steps that were played.
fn outcome(world: &World, snapshots: &Snapshots) -> TechniqueOutcome {
    let tally = world.tally();
    let [on_scene, lifted, in_tube] = [tally.on_scene, tally.lifted, tally.in_tube]
        .map(|amounts: [u64; 9]| amounts.iter().sum::<u64>() as f64 * world.quantum_mm3());
    TechniqueOutcome::Volumes {
        seconds: world.seconds(),
        volumes: world.volumes().len(),
        particles: world.volumes().iter().map(|volume| volume.vertices().len()).sum(),
        cells: world.grid().cells.len(),
        paint_mm3: PaintAmounts { on_scene, lifted, in_tube },
        from_seconds: snapshots.from_s,
        steps_computed: snapshots.played,
    }
}

/// Names of the pigments of the volumes.
fn pigment_names(materials: &VolumePigments) -> Vec<String> {
    let VolumePigments { library, slots, .. } = materials;
    slots.iter().flatten().map(|&pigment| library[pigment].name.clone()).collect()
}

/// The content of pictures that the key `show` asks for.
fn show_of(name: &str) -> Result<Show, SettingError> {
    name.parse::<Show>().map_err(|_| {
        let names = Show::ALL.map(Show::name).join(", ");
        let reason = format!("takes {names}, found `{name}`");
        SettingError::of("show", reason, "try [show=final]")
    })
}

/// Refuses a request that would write nothing.
fn check_outputs(request: &PictureRequest, own: &VolumesRequest) -> Result<(), SettingError> {
    let others = [&own.passes, &own.mask, &request.stages, &own.volumes, &own.script_out];
    let writes = request.exports.any() || others.into_iter().any(Option::is_some);
    if writes || request.animation.any() {
        return Ok(());
    }
    let hint = "add [picture=spread.png], [animation=spread.gif], or [output=painting.exr]";
    Err(SettingError::whole("nothing would be written", hint))
}

/// Refuses outputs with layers of pigments if there are no pigments, or if pictures do not show the
/// painting.
fn check_layers(
    request: &PictureRequest,
    show: Show,
    has_pigments: bool,
) -> Result<(), SettingError> {
    let Some(key) = request.exports.key_of_layers() else { return Ok(()) };
    if !has_pigments {
        return Err(needs_pigments(key));
    }
    if show == Show::Final {
        return Ok(());
    }
    let error = SettingError::of(key, "", format!("leave out [{key}] or [show]"));
    Err(error.naming(&format!("is of the painting, and [show] {} is not", show.name())))
}

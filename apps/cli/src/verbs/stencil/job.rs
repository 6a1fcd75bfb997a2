//! One run: the scene that you paint, the files that we write, and the summary at the end.

use std::path::{Path, PathBuf};

use calibrate::library::PigmentLibrary;
use graphics::compute::Compute;
use pictures::{Animation, FramesDigest};
use serde_json::json;
use volumes::painter::{Show, Subject, VolumePainter, VolumePigments};
use volumes::performance::Performance;
use volumes::settings::{Preset, Settings};
use volumes::world::{StepDevice, World};

use super::film::{Film, Snapshots, Stills};
use super::options::{OpenOutputs, Stencil, apply_style};
use super::scene::{OpenScript, Scene, Times};
use crate::console::Console;
use crate::csv_rows::at_most;
use crate::failure::{Failure, Result};
use crate::progress::waited;
use crate::technique::prepared;

/// A scene, its script and its outputs.
pub(super) struct Job {
    compute: Compute,
    script: OpenScript,
    settings: Settings,
    scene: Scene,
    /// The script before its first step.
    beginning: Performance,
    pigments: Option<VolumePigments>,
    show: Show,
    times: Times,
    title: String,
    /// Text of `--script-out`.
    script_text: String,
    outputs: OpenOutputs,
    animation: Option<Animation>,
    json: bool,
}

impl Job {
    /// Checks all options and reads all files.
    pub(super) fn of(verb: Stencil, console: &mut Console<'_>) -> Result<Self> {
        check_outputs(&verb)?;
        let path = verb.subject.clone().unwrap_or_default();
        let library = verb.pigments.library()?;
        let mut script = script(&verb, &path, library.as_ref(), console)?;
        let rate = verb.animation.request().rate;
        let frames = Times::frames(&script, rate).map_err(|fault| script.located(fault))?;
        let scene = script.scene(&path, &verb.subject_options.request(), frames)?;
        if scene.photograph {
            script.script.light_of_its_own();
        }
        let settings = script.script.settings().map_err(|fault| script.located(fault))?;
        let frames = if scene.cameras.len() > 1 { scene.cameras.len() } else { frames };
        let times = Times::of(script.script.seconds, verb.at, rate, frames)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let of_script = (&script.script, &settings);
        let pigments =
            verb.pigments.materials(of_script, (library, folder), |fault| script.located(fault))?;
        check_layers(&verb, pigments.is_some())?;
        let library = verb
            .pigments
            .input()
            .cloned()
            .or_else(|| script.script.library_file(folder).filter(|_| pigments.is_some()));
        let mut inputs: Vec<PathBuf> = scene.inputs.clone();
        inputs.extend(verb.settings.input().into_iter().chain(&library).cloned());
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let own_title = Some(script.script.title.clone()).filter(|title| !title.is_empty());
        let title = own_title.or(stem).unwrap_or_default();
        let script_text = match verb.outputs.script_folder() {
            None => String::new(),
            Some(to) => {
                let light = verb.pigments.light(&script.script, folder);
                script.text(&scene, &title, &to, (library.as_deref(), light.as_deref()))?
            }
        };
        let beginning = script.performance_at_start(&scene, &settings)?;
        let compute = verb.backend.compute(console)?;
        let animation = verb.animation.request().open(&inputs)?;
        let file = animation.as_ref().and_then(Animation::file);
        let outputs = verb.outputs.open(&inputs, frames, file)?;
        let show = verb.show;
        let json = verb.json;
        Ok(Self {
            compute,
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
            animation,
            json,
        })
    }

    /// Plays the script and writes everything.
    pub(super) fn run(mut self, console: &mut Console<'_>) -> Result<()> {
        let backend = self.compute.name().to_owned();
        let size = self.scene.size;
        let lighting = self.pigments.as_ref().map(|own| own.lighting.clone());
        let animation = self.animation.take();
        let digest = animation.as_ref().map(|_| self.digest(&backend));
        let device = StepDevice::beside(&self.compute);
        let mut snapshots = match (&animation, &digest) {
            (Some(animation), Some(digest)) => {
                let wish = digest.clone().text();
                Snapshots::find(animation.folder(), wish, (&self.beginning, device), console)?
            }
            _ => Snapshots::none(device),
        };
        let mut painter = self.painter(console)?;
        if painter.counts_elsewhere() {
            console.warnings(&[format!(
                "{backend} writes no buffers from fragments; volumes are counted on the processor"
            )])?;
        }
        let still = waited("spreading the paint", console, || {
            self.rehearsed(animation.is_some(), &mut snapshots)
        })?;
        let recording = match (animation, digest) {
            (Some(animation), Some(digest)) => {
                Some(animation.begin(digest, self.times.frames.len(), size)?)
            }
            _ => None,
        };
        let OpenOutputs { pictures, script, volumes } = self.outputs;
        let mut stills = Stills {
            painter: &mut painter,
            world: still.world(),
            camera: &self.scene.cameras[0],
            size,
            show: self.show,
            lighting: lighting.as_ref(),
            title: &self.title,
        };
        stills.write(pictures, console)?;
        if let Some(output) = script {
            output.write(&self.script_text, console)?;
        }
        let mut summary = Summary::of(still.world(), size, &backend);
        let mut film = Film {
            script: &self.script,
            scene: &self.scene,
            beginning: &self.beginning,
            steps: &self.times.frames,
            snapshots: &mut snapshots,
        };
        if let Some(folder) = volumes {
            film.write_volumes(&folder, console)?;
        }
        if let Some(recording) = recording {
            let found = film.record(recording, &mut painter, self.show, console)?;
            summary.frames = Some((self.times.frames.len(), found));
        }
        (summary.from_s, summary.played) = (snapshots.from_s, snapshots.played);
        summary.print(self.json, console)
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

    fn painter(&mut self, console: &Console<'_>) -> Result<VolumePainter> {
        let subject = Subject {
            scene: &self.scene.mesh,
            styles: &self.script.script.region_styles(&self.settings),
            pigments: self.pigments.take(),
            compute: std::mem::replace(&mut self.compute, Compute::cpu()),
        };
        Ok(prepared::<VolumePainter>(subject, &self.settings, console)?)
    }

    /// Plays the script to the time of the single pictures, and returns it there. If frames are wanted,
    /// this also plays a copy to the last step, so that it reports an impossible event before anything
    /// is written. If an earlier run left snapshots, that run has checked this already.
    fn rehearsed(&self, has_frames: bool, snapshots: &mut Snapshots) -> Result<Performance> {
        let mut play = self.beginning.clone();
        let played = snapshots.advance(&mut play, self.times.still);
        played.map_err(|error| self.script.located_event(error))?;
        let still = play.clone();
        if (has_frames || self.outputs.volumes.is_some()) && !snapshots.any() {
            let played = snapshots.advance(&mut play, self.times.last());
            played.map_err(|error| self.script.located_event(error))?;
        }
        Ok(still)
    }
}

/// Refuses options that ask for nothing.
fn check_outputs(verb: &Stencil) -> Result<()> {
    if !verb.outputs.any() && !verb.animation.request().any() {
        return Err(Failure::usage(
            "nothing would be written",
            "add --picture spread.png, --animation spread.gif, or --output painting.exr",
        ));
    }
    Ok(())
}

/// Refuses outputs with layers of pigments if there are no pigments, or if `--show` does not show the
/// painting.
fn check_layers(verb: &Stencil, has_pigments: bool) -> Result<()> {
    let Some(option) = verb.outputs.layer_option() else { return Ok(()) };
    if !has_pigments {
        return Err(Failure::usage(
            format!("{option} needs pigments, but no library is given"),
            "name a LIBRARY after the subject, and give --palette",
        ));
    }
    match verb.show {
        Show::Final => Ok(()),
        show => Err(Failure::usage(
            format!("{option} is of the painting, and --show {} is not", show.name()),
            format!("leave out {option} or --show"),
        )),
    }
}

/// Reads the script and changes it as the options say.
fn script(
    verb: &Stencil,
    path: &Path,
    library: Option<&PigmentLibrary>,
    console: &mut Console<'_>,
) -> Result<OpenScript> {
    let mut open = OpenScript::of(path, &verb.pours)?;
    let usual = (verb.pigments.any() && !open.is_file()).then_some(Preset::Grisaille);
    apply_style(&verb.settings, &mut open.script, usual)?;
    verb.pours.apply(&mut open.script, verb.pigments.palette(), library)?;
    verb.pigments.apply(&mut open.script, console)?;
    // A script that is written plays the same.
    open.script = open.script.rounded();
    open.script.check().map_err(|fault| open.located(fault))?;
    if open.script.events().is_empty() {
        return Err(Failure::usage(
            format!("{}: nothing is poured", path.display()),
            "add --pour 0.5,0.5, or a script with [[pour]]",
        ));
    }
    Ok(open)
}

/// Summary of a finished run.
pub(super) struct Summary {
    size: (usize, usize),
    backend: String,
    seconds: f64,
    volumes: usize,
    particles: usize,
    cells: usize,
    /// Paint on the scene, lifted and left in the tube, in mm3.
    paint_mm3: [f64; 3],
    /// Number of frames, and how many of them existed already.
    pub(super) frames: Option<(usize, usize)>,
    /// Seconds of the snapshot that the run went on from.
    pub(super) from_s: Option<f64>,
    /// Steps of the world that were computed.
    pub(super) played: u64,
}

impl Summary {
    /// Summary of the world that single pictures show.
    pub(super) fn of(world: &World, size: (usize, usize), backend: &str) -> Self {
        let tally = world.tally();
        Self {
            size,
            backend: backend.to_owned(),
            seconds: world.seconds(),
            volumes: world.volumes().len(),
            particles: world.volumes().iter().map(|volume| volume.vertices().len()).sum(),
            cells: world.grid().cells.len(),
            paint_mm3: [tally.on_scene, tally.lifted, tally.in_tube]
                .map(|amounts: [u64; 9]| amounts.iter().sum::<u64>() as f64 * world.quantum_mm3()),
            frames: None,
            from_s: None,
            played: 0,
        }
    }

    pub(super) fn print(&self, as_json: bool, console: &mut Console<'_>) -> Result<()> {
        match as_json {
            true => console.json(&self.json()),
            false => console.line(self.line()),
        }
    }

    fn json(&self) -> serde_json::Value {
        let [on_scene, lifted, in_tube] = self.paint_mm3;
        json!({
            "size": [self.size.0, self.size.1],
            "backend": self.backend,
            "seconds": self.seconds,
            "volumes": self.volumes,
            "particles": self.particles,
            "cells": self.cells,
            "paint_mm3": { "on_scene": on_scene, "lifted": lifted, "in_tube": in_tube },
            "frames": self.frames.map(|(frames, _)| frames),
            "frames_found": self.frames.map(|(_, found)| found),
            "from_seconds": self.from_s,
            "steps_computed": self.played,
        })
    }

    fn line(&self) -> String {
        let Self { size: (width, height), backend, seconds, volumes, .. } = self;
        let [on_scene, lifted, in_tube] = self.paint_mm3;
        let volumes = documents::counted(*volumes, "volume");
        let mut line = format!(
            "{width} x {height} pixels on {backend}: {volumes} after {} s, {on_scene:.1} mm3 of paint",
            at_most(*seconds, 2)
        );
        if lifted > 0.0 {
            line += &format!(", {lifted:.1} mm3 taken up");
        }
        if in_tube > 0.0 {
            line += &format!(", {in_tube:.1} mm3 had no room and stayed in the tube");
        }
        if let Some((frames, found)) = self.frames {
            line += &format!(", {}", documents::counted(frames, "frame"));
            if found > 0 {
                let from = self
                    .from_s
                    .map_or("the beginning".to_owned(), |s| format!("{} s", at_most(s, 2)));
                line += &format!(" ({found} of them existed already; played from {from})");
            }
        }
        line
    }
}

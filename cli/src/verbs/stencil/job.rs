//! One run: what is painted, and into which files.

use std::path::PathBuf;

use render::camera::Camera;
use render::compute::Compute;
use render::encoding::{linear_from_encoded, over_white};
use render::export::{PictureFormat, frame_of, picture_file};
use render::light::Light;
use render::paint::engine::PaintEngine;
use render::paint::painting::Painting;
use render::volumes::painter::{Show, VolumePainter, VolumePigments};
use render::volumes::performance::{FirstView, Performance};
use render::volumes::script::frames_fit;
use render::volumes::settings::Settings;
use render::volumes::surfaces::ply_of;
use render::volumes::volume::Volume;
use render::volumes::world::{STEPS_PER_SECOND, World};
use serde_json::json;
use spectra::Viewing;
use spectra::{Observer, light_from_text};

use super::Stencil;
use super::outputs::OpenOutputs;
use super::scene::{OpenScript, Scene};
use crate::animation::{Animation, FramesDigest};
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::plain_picture::PX_MM;

/// A scene, its script and its outputs.
pub(super) struct Job {
    compute: Compute,
    script: OpenScript,
    settings: Settings,
    scene: Scene,
    pigments: Option<VolumePigments>,
    show: Show,
    /// Step of single pictures.
    at: u64,
    /// Steps of the frames.
    steps: Vec<u64>,
    title: String,
    outputs: OpenOutputs,
    animation: Option<Animation>,
    json: bool,
}

impl Job {
    /// Checks all options and reads all files.
    pub(super) fn of(verb: Stencil, console: &mut Console<'_>) -> Result<Self> {
        if !verb.outputs.any() && !verb.animation.any() {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture spread.png, --animation spread.gif, or --output painting.exr",
            ));
        }
        if let Some(option) = verb.outputs.layer_option().filter(|_| !verb.pigments.any()) {
            return Err(Failure::usage(
                format!("{option} needs pigments, but no library is given"),
                "add --pigments LIBRARY and --palette",
            ));
        }
        let path = verb.subject.clone().unwrap_or_default();
        let mut script = OpenScript::of(&path, verb.pours.usual_seconds())?;
        verb.settings.apply(&mut script.script)?;
        verb.pours.apply(&mut script.script, verb.pigments.palette())?;
        script.script.check().map_err(|fault| script.located(fault))?;
        if script.script.events().is_empty() {
            return Err(Failure::usage(
                format!("{}: nothing is poured", path.display()),
                "add --pour 0.5,0.5, or a script with [[pour]]",
            ));
        }
        let seconds = script.script.seconds;
        let rate = verb.animation.rate();
        let frames = frames_fit(seconds, rate).map_err(|fault| script.located(fault))? as usize;
        let scene = script.scene(&path, &verb.subject_options, frames)?;
        if scene.photograph {
            script.script.light_of_its_own();
        }
        let settings = script.script.settings().map_err(|fault| script.located(fault))?;
        let step = |seconds: f64| (seconds * f64::from(STEPS_PER_SECOND)).round() as u64;
        let at = verb.at.unwrap_or(seconds);
        if !(0.0..=seconds).contains(&at) {
            return Err(Failure::usage(
                format!("--at takes 0 to {seconds} seconds, found `{at}`"),
                "leave it out for the end, or give more --seconds",
            ));
        }
        let frames = if scene.cameras.len() > 1 { scene.cameras.len() } else { frames };
        let steps = (0..frames).map(|frame| step((frame as f64 / rate).min(seconds))).collect();
        let located = |fault| script.located(fault);
        let pigments = verb.pigments.materials(&script.script, located, console)?;
        let mut inputs: Vec<PathBuf> = scene.inputs.clone();
        inputs.extend(verb.settings.input().into_iter().chain(verb.pigments.input()).cloned());
        let animation = verb.animation.open(&inputs)?;
        let file = animation.as_ref().and_then(Animation::file);
        // Last, because it creates folders.
        let outputs = verb.outputs.open(&inputs, frames, file)?;
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let own_title = Some(script.script.title.clone()).filter(|title| !title.is_empty());
        let title = own_title.or(stem).unwrap_or_default();
        let (compute, show, json) = (verb.backend.compute()?, verb.show, verb.json);
        let at = step(at);
        Ok(Self {
            compute,
            script,
            settings,
            scene,
            pigments,
            show,
            at,
            steps,
            title,
            outputs,
            animation,
            json,
        })
    }

    /// Plays the script and writes everything.
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let Self { compute, script, settings, scene, pigments, show, at, steps, title, .. } = self;
        let OpenOutputs { exports, passes, mask, script: script_file, volumes } = self.outputs;
        let Scene { mesh, cameras, size, .. } = scene;
        let backend = compute.name().to_owned();
        let view = FirstView::new(&mesh, &cameras[0], size);
        let beginning = Performance::new(&script.script, &mesh, &settings, &view);
        let beginning = beginning.map_err(|error| script.located_event(error))?;
        let styles = script.script.region_styles(&settings);
        let recording = match self.animation {
            None => None,
            Some(animation) => {
                let digest = FramesDigest::default()
                    .add(&env!("CARGO_PKG_VERSION"))
                    .add(&script.script)
                    .add(&settings)
                    .add(&(&cameras, &steps, show))
                    .add(&mesh)
                    .add(&pigments)
                    .add(&backend);
                Some(animation.begin(digest, steps.len(), size)?)
            }
        };
        let mut painter = VolumePainter::new(&mesh, &settings, &styles)?.on(compute)?;
        let illuminant = pigments.as_ref().map(|own| own.lighting.clone());
        if let Some(pigments) = pigments {
            painter = painter.with_pigments(pigments)?;
        }
        if let Some(output) = script_file {
            output.write(script.script.to_text()?)?;
        }
        let mut still = beginning.clone();
        still.advance_to(at).map_err(|error| script.located_event(error))?;
        let (world, first) = (still.world(), &cameras[0]);
        if exports.any() {
            match &illuminant {
                Some(lighting) => {
                    let document = painter.painting(world, first, size, &title)?;
                    let engine = PaintEngine::on_cpu(document.ground.height.clone());
                    let viewing = Viewing {
                        illuminant: light_from_text(&lighting.illuminant)?,
                        observer: Observer::named(&lighting.observer)?,
                    };
                    let light = Light::new(&document.library, &viewing)?;
                    let mut painting = Painting::open_under(document, light, engine, 0)?;
                    exports.write(&mut painting, console)?;
                }
                None => {
                    let picture = painter.shown(world, first, size, show)?;
                    let linear = linear_from_encoded(&over_white(&picture));
                    exports.write_picture(&linear, PX_MM, console)?;
                }
            }
        }
        if let Some(output) = mask {
            let mask = painter.shown(world, first, size, Show::Mask)?;
            let picture = linear_from_encoded(&mask);
            let format = PictureFormat::from_path(output.path()).unwrap_or_default();
            let file = picture_file(&picture, PX_MM, format)?;
            output.write(file.bytes)?;
        }
        if let Some(output) = passes {
            output.write(painter.passes(world, first, size, PX_MM)?)?;
        }
        let summary = Summary::of(world, size, &backend);
        if !volumes.is_empty() {
            let mut play = beginning.clone();
            for (output, &step) in volumes.into_iter().zip(&steps) {
                play.advance_to(step).map_err(|error| script.located_event(error))?;
                output.write(ply_of(play.world().volumes())?)?;
            }
        }
        let mut frames = None;
        if let Some(recording) = recording {
            let mut play = beginning;
            let found = recording.paint(console, |index| {
                play.advance_to(steps[index]).map_err(|error| script.located_event(error))?;
                let camera: &Camera = &cameras[index.min(cameras.len() - 1)];
                let picture = painter.shown(play.world(), camera, size, show)?;
                Ok(frame_of(&over_white(&picture)))
            })?;
            frames = Some((steps.len(), found));
        }
        summary.print(frames, self.json, console)
    }
}

/// Summary of a finished run.
struct Summary {
    size: (usize, usize),
    backend: String,
    seconds: f64,
    volumes: usize,
    particles: usize,
    cells: usize,
    /// Paint on the scene, lifted and left in the tube, in mm3.
    paint_mm3: [f64; 3],
}

impl Summary {
    fn of(world: &World, size: (usize, usize), backend: &str) -> Self {
        let tally = world.tally();
        let mm3 = |amounts: [u64; 9]| amounts.iter().sum::<u64>() as f64 * world.quantum_mm3();
        let particles = |volume: &Volume| volume.vertices().len();
        Self {
            size,
            backend: backend.to_owned(),
            seconds: world.seconds(),
            volumes: world.volumes().len(),
            particles: world.volumes().iter().map(particles).sum(),
            cells: world.grid().cells.len(),
            paint_mm3: [tally.on_scene, tally.lifted, tally.in_tube].map(mm3),
        }
    }

    fn print(
        &self,
        frames: Option<(usize, usize)>,
        as_json: bool,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let Self { size: (width, height), backend, seconds, volumes, particles, cells, .. } = self;
        let [on_scene, lifted, in_tube] = self.paint_mm3;
        if as_json {
            return console.json(&json!({
                "size": [width, height],
                "backend": backend,
                "seconds": seconds,
                "volumes": volumes,
                "particles": particles,
                "cells": cells,
                "paint_mm3": { "on_scene": on_scene, "lifted": lifted, "in_tube": in_tube },
                "frames": frames.map(|(frames, _)| frames),
                "frames_found": frames.map(|(_, found)| found),
            }));
        }
        let mut line = format!(
            "{width} x {height} pixels on {backend}: {volumes} volumes after {seconds:.2} s, {on_scene:.1} mm3 of paint"
        );
        if in_tube > 0.0 {
            line += &format!(", {in_tube:.1} mm3 had no room and stayed in the tube");
        }
        if let Some((frames, found)) = frames {
            line += &format!(", {frames} frames");
            if found > 0 {
                line += &format!(" ({found} of them existed already)");
            }
        }
        console.line(line)
    }
}

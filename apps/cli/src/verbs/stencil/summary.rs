//! The summary of a finished run.

use serde_json::json;
use volumes::volume::Volume;
use volumes::world::World;

use crate::console::Console;
use crate::decimals::at_most;
use crate::failure::Result;

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
    /// The world of single pictures.
    pub(super) fn of(world: &World, size: (usize, usize), backend: &str) -> Self {
        let tally = world.tally();
        let particles = |volume: &Volume| volume.vertices().len();
        Self {
            size,
            backend: backend.to_owned(),
            seconds: world.seconds(),
            volumes: world.volumes().len(),
            particles: world.volumes().iter().map(particles).sum(),
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

//! The frames of a script in their order.

use graphics::encoding::over_white;
use graphics::export::frame_of;
use volumes::painter::{Show, VolumePainter};
use volumes::performance::Performance;
use volumes::surfaces::ply_of;

use super::outputs::MeshFolder;
use super::scene::{OpenScript, Scene};
use super::snapshots::{EVERY, Snapshots};
use crate::animation::Recording;
use crate::console::Console;
use crate::failure::Result;

/// A script whose frames are made.
pub(super) struct Film<'a> {
    pub(super) script: &'a OpenScript,
    pub(super) scene: &'a Scene,
    /// The script before its first step.
    pub(super) beginning: &'a Performance,
    /// Steps of the frames.
    pub(super) steps: &'a [u64],
    pub(super) snapshots: &'a mut Snapshots,
}

impl Film<'_> {
    /// Writes the volumes of each frame.
    pub(super) fn write_volumes(
        &mut self,
        folder: &MeshFolder,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let mut play = self.beginning.clone();
        for (&step, output) in self.steps.iter().zip(folder.outputs()?) {
            self.advance(&mut play, step)?;
            output.put(ply_of(play.world().volumes())?)?;
        }
        folder.told(console)
    }

    /// Paints the missing frames and returns how many existed already.
    pub(super) fn record(
        mut self,
        recording: Recording,
        painter: &mut VolumePainter,
        show: Show,
        console: &mut Console<'_>,
    ) -> Result<usize> {
        let mut play = self.beginning.clone();
        let cameras = &self.scene.cameras;
        let size = self.scene.size;
        let found = recording.paint(console, |frame| {
            self.advance_with_snapshots(&mut play, frame)?;
            let camera = &cameras[frame.min(cameras.len() - 1)];
            let picture = painter.shown(play.world(), camera, size, show)?;
            Ok(frame_of(&over_white(&picture)))
        })?;
        self.snapshots.remove()?;
        Ok(found)
    }

    /// Plays on to a frame, and keeps the snapshots on the way.
    fn advance_with_snapshots(&mut self, play: &mut Performance, frame: usize) -> Result<()> {
        let steps = self.steps;
        self.snapshots.go_ahead(play, steps[frame]);
        for mark in (EVERY..=frame).step_by(EVERY) {
            if steps[mark] > play.step() {
                self.advance(play, steps[mark])?;
                self.snapshots.keep(mark, play)?;
            }
        }
        self.advance(play, steps[frame])
    }

    fn advance(&mut self, play: &mut Performance, step: u64) -> Result<()> {
        let played = self.snapshots.advance(play, step);
        played.map_err(|error| self.script.located_event(error))
    }
}

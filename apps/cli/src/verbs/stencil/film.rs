//! Makes the frames of a script in order, and single pictures of a world. While we make an
//! animation, we keep snapshots of the script beside its frames, from which you can continue if you
//! interrupt it.

use std::path::{Path, PathBuf};

use documents::file::{read, write_whole};
use graphics::camera::Camera;
use graphics::encoding::{linear_from_encoded, over_white};
use graphics::export::{Frame, PictureFormat, frame_of, picture_file};
use paint::document::Lighting;
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;
use pictures::{PX_MM, Recording};
use spectra::{Observer, Viewing, light_from_text};
use volumes::painter::{Show, View, VolumePainter};
use volumes::performance::{Performance, PerformanceError};
use volumes::surfaces::ply_of;
use volumes::world::{StepDevice, World};

use super::options::{MeshFolder, PictureFiles};
use super::scene::{OpenScript, Scene};
use crate::console::Console;
use crate::csv_rows::at_most;
use crate::failure::{Context, Result};
use crate::output::Output;
use crate::pictures::{OpenExports, heard};
use crate::progress::waited;
use crate::technique::{painted, write_stages};

/// A script, and the frames that we make of it.
pub(super) struct Film<'a> {
    pub(super) script: &'a OpenScript,
    pub(super) scene: &'a Scene,
    /// The script before its first step.
    pub(super) beginning: &'a Performance,
    /// For each frame, the step of the world that it shows.
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
        let found = heard(console, |task, listener| {
            recording.paint(task, listener, |frame| -> Result<Frame> {
                self.advance_with_snapshots(&mut play, frame)?;
                let camera = &cameras[frame.min(cameras.len() - 1)];
                let picture = painter.shown(play.world(), camera, size, show)?;
                Ok(frame_of(&over_white(&picture)))
            })
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

/// A world at one time, seen by the first camera.
pub(super) struct Stills<'a> {
    pub(super) painter: &'a mut VolumePainter,
    pub(super) world: &'a World,
    pub(super) camera: &'a Camera,
    pub(super) size: (usize, usize),
    pub(super) show: Show,
    /// Light of a painting, if it is one.
    pub(super) lighting: Option<&'a Lighting>,
    pub(super) title: &'a str,
}

impl<'a> Stills<'a> {
    /// Writes all files that are wanted.
    pub(super) fn write(&mut self, files: PictureFiles, console: &mut Console<'_>) -> Result<()> {
        let PictureFiles { exports, passes, mask, stages } = files;
        if exports.any() {
            self.exports(exports, console)?;
        }
        if let Some(output) = mask {
            self.mask(output, console)?;
        }
        if let Some(output) = passes {
            self.passes(output, console)?;
        }
        if let Some(folder) = stages {
            let view = self.view();
            write_stages(self.painter, view, &folder, console)?;
        }
        Ok(())
    }

    /// Writes the picture, and the painting with its layers.
    fn exports(&mut self, exports: OpenExports, console: &mut Console<'_>) -> Result<()> {
        match self.lighting.filter(|_| self.show == Show::Final) {
            Some(lighting) => {
                let mut painting = waited("painting", console, || self.painting(lighting))?;
                exports.write(&mut painting, console)
            }
            None => {
                let view = self.view();
                let picture = painted(self.painter, view, console)?;
                let linear = linear_from_encoded(&over_white(&picture));
                exports.write_picture(&linear, PX_MM, console)
            }
        }
    }

    fn view(&self) -> View<'a> {
        let Self { world, camera, size, show, .. } = *self;
        View { world, camera, size, show }
    }

    /// The painting under the light that it is viewed in.
    fn painting(&mut self, lighting: &Lighting) -> Result<Painting> {
        let document = self.painter.painting(self.world, self.camera, self.size, self.title)?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        let viewing = Viewing {
            illuminant: light_from_text(&lighting.illuminant)?,
            observer: Observer::named(&lighting.observer)?,
        };
        let light = Light::new(&document.library, &viewing)?;
        Ok(Painting::open_under(document, light, engine, 0)?)
    }

    fn mask(&mut self, output: Output, console: &mut Console<'_>) -> Result<()> {
        let mask = self.painter.shown(self.world, self.camera, self.size, Show::Mask)?;
        let format = PictureFormat::from_path(output.path()).unwrap_or_default();
        output.write(picture_file(&linear_from_encoded(&mask), PX_MM, format)?.bytes, console)
    }

    fn passes(&mut self, output: Output, console: &mut Console<'_>) -> Result<()> {
        output.write(self.painter.passes(self.world, self.camera, self.size, PX_MM)?, console)
    }
}

/// Number of frames from one snapshot to the next.
pub(super) const EVERY: usize = 50;
/// Number of snapshots that are kept.
const KEPT: usize = 2;

/// Plays scripts. If there are snapshots of an earlier run, we continue from the newest one.
pub(super) struct Snapshots {
    /// Device that computes the steps of large worlds.
    device: StepDevice,
    folder: PathBuf,
    /// Digest of everything that the frames depend on.
    wish: String,
    /// Snapshots of an earlier run, in the order of their steps.
    found: Vec<Performance>,
    /// Files of snapshots, the latest written last.
    files: Vec<PathBuf>,
    /// Time in seconds of the first snapshot that was used.
    pub(super) from_s: Option<f64>,
    /// Steps that were computed.
    pub(super) played: u64,
}

impl Snapshots {
    /// No snapshots, for scripts that are played from their beginning.
    pub(super) fn none(device: StepDevice) -> Self {
        Self {
            device,
            folder: PathBuf::new(),
            wish: String::new(),
            found: Vec::new(),
            files: Vec::new(),
            from_s: None,
            played: 0,
        }
    }

    /// Finds the snapshots with the digest `wish` in the folder of the frames. If some have another
    /// digest or are damaged, we say so and do not use them.
    pub(super) fn find(
        folder: &Path,
        wish: String,
        (beginning, device): (&Performance, StepDevice),
        console: &mut Console<'_>,
    ) -> Result<Self> {
        let files = files(folder);
        let mut found = Vec::new();
        let mut faults = Vec::new();
        for file in &files {
            match read(file) {
                Err(error) => faults.push(error.to_string()),
                Ok(bytes) => match beginning.resumed(&bytes, &wish) {
                    Ok(moment) => found.push(moment),
                    Err(error) => faults.push(format!("{}: {error}", file.display())),
                },
            }
        }
        found.sort_by_key(Performance::step);
        let start = found.last().map_or("the beginning".to_owned(), |newest| {
            format!("the snapshot after {} s", at_most(newest.world().seconds(), 2))
        });
        for fault in faults {
            console.remark(format!("{fault}; the script goes on from {start}"))?;
        }
        Ok(Self { folder: folder.to_owned(), wish, found, files, ..Self::none(device) })
    }

    /// Whether there is a snapshot.
    pub(super) fn any(&self) -> bool {
        !self.found.is_empty()
    }

    /// Goes on to the newest snapshot that is not later than `step`, if it is ahead.
    pub(super) fn go_ahead(&mut self, play: &mut Performance, step: u64) {
        let now = play.step();
        let mut ahead = self.found.iter().rev();
        if let Some(moment) = ahead.find(|moment| moment.step() > now && moment.step() <= step) {
            self.from_s.get_or_insert(moment.world().seconds());
            *play = moment.clone();
        }
    }

    /// Plays until `step`. If a snapshot on the way is ahead of us, we continue from it.
    pub(super) fn advance(
        &mut self,
        play: &mut Performance,
        step: u64,
    ) -> Result<(), PerformanceError> {
        self.go_ahead(play, step);
        let before = play.step();
        let played = play.advance_on(&mut self.device, step);
        self.played += play.step() - before;
        played
    }

    /// Writes the moment of a frame, and removes all files but the newest ones.
    pub(super) fn keep(&mut self, frame: usize, moment: &Performance) -> Result<()> {
        let file = self.folder.join(file_name(frame));
        write_whole(&file, &moment.saved(&self.wish))?;
        self.files.retain(|other| *other != file);
        self.files.push(file);
        let old = self.files.len().saturating_sub(KEPT);
        self.files.drain(..old).try_for_each(|file| remove(&file))
    }

    /// Removes all files, as the animation is complete.
    pub(super) fn remove(&mut self) -> Result<()> {
        self.files.drain(..).try_for_each(|file| remove(&file))
    }
}

/// Name of the file of a frame. Indices count from 0, names from 1.
fn file_name(frame: usize) -> String {
    format!("frame-{:04}.world", frame + 1)
}

/// Files of snapshots in a folder, in the order of their frames.
fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let numbered = entries.filter_map(|entry| {
        let path = entry.ok()?.path();
        let name = path.file_name()?.to_str()?;
        let number = name.strip_prefix("frame-")?.strip_suffix(".world")?.parse::<usize>().ok()?;
        Some((number, path))
    });
    let mut files: Vec<(usize, PathBuf)> = numbered.collect();
    files.sort_unstable();
    files.into_iter().map(|(_, path)| path).collect()
}

fn remove(file: &Path) -> Result<()> {
    match std::fs::remove_file(file) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(error).context(|| format!("{}: this snapshot cannot be removed", file.display()))
        }
        _ => Ok(()),
    }
}

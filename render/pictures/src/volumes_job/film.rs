//! Makes the frames of a script in order. While we make an animation, we write snapshots of the script
//! beside its frames. If you interrupt the run, the next run continues from the newest snapshot.

use std::path::{Path, PathBuf};

use calibrate::Remark;
use documents::{
    Task,
    file::{read, write_whole},
};
use graphics::{
    encoding::over_white,
    export::{Frame, frame_of},
};
use volumes::painter::{Show, VolumePainter};
use volumes::performance::Performance;
use volumes::surfaces::ply_of;
use volumes::world::StepDevice;

use super::scene::Scene;
use super::script::OpenScript;
use crate::animation::Recording;
use crate::error::PictureError;
use crate::exports::{FrameFolder, Listener, Note, frame_name};

/// A script, and the frames that we make of it.
pub(super) struct Film<'a> {
    pub(super) script: &'a OpenScript,
    pub(super) scene: &'a Scene,
    /// The script before its first step.
    pub(super) beginning: &'a Performance,
    /// For each frame, the step of the world that it shows.
    pub(super) steps: &'a [u64],
    pub(super) snapshots: &'a mut Snapshots,
    pub(super) task: &'a Task,
}

impl Film<'_> {
    /// Writes the volumes of each frame.
    pub(super) fn write_volumes(
        &mut self,
        folder: FrameFolder,
        listener: &mut Listener<'_>,
    ) -> Result<(), PictureError> {
        self.task.stage("writing the volumes");
        let mut play = self.beginning.clone();
        let task = self.task;
        folder.write(task, listener, |frame| {
            self.advance(&mut play, self.steps[frame])?;
            Ok(ply_of(play.world().volumes())?)
        })
    }

    /// Paints the missing frames and returns how many existed already.
    pub(super) fn record(
        mut self,
        recording: Recording,
        painter: &mut VolumePainter,
        show: Show,
        listener: &mut Listener<'_>,
    ) -> Result<usize, PictureError> {
        let mut play = self.beginning.clone();
        let Scene { cameras, size, .. } = self.scene;
        let task = self.task;
        let found = recording.paint(task, listener, |frame| -> Result<Frame, PictureError> {
            self.advance_with_snapshots(&mut play, frame)?;
            let camera = &cameras[frame.min(cameras.len() - 1)];
            let picture = painter.shown(play.world(), camera, *size, show)?;
            Ok(frame_of(&over_white(&picture)))
        })?;
        self.snapshots.remove()?;
        Ok(found)
    }

    /// Plays on to a frame, and writes snapshots on the way.
    fn advance_with_snapshots(
        &mut self,
        play: &mut Performance,
        frame: usize,
    ) -> Result<(), PictureError> {
        let steps = self.steps;
        self.snapshots.skip_ahead(play, steps[frame]);
        for mark in (FRAMES_PER_SNAPSHOT..=frame).step_by(FRAMES_PER_SNAPSHOT) {
            if steps[mark] > play.step() {
                self.advance(play, steps[mark])?;
                self.snapshots.save(mark, play)?;
            }
        }
        self.advance(play, steps[frame])
    }

    fn advance(&mut self, play: &mut Performance, step: u64) -> Result<(), PictureError> {
        self.snapshots.advance(play, step, self.script, self.task)
    }
}

/// Number of frames from one snapshot to the next.
const FRAMES_PER_SNAPSHOT: usize = 50;
/// Number of the newest snapshots that stay beside the frames.
const MOST_SNAPSHOTS: usize = 2;
/// Number of steps after which we check whether the task is cancelled. This is one second of the world.
const STEPS_PER_CHECK: u64 = 120;

/// Plays scripts. If there are snapshots of an earlier run, we continue from the newest one.
pub(super) struct Snapshots {
    /// Device that computes the steps of large worlds.
    device: StepDevice,
    folder: PathBuf,
    /// Digest of everything that the frames depend on.
    digest: String,
    /// Snapshots of an earlier run, in the order of their steps.
    found: Vec<Performance>,
    /// Files of snapshots, the latest written last.
    files: Vec<PathBuf>,
    /// Time in seconds of the first snapshot that was used.
    pub(super) from_s: Option<f64>,
    /// Number of steps that were computed.
    pub(super) played: u64,
}

impl Snapshots {
    /// No snapshots. Use this for a script that is played from its beginning.
    pub(super) fn none(device: StepDevice) -> Self {
        Self {
            device,
            folder: PathBuf::new(),
            digest: String::new(),
            found: Vec::new(),
            files: Vec::new(),
            from_s: None,
            played: 0,
        }
    }

    /// Finds the snapshots with this `digest` in the folder of the frames. If some have another digest
    /// or are damaged, the listener hears of it and we do not use them.
    pub(super) fn find(
        folder: &Path,
        digest: String,
        (beginning, device): (&Performance, StepDevice),
        listener: &mut Listener<'_>,
    ) -> Self {
        let files = files(folder);
        let mut found = Vec::new();
        let mut faults = Vec::new();
        for file in &files {
            match read(file) {
                Err(error) => faults.push(error.to_string()),
                Ok(bytes) => match beginning.resumed(&bytes, &digest) {
                    Ok(moment) => found.push(moment),
                    Err(error) => faults.push(format!("{}: {error}", file.display())),
                },
            }
        }
        found.sort_by_key(Performance::step);
        let start = found.last().map_or("the beginning".to_owned(), |newest| {
            format!("the snapshot after {} s", with_two_decimals(newest.world().seconds()))
        });
        for fault in faults {
            let text = format!("{fault}; the script goes on from {start}");
            listener(Note::Remark(Remark::note(text)));
        }
        Self { folder: folder.to_owned(), digest, found, files, ..Self::none(device) }
    }

    /// Whether there is a snapshot.
    pub(super) fn any(&self) -> bool {
        !self.found.is_empty()
    }

    /// Replaces `play` by the newest snapshot up to `step`, if this snapshot is later than `play`.
    fn skip_ahead(&mut self, play: &mut Performance, step: u64) {
        let now = play.step();
        let mut ahead = self.found.iter().rev();
        if let Some(moment) = ahead.find(|moment| moment.step() > now && moment.step() <= step) {
            self.from_s.get_or_insert(moment.world().seconds());
            *play = moment.clone();
        }
    }

    /// Plays `script` until `step`. If there is a snapshot on the way, we continue from it.
    pub(super) fn advance(
        &mut self,
        play: &mut Performance,
        step: u64,
        script: &OpenScript,
        task: &Task,
    ) -> Result<(), PictureError> {
        self.skip_ahead(play, step);
        while play.step() < step {
            task.check()?;
            let before = play.step();
            let played = play.advance_on(&mut self.device, step.min(before + STEPS_PER_CHECK));
            self.played += play.step() - before;
            played.map_err(|error| script.located_event(error))?;
        }
        Ok(())
    }

    /// Writes a snapshot of a frame, and removes all files except the newest ones.
    fn save(&mut self, frame: usize, moment: &Performance) -> Result<(), PictureError> {
        let file = self.folder.join(frame_name(frame, "world"));
        write_whole(&file, &moment.saved(&self.digest))?;
        self.files.retain(|other| *other != file);
        self.files.push(file);
        let old = self.files.len().saturating_sub(MOST_SNAPSHOTS);
        self.files.drain(..old).try_for_each(|file| remove(&file))
    }

    /// Removes all files, as the animation is complete.
    fn remove(&mut self) -> Result<(), PictureError> {
        self.files.drain(..).try_for_each(|file| remove(&file))
    }
}

/// A number with at most two decimals, e.g. `0.5`.
fn with_two_decimals(seconds: f64) -> String {
    let text = format!("{seconds:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
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

fn remove(file: &Path) -> Result<(), PictureError> {
    match std::fs::remove_file(file) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(PictureError::Snapshot(file.display().to_string(), error))
        }
        _ => Ok(()),
    }
}

//! Moments of a script beside the frames of its animation, from which an interrupted one goes on.

use std::path::{Path, PathBuf};

use documents::file::{read, write_whole};
use volumes::performance::{Performance, PerformanceError};
use volumes::world::StepDevice;

use crate::console::Console;
use crate::decimals::at_most;
use crate::failure::{Context, Result};

/// Frames from one snapshot to the next.
pub(super) const EVERY: usize = 50;
/// Number of snapshots that are kept.
const KEPT: usize = 2;

/// Plays scripts, from the newest snapshot where there is one.
pub(super) struct Snapshots {
    /// Device of large worlds.
    device: StepDevice,
    folder: PathBuf,
    /// Digest of everything that the frames depend on.
    wish: String,
    /// Snapshots of an earlier run, in the order of their steps.
    found: Vec<Performance>,
    /// Files of snapshots, the latest written last.
    files: Vec<PathBuf>,
    /// Seconds of the snapshot that was used first.
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

    /// Finds the snapshots of this `wish` in the folder of its frames. Others, and damaged ones,
    /// are told and not used.
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

    /// Whether there is one.
    pub(super) fn any(&self) -> bool {
        !self.found.is_empty()
    }

    /// Goes on to the newest snapshot that is not later than `step`, if it is ahead.
    pub(super) fn go_ahead(&mut self, play: &mut Performance, step: u64) {
        let now = play.step();
        let ahead = |moment: &&Performance| moment.step() > now && moment.step() <= step;
        if let Some(moment) = self.found.iter().rev().find(ahead) {
            self.from_s.get_or_insert(moment.world().seconds());
            *play = moment.clone();
        }
    }

    /// Plays on until `step`, by way of a snapshot where one is ahead.
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

/// Name of the file of a frame; indices count from 0, names from 1.
fn file_name(frame: usize) -> String {
    format!("frame-{:04}.world", frame + 1)
}

/// Files of snapshots in a folder, in the order of their frames.
fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let numbered = |path: PathBuf| {
        let name = path.file_name()?.to_str()?;
        let number = name.strip_prefix("frame-")?.strip_suffix(".world")?.parse::<usize>().ok()?;
        Some((number, path))
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files: Vec<(usize, PathBuf)> = paths.filter_map(numbered).collect();
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

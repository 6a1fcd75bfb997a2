//! The recording of a session in a file that only grows.
//!
//! Each line is an action. A generation names the file and says how many of its bytes belong to it,
//! so that what a crash left behind them does no harm, and an autosave writes only the actions
//! since the last one.

use documents::file::disk;
use documents::file::disk::{File, OpenOptions};
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use paint::session::RecordingTail;
use paint::strokes::{Action, StrokeScript};
use serde::{Deserialize, Serialize};

use crate::failure::FileFailure;

/// Start of the names of recordings.
const NAME: &str = "recording-";

/// Start of the names of the paintings that recordings continue.
const START: &str = "start-";

/// The recording of a generation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct KeptRecording {
    file: String,
    bytes: u64,
    header: StrokeScript,
    /// Action that was not yet finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    open: Option<Action>,
    /// File of the painting that the recording continues.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<String>,
}

/// The recording file of a running session.
#[derive(Debug, Default)]
pub(super) struct RecordingFile {
    /// Number of recordings so far, which gives each its own names.
    count: u64,
    now: Option<Written>,
}

/// Part of the present recording that is already written.
#[derive(Debug)]
struct Written {
    bytes: u64,
    actions: usize,
    start: Option<String>,
}

impl RecordingFile {
    /// Number of actions that are written.
    pub(super) fn actions(&self) -> usize {
        self.now.as_ref().map_or(0, |written| written.actions)
    }

    /// Appends the end of a recording to its file in `folder`. An end from the first action on
    /// begins another file, beside the painting that it continues. Returns `None` for an end that
    /// does not follow what is written.
    pub(super) fn append(
        &mut self,
        folder: &Path,
        tail: &RecordingTail,
        start: Option<&[u8]>,
    ) -> std::io::Result<Option<KeptRecording>> {
        if tail.from == 0 {
            self.now = None;
            self.count += 1;
            let start = match start.filter(|_| tail.header.start.is_some()) {
                Some(bytes) => Some(self.write_start(folder, bytes)?),
                None => None,
            };
            File::create(folder.join(self.name()))?;
            self.now = Some(Written { bytes: 0, actions: 0, start });
        }
        let name = self.name();
        let Some(written) = self.now.as_mut().filter(|written| written.actions == tail.from) else {
            return Ok(None);
        };
        let mut file = OpenOptions::new().write(true).open(folder.join(&name))?;
        // An attempt that failed may have left more.
        file.set_len(written.bytes)?;
        file.seek(SeekFrom::End(0))?;
        let mut lines = BufWriter::new(file);
        let mut bytes = written.bytes;
        for action in &tail.actions {
            let line = serde_json::to_vec(action)?;
            lines.write_all(&line)?;
            lines.write_all(b"\n")?;
            bytes += line.len() as u64 + 1;
        }
        lines.into_inner().map_err(std::io::IntoInnerError::into_error)?.sync_all()?;
        (written.bytes, written.actions) = (bytes, written.actions + tail.actions.len());
        let header = tail.header.clone();
        let open = tail.open.clone();
        let start = written.start.clone();
        Ok(Some(KeptRecording { file: name, bytes, header, open, start }))
    }

    fn name(&self) -> String {
        format!("{NAME}{}.jsonl", self.count)
    }

    fn write_start(&self, folder: &Path, bytes: &[u8]) -> std::io::Result<String> {
        let name = format!("{START}{}.exr", self.count);
        let mut file = File::create(folder.join(&name))?;
        file.write_all(bytes)?;
        file.sync_all()?;
        Ok(name)
    }

    /// Forgets the recording, whose files are removed with those of older ones.
    pub(super) fn clear(&mut self, folder: &Path) -> std::io::Result<()> {
        self.now = None;
        remove_others(folder, &[])
    }

    /// Removes the files of all recordings but the present one.
    pub(super) fn remove_older(&self, folder: &Path) -> std::io::Result<()> {
        let Some(written) = &self.now else { return Ok(()) };
        let kept: Vec<String> = written.start.iter().cloned().chain([self.name()]).collect();
        remove_others(folder, &kept)
    }
}

fn remove_others(folder: &Path, kept: &[String]) -> std::io::Result<()> {
    for entry in disk::read_dir(folder)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        let own = name.starts_with(NAME) || name.starts_with(START);
        if own && !kept.contains(&name) {
            disk::remove_file(folder.join(&name))?;
        }
    }
    Ok(())
}

impl KeptRecording {
    /// Reads the recording below `folder`, and the painting that it continues.
    pub(super) fn read(
        &self,
        folder: &Path,
    ) -> Result<(StrokeScript, Option<Vec<u8>>), FileFailure> {
        let path = folder.join(own_name(&self.file, folder)?);
        let cannot = |error: std::io::Error| FileFailure::io(&path, "read", &error);
        let mut text = String::new();
        let file = File::open(&path).map_err(cannot)?;
        file.take(self.bytes).read_to_string(&mut text).map_err(cannot)?;
        if text.len() as u64 != self.bytes {
            return Err(cannot(std::io::ErrorKind::UnexpectedEof.into()));
        }
        let actions: Result<Vec<Action>, _> = text.lines().map(serde_json::from_str).collect();
        let actions = actions.map_err(|error| cannot(error.into()))?;
        let mut script = self.header.clone();
        script.actions = actions.into_iter().chain(self.open.clone()).collect();
        script.check().map_err(|error| FileFailure::explained(&error))?;
        let start = match &self.start {
            None => None,
            Some(name) => Some(
                documents::file::read(&folder.join(own_name(name, folder)?))
                    .map_err(|error| FileFailure::explained(&error))?,
            ),
        };
        Ok((script, start))
    }
}

/// Refuses names that lead out of the folder.
fn own_name<'a>(name: &'a str, folder: &Path) -> Result<&'a str, FileFailure> {
    let plain = Path::new(name).file_name().is_some_and(|plain| plain == name);
    if plain {
        return Ok(name);
    }
    Err(FileFailure::io(&folder.join(name), "read", &std::io::ErrorKind::InvalidInput.into()))
}

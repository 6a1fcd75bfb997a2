//! The parts of an autosave besides its documents: the recording, the brushes with their paint, and
//! the mask. Paint and mask are stored as bytes.
//!
//! The recording is a file that only grows, with one action per line. A generation names this file
//! and says how many of its bytes belong to it. So an autosave writes only the actions since the
//! last one, and a line that was half written in a crash does no harm.

use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::Arc;

use documents::file::disk;
use documents::file::disk::{File, OpenOptions};
use graphics::tile::Rect;
use paint::engine::BrushId;
use paint::layer::{Cell, Layer, SLOTS};
use paint::mask::Mask;
use paint::session::{KeptHead, KeptSession, RecordingTail};
use paint::strokes::{Action, BrushSpec, PerSurface, StrokeScript, SurfaceId};
use serde::{Deserialize, Serialize};

use crate::failure::FileFailure;

/// Description of the recording and of the brushes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct WorkFile {
    recording: Option<KeptRecording>,
    brushes: Vec<BrushFile>,
    /// The mask of the canvas. Its bits follow the paint of the brushes. Autosaves of earlier
    /// versions have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mask: Option<Place>,
}

/// A brush. Its paint is in a file with all brushes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct BrushFile {
    name: String,
    recorded: String,
    spec: BrushSpec,
    named: bool,
    at: SurfaceId,
    /// Index of the brush on the canvas and on the palette, if it is there.
    numbers: [Option<usize>; 2],
    paint: Option<Place>,
}

/// Place of a brush's paint, or of the mask, in the file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Place {
    width: usize,
    height: usize,
    start: usize,
    bytes: usize,
}

/// State from which a recovered session goes on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecoveredWork {
    /// Brushes, recording and mask.
    pub session: KeptSession,
    /// Content of the painting's file that the recording continues.
    pub start: Option<Vec<u8>>,
}

/// Describes recording, brushes and mask. Also returns the paint of all brushes followed by the
/// bits of the mask.
pub(super) fn describe(
    recording: Option<KeptRecording>,
    brushes: &[KeptHead],
    mask: Option<&Mask>,
) -> (WorkFile, Vec<u8>) {
    let mut all = Vec::new();
    let mut keep = |bytes: Vec<u8>, width, height| {
        let start = all.len();
        let count = bytes.len();
        all.extend_from_slice(&bytes);
        Place { width, height, start, bytes: count }
    };
    let brushes = brushes.iter().map(|brush| {
        let KeptHead { name, recorded, spec, named, at, ids, paint } = brush.clone();
        let paint = paint.map(|paint| keep(bytes_of(&paint), paint.width(), paint.height()));
        let numbers = [ids.canvas, ids.palette].map(|id| id.map(|id| id.0));
        BrushFile { name, recorded, spec, named, at, numbers, paint }
    });
    let brushes = brushes.collect();
    let mask = mask.map(|mask| keep(bits_of(mask), mask.bounds().width, mask.bounds().height));
    let file = WorkFile { recording, brushes, mask };
    (file, all)
}

impl WorkFile {
    /// Returns the state that the file describes. You pass the `folder` of the recording, and the
    /// `paint` of all brushes with the mask, which was read from `path`.
    pub(super) fn read(
        self,
        folder: &Path,
        (path, paint): (&Path, &[u8]),
    ) -> Result<RecoveredWork, FileFailure> {
        let wrong = || FileFailure::io(path, "read", &std::io::ErrorKind::InvalidData.into());
        let own = |Place { start, bytes, .. }: Place| {
            let end = start.checked_add(bytes).ok_or_else(wrong)?;
            paint.get(start..end).ok_or_else(wrong)
        };
        let mask = self.mask.map(|place| {
            let Place { width, height, .. } = place;
            mask_of(width, height, own(place)?).map(Arc::new).ok_or_else(wrong)
        });
        let mask = mask.transpose()?;
        let brushes = self.brushes.into_iter().map(|brush| {
            let BrushFile { name, recorded, spec, named, at, numbers, paint: place } = brush;
            let [canvas, palette] = numbers.map(|number| number.map(BrushId));
            let ids = PerSurface { canvas, palette };
            let paint = place.map(|place| {
                let Place { width, height, .. } = place;
                paint_of(width, height, own(place)?).ok_or_else(wrong)
            });
            let paint = paint.transpose()?;
            Ok(KeptHead { name, recorded, spec, named, at, ids, paint })
        });
        let brushes = brushes.collect::<Result<_, FileFailure>>()?;
        let (recording, start) = match &self.recording {
            None => (None, None),
            Some(recording) => {
                let (script, start) = recording.read(folder)?;
                (Some(script), start)
            }
        };
        Ok(RecoveredWork { session: KeptSession { brushes, recording, mask }, start })
    }
}

/// Numbers per cell: one for each slot, then the vehicle.
const NUMBERS: usize = SLOTS + 1;

/// Refuses to read a larger head, e.g. from a damaged file.
const MOST_CELLS: usize = 1 << 24;

/// All cells of a head, row by row. Each number takes four bytes, the lowest first.
pub(super) fn bytes_of(paint: &Layer) -> Vec<u8> {
    let cells = (0..paint.width() * paint.height()).map(|index| paint.cell(index));
    let numbers = cells.flat_map(|Cell { pigments, vehicle }| {
        pigments.into_iter().chain([vehicle]).flat_map(u32::to_le_bytes)
    });
    numbers.collect()
}

/// Returns `None` if the bytes do not fit a head of this width and height.
pub(super) fn paint_of(width: usize, height: usize, bytes: &[u8]) -> Option<Layer> {
    let cells = width.checked_mul(height).filter(|&cells| cells <= MOST_CELLS)?;
    let (numbers, rest) = bytes.as_chunks::<4>();
    if numbers.len() != cells * NUMBERS || !rest.is_empty() {
        return None;
    }
    let mut paint = Layer::empty(width, height);
    for (index, cell) in numbers.as_chunks::<NUMBERS>().0.iter().enumerate() {
        let [pigments @ .., vehicle] = cell.map(u32::from_le_bytes);
        paint.set_cell(index, Cell { pigments, vehicle });
    }
    Some(paint)
}

const MOST_MASK_CELLS: usize = 1 << 30;

/// One bit per cell, row by row, starting with the lowest bit of the first byte. 1 means covered.
pub(super) fn bits_of(mask: &Mask) -> Vec<u8> {
    let cells = mask.bounds().width * mask.bounds().height;
    let bytes = (0..cells).step_by(8).map(|first| {
        let bits = (first..cells.min(first + 8)).enumerate();
        bits.fold(0, |bits, (bit, cell)| bits | u8::from(mask.covers(cell)) << bit)
    });
    bytes.collect()
}

/// Returns `None` if the bytes do not fit a canvas of this width and height in cells.
pub(super) fn mask_of(width: usize, height: usize, bytes: &[u8]) -> Option<Mask> {
    let cells = width.checked_mul(height).filter(|&cells| cells <= MOST_MASK_CELLS)?;
    let bounds = Rect { x: 0, y: 0, width, height };
    (bytes.len() == cells.div_ceil(8))
        .then(|| Mask::with_open(bounds, |cell: usize| bytes[cell / 8] >> (cell % 8) & 1 == 0))
}

const NAME: &str = "recording-";

/// Prefix of the names of files with paintings that recordings continue.
const START: &str = "start-";

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct KeptRecording {
    file: String,
    bytes: u64,
    header: StrokeScript,
    /// Action that was not finished yet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    open: Option<Action>,
    /// File of the painting that the recording continues.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<String>,
}

/// The recording file of a running session.
#[derive(Debug, Default)]
pub(super) struct RecordingFile {
    /// Number of recordings so far. The file names of each recording contain its number.
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
    pub(super) fn actions(&self) -> usize {
        self.now.as_ref().map_or(0, |written| written.actions)
    }

    /// Appends new actions of a recording to its file in `folder`. If `tail` starts with the first
    /// action, this begins another file, and saves the painting that the recording continues in
    /// the same folder. Returns `None` if `tail` does not follow the actions written before.
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

    /// Forgets the recording, and removes the files of all recordings.
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

fn own_name<'a>(name: &'a str, folder: &Path) -> Result<&'a str, FileFailure> {
    let plain = Path::new(name).file_name().is_some_and(|plain| plain == name);
    if plain {
        return Ok(name);
    }
    Err(FileFailure::io(&folder.join(name), "read", &std::io::ErrorKind::InvalidInput.into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paint_is_read_as_it_was_written() {
        let mut paint = Layer::empty(3, 2);
        paint.set_cell(4, Cell { pigments: [1, 2, 3, 4, 5, 6, 7, 1 << 30], vehicle: 9 });
        let bytes = bytes_of(&paint);
        assert_eq!(bytes.len(), 3 * 2 * 9 * 4);
        assert_eq!(paint_of(3, 2, &bytes), Some(paint));
        assert_eq!(paint_of(2, 2, &bytes), None);
        assert_eq!(paint_of(3, 2, &bytes[1..]), None);
        assert_eq!(paint_of(usize::MAX, 2, &bytes), None);
    }

    #[test]
    fn a_mask_is_read_as_it_was_written() {
        let bounds = Rect { x: 0, y: 0, width: 7, height: 3 };
        let mask = Mask::with_open(bounds, |cell| cell % 3 == 1);
        let bits = bits_of(&mask);
        assert_eq!(bits.len(), 3, "21 cells");
        assert_eq!(mask_of(7, 3, &bits), Some(mask));
        assert_eq!(mask_of(9, 3, &bits), None);
        assert_eq!(mask_of(7, 3, &bits[1..]), None);
        assert_eq!(mask_of(usize::MAX, 3, &bits), None);
    }
}

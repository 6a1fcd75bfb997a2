//! What an autosave holds besides its documents: the recording, and the brushes with their paint.

use std::path::Path;

use render::paint::session::{KeptHead, KeptSession};
use render::paint::strokes::{BrushSpec, PerSurface, SurfaceId};
use serde::{Deserialize, Serialize};

use super::brush_paint::{bytes_of, paint_of};
use super::recording_file::KeptRecording;
use crate::failure::FileFailure;

/// Description of the recording and of the brushes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct WorkFile {
    recording: Option<KeptRecording>,
    brushes: Vec<BrushFile>,
}

/// A brush; its paint is in a file of all brushes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct BrushFile {
    name: String,
    recorded: String,
    spec: BrushSpec,
    named: bool,
    at: SurfaceId,
    /// Numbers on canvas and palette.
    numbers: [Option<usize>; 2],
    paint: Option<PaintPlace>,
}

/// Place of a brush's paint in the file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct PaintPlace {
    width: usize,
    height: usize,
    start: usize,
    bytes: usize,
}

/// What a recovered session goes on from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecoveredWork {
    /// Brushes and recording.
    pub session: KeptSession,
    /// Content of the painting's file that the recording continues.
    pub start: Option<Vec<u8>>,
}

/// Describes recording and brushes. The second value is the paint of all brushes.
pub(super) fn describe(
    recording: Option<KeptRecording>,
    brushes: &[KeptHead],
) -> (WorkFile, Vec<u8>) {
    let mut all = Vec::new();
    let brushes = brushes.iter().map(|brush| {
        let KeptHead { name, recorded, spec, named, at, numbers, paint } = brush.clone();
        let paint = paint.map(|paint| {
            let (start, bytes) = (all.len(), bytes_of(&paint));
            all.extend_from_slice(&bytes);
            let (width, height) = (paint.width(), paint.height());
            PaintPlace { width, height, start, bytes: bytes.len() }
        });
        let numbers = [numbers.canvas, numbers.palette];
        BrushFile { name, recorded, spec, named, at, numbers, paint }
    });
    let file = WorkFile { recording, brushes: brushes.collect() };
    (file, all)
}

impl WorkFile {
    /// What is described; the recording lies in `folder`, `paint` is the paint of all brushes, read
    /// from `path`.
    pub(super) fn read(
        self,
        folder: &Path,
        (path, paint): (&Path, &[u8]),
    ) -> Result<RecoveredWork, FileFailure> {
        let wrong = || FileFailure::io(path, "read", &std::io::ErrorKind::InvalidData.into());
        let brushes = self.brushes.into_iter().map(|brush| {
            let BrushFile { name, recorded, spec, named, at, numbers, paint: place } = brush;
            let [canvas, palette] = numbers;
            let numbers = PerSurface { canvas, palette };
            let paint = match place {
                None => None,
                Some(PaintPlace { width, height, start, bytes }) => {
                    let end = start.checked_add(bytes).ok_or_else(wrong)?;
                    let own = paint.get(start..end).ok_or_else(wrong)?;
                    Some(paint_of(width, height, own).ok_or_else(wrong)?)
                }
            };
            Ok(KeptHead { name, recorded, spec, named, at, numbers, paint })
        });
        let brushes = brushes.collect::<Result<_, FileFailure>>()?;
        let (recording, start) = match &self.recording {
            None => (None, None),
            Some(recording) => {
                let (script, start) = recording.read(folder)?;
                (Some(script), start)
            }
        };
        Ok(RecoveredWork { session: KeptSession { brushes, recording }, start })
    }
}

//! Contents of an autosave besides its documents: the recording, the brushes with their paint, and
//! the mask.

use std::path::Path;
use std::sync::Arc;

use paint::mask::Mask;
use paint::session::{KeptHead, KeptSession};
use paint::strokes::{BrushSpec, PerSurface, SurfaceId};
use serde::{Deserialize, Serialize};

use super::brush_paint::{bytes_of, paint_of};
use super::mask_bits::{bits_of, mask_of};
use super::recording_file::KeptRecording;
use crate::failure::FileFailure;

/// Description of the recording and of the brushes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct WorkFile {
    recording: Option<KeptRecording>,
    brushes: Vec<BrushFile>,
    /// The mask of the canvas; its bits follow the paint of the brushes. Autosaves of earlier
    /// versions have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mask: Option<Place>,
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
    paint: Option<Place>,
}

/// Place of a brush's paint, or of the mask, in the file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Place {
    /// Cells of the head or of the canvas.
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

/// Describes recording, brushes and mask. The second value is the paint of all brushes, then the
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
        let KeptHead { name, recorded, spec, named, at, numbers, paint } = brush.clone();
        let paint = paint.map(|paint| keep(bytes_of(&paint), paint.width(), paint.height()));
        let numbers = [numbers.canvas, numbers.palette];
        BrushFile { name, recorded, spec, named, at, numbers, paint }
    });
    let brushes = brushes.collect();
    let mask = mask.map(|mask| keep(bits_of(mask), mask.bounds().width, mask.bounds().height));
    let file = WorkFile { recording, brushes, mask };
    (file, all)
}

impl WorkFile {
    /// Returns the state that the file describes. The recording lies in `folder`; `paint` is the
    /// paint of all brushes and the mask, read from `path`.
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
            let [canvas, palette] = numbers;
            let numbers = PerSurface { canvas, palette };
            let paint = place.map(|place| {
                let Place { width, height, .. } = place;
                paint_of(width, height, own(place)?).ok_or_else(wrong)
            });
            let paint = paint.transpose()?;
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
        Ok(RecoveredWork { session: KeptSession { brushes, recording, mask }, start })
    }
}

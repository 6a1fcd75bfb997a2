//! The figures of a session as a file for measuring: one JSON line a second.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use serde::Serialize;

use session::FileFailure;
use session::Performance;

/// One line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FigureLine {
    /// Seconds since the log began.
    pub seconds: f64,
    /// Frames that the window drew in the last second.
    pub frames_a_second: f64,
    /// From the arrival of a sample to the frame that shows it, in ms: the mean
    /// of the last second.
    pub latency_ms: f64,
    /// The longest of the last second.
    pub worst_latency_ms: f64,
    /// Sub-steps of the last second.
    pub substeps_a_second: f64,
    /// Sub-steps that wait.
    pub behind: usize,
    /// Where the view of the canvas is, in physical pixels of the window: left,
    /// top, right, bottom.
    pub canvas_px: [f32; 4],
}

/// What the window knows besides the worker's figures.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrameFigures {
    /// Frames in the last second.
    pub frames_a_second: f64,
    /// From input to screen, the mean of the last second, in ms.
    pub latency_ms: f64,
    /// The longest, in ms.
    pub worst_latency_ms: f64,
    /// The view of the canvas in physical pixels: left, top, right, bottom.
    pub canvas_px: [f32; 4],
}

/// The file.
#[derive(Debug)]
pub struct FiguresLog {
    file: File,
    began: Instant,
    told: Option<Instant>,
}

impl FiguresLog {
    /// Appends to `path`, which is made if it is not there.
    ///
    /// # Errors
    /// [`FileFailure`] if it cannot be written.
    pub fn append(path: &Path) -> Result<Self, FileFailure> {
        let file = File::options().create(true).append(true).open(path);
        let file = file.map_err(|error| FileFailure::io(path, "written", &error))?;
        Ok(Self { file, began: Instant::now(), told: None })
    }

    /// Writes a line if a second has passed since the last. A line that cannot be
    /// written is left out.
    pub fn tell(&mut self, now: Instant, frames: &FrameFigures, figures: &Performance) {
        if self.told.is_some_and(|told| now.duration_since(told) < Duration::from_secs(1)) {
            return;
        }
        self.told = Some(now);
        let line = FigureLine {
            seconds: now.duration_since(self.began).as_secs_f64(),
            frames_a_second: frames.frames_a_second,
            latency_ms: frames.latency_ms,
            worst_latency_ms: frames.worst_latency_ms,
            substeps_a_second: figures.substeps_per_second,
            behind: figures.waiting_substeps,
            canvas_px: frames.canvas_px,
        };
        if let Ok(mut text) = serde_json::to_string(&line) {
            text.push('\n');
            let _ = self.file.write_all(text.as_bytes());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_a_second_is_appended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figures.jsonl");
        std::fs::write(&path, "{\"before\": 1}\n").unwrap();
        let mut log = FiguresLog::append(&path).unwrap();
        let figures = Performance { waiting_substeps: 3, ..Performance::default() };
        let start = Instant::now();
        for ms in [0, 400, 900, 1100, 1500, 2200] {
            let now = start + Duration::from_millis(ms);
            log.tell(now, &FrameFigures::default(), &figures);
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let lines: Vec<serde_json::Value> =
            text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert_eq!(lines.len(), 4, "{text}");
        assert_eq!(lines[3]["behind"], 3);
        assert!(lines[3]["seconds"].as_f64().unwrap() > 2.0, "{text}");
    }
}

//! A log of performance figures for measuring: one line of JSON per second.

use documents::file::disk::File;
use std::io::Write;
use std::path::Path;
use web_time::{Duration, Instant};

use serde::Serialize;

use super::problem::Problem;
use session::Performance;

#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct FigureLine {
    seconds: f64,
    frames_a_second: f64,
    /// Mean time in the last second from the arrival of a pen sample to the frame that shows it, in
    /// ms.
    latency_ms: f64,
    /// Longest such time in the last second, in ms.
    worst_latency_ms: f64,
    substeps_a_second: f64,
    /// Number of sub-steps waiting to be simulated.
    behind: usize,
    /// Bounding box of the canvas in physical pixels of the window: left, top, right,
    /// bottom.
    canvas_px: [f32; 4],
}

/// Figures of the window. The worker's figures complete a line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrameFigures {
    /// Frames drawn in the last second.
    pub frames_a_second: f64,
    /// Mean time from input to screen in the last second, in ms.
    pub latency_ms: f64,
    /// Longest such time in the last second, in ms.
    pub worst_latency_ms: f64,
    /// Bounding box of the canvas in physical pixels of the window: left, top, right,
    /// bottom.
    pub canvas_px: [f32; 4],
}

/// The log file.
#[derive(Debug)]
pub struct FiguresLog {
    file: File,
    began: Instant,
    last: Option<Instant>,
}

impl FiguresLog {
    /// Opens `path` for appending. If it does not exist, this creates it.
    ///
    /// # Errors
    /// [`Problem`] if the file cannot be written.
    pub fn open(path: &Path) -> Result<Self, Problem> {
        let file = File::options().create(true).append(true).open(path);
        let file = file.map_err(|error| Problem::io(path, "written", &error))?;
        Ok(Self { file, began: Instant::now(), last: None })
    }

    /// Appends a line if a second has passed since the last one. If this fails, the line is
    /// dropped.
    pub fn append_when_due(&mut self, now: Instant, frames: &FrameFigures, figures: &Performance) {
        if self.last.is_some_and(|last| now.duration_since(last) < Duration::from_secs(1)) {
            return;
        }
        self.last = Some(now);
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
        let mut log = FiguresLog::open(&path).unwrap();
        let figures = Performance { waiting_substeps: 3, ..Performance::default() };
        let start = Instant::now();
        for ms in [0, 400, 900, 1100, 1500, 2200] {
            let now = start + Duration::from_millis(ms);
            log.append_when_due(now, &FrameFigures::default(), &figures);
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let lines: Vec<serde_json::Value> =
            text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert_eq!(lines.len(), 4, "{text}");
        assert_eq!(lines[3]["behind"], 3);
        assert!(lines[3]["seconds"].as_f64().unwrap() > 2.0, "{text}");
    }
}

//! Overlay with performance figures.

use eframe::egui::{Align2, FontId, Rect, Ui, vec2};

use crate::language::{tr, tr_format};
use crate::theme;
use session::Performance;

/// Frame rate and latency of the window over the last second.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrameRate {
    /// Frames drawn per second.
    pub frames_a_second: f64,
    /// Mean time from the arrival of a pen sample to the end of the frame that shows it, in ms; 0
    /// without a sample.
    pub latency_ms: f64,
    /// Longest such time, in ms.
    pub worst_ms: f64,
}

/// Figures of window and worker as pairs of label and value.
#[must_use]
pub fn lines(rate: FrameRate, worker: Performance, backend: &str) -> Vec<(&'static str, String)> {
    fn ms(mean: f64, worst: f64) -> String {
        match worst {
            0.0 => "-".to_owned(),
            _ => tr_format!("{mean:.1} ms, worst {worst:.1}", mean, worst),
        }
    }
    vec![
        (tr("frames a second"), format!("{:.0}", rate.frames_a_second)),
        (tr("pen to screen"), ms(rate.latency_ms, rate.worst_ms)),
        (tr("pen to paint"), ms(worker.mean_latency_ms, worker.max_latency_ms)),
        (tr("sub-steps a second"), format!("{:.0}", worker.substeps_per_second)),
        (tr("steps behind"), worker.waiting_substeps.to_string()),
        (tr("paint computed by"), backend.to_owned()),
    ]
}

/// Draws the figures over the upper left corner of `over`.
pub fn overlay(ui: &Ui, over: Rect, rate: FrameRate, worker: Performance, backend: &str) {
    let size = 12.0;
    let row = 16.0;
    let value_at = 128.0;
    let font = FontId::proportional(size);
    let painter = ui.painter().with_clip_rect(over);
    let lines = lines(rate, worker, backend);
    let widths = lines.iter().map(|(_, value)| {
        painter.layout_no_wrap(value.clone(), font.clone(), theme::BOARD_TEXT).size().x
    });
    let widest = widths.fold(60.0, f32::max);
    let size = vec2(value_at + widest + 12.0, row * lines.len() as f32 + 10.0);
    let board = Rect::from_min_size(over.min + vec2(10.0, 10.0), size);
    painter.rect_filled(board, theme::CORNER_RADIUS, theme::BOARD);
    for (index, (name, value)) in lines.iter().enumerate() {
        let place = board.min + vec2(8.0, 5.0 + row * index as f32);
        painter.text(place, Align2::LEFT_TOP, name, font.clone(), theme::DARK.text);
        let place = place + vec2(value_at - 8.0, 0.0);
        painter.text(place, Align2::LEFT_TOP, value, font.clone(), theme::BOARD_TEXT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_figure_has_its_unit() {
        let rate = FrameRate { frames_a_second: 59.6, latency_ms: 21.44, worst_ms: 33.0 };
        let worker = Performance {
            substeps_per_second: 1012.4,
            waiting_substeps: 17,
            mean_latency_ms: 8.04,
            max_latency_ms: 12.26,
            paint_is_behind: false,
        };
        let figures = lines(rate, worker, "CPU, 2 threads");
        let values: Vec<&str> = figures.iter().map(|(_, value)| value.as_str()).collect();
        let wanted =
            ["60", "21.4 ms, worst 33.0", "8.0 ms, worst 12.3", "1012", "17", "CPU, 2 threads"];
        assert_eq!(values, wanted);
    }

    #[test]
    fn without_a_sample_there_is_no_latency() {
        let figures = lines(FrameRate::default(), Performance::default(), "CPU");
        assert_eq!((figures[1].1.as_str(), figures[2].1.as_str()), ("-", "-"));
    }
}

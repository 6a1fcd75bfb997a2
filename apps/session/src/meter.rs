//! Measures how fast the worker paints and how long samples wait, and reports in words how much
//! paint a tool took off a surface.

use std::collections::VecDeque;

use documents::hint::Hint;
use paint::painting::{Painting, TakenPaint};
use paint::strokes::StrokeTool;
use web_time::{Duration, Instant};

use super::state::Performance;

/// The performance is averaged over this time.
const SPAN: Duration = Duration::from_secs(1);

/// Duration of a slice of painting. Keep this short: commands are received and pictures are sent
/// only between slices.
const SLICE: Duration = Duration::from_millis(8);

/// If the waiting sub-steps take longer than this to paint, the paint is behind the pen. This is
/// three frames of 50 ms.
const BEHIND_MS: f64 = 150.0;

/// Measures painting speed and the latency of samples.
#[derive(Debug)]
pub(super) struct Meter {
    /// End, number of sub-steps and duration of the last slices.
    slices: VecDeque<(Instant, usize, Duration)>,
    /// For each of the last samples, the time at which we sent its tiles, and its latency in ms.
    samples: VecDeque<(Instant, f64)>,
    /// Sub-steps per second while painting, smoothed.
    speed: f64,
}

impl Default for Meter {
    fn default() -> Self {
        // A guess that the first slices correct.
        Self { slices: VecDeque::new(), samples: VecDeque::new(), speed: 2000.0 }
    }
}

impl Meter {
    pub(super) fn slice(&self) -> usize {
        ((self.speed * SLICE.as_secs_f64()) as usize).clamp(8, 4096)
    }

    /// Adds a slice of `substeps` that took `time`.
    pub(super) fn add_slice(&mut self, now: Instant, substeps: usize, time: Duration) {
        if substeps == 0 {
            return;
        }
        self.slices.push_back((now, substeps, time));
        let measured = substeps as f64 / time.as_secs_f64().max(1e-6);
        // Smoothed over a few slices, because sub-steps differ in cost.
        self.speed += 0.3 * (measured - self.speed);
    }

    /// Adds a sample that arrived at `arrived` and is shown by tiles sent at `now`.
    pub(super) fn add_sample(&mut self, now: Instant, arrived: Instant) {
        let ms = now.saturating_duration_since(arrived).as_secs_f64() * 1000.0;
        self.samples.push_back((now, ms));
    }

    /// Whether there was nothing to measure for [`SPAN`].
    pub(super) fn is_idle(&self) -> bool {
        self.slices.is_empty() && self.samples.is_empty()
    }

    /// Performance of the last second while `behind` sub-steps wait.
    pub(super) fn performance(&mut self, now: Instant, behind: usize) -> Performance {
        while self.slices.front().is_some_and(|(at, ..)| now.saturating_duration_since(*at) > SPAN)
        {
            self.slices.pop_front();
        }
        while self.samples.front().is_some_and(|(at, _)| now.saturating_duration_since(*at) > SPAN)
        {
            self.samples.pop_front();
        }
        let substeps: usize = self.slices.iter().map(|(_, substeps, _)| substeps).sum();
        let total_ms: f64 = self.samples.iter().map(|(_, ms)| ms).sum();
        Performance {
            substeps_per_second: substeps as f64 / SPAN.as_secs_f64(),
            waiting_substeps: behind,
            mean_latency_ms: total_ms / self.samples.len().max(1) as f64,
            max_latency_ms: self.samples.iter().map(|(_, ms)| *ms).fold(0.0, f64::max),
            paint_is_behind: 1000.0 * behind as f64 / self.speed > BEHIND_MS,
        }
    }
}

/// Says how much paint a stroke of `tool` took off. The hint lists the volume of each pigment in
/// mm3, or gives advice if there was no paint. Both surfaces have the pigments of `canvas`.
pub(super) fn stroke_message(
    tool: StrokeTool,
    taken: &TakenPaint,
    canvas: &Painting,
) -> (String, Option<Hint>) {
    let volumes = taken.volumes_mm3(canvas.cell_mm());
    let whole = volumes.iter().sum();
    if whole == 0.0 {
        let text = format!("there was no wet paint to {}", tool.name());
        return (text, Some(Hint::new("dry layers stay as they are")));
    }
    let what = match tool {
        StrokeTool::Blend { .. } => "wiped off the head",
        _ => "taken off",
    };
    let names = canvas
        .state()
        .slots
        .iter()
        .map(|slot| slot.map_or("", |pigment| canvas.library()[pigment].name.as_str()));
    let mut parts: Vec<(&str, f64)> = names.chain(["medium"]).zip(volumes).collect();
    parts.retain(|(_, mm3)| *mm3 >= 0.005 * whole);
    parts.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let parts: Vec<String> =
        parts.iter().map(|(name, mm3)| format!("{name} {}", three_digits(*mm3))).collect();
    let text = format!("{} mm3 of paint {what}", three_digits(whole));
    (text, Some(Hint::new(parts.join(", "))))
}

/// A volume with three significant digits, or with none after the point from 100 on.
fn three_digits(volume: f64) -> String {
    let digits = (2.0 - volume.log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{volume:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn performance_is_of_the_last_second() {
        let mut meter = Meter::default();
        let start = Instant::now();
        let at = |ms: u64| start + Duration::from_millis(ms);
        meter.add_slice(at(0), 500, Duration::from_millis(100));
        meter.add_slice(at(900), 300, Duration::from_millis(100));
        meter.add_sample(at(0), start);
        meter.add_sample(at(900), at(880));
        meter.add_sample(at(900), at(890));
        meter.add_sample(at(950), at(890));
        let performance = meter.performance(at(1100), 7);
        assert_eq!((performance.substeps_per_second, performance.waiting_substeps), (300.0, 7));
        assert_eq!((performance.mean_latency_ms, performance.max_latency_ms), (30.0, 60.0));
        assert!(!performance.paint_is_behind, "7 sub-steps take a few milliseconds");
        assert!(meter.performance(at(1100), 600).paint_is_behind, "600 take 200 ms");
        let later = meter.performance(at(5000), 0);
        assert_eq!(later, Performance::default(), "nothing happened for a second");
    }

    #[test]
    fn slices_take_about_8_ms() {
        let mut meter = Meter::default();
        for _ in 0..40 {
            let substeps = meter.slice();
            // A machine that computes 40,000 sub-steps per second.
            let time = Duration::from_secs_f64(substeps as f64 / 40_000.0);
            meter.add_slice(Instant::now(), substeps, time);
        }
        assert!((300..=340).contains(&meter.slice()), "8 ms, found {} sub-steps", meter.slice());
        meter.add_slice(Instant::now(), 1, Duration::from_secs(1));
        assert!(meter.slice() >= 8, "a slow slice does not stop the next");
    }

    #[test]
    fn volumes_have_three_digits() {
        for (volume, text) in [
            (1234.4, "1234"),
            (12.34, "12.3"),
            (12.0, "12"),
            (0.5, "0.5"),
            (0.012_34, "0.0123"),
            (1e-9, "0"),
        ] {
            assert_eq!(three_digits(volume), text);
        }
    }
}

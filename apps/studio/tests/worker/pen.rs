//! Synthetic strokes and brush loads for the tests of the worker.

use paint::pose::Sample;
use paint::strokes::{Action, Load, Stroke, StrokeTool, SurfaceId};

/// Samples of a wandering stroke of sines within `width_mm` x `height_mm`, at 120 samples per
/// second. `seed` selects the phase.
pub(crate) fn wander(seed: u64, count: usize, width_mm: f64, height_mm: f64) -> Vec<Sample> {
    let phase = seed as f64 * 1.7;
    let sample = |index: usize| {
        let seconds = index as f64 / 120.0;
        let a = phase + 2.1 * seconds;
        let b = 1.3 * phase + 1.7 * seconds;
        Sample {
            seconds,
            x_mm: width_mm * (0.5 + 0.45 * a.sin()),
            y_mm: height_mm * (0.5 + 0.45 * b.cos()),
            pressure: 0.4 + 0.3 * (3.0 * seconds + phase).sin(),
            tilt_x_deg: 20.0 * (seconds + phase).sin(),
            tilt_y_deg: 15.0 * (seconds - phase).cos(),
            twist_deg: 40.0 * (0.5 * seconds).sin(),
        }
    };
    (0..count).map(sample).collect()
}

pub(crate) fn load(brush: &str, pigment: &str) -> Action {
    Action::Load(Load {
        brush: brush.to_owned(),
        recipe: [(pigment.to_owned(), 1.0)].into(),
        vehicle: 0.1,
        amount_mm: 0.3,
    })
}

pub(crate) fn stroke(surface: SurfaceId, brush: &str, samples: &[Sample]) -> Action {
    Action::Stroke(Stroke {
        brush: brush.to_owned(),
        on: surface,
        tool: StrokeTool::Paint,
        samples: samples.to_vec(),
    })
}

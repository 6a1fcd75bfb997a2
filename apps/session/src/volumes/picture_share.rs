//! How large pictures of moving scenes are drawn, so that they come in time.

use std::time::Duration;

/// Time for a picture of a scene that moves. It is drawn smaller if it would take longer.
const MOVING: Duration = Duration::from_millis(40);

/// Smallest share of width and height at which moving scenes are drawn.
const SMALLEST: f64 = 0.5;

/// Share of width and height, in eighths, at which a picture of `size` takes no longer than
/// [`MOVING`], at least [`SMALLEST`].
pub(super) fn share_in_time([width, height]: [usize; 2], pixel_seconds: f64) -> f64 {
    let whole = pixel_seconds * (width * height) as f64;
    let share = (MOVING.as_secs_f64() / whole.max(1e-9)).sqrt();
    ((8.0 * share).floor() / 8.0).clamp(SMALLEST, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moving_picture_is_as_large_as_there_is_time_for() {
        assert_eq!(
            [0.0, 39.0, 41.0, 71.0, 170.0, 1e9]
                .map(|milliseconds: f64| share_in_time([800, 500], 1e-3 * milliseconds / 4e5)),
            [1.0, 1.0, 0.875, 0.75, 0.5, 0.5]
        );
    }
}

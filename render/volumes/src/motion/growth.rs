//! The resting radius follows its target.

/// Time in which the radius comes near to its target, in seconds.
const DELAY: f32 = 0.15;

/// Share of the target from which the radius takes it on, once rounding stops its growth.
const NEAR: f32 = 1e-4;

/// The radius after `seconds`: it goes to its `target` at the speed `(target - radius) / 0.15 s`, at
/// most `fastest` (per second), by implicit Euler, which never goes past the target.
pub(super) fn grown(radius: f32, target: f32, fastest: f32, seconds: f32) -> f32 {
    let missing = target - radius;
    let most = fastest * seconds;
    let next = radius + (missing * (seconds / (DELAY + seconds))).clamp(-most, most);
    if next == radius && missing.abs() <= NEAR * target { target } else { next }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(seconds: f32, step: f32, target: f32, fastest: f32) -> f32 {
        let steps = (seconds / step).round() as usize;
        (0..steps).fold(1.0, |radius, _| grown(radius, target, fastest, step))
    }

    #[test]
    fn a_radius_comes_to_its_target_and_stays() {
        // exp(-0.3 / 0.15) of the way is left; the implicit form lags by a third of a step in ten.
        let left = 2.0 - after(0.3, 1e-3, 2.0, 100.0);
        assert!((left - (-2.0_f32).exp()).abs() < 2e-3, "{left}");
        assert_eq!(after(4.0, 1.0 / 120.0, 2.0, 100.0), 2.0);
        assert_eq!(after(4.0, 1.0 / 120.0, 0.5, 100.0), 0.5);
    }

    #[test]
    fn growth_is_no_faster_than_allowed() {
        assert!((after(1.0, 1.0 / 120.0, 9.0, 0.25) - 1.25).abs() < 1e-4);
        assert!((after(1.0, 1.0 / 120.0, 0.0, 0.25) - 0.75).abs() < 1e-4);
    }

    #[test]
    fn a_long_step_does_not_go_past_the_target() {
        let radius = grown(1.0, 2.0, 1e3, 10.0);
        assert!((1.9..2.0).contains(&radius), "{radius}");
    }
}

//! The resting radius and the centre follow their targets.

use glam::Vec3;

/// Time in which the radius comes near to its target, in seconds.
const DELAY: f32 = 0.15;

/// Share of the target from which the radius takes it on, once rounding stops its growth; share of
/// the radius from which the centre does.
const NEAR: f32 = 1e-4;

/// The radius after `seconds`: it goes to its `target` at the speed `(target - radius) / 0.15 s`, at
/// most `fastest` (per second), by implicit Euler, which never goes past the target.
pub(super) fn grown(radius: f32, target: f32, fastest: f32, seconds: f32) -> f32 {
    let missing = target - radius;
    let most = fastest * seconds;
    let next = radius + (missing * (seconds / (DELAY + seconds))).clamp(-most, most);
    if next == radius && missing.abs() <= NEAR * target { target } else { next }
}

/// Greatest speed of the centre of a small volume, in that of its growth. Dents of the skin then do
/// not bare the place where it began.
const KEEPING: f32 = 0.6;

/// Centre and radius after `seconds`, both on their way to their targets as [`grown`] has it. The
/// place of the skin that gets ahead most is no faster than `fastest`. The centre of a volume that
/// is small beside a `cell` moves more slowly than the volume grows, so that it keeps what it held.
pub(super) fn moved(
    (center, radius): (Vec3, f32),
    (target_center, target): (Vec3, f32),
    (fastest, cell): (f32, f32),
    seconds: f32,
) -> (Vec3, f32) {
    let next = grown(radius, target, fastest, seconds);
    let way = target_center - center;
    let distance = way.length();
    if distance <= NEAR * next {
        return (target_center, next);
    }
    let growth = (next - radius).max(0.0);
    let free = if next == target { 1.0 } else { (radius / cell) * (radius / cell) };
    let step = distance * (seconds / (DELAY + seconds));
    let step = step.min(KEEPING * growth + step * free);
    let share = (fastest * seconds / (step + growth)).min(1.0);
    let next = if growth > 0.0 { radius + growth * share } else { next };
    let moved = center + way * (step * share / distance);
    (if moved == center { target_center } else { moved }, next)
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
    fn the_skin_gets_ahead_no_faster_than_allowed() {
        let targets = (Vec3::new(1.6, 0.3, -0.7), 1.5);
        let mut center = Vec3::X;
        let mut radius = 0.1;
        let ahead = targets.0 - center;
        let mut tip = radius;
        for _ in 0..2400 {
            (center, radius) = moved((center, radius), targets, (0.5, 1.0), 1.0 / 120.0);
            let next = radius + (center - Vec3::X).dot(ahead) / ahead.length();
            // At last the centre takes on its target.
            let most = 0.5 / 120.0 + NEAR * radius;
            assert!((-1e-6..most).contains(&(next - tip)), "{next} after {tip}");
            tip = next;
            if radius < 0.3 {
                assert!(center.distance(Vec3::X) < 0.85 * radius, "{center} {radius}");
            }
        }
        assert_eq!((center, radius), targets);
        // Without a way to go the radius grows as for itself.
        let alone = moved((Vec3::X, 0.1), (Vec3::X, 1.5), (0.5, 1.0), 0.1);
        assert_eq!(alone, (Vec3::X, grown(0.1, 1.5, 0.5, 0.1)));
    }

    #[test]
    fn a_long_step_does_not_go_past_the_target() {
        let radius = grown(1.0, 2.0, 1e3, 10.0);
        assert!((1.9..2.0).contains(&radius), "{radius}");
    }
}

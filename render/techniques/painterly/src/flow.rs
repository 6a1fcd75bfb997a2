//! Strokes that move along the surface, in loops that close.

use super::settings::FlowSettings;

/// Where strokes stand in a loop, 0 to below 1. A whole number of loops later it is the same to
/// the bit.
///
/// `seconds` is divided by the duration in f64, so that times which are whole multiples of a frame
/// rate do not drift.
pub(super) fn phase(seconds: f64, settings: &FlowSettings) -> f32 {
    let loops = seconds / f64::from(settings.loop_seconds);
    let phase = (loops - loops.floor()) as f32;
    // Steps of 2^-20, so that rounding before the end of a loop and after it agree.
    let steps = (phase * 1_048_576.0).round() / 1_048_576.0;
    if steps >= 1.0 { 0.0 } else { steps }
}

/// How much lighter a stroke is, -1 to 1, at a `phase` of a loop with so many changes to lighter and
/// darker; `own` (0 to 1) is where the stroke stands at the beginning.
pub(super) fn twinkled(twinkles: u32, phase: f32, own: f32) -> f32 {
    let at = phase * twinkles as f32 + own;
    let at = at - at.floor();
    // A parabola up and one down, close to a sine.
    let half = if at < 0.5 { 4.0 * at } else { 4.0 * at - 2.0 };
    let arc = half * (2.0 - half);
    if at < 0.5 { arc } else { -arc }
}

/// Change of the place in the map along the stroke, in widths of the map, at a `phase` of the loop
/// (equation 11 of Yan and others 2008). Strokes move by a whole number of widths in a loop, up to
/// `periods`, the more the stronger the flow is, 0 to 1: so every loop closes.
pub(super) fn moved(strength: f32, phase: f32, periods: u32) -> f32 {
    let periods = (periods as f32 * strength.clamp(0.0, 1.0)).round();
    // The brushwork moves along the arrow if the place in the map moves against it.
    let back = -periods * phase;
    back - back.floor()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(periods: u32) -> FlowSettings {
        FlowSettings { periods, loop_seconds: 2.4, ..FlowSettings::default() }
    }

    #[test]
    fn a_loop_ends_where_it_began_to_the_bit() {
        let settings = settings(3);
        for frame in 0..48 {
            let time = |frame: i32| f64::from(frame) * f64::from(settings.loop_seconds) / 48.0;
            let place = |frame| moved(0.8, phase(time(frame), &settings), settings.periods);
            for loops in [1, 2, 7, 1000] {
                assert_eq!(place(frame).to_bits(), place(frame + 48 * loops).to_bits(), "{frame}");
            }
        }
    }

    #[test]
    fn strokes_of_weak_flow_go_on_over_the_end_of_a_loop() {
        for strength in [0.1, 0.4, 0.6, 0.9] {
            let step = |from: f32, to: f32| {
                let [from, to] = [from, to].map(|phase| moved(strength, phase, 3));
                (from - to).rem_euclid(1.0)
            };
            let inside = step(0.25, 0.5);
            let over = step(0.75, 0.0);
            assert!((inside - over).abs() < 1e-6, "{strength}: {inside}, {over}");
        }
    }

    #[test]
    fn strokes_move_evenly_and_stand_where_there_is_no_flow() {
        let step = |phase: f32| {
            let step = moved(1.0, phase, 2) - moved(1.0, phase + 0.01, 2);
            step.rem_euclid(1.0)
        };
        assert!((0..99).all(|i| (step(i as f32 * 0.01) - 0.02).abs() < 1e-4));
        assert_eq!(moved(0.0, 0.3, 2), 0.0);
        assert_eq!(moved(1.0, 0.3, 0), 0.0);
    }

    #[test]
    fn twinkling_strokes_are_as_much_lighter_as_darker_and_close_their_loop() {
        let values: Vec<f32> = (0..240).map(|i| twinkled(3, i as f32 / 240.0, 0.2)).collect();
        assert!(values.iter().sum::<f32>().abs() < 1e-3);
        let (least, most) =
            values.iter().fold((1.0_f32, -1.0_f32), |(a, b), &v| (a.min(v), b.max(v)));
        assert!(least < -0.99 && most > 0.99 && (-1.0..=1.0).contains(&most));
        let steps = (0..240).map(|i| (values[(i + 1) % 240] - values[i]).abs());
        assert!(steps.fold(0.0, f32::max) < 0.11);
        for i in 0..=100 {
            let at = i as f32 / 100.0;
            let sine = (std::f32::consts::TAU * at).sin();
            assert!((twinkled(1, at, 0.0) - sine).abs() < 0.06, "{at}");
        }
    }
}

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

/// Change of the place in the map along the stroke, in widths of the map, at a `phase` of the loop
/// (equation 11 of Yan and others 2008). Strokes move by a whole number of widths in a loop, the
/// more the stronger the flow is, 0 to 1: so every loop closes.
pub(super) fn moved(strength: f32, phase: f32, settings: &FlowSettings) -> f32 {
    let periods = (settings.periods as f32 * strength.clamp(0.0, 1.0)).round();
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
            let place = |frame| moved(0.8, phase(time(frame), &settings), &settings);
            for loops in [1, 2, 7, 1000] {
                assert_eq!(place(frame).to_bits(), place(frame + 48 * loops).to_bits(), "{frame}");
            }
        }
    }

    #[test]
    fn strokes_of_weak_flow_go_on_over_the_end_of_a_loop() {
        let settings = settings(3);
        for strength in [0.1, 0.4, 0.6, 0.9] {
            let step = |from: f32, to: f32| {
                let [from, to] = [from, to].map(|phase| moved(strength, phase, &settings));
                (from - to).rem_euclid(1.0)
            };
            let (inside, over) = (step(0.25, 0.5), step(0.75, 0.0));
            assert!((inside - over).abs() < 1e-6, "{strength}: {inside}, {over}");
        }
    }

    #[test]
    fn strokes_move_evenly_and_stand_where_there_is_no_flow() {
        let settings = settings(2);
        let step = |phase: f32| {
            let step = moved(1.0, phase, &settings) - moved(1.0, phase + 0.01, &settings);
            step.rem_euclid(1.0)
        };
        assert!((0..99).all(|i| (step(i as f32 * 0.01) - 0.02).abs() < 1e-4));
        assert_eq!(moved(0.0, 0.3, &settings), 0.0);
        assert_eq!(moved(1.0, 0.3, &FlowSettings::default()), 0.0);
    }
}

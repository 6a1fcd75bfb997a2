//! The movement of the dashes of a mask, which stops while nothing happens.

/// Length of a dash of the outline, in points.
pub(super) const DASH: f32 = 5.0;

/// Dashes by which the outline moves in a second.
const DASHES_A_SECOND: f64 = 2.0;

/// Time for which the dashes move after the last input, in seconds.
const MOVES: f64 = 3.0;

/// Dashes that move for a while after each input.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Dashes {
    /// Time of the last input, in seconds; `None` before the first.
    last: Option<f64>,
}

impl Dashes {
    /// Way of the dashes at `now`, in points, and whether they still move; times are in seconds.
    /// `happens` tells that there was input in this frame.
    pub(super) fn phase(&mut self, now: f64, happens: bool) -> (f32, bool) {
        if happens {
            self.last = Some(now);
        }
        let stop = *self.last.get_or_insert(now) + MOVES;
        let phase = (now.min(stop) * DASHES_A_SECOND).rem_euclid(2.0) as f32 * DASH;
        (phase, now < stop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_move_after_input_and_then_stand_still() {
        let mut dashes = Dashes::default();
        assert_eq!(dashes.phase(100.0, false), (0.0, true), "they begin with a mask");
        assert_eq!(dashes.phase(100.25, false), (0.5 * DASH, true));
        assert_eq!(dashes.phase(102.75, true), (1.5 * DASH, true));
        assert_eq!(dashes.phase(105.5, false), (DASH, true), "input prolongs it");
        let still = dashes.phase(105.75, false);
        assert_eq!(still, (1.5 * DASH, false));
        assert_eq!(dashes.phase(900.0, false), still);
        assert_eq!(dashes.phase(901.0, true), (0.0, true), "and input begins it again");
    }
}

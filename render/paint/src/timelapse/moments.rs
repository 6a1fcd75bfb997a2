//! The moments at which frames are taken.

use super::kept::shown;
use super::settings::{Interval, TimelapseSettings};
use crate::pose::Sample;
use crate::strokes::{Action, Stroke};

/// A moment of a script: before the action `action`, or within it, if it is a stroke, after
/// `samples` of its samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Moment {
    pub(super) action: usize,
    pub(super) samples: usize,
}

/// Moments of all frames, rising: the start, those between, and the end.
pub(super) fn moments(actions: &[Action], settings: &TimelapseSettings) -> Vec<Moment> {
    let shown = shown(actions, settings.with_undone);
    let after = |index: usize| Moment { action: index + 1, samples: 0 };
    let changes: Vec<usize> = (0..actions.len()).filter(|&index| shown[index]).collect();
    let seconds: f64 = changes.iter().map(|&index| duration(&actions[index])).sum();
    let start = Moment { action: 0, samples: 0 };
    let end = Moment { action: actions.len(), samples: 0 };
    let between: Vec<Moment> = match settings.interval {
        Interval::Actions(count) => changes
            .chunks_exact(count)
            .filter_map(|chunk| chunk.last())
            .map(|&i| after(i))
            .collect(),
        Interval::Seconds(every) => at_times(actions, &changes, &times(every, seconds)),
        Interval::Frames(count) if seconds > 0.0 => {
            let parts = (count - 1).max(1) as f64;
            let times: Vec<f64> =
                (1..count - 1).map(|index| seconds * index as f64 / parts).collect();
            at_times(actions, &changes, &times)
        }
        Interval::Frames(count) => {
            let parts = (count - 1).min(changes.len()).max(1);
            (1..parts).map(|index| after(changes[index * changes.len() / parts - 1])).collect()
        }
    };
    let last = changes.last().map_or(start, |&index| after(index));
    // The end shows what the last action left.
    let between = between.into_iter().filter(|moment| *moment < last);
    let mut all: Vec<Moment> = std::iter::once(start).chain(between).chain([end]).collect();
    all.dedup();
    all
}

/// Multiples of `every` seconds below `seconds`.
fn times(every: f64, seconds: f64) -> Vec<f64> {
    // One more than fits is enough to be refused.
    let count = (seconds / every).ceil().min(super::settings::MOST_FRAMES as f64 + 1.0) as usize;
    (1..count.max(1)).map(|index| index as f64 * every).collect()
}

/// Moments at `times` of painting, in seconds, rising.
fn at_times(actions: &[Action], changes: &[usize], times: &[f64]) -> Vec<Moment> {
    let mut found = Vec::new();
    let mut times = times.iter().copied().peekable();
    let mut before = 0.0;
    for &index in changes {
        let Some(Stroke { samples, .. }) = actions[index].stroke() else { continue };
        let length = duration(&actions[index]);
        while let Some(time) = times.next_if(|time| *time < before + length) {
            let first = samples.first().map_or(0.0, |sample| sample.seconds);
            let count = samples.partition_point(|sample| sample.seconds - first <= time - before);
            found.push(Moment { action: index, samples: count });
        }
        before += length;
    }
    found
}

/// Seconds that a stroke takes; 0 for other actions.
fn duration(action: &Action) -> f64 {
    let Some(Stroke { samples, .. }) = action.stroke() else { return 0.0 };
    let seconds = |sample: Option<&Sample>| sample.map_or(0.0, |sample| sample.seconds);
    seconds(samples.last()) - seconds(samples.first())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brush::StrokeTool;
    use crate::strokes::SurfaceId;

    /// A stroke of 2 s with five samples, half a second apart.
    fn stroke(on: SurfaceId) -> Action {
        let samples = (0..5)
            .map(|index| Sample::upright(3.0 + 0.5 * f64::from(index), 1.0, 1.0, 0.5))
            .collect();
        Action::Stroke(Stroke { brush: "round".to_owned(), on, tool: StrokeTool::Paint, samples })
    }

    fn at(interval: Interval, actions: &[Action]) -> Vec<(usize, usize)> {
        let settings = TimelapseSettings { interval, ..TimelapseSettings::default() };
        let moments = moments(actions, &settings).into_iter();
        moments.map(|Moment { action, samples }| (action, samples)).collect()
    }

    fn script() -> [Action; 6] {
        let wash = Action::Wash { brush: "round".to_owned() };
        let canvas = || stroke(SurfaceId::Canvas);
        [wash, canvas(), stroke(SurfaceId::Palette), canvas(), canvas(), Action::Undo {}]
    }

    #[test]
    fn frames_are_taken_after_actions() {
        assert_eq!(at(Interval::Actions(1), &script()), [(0, 0), (2, 0), (6, 0)]);
        assert_eq!(at(Interval::Actions(5), &script()), [(0, 0), (6, 0)]);
        let settings = TimelapseSettings {
            interval: Interval::Actions(1),
            with_undone: true,
            ..TimelapseSettings::default()
        };
        let found: Vec<usize> = moments(&script(), &settings).iter().map(|m| m.action).collect();
        assert_eq!(found, [0, 2, 4, 5, 6]);
    }

    #[test]
    fn frames_are_taken_by_painting_time_within_strokes_that_are_left() {
        // 4 s: the stroke on the palette and the undone one do not count.
        let wanted = [(0, 0), (1, 2), (1, 4), (3, 1), (3, 3), (6, 0)];
        assert_eq!(at(Interval::Seconds(0.8), &script()), wanted);
        assert_eq!(at(Interval::Seconds(100.0), &script()), [(0, 0), (6, 0)]);
    }

    #[test]
    fn a_number_of_frames_is_spread_over_time_or_actions() {
        assert_eq!(at(Interval::Frames(5), &script()), [(0, 0), (1, 3), (3, 1), (3, 3), (6, 0)]);
        assert_eq!(at(Interval::Frames(2), &script()), [(0, 0), (6, 0)]);
        let dry: Vec<Action> = (0..9).map(|_| Action::Dry { fraction: 0.1 }).collect();
        assert_eq!(at(Interval::Frames(4), &dry), [(0, 0), (3, 0), (6, 0), (9, 0)]);
        assert_eq!(at(Interval::Frames(100), &dry).len(), 10, "one for each action");
        assert_eq!(at(Interval::Frames(7), &[]), [(0, 0)], "nothing was painted");
    }
}

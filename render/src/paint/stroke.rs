//! From samples of a pen to sub-steps of at most one cell, and what a head
//! touches in each.

mod path;

use path::{Piece, Way};

use super::brush::{Head, Relief};
use super::contact::Contact;
use super::pose::{Pose, Sample};
use crate::tile::Rect;

/// The most sub-steps a stroke may take.
pub const MOST_SUBSTEPS: u64 = 10_000_000;

/// How far from the canvas's origin a sample may be, in cells.
const FARTHEST: f64 = 1e9;

/// Pressures of a dab, as shares of its sample's: down, and up again.
const DAB: [f64; 8] = [0.0, 0.25, 0.5, 0.75, 1.0, 0.67, 0.33, 0.0];

/// The poses of a stroke, each at most one cell from the last, the first at the
/// first sample and the last at the last.
///
/// The path is smooth through the samples (centripetal Catmull-Rom, Yuksel,
/// Schaefer and Keyser 2011); pressure, tilt and twist run straight between
/// them, twist the shorter way. Poses are one cell of way apart, or nearer where
/// the hand turns: 1/16 of pressure, 3 degrees. Time counts for nothing else: a
/// brush at rest makes no sub-steps. Samples all at one place and pose are a
/// dab: lowered, pressed and lifted there.
///
/// # Errors
/// [`StrokeError`] if there is no sample, a number is none or out of its range,
/// time runs backwards, a place is 1e9 cells away, or the way is longer than [`MOST_SUBSTEPS`].
pub fn substeps(
    samples: &[Sample],
    cell_mm: f64,
) -> Result<impl Iterator<Item = Pose> + use<>, StrokeError> {
    if !(cell_mm.is_finite() && cell_mm > 0.0) {
        return Err(StrokeError::Cell { cell_mm });
    }
    if samples.is_empty() {
        return Err(StrokeError::Empty);
    }
    check(samples, cell_mm)?;
    let poses: Vec<Pose> = samples.iter().map(|sample| sample.pose(cell_mm)).collect();
    let pieces: Vec<Piece> = (1..poses.len()).map(|end| Piece::new(&poses, end)).collect();
    let length: f64 = pieces.iter().map(Piece::size).sum();
    if length > MOST_SUBSTEPS as f64 {
        return Err(StrokeError::TooLong { substeps: length });
    }
    let last = poses[poses.len() - 1];
    let dab = length == 0.0;
    let pressed = DAB.map(|share| Pose { pressure: share * last.pressure, ..last });
    let way = Way::new(pieces, poses[0], last);
    let dab = pressed.into_iter().filter(move |_| dab);
    let way = way.filter(move |_| length > 0.0);
    Ok(dab.chain(way))
}

/// What `head` touches along `poses`: set down at the first without dragging,
/// then a contact for each. Poses that touch nothing give none. The head is
/// lifted at the end.
pub fn contacts(
    head: &mut Head,
    poses: impl Iterator<Item = Pose>,
    relief: &Relief,
    bounds: Rect,
) -> impl Iterator<Item = Contact> {
    let mut poses = poses.peekable();
    let first = poses.next();
    if let Some(first) = &first {
        let next = poses.peek().unwrap_or(first);
        head.set_down(first, (next.x - first.x, next.y - first.y), relief);
    }
    let mut poses = first.into_iter().chain(poses);
    std::iter::from_fn(move || {
        for pose in poses.by_ref() {
            let mut contact = Contact { rect: Rect::default(), touches: Vec::new() };
            head.advance(&pose, relief, bounds, &mut contact);
            if !contact.rect.is_empty() {
                return Some(contact);
            }
        }
        head.lift();
        None
    })
}

/// Refuses what no hand does.
fn check(samples: &[Sample], cell_mm: f64) -> Result<(), StrokeError> {
    let farthest = FARTHEST * cell_mm;
    for (index, sample) in samples.iter().enumerate() {
        let fields = [
            ("seconds", sample.seconds, f64::INFINITY),
            ("x_mm", sample.x_mm, farthest),
            ("y_mm", sample.y_mm, farthest),
            ("pressure", sample.pressure, 1.0),
            ("tilt_x_deg", sample.tilt_x_deg, 90.0),
            ("tilt_y_deg", sample.tilt_y_deg, 90.0),
            ("twist_deg", sample.twist_deg, f64::INFINITY),
        ];
        for (field, found, highest) in fields {
            if !found.is_finite() {
                return Err(StrokeError::NoNumber { sample: index, field, found });
            }
            let lowest = if field == "pressure" { 0.0 } else { -highest };
            if !(lowest..=highest).contains(&found) {
                return Err(StrokeError::Range { sample: index, field, found, lowest, highest });
            }
        }
        if index > 0 && sample.seconds < samples[index - 1].seconds {
            let before = samples[index - 1].seconds;
            return Err(StrokeError::Backwards { sample: index, found: sample.seconds, before });
        }
    }
    Ok(())
}

/// Why samples are no stroke. Samples are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StrokeError {
    /// No sample.
    #[error("a stroke without samples")]
    Empty,
    /// Cells without width.
    #[error("cells have a width above 0 mm: `{cell_mm}` mm")]
    Cell {
        /// As it was given.
        cell_mm: f64,
    },
    /// Infinite, or not a number.
    #[error("sample {sample}: {field} is no number: `{found}`")]
    NoNumber {
        /// Which sample.
        sample: usize,
        /// Which of its fields.
        field: &'static str,
        /// What it says.
        found: f64,
    },
    /// Beyond what the field can be.
    #[error("sample {sample}: {field} is from {lowest} to {highest}: `{found}`")]
    Range {
        /// Which sample.
        sample: usize,
        /// Which of its fields.
        field: &'static str,
        /// What it says.
        found: f64,
        /// The least it can be.
        lowest: f64,
        /// The most it can be.
        highest: f64,
    },
    /// A sample earlier than the one before it.
    #[error("sample {sample}: seconds fall, from {before} to `{found}`")]
    Backwards {
        /// Which sample.
        sample: usize,
        /// What it says.
        found: f64,
        /// What the sample before it says.
        before: f64,
    },
    /// More sub-steps than a stroke may take.
    #[error("the stroke takes up to {substeps:.0} sub-steps, at most {MOST_SUBSTEPS} are allowed")]
    TooLong {
        /// What it would take at most.
        substeps: f64,
    },
}

impl StrokeError {
    /// The way out.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Empty => "give at least one sample",
            Self::Cell { .. } => "give the width of a cell in mm, such as 0.1",
            Self::NoNumber { .. } => "leave the sample out",
            Self::Range { field: "pressure", .. } => "divide by the pen's highest pressure",
            Self::Range { field: "x_mm" | "y_mm", .. } => {
                "places are in mm from the canvas's corner"
            }
            Self::Range { .. } => "tilts are degrees from upright",
            Self::Backwards { .. } => "sort the samples by time",
            Self::TooLong { .. } => "places are in mm; cut the stroke in pieces",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::brush::HeadShape;
    use super::*;

    const SAMPLE: Sample = Sample {
        seconds: 0.0,
        x_mm: 5.0,
        y_mm: 5.0,
        pressure: 0.5,
        tilt_x_deg: 0.0,
        tilt_y_deg: 0.0,
        twist_deg: 0.0,
    };

    fn poses(samples: &[Sample]) -> Vec<Pose> {
        substeps(samples, 0.1).unwrap().collect()
    }

    fn at(seconds: f64, x_mm: f64, y_mm: f64) -> Sample {
        Sample { seconds, x_mm, y_mm, ..SAMPLE }
    }

    #[test]
    fn steps_are_at_most_one_cell_and_nearly_so_through_all_samples() {
        let samples = [
            at(0.0, 5.0, 5.0),
            at(0.1, 5.02, 5.01),
            at(0.2, 9.0, 5.0),
            at(0.3, 9.0, 8.0),
            at(0.3, 9.0, 8.0),
            at(0.4, 2.0, 8.0),
        ];
        let poses = poses(&samples);
        let steps = poses.windows(2).map(|w| (w[0].x - w[1].x).hypot(w[0].y - w[1].y));
        let steps: Vec<f64> = steps.collect();
        assert!(steps.iter().all(|&step| step <= 1.0), "{steps:?}");
        let full = steps.iter().filter(|&&step| step > 0.85).count();
        assert!(full + 8 >= steps.len(), "{full} of {}", steps.len());
        for sample in samples {
            let near = |p: &Pose| (p.x - 10.0 * sample.x_mm).hypot(p.y - 10.0 * sample.y_mm);
            let nearest = poses.iter().map(near).fold(f64::INFINITY, f64::min);
            assert!(nearest <= 0.5, "{sample:?}: {nearest}");
        }
        assert_eq!((poses[0].x, poses[0].y), (50.0, 50.0));
        assert_eq!(poses.last().map(|p| (p.x, p.y)), Some((20.0, 80.0)));
    }

    #[test]
    fn two_samples_are_a_straight_line_and_the_hand_turns_evenly() {
        let end =
            Sample { pressure: 0.9, tilt_x_deg: 30.0, twist_deg: 350.0, ..at(1.0, 15.0, 5.0) };
        for pose in poses(&[SAMPLE, end]) {
            let share = (pose.x - 50.0) / 100.0;
            assert!((pose.y - 50.0).abs() < 1e-9);
            assert!((pose.pressure - 0.5 - 0.4 * share).abs() < 1e-9, "{pose:?}");
            assert!((pose.tilt_x_deg - 30.0 * share).abs() < 1e-9, "{pose:?}");
            // 350 degrees are 10 the other way.
            let twist = if share < 1.0 { -10.0 * share } else { 350.0 };
            assert!((pose.twist_deg - twist).abs() < 1e-9, "{pose:?}");
        }
    }

    #[test]
    fn pressing_and_turning_on_the_spot_takes_steps_of_its_own() {
        let end = Sample { pressure: 1.0, twist_deg: 90.0, ..SAMPLE };
        let poses = poses(&[SAMPLE, end]);
        assert!(poses.len() > 30, "{}", poses.len());
        for pair in poses.windows(2) {
            assert!(path::turned(&pair[0], &pair[1]) <= 1.0 + 1e-9, "{pair:?}");
        }
    }

    #[test]
    fn one_sample_is_a_dab() {
        for samples in [&[SAMPLE][..], &[SAMPLE, at(1.0, 5.0, 5.0)]] {
            let pressures: Vec<f64> = poses(samples).iter().map(|pose| pose.pressure).collect();
            assert_eq!(pressures.len(), DAB.len());
            assert_eq!(pressures.iter().copied().fold(0.0, f64::max), 0.5);
            assert_eq!((pressures[0], pressures[7]), (0.0, 0.0));
        }
    }

    #[test]
    fn contacts_begin_at_rest_and_a_dab_moves() {
        let relief = Relief::flat(300, 100, 0.1);
        let bounds = Rect { x: 0, y: 0, width: 300, height: 100 };
        let mut head = Head::new(HeadShape::Filbert, 3.0, 0.1).unwrap();
        let line = substeps(&[SAMPLE, at(1.0, 20.0, 5.0)], 0.1).unwrap();
        let stroke: Vec<Contact> = contacts(&mut head, line, &relief, bounds).collect();
        assert!(stroke.len() > 150, "{}", stroke.len());
        let fastest = |contact: &Contact| {
            let pressed = contact.touches.iter().filter(|touch| touch.height < 0);
            pressed.map(|touch| touch.velocity().0.abs()).max()
        };
        assert!(fastest(&stroke[0]) < Some(96), "{:?}", fastest(&stroke[0]));
        assert!(fastest(&stroke[140]) > Some(240), "{:?}", fastest(&stroke[140]));
        let dab = substeps(&[SAMPLE], 0.1).unwrap();
        let dab: Vec<Contact> = contacts(&mut head, dab, &relief, bounds).collect();
        assert_eq!(dab.len(), DAB.len() - 2);
        let paints = |contact: &Contact| {
            contact.touches.iter().any(|touch| touch.height < 0 && touch.speed() == 256)
        };
        assert!(dab.iter().any(paints));
    }

    #[test]
    fn what_no_hand_does_is_refused_with_its_place() {
        let refused = |second: Sample| substeps(&[SAMPLE, second], 0.1).err().unwrap();
        let error = refused(Sample { pressure: 1.5, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: pressure is from 0 to 1: `1.5`");
        let error = refused(Sample { tilt_y_deg: -91.0, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: tilt_y_deg is from -90 to 90: `-91`");
        let error = refused(Sample { x_mm: f64::NAN, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: x_mm is no number: `NaN`");
        let error = refused(Sample { twist_deg: f64::INFINITY, ..SAMPLE });
        assert!(matches!(error, StrokeError::NoNumber { field: "twist_deg", .. }), "{error}");
        let error = refused(Sample { seconds: -0.1, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: seconds fall, from 0 to `-0.1`");
        for x_mm in [1e9, 1e300, -1e308] {
            let error = refused(Sample { x_mm, ..SAMPLE });
            assert!(matches!(error, StrokeError::Range { field: "x_mm", .. }), "{error}");
        }
        for x_mm in [1.1e6, -9e7] {
            let error = refused(Sample { x_mm, ..SAMPLE });
            assert!(matches!(error, StrokeError::TooLong { .. }), "{error}");
        }
        assert!(matches!(substeps(&[], 0.1).err(), Some(StrokeError::Empty)));
        assert!(matches!(substeps(&[SAMPLE], 0.0).err(), Some(StrokeError::Cell { .. })));
    }
}

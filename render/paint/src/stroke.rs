//! Strokes: the smooth path through pen samples, cut into sub-steps of at most one cell,
//! and the contacts of a head along it.

mod decimals;
mod limits;
mod error;
mod piece;
mod path;

pub use decimals::SampleDecimals;
pub use error::StrokeError;
pub use limits::MOST_SUBSTEPS;
pub use path::Path;

use super::brush::{Head, Relief};
use super::contact::Contact;
use super::pose::{Pose, Sample};
use graphics::tile::Rect;

/// Poses of a stroke, each at most one cell from the previous one, from the first sample to
/// the last, where the brush is lifted.
///
/// The path is a centripetal Catmull-Rom curve through the samples (Yuksel, Schaefer and
/// Keyser 2011); pressure, tilt and twist are interpolated linearly, twist the shorter way
/// round. From one pose to the next, the sides of a brush of `size_mm` move by one cell at most,
/// an angle changes by 3 degrees at most, and the pressure by 1/16 at most, less for a wide brush,
/// so that the sides of its mark move by about a cell. At the last sample the brush is lifted on
/// the spot, by 1.5 cells of its sides a pose. Time only orders the samples: a brush at rest makes
/// no sub-steps. If all samples have the same position and pose, the stroke is a dab: the brush is
/// pressed down and lifted at that position.
///
/// # Errors
/// [`StrokeError`] if there is no sample, a number is not finite or out of range, time runs
/// backwards, a position is more than 1e9 cells away, or the path takes more than
/// [`MOST_SUBSTEPS`].
pub fn substeps(
    samples: &[Sample],
    cell_mm: f64,
    size_mm: f64,
) -> Result<impl Iterator<Item = Pose> + use<>, StrokeError> {
    if samples.is_empty() {
        return Err(StrokeError::Empty);
    }
    let mut path = Path::new(cell_mm, size_mm)?;
    path.push(samples)?;
    path.finish();
    Ok(path)
}

/// Contacts of `head` with the canvas along `poses`. The head is set down at the first pose
/// without dragging and lifted after the last. Poses that touch nothing give no contact, unless
/// paint flows along the hair.
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
            let mut contact = Contact::default();
            head.advance(&pose, relief, bounds, &mut contact);
            if !contact.rect.is_empty() || contact.wicking.share > 0 {
                return Some(contact);
            }
        }
        head.lift();
        None
    })
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

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

    /// Width of the brush.
    const SIZE_MM: f64 = 3.0;

    fn poses(samples: &[Sample]) -> Vec<Pose> {
        substeps(samples, 0.1, SIZE_MM).unwrap().collect()
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
        let steps = &steps[..steps.len() - 10];
        assert!(poses[steps.len()..].iter().all(|pose| (pose.x, pose.y) == (20.0, 80.0)));
        let full = steps.iter().filter(|&&step| step > 0.85).count();
        assert!(full + 8 >= steps.len(), "{full} of {}", steps.len());
        for sample in samples {
            let nearest = poses
                .iter()
                .map(|p: &Pose| (p.x - 10.0 * sample.x_mm).hypot(p.y - 10.0 * sample.y_mm))
                .fold(f64::INFINITY, f64::min);
            assert!(nearest <= 0.5, "{sample:?}: {nearest}");
        }
        assert_eq!((poses[0].x, poses[0].y), (50.0, 50.0));
        assert_eq!(poses.last().map(|p| (p.x, p.y, p.pressure)), Some((20.0, 80.0, 0.0)));
    }

    #[test]
    fn two_samples_are_a_straight_line_and_the_hand_turns_evenly() {
        let end =
            Sample { pressure: 0.9, tilt_x_deg: 30.0, twist_deg: 350.0, ..at(1.0, 15.0, 5.0) };
        for pose in poses(&[SAMPLE, end]).into_iter().filter(|pose| pose.x < 150.0) {
            let share = (pose.x - 50.0) / 100.0;
            assert!((pose.y - 50.0).abs() < 1e-9);
            assert!((pose.pressure - 0.5 - 0.4 * share).abs() < 1e-9, "{pose:?}");
            assert!((pose.tilt_x_deg - 30.0 * share).abs() < 1e-9, "{pose:?}");
            // 350 degrees are 10 the other way.
            assert!((pose.twist_deg + 10.0 * share).abs() < 1e-9, "{pose:?}");
        }
    }

    /// Samples with repeated places, rests and turns.
    fn random_samples(random: &mut ChaCha8Rng) -> Vec<Sample> {
        let count = random.random_range(1..12);
        let still = random.random_range(0..4) == 0;
        let (mut samples, mut sample): (Vec<Sample>, _) = (Vec::new(), SAMPLE);
        for index in 0..count {
            sample.seconds = 0.01 * f64::from(index);
            if !still && random.random_range(0..3) > 0 {
                sample.x_mm += random.random_range(-1.0..1.0);
                sample.y_mm += random.random_range(-0.3..0.3);
            }
            if !still && random.random_range(0..3) == 0 {
                sample.pressure = random.random_range(0.0..1.0);
                sample.twist_deg += random.random_range(-200.0..200.0);
            }
            samples.push(sample);
        }
        samples
    }

    #[test]
    fn poses_of_a_stroke_in_pieces_are_those_of_the_whole() {
        let mut dabs = 0;
        for seed in 0..300 {
            let random = &mut ChaCha8Rng::seed_from_u64(seed);
            let samples = random_samples(random);
            let whole = poses(&samples);
            let place = |sample: &Sample| (sample.x_mm, sample.y_mm);
            dabs += usize::from(samples.iter().all(|sample| place(sample) == place(&SAMPLE)));
            let mut path = Path::new(0.1, SIZE_MM).unwrap();
            let mut pieces = Vec::new();
            let mut rest = &samples[..];
            let mut lagged = 0;
            while !rest.is_empty() {
                let (now, later) = rest.split_at(random.random_range(0..=rest.len()));
                path.push(now).unwrap();
                rest = later;
                let least = path.waiting();
                let most = random.random_range(0..40);
                let before = pieces.len();
                pieces.extend(path.by_ref().take(most));
                assert_eq!(least > 0 && most > 0, pieces.len() > before, "seed {seed}");
                assert!(pieces.len() - before <= least, "seed {seed}: {least} at most");
                let reached = path.reached();
                assert!(reached <= path.samples(), "seed {seed}");
                lagged = lagged.max(path.samples() - reached);
            }
            path.finish();
            pieces.extend(path.by_ref());
            assert_eq!(path.reached(), samples.len(), "seed {seed}");
            assert!(pieces == whole, "seed {seed}: {} of {}", pieces.len(), whole.len());
            assert!(lagged > 0, "seed {seed}: no path lagged behind");
        }
        assert!(dabs > 20, "{dabs} dabs");
    }

    #[test]
    fn a_refused_sample_leaves_the_path_where_it_was() {
        let good = [SAMPLE, at(0.1, 7.0, 5.0), at(0.2, 9.0, 6.0)];
        let mut path = Path::new(0.1, SIZE_MM).unwrap();
        path.push(&good[..2]).unwrap();
        for bad in [
            Sample { pressure: -0.1, ..good[2] },
            Sample { y_mm: f64::NAN, ..good[2] },
            Sample { seconds: 0.05, ..good[2] },
            Sample { x_mm: 1.1e6, ..good[2] },
        ] {
            let error = path.push(&[bad]).unwrap_err();
            let place = matches!(error, StrokeError::TooLong { .. })
                || error.to_string().starts_with("sample 2: ");
            assert!(place, "{error}");
        }
        path.push(&good[2..]).unwrap();
        path.finish();
        assert_eq!(path.collect::<Vec<_>>(), poses(&good));
    }

    #[test]
    fn pressing_and_turning_on_the_spot_takes_steps_of_its_own() {
        let end = Sample { pressure: 1.0, twist_deg: 90.0, ..SAMPLE };
        let poses = poses(&[SAMPLE, end]);
        assert!(poses.len() > 30, "{}", poses.len());
        for pair in poses[..poses.len() - 20].windows(2) {
            assert!(piece::turned(&pair[0], &pair[1], 15.0) <= 1.0 + 1e-9, "{pair:?}");
        }
    }

    #[test]
    fn sides_of_a_brush_move_by_a_cell_at_most() {
        let bend = |index: u32| {
            let angle = f64::from(index) * 0.2;
            let (sin, cos) = angle.sin_cos();
            let twist_deg = angle.to_degrees();
            Sample { twist_deg, ..at(f64::from(index), 5.0 + 2.0 * sin, 5.0 - 2.0 * cos) }
        };
        let samples: Vec<Sample> = (0..20).map(bend).collect();
        let size_mm = 6.0;
        let side = |pose: &Pose| {
            let (sin, cos) = pose.twist_deg.to_radians().sin_cos();
            let half = size_mm / 2.0 / 0.1;
            (pose.x + half * sin, pose.y - half * cos)
        };
        let poses: Vec<Pose> = substeps(&samples, 0.1, size_mm).unwrap().collect();
        for pair in poses.windows(2) {
            let from = side(&pair[0]);
            let to = side(&pair[1]);
            let way = (from.0 - to.0).hypot(from.1 - to.1);
            assert!(way <= 1.0 + 1e-9, "{way} cells from {pair:?}");
        }
    }

    #[test]
    fn one_sample_is_a_dab() {
        for samples in [&[SAMPLE][..], &[SAMPLE, at(1.0, 5.0, 5.0)]] {
            let pressures: Vec<f64> = poses(samples).iter().map(|pose| pose.pressure).collect();
            // By 1.5/30 for a brush 30 cells wide.
            assert_eq!(pressures.len(), 2 * 10 + 1);
            for (at, pressure) in pressures.iter().enumerate() {
                let wanted = (10 - 10_usize.abs_diff(at)) as f64 / 20.0;
                assert!((pressure - wanted).abs() < 1e-9, "{at}: {pressure}, not {wanted}");
            }
        }
    }

    #[test]
    fn contacts_begin_at_rest_and_a_dab_moves() {
        let relief = Relief::flat(300, 100, 0.1);
        let bounds = Rect { x: 0, y: 0, width: 300, height: 100 };
        let mut head = Head::new(HeadShape::Filbert, SIZE_MM, 0.1).unwrap();
        let line = substeps(&[SAMPLE, at(1.0, 20.0, 5.0)], 0.1, SIZE_MM).unwrap();
        let stroke: Vec<Contact> = contacts(&mut head, line, &relief, bounds).collect();
        assert!(stroke.len() > 150, "{}", stroke.len());
        // Hair is pressed by about half its sink.
        let sunk = |contact: &Contact| (contact.rates.sink / 2) as i32;
        let fastest = |contact: &Contact| {
            let pressed = contact.touches.iter().filter(|touch| touch.height < sunk(contact));
            pressed.map(|touch| touch.velocity().0.abs()).max()
        };
        assert!(fastest(&stroke[0]) < Some(96), "{:?}", fastest(&stroke[0]));
        assert!(fastest(&stroke[140]) > Some(240), "{:?}", fastest(&stroke[140]));
        let dab = substeps(&[SAMPLE], 0.1, SIZE_MM).unwrap();
        let dab: Vec<Contact> = contacts(&mut head, dab, &relief, bounds).collect();
        assert_eq!(dab.len(), 2 * 10 - 1);
        assert!(dab.iter().any(|contact: &Contact| {
            let mut touches = contact.touches.iter();
            touches.any(|touch| touch.height < sunk(contact) && touch.transfer_weight() == 256)
        }));
    }

    #[test]
    fn impossible_samples_are_refused_with_their_index() {
        let refused = |second: Sample| substeps(&[SAMPLE, second], 0.1, SIZE_MM).err().unwrap();
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
        assert!(matches!(substeps(&[], 0.1, SIZE_MM).err(), Some(StrokeError::Empty)));
        assert!(matches!(substeps(&[SAMPLE], 0.0, SIZE_MM).err(), Some(StrokeError::Cell { .. })));
    }
}

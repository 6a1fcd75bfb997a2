//! A stroke is a smooth path through pen samples. This module follows the path as samples arrive,
//! cuts it into sub-steps of at most one cell, and gives you the contacts of a head along it.

mod piece;

use std::collections::VecDeque;

use documents::hint::Explain;
use graphics::tile::Rect;

use super::brush::{Head, Relief};
use super::contact::Contact;
pub use super::pose::SampleDecimals;
use super::pose::{Pose, Sample};
use piece::{Piece, distance, interpolated, most_pressure, place};

/// Computes the poses of a stroke. Each is at most one cell from the previous one, from the first
/// sample to the last. There we lift the brush.
///
/// The path is a centripetal Catmull-Rom curve through the samples (Yuksel, Schaefer and Keyser
/// 2011). Pressure, tilt and twist are interpolated linearly, twist the shorter way round. From one
/// pose to the next, the sides of a brush of `size_mm` move by one cell at most, an angle changes
/// by 3 degrees at most, and the pressure by 1/16 at most, less for a wide brush, so that the sides
/// of its mark move by about a cell. After the last sample we lift the brush: the sides of its mark
/// move by 0.75 cells a pose. Times give the speed of the hand: a brush at rest does not make sub-steps.
/// If all samples have one position and pose, you get a dab: we press the brush down and lift it at
/// this position.
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
    samples.iter().try_for_each(|sample| path.push(sample))?;
    path.finish();
    Ok(path)
}

/// Contacts of `head` with the canvas along `poses`. We set the head down at the first pose without
/// dragging it and lift it after the last. You do not get contacts for poses that touch nothing,
/// unless paint flows along the hair.
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

/// Maximum number of sub-steps of a stroke.
pub const MOST_SUBSTEPS: u64 = 10_000_000;

/// Maximum distance of a sample from the origin of the canvas along each axis, in cells.
const FARTHEST: f64 = 1e9;

/// Why samples cannot be painted. Samples are counted from 0, the first of the stroke.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum StrokeError {
    /// The stroke has no sample.
    #[error("a stroke without samples")]
    #[hint("give at least one sample")]
    Empty,
    /// The width of a cell is not above 0.
    #[error("cells have a width above 0 mm: `{0}` mm")]
    #[hint("give the width of a cell in mm, such as 0.1")]
    Cell(f64),
    /// A number is infinite or NaN.
    #[error("sample {sample}: {field} is not a number: `{found}`")]
    #[hint("leave the sample out")]
    NoNumber {
        /// Index of the sample.
        sample: usize,
        /// Name of the field.
        field: &'static str,
        /// Value of the field.
        found: f64,
    },
    /// A number is out of range.
    #[error("sample {sample}: {field} is from {lowest} to {highest}: `{found}`")]
    #[hint(if *field == "pressure", "divide by the pen's highest pressure")]
    #[hint(if field.ends_with("_mm"), "places are in mm from the canvas's corner")]
    #[hint("tilts are degrees from upright")]
    Range {
        /// Index of the sample.
        sample: usize,
        /// Name of the field.
        field: &'static str,
        /// Value of the field.
        found: f64,
        /// Lowest value allowed.
        lowest: f64,
        /// Highest value allowed.
        highest: f64,
    },
    /// A sample is earlier than the one before it.
    #[error("sample {sample}: seconds fall, from {before} to `{found}`")]
    #[hint("sort the samples by time")]
    Backwards {
        /// Index of the sample.
        sample: usize,
        /// Value of the field.
        found: f64,
        /// Seconds of the sample before it.
        before: f64,
    },
    /// The stroke needs more than [`MOST_SUBSTEPS`] sub-steps.
    #[error("the stroke takes up to {0:.0} sub-steps, at most {MOST_SUBSTEPS} are allowed")]
    #[hint("places are in mm; cut the stroke in pieces")]
    TooLong(f64),
    /// A sample came after the brush was lifted.
    #[error("the brush was lifted, so the stroke takes no more samples")]
    #[hint("begin another stroke")]
    Lifted,
}

/// Cells by which the side of a mark moves in a sub-step of pressing down or lifting (chosen by the measured
/// lines before the end of a stroke).
const LIFT: f64 = 0.75;

/// Cells by which the hand sweeps on in each sub-step in which it lifts the brush. From a pressure of 0.5 this
/// is nearly half of the width of the brush (chosen by the measured ends of strokes).
const SWEEP: f64 = 0.7;

/// Number of sub-steps in which the hand comes down to the start of a path, relative to those in which it
/// would lift the brush from there (chosen so that the middle of a mark stays at the pen).
const APPROACH: f64 = 0.66;

/// Distance in mm over which the speed of the hand follows its samples. A pen's clock jitters.
const SPEED_MM: f64 = 3.0;

/// Highest speed of a hand in mm/s.
const FASTEST: f64 = 5000.0;

/// Iterator over the poses of a stroke. You may pass its samples in portions and still get the
/// poses for all samples at once, equal to the bit: those of [`substeps`], unless you let the hand
/// [sweep](Path::sweep).
///
/// The curve to a sample depends on the next one, so poses lag one sample behind until you finish
/// the path. A dab (all samples at one position and pose) does not have poses until then.
#[derive(Debug, Clone)]
pub struct Path {
    cell_mm: f64,
    /// Half of the width of the brush in cells.
    reach: f64,
    samples: usize,
    seconds: f64,
    /// Poses of the last three samples, the newest last. We need them for the curve of the next
    /// piece.
    recent: [Option<Pose>; 3],
    /// Pieces with a known curve that we have not walked to their end.
    pieces: VecDeque<Piece>,
    /// Sum of the sizes of all pieces with a known curve, in sub-steps.
    length: f64,
    first: Option<Pose>,
    finished: bool,
    /// Whether the hand moves while it comes down and lifts the brush.
    sweeps: bool,
    /// Direction of the path at its end: a unit vector, or (0, 0) if the hand rests.
    heading: (f64, f64),
    /// Number of poses left from coming down to `first`. `None` before we know it.
    approach: Option<usize>,
    /// Number of poses returned of a dab, or of the lifting of the brush after a path.
    ended: usize,
    /// Number of pieces walked to their end.
    walked: usize,
    /// Number of steps walked in the first of `pieces`. See `Piece::looks`.
    look: u64,
    /// Fraction of a sub-step from the last pose returned to `look`.
    since: f64,
    /// Next pose, if we have computed it and not yet returned it.
    next: Option<Pose>,
}

impl Path {
    /// An empty path for a brush of `size_mm`, over cells of `cell_mm`. We choose its sub-steps so
    /// that in each the sides of this brush move by about a cell or less.
    ///
    /// # Errors
    /// [`StrokeError::Cell`] if `cell_mm` is not a finite number above 0.
    pub fn new(cell_mm: f64, size_mm: f64) -> Result<Self, StrokeError> {
        if !(cell_mm.is_finite() && cell_mm > 0.0) {
            return Err(StrokeError::Cell(cell_mm));
        }
        Ok(Self {
            cell_mm,
            reach: 0.5 * size_mm / cell_mm,
            samples: 0,
            seconds: f64::NEG_INFINITY,
            recent: [None; 3],
            pieces: VecDeque::new(),
            length: 0.0,
            first: None,
            finished: false,
            sweeps: false,
            heading: (0.0, 0.0),
            approach: None,
            ended: 0,
            walked: 0,
            look: 0,
            since: 0.0,
            next: None,
        })
    }

    /// Lets the hand come down along its way before the first sample, and move on after the last while it
    /// lifts the brush. A hand that rests at an end of the path, and a dab, stay there. Call this before you
    /// take poses.
    pub fn sweep(&mut self) {
        self.sweeps = true;
    }

    /// Appends a sample. If it is refused, others can be appended instead.
    ///
    /// # Errors
    /// [`StrokeError`] for an impossible sample, and for a path of more than
    /// [`MOST_SUBSTEPS`]. Samples are counted from the first of the path.
    ///
    /// # Panics
    /// If the path is finished.
    pub fn push(&mut self, sample: &Sample) -> Result<(), StrokeError> {
        assert!(!self.finished, "a path takes no samples after it is finished");
        self.check(sample)?;
        let mut pose = sample.pose(self.cell_mm);
        let [before, from, mut to] = self.recent;
        if let Some(to) = &mut to {
            pose.speed_mm_s = self.speed_after(to, (&pose, sample.seconds));
            if self.samples == 1 {
                to.speed_mm_s = pose.speed_mm_s;
            }
        }
        let known =
            from.zip(to).map(|(from, to)| Piece::new((before, from), (to, Some(pose)), self.reach));
        let guessed = to.map(|to| Piece::new((from, to), (pose, None), self.reach));
        let substeps = self.length + piece_size(&known) + piece_size(&guessed);
        if substeps > MOST_SUBSTEPS as f64 {
            return Err(StrokeError::TooLong(substeps));
        }
        // The first sample has the speed of the hand to the second.
        self.first = match self.samples {
            0 => Some(pose),
            1 => to,
            _ => self.first,
        };
        self.samples += 1;
        self.seconds = sample.seconds;
        self.recent = [from, to, Some(pose)];
        self.add(known);
        Ok(())
    }

    /// Speed of the hand in mm/s at the sample `to`, after the sample `from`. If no time has passed between
    /// them, it is the speed before.
    fn speed_after(&self, from: &Pose, (to, seconds): (&Pose, f64)) -> f64 {
        let way_mm = distance(place(from), place(to)) * self.cell_mm;
        let took = seconds - self.seconds;
        if took <= 0.0 {
            return from.speed_mm_s;
        }
        let speed = (way_mm / took).min(FASTEST);
        let followed = if self.samples == 1 { 1.0 } else { 1.0 - libm::exp(-way_mm / SPEED_MM) };
        interpolated(from.speed_mm_s, speed, followed)
    }

    fn add(&mut self, piece: Option<Piece>) {
        if let Some(piece) = &piece {
            self.heading = piece.headings()[1];
        }
        self.length += piece.as_ref().map_or(0.0, Piece::size);
        self.pieces.extend(piece);
    }

    /// Ends the path at the last sample. After this you can get its last poses.
    pub fn finish(&mut self) {
        let [before, from, to] = self.recent;
        if !self.finished {
            self.add(
                from.zip(to).map(|(from, to)| Piece::new((before, from), (to, None), self.reach)),
            );
        }
        self.finished = true;
    }

    /// Whether the path was finished.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.finished
    }

    /// Number of samples that the returned poses have reached.
    #[must_use]
    pub fn reached(&self) -> usize {
        match (self.finished && self.ended > 0, self.first) {
            (true, _) => self.samples,
            (false, None) if self.samples > 0 => self.walked + 1,
            _ => 0,
        }
    }

    /// Upper bound of the number of poses that you can get now. This is 0 if and only if there is
    /// none.
    pub fn waiting(&mut self) -> usize {
        if self.peek().is_none() {
            return 0;
        }
        if self.length == 0.0 {
            return self.pressing().1 + 1 - self.ended;
        }
        let looked = match self.pieces.front() {
            Some(piece) => piece.size() * self.look as f64 / piece.looks.max(1) as f64,
            None => 0.0,
        };
        let sizes: f64 = self.pieces.iter().map(Piece::size).sum();
        let lifting = if self.finished { self.pressing().1 - self.ended } else { 0 };
        let approach = self.first.and(self.approach).map_or(0, |left| left + 1);
        1 + approach + lifting + (sizes - looked + self.since).max(0.0) as usize
    }

    /// The next pose, if it is known, without removing it.
    pub fn peek(&mut self) -> Option<&Pose> {
        if self.next.is_none() {
            self.next = self.walk();
        }
        self.next.as_ref()
    }

    /// Removes and returns the first pose together with a copy of the second, once we know both.
    /// You need both to set a head down at the first pose in the direction of the second. Call this
    /// before you remove any pose.
    pub fn set_out(&mut self) -> Option<(Pose, Pose)> {
        let first = self.next()?;
        let second = self.peek().copied();
        if second.is_none() {
            self.next = Some(first);
        }
        second.map(|second| (first, second))
    }

    fn walk(&mut self) -> Option<Pose> {
        if self.length == 0.0 {
            return self.pressed();
        }
        if let Some(first) = self.first {
            let (x, y) = self.pieces.front().map_or((0.0, 0.0), |piece| piece.headings()[0]);
            let before = self.approach.unwrap_or_else(|| {
                let moves = self.sweeps && (x, y) != (0.0, 0.0);
                let poses = APPROACH * self.lifting(first.pressure) as f64;
                if moves { poses as usize } else { 0 }
            });
            self.approach = before.checked_sub(1);
            if before == 0 {
                self.first = None;
            }
            let back = SWEEP * before as f64;
            return Some(Pose { x: first.x - back * x, y: first.y - back * y, ..first });
        }
        while let Some(piece) = self.pieces.front() {
            while self.look < piece.looks {
                let part = piece.part(self.look);
                if self.since + part > 1.0 {
                    self.since = 0.0;
                    return Some(piece.pose(self.look));
                }
                self.since += part;
                self.look += 1;
            }
            self.pieces.pop_front();
            self.walked += 1;
            self.look = 0;
        }
        self.pressed()
    }

    /// Number of sub-steps in which we lift the brush from this pressure.
    fn lifting(&self, pressure: f64) -> usize {
        (pressure / (LIFT * most_pressure(self.reach))).ceil() as usize
    }

    /// Number of sub-steps in which we lift the brush at the last sample, and number of all poses
    /// there. On a path the brush arrives pressed, so we only lift it. For a dab we press it down
    /// first, in as many sub-steps.
    fn pressing(&self) -> (usize, usize) {
        let lifting = self.lifting(self.recent[2].map_or(0.0, |last| last.pressure));
        (lifting, if self.length == 0.0 { 2 * lifting + 1 } else { lifting + 1 })
    }

    /// The next pose at the last sample.
    fn pressed(&mut self) -> Option<Pose> {
        let last = self.recent[2].filter(|_| self.finished)?;
        let (lifting, poses) = self.pressing();
        let left = (poses - 1).checked_sub(self.ended)?;
        let swept = if self.sweeps { SWEEP * self.ended as f64 } else { 0.0 };
        self.ended += 1;
        let share = 1.0 - lifting.abs_diff(left) as f64 / lifting.max(1) as f64;
        let x = last.x + swept * self.heading.0;
        let y = last.y + swept * self.heading.1;
        Some(Pose { x, y, pressure: share * last.pressure, ..last })
    }

    fn check(&self, sample: &Sample) -> Result<(), StrokeError> {
        let index = self.samples;
        let farthest = FARTHEST * self.cell_mm;
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
        if sample.seconds < self.seconds {
            let found = sample.seconds;
            let before = self.seconds;
            return Err(StrokeError::Backwards { sample: index, found, before });
        }
        Ok(())
    }
}

fn piece_size(piece: &Option<Piece>) -> f64 {
    piece.as_ref().map_or(0.0, Piece::size)
}

impl Iterator for Path {
    type Item = Pose;

    /// The next pose. This is `None` while we do not know it, and after the last.
    fn next(&mut self) -> Option<Pose> {
        self.peek();
        self.next.take()
    }
}

#[cfg(test)]
mod tests {
    use super::piece::turned;
    use super::*;
    use crate::brush::HeadShape;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    const SAMPLE: Sample = Sample {
        seconds: 0.0,
        x_mm: 5.0,
        y_mm: 5.0,
        pressure: 0.5,
        tilt_x_deg: 0.0,
        tilt_y_deg: 0.0,
        twist_deg: 0.0,
    };

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
        let steps = &steps[..steps.len() - 20];
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
            let mut whole = Path::new(0.1, SIZE_MM).unwrap();
            whole.sweep();
            samples.iter().for_each(|sample| whole.push(sample).unwrap());
            whole.finish();
            let whole: Vec<Pose> = whole.collect();
            dabs += usize::from(
                samples.iter().all(|sample| sample_place(sample) == sample_place(&SAMPLE)),
            );
            let mut path = Path::new(0.1, SIZE_MM).unwrap();
            path.sweep();
            let mut pieces = Vec::new();
            let mut rest = &samples[..];
            let mut lagged = 0;
            while !rest.is_empty() {
                let (now, later) = rest.split_at(random.random_range(0..=rest.len()));
                now.iter().for_each(|sample| path.push(sample).unwrap());
                rest = later;
                let least = path.waiting();
                let most = random.random_range(0..40);
                let before = pieces.len();
                pieces.extend(path.by_ref().take(most));
                assert_eq!(least > 0 && most > 0, pieces.len() > before, "seed {seed}");
                assert!(pieces.len() - before <= least, "seed {seed}: {least} at most");
                let reached = path.reached();
                assert!(reached <= path.samples, "seed {seed}");
                lagged = lagged.max(path.samples - reached);
            }
            path.finish();
            pieces.extend(path.by_ref());
            assert_eq!(path.reached(), samples.len(), "seed {seed}");
            assert!(pieces == whole, "seed {seed}: {} of {}", pieces.len(), whole.len());
            assert!(lagged > 0, "seed {seed}: no path lagged behind");
        }
        assert!(dabs > 20, "{dabs} dabs");
    }

    fn sample_place(sample: &Sample) -> (f64, f64) {
        (sample.x_mm, sample.y_mm)
    }

    #[test]
    fn a_refused_sample_leaves_the_path_where_it_was() {
        let good = [SAMPLE, at(0.1, 7.0, 5.0), at(0.2, 9.0, 6.0)];
        let mut path = Path::new(0.1, SIZE_MM).unwrap();
        good[..2].iter().for_each(|sample| path.push(sample).unwrap());
        for bad in [
            Sample { pressure: -0.1, ..good[2] },
            Sample { y_mm: f64::NAN, ..good[2] },
            Sample { seconds: 0.05, ..good[2] },
            Sample { x_mm: 1.1e6, ..good[2] },
        ] {
            let error = path.push(&bad).unwrap_err();
            let place = matches!(error, StrokeError::TooLong(..))
                || error.to_string().starts_with("sample 2: ");
            assert!(place, "{error}");
        }
        path.push(&good[2]).unwrap();
        path.finish();
        assert_eq!(path.collect::<Vec<_>>(), poses(&good));
    }

    #[test]
    fn pressing_and_turning_on_the_spot_takes_steps_of_its_own() {
        let end = Sample { pressure: 1.0, twist_deg: 90.0, ..SAMPLE };
        let poses = poses(&[SAMPLE, end]);
        assert!(poses.len() > 30, "{}", poses.len());
        for pair in poses[..poses.len() - 40].windows(2) {
            assert!(turned(&pair[0], &pair[1], 15.0) <= 1.0 + 1e-9, "{pair:?}");
        }
    }

    #[test]
    fn sides_of_a_brush_move_by_a_cell_at_most() {
        let samples: Vec<Sample> = (0..20)
            .map(|index: u32| {
                let angle = f64::from(index) * 0.2;
                let (sin, cos) = angle.sin_cos();
                let twist_deg = angle.to_degrees();
                Sample { twist_deg, ..at(f64::from(index), 5.0 + 2.0 * sin, 5.0 - 2.0 * cos) }
            })
            .collect();
        let size_mm = 6.0;
        let poses: Vec<Pose> = substeps(&samples, 0.1, size_mm).unwrap().collect();
        for pair in poses.windows(2) {
            let from = side(&pair[0], size_mm);
            let to = side(&pair[1], size_mm);
            let way = (from.0 - to.0).hypot(from.1 - to.1);
            assert!(way <= 1.0 + 1e-9, "{way} cells from {pair:?}");
        }
    }

    #[test]
    fn one_sample_is_a_dab() {
        for samples in [&[SAMPLE][..], &[SAMPLE, at(1.0, 5.0, 5.0)]] {
            let pressures: Vec<f64> = poses(samples).iter().map(|pose| pose.pressure).collect();
            // By 0.75/30 for a brush 30 cells wide.
            assert_eq!(pressures.len(), 2 * 20 + 1);
            for (at, pressure) in pressures.iter().enumerate() {
                let wanted = (20 - 20_usize.abs_diff(at)) as f64 / 40.0;
                assert!((pressure - wanted).abs() < 1e-9, "{at}: {pressure}, not {wanted}");
            }
        }
    }

    fn side(pose: &Pose, size_mm: f64) -> (f64, f64) {
        let (sin, cos) = pose.twist_deg.to_radians().sin_cos();
        let half = size_mm / 2.0 / 0.1;
        (pose.x + half * sin, pose.y - half * cos)
    }

    #[test]
    fn contacts_begin_at_rest_and_a_dab_moves() {
        let relief = Relief::flat(300, 100, 0.1);
        let bounds = Rect { x: 0, y: 0, width: 300, height: 100 };
        let mut head = Head::new(HeadShape::Filbert, SIZE_MM, 0.1).unwrap();
        let line = substeps(&[SAMPLE, at(1.0, 20.0, 5.0)], 0.1, SIZE_MM).unwrap();
        let stroke: Vec<Contact> = contacts(&mut head, line, &relief, bounds).collect();
        assert!(stroke.len() > 150, "{}", stroke.len());
        let fastest = |contact: &Contact| {
            let pressed = contact.touches.iter().filter(|touch| touch.height < sunk(contact));
            pressed.map(|touch| touch.velocity().0.abs()).max()
        };
        assert!(fastest(&stroke[0]) < Some(96), "{:?}", fastest(&stroke[0]));
        assert!(fastest(&stroke[140]) > Some(240), "{:?}", fastest(&stroke[140]));
        let dab = substeps(&[SAMPLE], 0.1, SIZE_MM).unwrap();
        let dab: Vec<Contact> = contacts(&mut head, dab, &relief, bounds).collect();
        assert_eq!(dab.len(), 2 * 20 - 1);
        assert!(dab.iter().any(|contact: &Contact| {
            let mut touches = contact.touches.iter();
            touches.any(|touch| touch.height < sunk(contact) && touch.transfer_weight() == 256)
        }));
    }

    #[test]
    fn a_hand_comes_down_and_sweeps_on_along_its_way() {
        let mut path = Path::new(0.1, SIZE_MM).unwrap();
        path.sweep();
        for sample in [SAMPLE, at(0.2, 12.0, 5.0), at(0.4, 20.0, 5.0)] {
            path.push(&sample).unwrap();
        }
        path.finish();
        let poses: Vec<Pose> = path.collect();
        let first = poses[0];
        let last = poses[poses.len() - 1];
        assert!(first.x < 45.0 && first.pressure == 0.5, "{first:?}");
        assert!(last.x > 210.0 && last.pressure == 0.0, "{last:?}");
        assert!(poses.iter().all(|pose| (pose.y - 50.0).abs() < 1e-9));
        for pair in poses.windows(2) {
            let way = pair[1].x - pair[0].x;
            assert!((0.0..=1.0 + 1e-9).contains(&way), "{pair:?}");
        }
        // A dab stays where it is, and so does a hand that rests before it lifts.
        for samples in [&[SAMPLE][..], &[SAMPLE, at(0.2, 12.0, 5.0), at(0.3, 12.0, 5.0)]] {
            let mut path = Path::new(0.1, SIZE_MM).unwrap();
            path.sweep();
            samples.iter().for_each(|sample| path.push(sample).unwrap());
            path.finish();
            let end = path.last().unwrap();
            assert_eq!((end.x, end.y), (10.0 * samples[samples.len() - 1].x_mm, 50.0));
        }
    }

    fn speeds(samples: &[Sample]) -> Vec<f64> {
        poses(samples).iter().map(|pose| pose.speed_mm_s).collect()
    }

    #[test]
    fn speed_follows_the_samples_and_ignores_clocks_that_stand_still() {
        let even = speeds(&[SAMPLE, at(0.1, 15.0, 5.0), at(0.2, 25.0, 5.0)]);
        assert!(even.iter().all(|speed| (speed - 100.0).abs() < 1e-9), "{even:?}");
        let unknown = speeds(&[SAMPLE, at(0.0, 15.0, 5.0)]);
        assert!(unknown.iter().all(|&speed| speed == 0.0), "{unknown:?}");
        let faster = speeds(&[SAMPLE, at(0.1, 15.0, 5.0), at(0.12, 25.0, 5.0)]);
        let last = faster[faster.len() - 1];
        assert!(last > 450.0 && last < 500.0, "{last}");
        let jitter = speeds(&[SAMPLE, at(0.1, 15.0, 5.0), at(0.1001, 15.5, 5.0)]);
        assert!(jitter[jitter.len() - 1] < 900.0, "half a mm counts little");
    }

    #[test]
    fn impossible_samples_are_refused_with_their_index() {
        let error = refused_second(Sample { pressure: 1.5, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: pressure is from 0 to 1: `1.5`");
        let error = refused_second(Sample { tilt_y_deg: -91.0, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: tilt_y_deg is from -90 to 90: `-91`");
        let error = refused_second(Sample { x_mm: f64::NAN, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: x_mm is not a number: `NaN`");
        let error = refused_second(Sample { twist_deg: f64::INFINITY, ..SAMPLE });
        assert!(matches!(error, StrokeError::NoNumber { field: "twist_deg", .. }), "{error}");
        let error = refused_second(Sample { seconds: -0.1, ..SAMPLE });
        assert_eq!(error.to_string(), "sample 1: seconds fall, from 0 to `-0.1`");
        for x_mm in [1e9, 1e300, -1e308] {
            let error = refused_second(Sample { x_mm, ..SAMPLE });
            assert!(matches!(error, StrokeError::Range { field: "x_mm", .. }), "{error}");
        }
        for x_mm in [1.1e6, -9e7] {
            let error = refused_second(Sample { x_mm, ..SAMPLE });
            assert!(matches!(error, StrokeError::TooLong(..)), "{error}");
        }
        assert!(matches!(substeps(&[], 0.1, SIZE_MM).err(), Some(StrokeError::Empty)));
        assert!(matches!(substeps(&[SAMPLE], 0.0, SIZE_MM).err(), Some(StrokeError::Cell(..))));
    }

    fn refused_second(second: Sample) -> StrokeError {
        substeps(&[SAMPLE, second], 0.1, SIZE_MM).err().unwrap()
    }

    /// Depth in quanta by which hair is pressed in: about half of its sink.
    fn sunk(contact: &Contact) -> i32 {
        (contact.rates.sink / 2) as i32
    }
}

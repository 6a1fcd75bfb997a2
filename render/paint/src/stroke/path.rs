//! The smooth path through samples as they arrive, in even steps.

use std::collections::VecDeque;

use super::error::StrokeError;
use super::limits::{FARTHEST, MOST_SUBSTEPS};
use super::piece::{Piece, most_pressure};
use crate::pose::{Pose, Sample};

/// Cells by which the side of a mark moves in a sub-step of pressing down or lifting on the spot
/// (chosen by the measured lip at the end of a stroke).
const LIFT: f64 = 1.5;

/// Iterator over the poses of a stroke whose samples arrive in portions. The poses are the
/// same to the bit as those of [`substeps`](super::substeps) for all samples at once.
///
/// The curve to a sample depends on the one after it, so poses lag one sample behind until
/// the path is finished. A dab (all samples at one position and pose) has no poses until
/// then.
#[derive(Debug, Clone)]
pub struct Path {
    cell_mm: f64,
    /// Half of the width of the brush in cells.
    reach: f64,
    samples: usize,
    seconds: f64,
    /// Poses of the last three samples, the newest last: the curve of the next piece needs them.
    recent: [Option<Pose>; 3],
    /// Pieces whose curve is known and that are not yet walked to their end.
    pieces: VecDeque<Piece>,
    /// Sum of the sizes of all pieces whose curve is known, in sub-steps.
    length: f64,
    first: Option<Pose>,
    finished: bool,
    /// Number of poses returned of a dab, or of the lifting of the brush after a path.
    ended: usize,
    /// Number of pieces walked to their end.
    walked: usize,
    /// Number of steps walked in the first of `pieces`; see `Piece::looks`.
    look: u64,
    /// Fraction of a sub-step from the last pose returned to `look`.
    since: f64,
    /// Next pose, if it was computed and not yet returned.
    next: Option<Pose>,
}

impl Path {
    /// A path without samples over cells of `cell_mm`, for a brush of `size_mm`, whose sides move
    /// by a cell or less in a sub-step.
    ///
    /// # Errors
    /// [`StrokeError::Cell`] if `cell_mm` is not a finite number above 0.
    pub fn new(cell_mm: f64, size_mm: f64) -> Result<Self, StrokeError> {
        if !(cell_mm.is_finite() && cell_mm > 0.0) {
            return Err(StrokeError::Cell { cell_mm });
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
            ended: 0,
            walked: 0,
            look: 0,
            since: 0.0,
            next: None,
        })
    }

    /// Appends samples. If one is refused, the path keeps those before it, and others can be
    /// appended after them.
    ///
    /// # Errors
    /// [`StrokeError`] for an impossible sample, and for a path of more than
    /// [`MOST_SUBSTEPS`]; samples are counted from the first of the path.
    ///
    /// # Panics
    /// If the path is finished.
    pub fn push(&mut self, samples: &[Sample]) -> Result<(), StrokeError> {
        assert!(!self.finished, "a path takes no samples after it is finished");
        samples.iter().try_for_each(|sample| self.push_one(sample))
    }

    fn push_one(&mut self, sample: &Sample) -> Result<(), StrokeError> {
        self.check(sample)?;
        let pose = sample.pose(self.cell_mm);
        let [before, from, to] = self.recent;
        let known =
            from.zip(to).map(|(from, to)| Piece::new((before, from), (to, Some(pose)), self.reach));
        let guessed = to.map(|to| Piece::new((from, to), (pose, None), self.reach));
        let size = |piece: &Option<Piece>| piece.as_ref().map_or(0.0, Piece::size);
        let substeps = self.length + size(&known) + size(&guessed);
        if substeps > MOST_SUBSTEPS as f64 {
            return Err(StrokeError::TooLong { substeps });
        }
        self.first = if self.samples == 0 { Some(pose) } else { self.first };
        self.samples += 1;
        self.seconds = sample.seconds;
        self.recent = [from, to, Some(pose)];
        self.add(known);
        Ok(())
    }

    fn add(&mut self, piece: Option<Piece>) {
        self.length += piece.as_ref().map_or(0.0, Piece::size);
        self.pieces.extend(piece);
    }

    /// Ends the path at the last sample; its last poses can be computed now.
    pub fn finish(&mut self) {
        let [before, from, to] = self.recent;
        if !self.finished {
            self.add(
                from.zip(to).map(|(from, to)| Piece::new((before, from), (to, None), self.reach)),
            );
        }
        self.finished = true;
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
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

    /// Upper bound of the number of poses that can be computed now; 0 if and only if there is
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
        1 + lifting + (sizes - looked + self.since).max(0.0) as usize
    }

    /// The next pose, if it is known, without removing it.
    pub fn peek(&mut self) -> Option<&Pose> {
        if self.next.is_none() {
            self.next = self.walk();
        }
        self.next.as_ref()
    }

    /// Removes and returns the first pose together with a copy of the second, once both are
    /// known: a head is set down at the first in the direction of the second. Call it
    /// before any pose is removed.
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
        if let Some(first) = self.first.take() {
            return Some(first);
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

    /// Number of sub-steps in which the brush is lifted at the last sample, and number of all poses
    /// there. A path arrives pressed and is only lifted; a dab is pressed down first, in as many
    /// sub-steps.
    fn pressing(&self) -> (usize, usize) {
        let pressure = self.recent[2].map_or(0.0, |last| last.pressure);
        let lifting = (pressure / (LIFT * most_pressure(self.reach))).ceil() as usize;
        (lifting, if self.length == 0.0 { 2 * lifting + 1 } else { lifting + 1 })
    }

    /// The next pose at the last sample.
    fn pressed(&mut self) -> Option<Pose> {
        let last = self.recent[2].filter(|_| self.finished)?;
        let (lifting, poses) = self.pressing();
        let left = (poses - 1).checked_sub(self.ended)?;
        self.ended += 1;
        let share = 1.0 - lifting.abs_diff(left) as f64 / lifting.max(1) as f64;
        Some(Pose { pressure: share * last.pressure, ..last })
    }

    /// Refuses impossible samples.
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

impl Iterator for Path {
    type Item = Pose;

    /// The next pose; `None` while it is not known, and after the last.
    fn next(&mut self) -> Option<Pose> {
        self.peek();
        self.next.take()
    }
}

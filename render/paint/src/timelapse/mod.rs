//! Timelapse of a script: its canvas at chosen moments, as GIF, animated PNG, or a folder of
//! frames.
//!
//! A [`Timelapse`] plans the moments. [`Timelapse::play`] plays the script and hands you the
//! frames. [`Timelapse::write`] keeps them in a folder and joins them to one file. If you interrupt
//! it, it continues from this folder. One script always gives the same frames.

#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::PathBuf;

use documents::file::{FileError, write_whole};
use documents::hint::Explain;
use graphics::export::{
    AnimationFormat, ExportError, Frame, FrameError, FrameRate, Sequence, SequenceError,
    SequenceSettings, reduced, reduced_size, srgb8,
};
use sha2::{Digest, Sha256};

use crate::file::PaintingFileError;
use crate::painting::PaintingError;
use crate::pose::Sample;
use crate::session::PaintingSession;
use crate::strokes::{Action, ScriptError, Squeeze, Stroke, StrokeScript, SurfaceId};

/// Most frames of a timelapse.
const MOST_FRAMES: usize = 100_000;

/// How often you take a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Interval {
    /// After every so many actions that change the canvas, from 1.
    Actions(usize),
    /// After every so many seconds of painting, 0.01 to 86,400. We count the time of strokes on the
    /// canvas, without pauses and without mixing on the palette.
    Seconds(f64),
    /// This many frames in all, 2 and up. We spread them evenly over the painting time, or over the
    /// actions if the strokes did not take time. You get fewer frames if several moments fall
    /// between the same two samples.
    Frames(usize),
}

/// Settings of a timelapse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimelapseSettings {
    /// How often a frame is taken. The first frame shows the start, the last one the end.
    pub interval: Interval,
    /// Longest side of a frame in pixels, 16 to 16,384. If the canvas has fewer cells, a frame has
    /// one pixel per cell.
    pub longest_px: usize,
    /// Whether you see passages that were undone later. We paint them in any case.
    pub with_undone: bool,
}

impl Default for TimelapseSettings {
    fn default() -> Self {
        Self { interval: Interval::Frames(250), longest_px: 960, with_undone: false }
    }
}

impl TimelapseSettings {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`TimelapseError::Setting`], [`TimelapseError::Frames`].
    pub fn check(&self) -> Result<(), TimelapseError> {
        let setting = |name, wanted, found| Err(TimelapseError::Setting { name, wanted, found });
        match self.interval {
            Interval::Actions(0) => return setting("every", "1 action and up", 0.0),
            Interval::Seconds(found) if !(0.01..=86_400.0).contains(&found) => {
                return setting("seconds", "0.01 to 86400 s", found);
            }
            Interval::Frames(found @ 0..=1) => {
                return setting("count", "2 frames and up", found as f64);
            }
            Interval::Frames(found) if found > MOST_FRAMES => {
                return Err(TimelapseError::Frames { most: MOST_FRAMES, found });
            }
            _ => {}
        }
        match self.longest_px {
            16..=16_384 => Ok(()),
            found => setting("size", "16 to 16384 px", found as f64),
        }
    }
}

/// Returns which actions change the canvas and are shown: all, or those that are done at the end.
/// An action that was undone and then done again counts as done.
fn shown(actions: &[Action], with_undone: bool) -> Vec<bool> {
    let changes = actions.iter().map(changes_canvas);
    if with_undone {
        return changes.collect();
    }
    let mut left = vec![false; actions.len()];
    for index in done_at_end(actions) {
        left[index] = true;
    }
    changes.zip(left).map(|(changes, left)| changes && left).collect()
}

/// Indices of the actions of the history that are done at the end of a script.
fn done_at_end(actions: &[Action]) -> Vec<usize> {
    let mut done = Vec::new();
    let mut undone = Vec::new();
    for (index, action) in actions.iter().enumerate() {
        match action {
            Action::Undo {} => undone.extend(done.pop()),
            Action::Redo {} => done.extend(undone.pop()),
            // These are not actions of the history.
            Action::Load(_) | Action::Wipe { .. } | Action::Wash { .. } | Action::Save { .. } => {}
            _ => {
                done.push(index);
                undone.clear();
            }
        }
    }
    done
}

/// Whether an action can change what the canvas shows.
fn changes_canvas(action: &Action) -> bool {
    match action {
        Action::Stroke(Stroke { on, .. })
        | Action::Cut(Stroke { on, .. })
        | Action::Squeeze(Squeeze { on, .. })
        | Action::Scrape { on } => *on == SurfaceId::Canvas,
        Action::Load(_)
        | Action::Wipe { .. }
        | Action::Wash { .. }
        | Action::Palette(_)
        | Action::Stiffness { .. }
        | Action::Save { .. } => false,
        _ => true,
    }
}

/// A moment of a script: before the action `action`, or, if this is a stroke, within it after
/// `samples` of its samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Moment {
    action: usize,
    samples: usize,
}

/// Moments of all frames, rising: the start, those between, and the end.
fn moments(actions: &[Action], settings: &TimelapseSettings) -> Vec<Moment> {
    let shown = shown(actions, settings.with_undone);
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

fn after(index: usize) -> Moment {
    Moment { action: index + 1, samples: 0 }
}

/// Multiples of `every` seconds below `seconds`.
fn times(every: f64, seconds: f64) -> Vec<f64> {
    // One more than fits is enough to be refused.
    let count = (seconds / every).ceil().min(MOST_FRAMES as f64 + 1.0) as usize;
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

/// Seconds that a stroke takes. 0 for other actions.
fn duration(action: &Action) -> f64 {
    let Some(Stroke { samples, .. }) = action.stroke() else { return 0.0 };
    seconds(samples.last()) - seconds(samples.first())
}

fn seconds(sample: Option<&Sample>) -> f64 {
    sample.map_or(0.0, |sample| sample.seconds)
}

/// A script and the moments of its timelapse. For example, this takes a frame after each action:
///
/// ```
/// use std::ops::ControlFlow;
///
/// use paint::timelapse::{Interval, Timelapse, TimelapseSettings};
/// use paint::{Canvas, PaintingSession};
/// use pigment::PigmentLibrary;
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let canvas = Canvas { width_mm: 20.0, height_mm: 10.0, cell_mm: 0.5, ..Canvas::default() };
/// let script = PaintingSession::on_canvas(&oils, &canvas)?.recording().unwrap().clone();
/// let settings = TimelapseSettings { interval: Interval::Actions(1), ..Default::default() };
/// let timelapse = Timelapse::new(&script, settings)?;
/// let mut session = PaintingSession::on_canvas(&oils, &canvas)?;
/// let mut frames = Vec::new();
/// timelapse.play(&mut session, &[0], |_| ControlFlow::Continue(()), |_, frame| {
///     frames.push(frame);
///     Ok(())
/// })?;
/// assert_eq!((frames[0].width(), frames[0].height()), (40, 20));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Timelapse<'a> {
    script: &'a StrokeScript,
    settings: TimelapseSettings,
    moments: Vec<Moment>,
}

impl<'a> Timelapse<'a> {
    /// Plans the timelapse of `script`.
    ///
    /// # Errors
    /// [`TimelapseError`] for settings out of range, and for too many frames.
    pub fn new(
        script: &'a StrokeScript,
        settings: TimelapseSettings,
    ) -> Result<Self, TimelapseError> {
        settings.check()?;
        let moments = moments(&script.actions, &settings);
        match moments.len() {
            0..=MOST_FRAMES => Ok(Self { script, settings, moments }),
            found => Err(TimelapseError::Frames { most: MOST_FRAMES, found }),
        }
    }

    /// Number of frames, 1 and up.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.moments.len()
    }

    /// Width and height of a frame of the canvas of `session`, in pixels.
    #[must_use]
    pub fn size(&self, session: &PaintingSession) -> (usize, usize) {
        let bounds = session.canvas().bounds();
        reduced_size((bounds.width, bounds.height), self.settings.longest_px)
    }

    /// Plays the script on `session` up to the last of the frames `wanted` (indices from 0,
    /// rising), and calls `put` with each of them. You must pass a session in the state in which
    /// the script begins (see [`StrokeScript::surfaces`]). This does not write the files that the
    /// script saves. Before each action it calls `step` with the share of the script that it has
    /// played, 0 to 1. If you return a break from `step`, the play ends.
    ///
    /// # Errors
    /// [`TimelapseError`] if the script is invalid or the session refuses an action, and the
    /// errors of `put`.
    pub fn play(
        &self,
        session: &mut PaintingSession,
        wanted: &[usize],
        mut step: impl FnMut(f64) -> ControlFlow<()>,
        put: impl FnMut(usize, Frame) -> Result<(), TimelapseError>,
    ) -> Result<ControlFlow<()>, TimelapseError> {
        self.script.resolve(session.canvas().library())?;
        session.add_names_of(&self.script.palette).map_err(ScriptError::from)?;
        let mut taking = Taking { timelapse: self, wanted, put };
        let mut used = BTreeSet::new();
        let weights: Vec<usize> = self.script.actions.iter().map(weight).collect();
        let mut done = 0;
        let all = weights.iter().sum::<usize>().max(1);
        for (index, action) in self.script.actions.iter().enumerate() {
            taking.take_until(session, Moment { action: index, samples: 0 })?;
            if taking.wanted.is_empty() {
                break;
            }
            if step(done as f64 / all as f64).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            // Brushes are added when they are first used.
            let brush = action.brush().filter(|name| used.insert(*name));
            let added = brush.map(|name| session.set_brush(name, &self.script.brushes[name]));
            let failed = |error| {
                let error = Box::new(error);
                TimelapseError::Action { index, kind: action.kind(), error }
            };
            added.unwrap_or(Ok(())).map_err(failed)?;
            match action {
                Action::Save { .. } => {}
                Action::Stroke(stroke) => taking.paint(session, index, stroke)?,
                action => {
                    session.apply(action).map_err(failed)?;
                }
            }
            done += weights[index];
        }
        taking.take_until(session, Moment { action: self.script.actions.len(), samples: 0 })?;
        Ok(ControlFlow::Continue(()))
    }
}

/// Work of playing an action, relative to the work of other actions.
fn weight(action: &Action) -> usize {
    action.stroke().map_or(1, |stroke| stroke.samples.len())
}

/// The frames that are still to be taken.
struct Taking<'a, P> {
    timelapse: &'a Timelapse<'a>,
    /// Indices of these frames, rising.
    wanted: &'a [usize],
    put: P,
}

impl<P: FnMut(usize, Frame) -> Result<(), TimelapseError>> Taking<'_, P> {
    fn next(&self) -> Option<Moment> {
        self.wanted.first().map(|&frame| self.timelapse.moments[frame])
    }

    /// Takes all frames up to `now`, the present moment of `session`.
    fn take_until(
        &mut self,
        session: &mut PaintingSession,
        now: Moment,
    ) -> Result<(), TimelapseError> {
        if self.next().is_none_or(|moment| moment > now) {
            return Ok(());
        }
        let picture = session.canvas_mut().picture()?;
        let frame = srgb8(&reduced(&picture, self.timelapse.settings.longest_px))?;
        while let Some((&index, rest)) = self.wanted.split_first()
            && self.timelapse.moments[index] <= now
        {
            (self.put)(index, frame.clone())?;
            self.wanted = rest;
        }
        Ok(())
    }

    /// Paints the stroke that is action `index`, and takes the frames within it. If we paint it in
    /// pieces, it equals the whole stroke to the bit.
    fn paint(
        &mut self,
        session: &mut PaintingSession,
        index: usize,
        stroke: &Stroke,
    ) -> Result<(), TimelapseError> {
        let failed = |error: PaintingError| {
            let error = Box::new(error);
            TimelapseError::Action { index, kind: "stroke", error }
        };
        session.begin_stroke(stroke.on, &stroke.brush).map_err(failed)?;
        let mut added = 0;
        while let Some(Moment { samples, .. }) = self.next().filter(|next| next.action == index) {
            let samples = samples.min(stroke.samples.len());
            session.extend(&stroke.samples[added..samples]).map_err(failed)?;
            added = samples;
            while session.advance(usize::MAX).map_err(failed)? > 0 {}
            self.take_until(session, Moment { action: index, samples })?;
        }
        session.extend(&stroke.samples[added..]).map_err(failed)?;
        session.end_stroke().map_err(failed)?;
        Ok(())
    }
}

/// Share of the work that is playing the script. The rest is joining the frames.
const PLAYING: f64 = 0.9;

/// Files of a timelapse.
#[derive(Debug, Clone, PartialEq)]
pub struct TimelapseFiles {
    /// The file of all frames and its format. If you pass `None`, you only get frames.
    pub animation: Option<(PathBuf, AnimationFormat)>,
    /// Folder of the frames. After an interrupted run, we keep its frames if script and settings
    /// agree. See [`Sequence`].
    pub frames: PathBuf,
    /// Whether the frames stay once we have written the animation or you end the work. If you kill
    /// the program itself, they stay in any case.
    pub keep_frames: bool,
    /// Frames a second.
    pub rate: FrameRate,
    /// Seconds for which the animation shows its last frame, 0 to 60. At least one frame.
    pub hold_seconds: f64,
}

impl TimelapseFiles {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`TimelapseError::Setting`].
    pub fn check(&self) -> Result<(), TimelapseError> {
        let found = self.hold_seconds;
        if (0.0..=60.0).contains(&found) {
            return Ok(());
        }
        let name = "hold";
        let wanted = "0 to 60 s";
        Err(TimelapseError::Setting { name, wanted, found })
    }
}

impl Timelapse<'_> {
    /// Plays the script on `session` and writes the files. You must pass a session in the state in
    /// which the script begins. This calls `report` with the share that is done, 0 to 1, and
    /// `report` can end the work. If frames stayed from an earlier run, we do not take them again.
    /// You get their number, or `None` if `report` ended the work.
    ///
    /// # Errors
    /// [`TimelapseError`] if the script cannot be played, or a file cannot be written.
    pub fn write(
        &self,
        session: &mut PaintingSession,
        files: &TimelapseFiles,
        mut report: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<usize>, TimelapseError> {
        files.check()?;
        let (width, height) = self.size(session);
        let frames = self.frames();
        let settings = self.digest(session)?;
        let settings = SequenceSettings { settings, frames, width, height };
        let mut sequence = Sequence::open(&files.frames, settings)?;
        let missing = sequence.remaining().to_vec();
        let played = self.play(
            session,
            &missing,
            |done: f64| report(PLAYING * done),
            |index, frame| Ok(sequence.write_frame(index, &frame)?),
        )?;
        if played.is_break() || report(PLAYING).is_break() {
            if !files.keep_frames {
                sequence.remove()?;
            }
            return Ok(None);
        }
        if let Some((path, format)) = &files.animation {
            let held = files.rate.frames_in(files.hold_seconds);
            write_whole(path, &format.encode(&sequence, (files.rate, held))?)?;
            if !files.keep_frames {
                sequence.remove()?;
            }
        }
        Ok(Some(frames - missing.len()))
    }

    /// SHA-256 digest of all that the frames depend on.
    fn digest(&self, session: &mut PaintingSession) -> Result<String, TimelapseError> {
        let mut digest = Sha256::new();
        digest.update(self.script.to_json()?);
        digest.update(format!("{:?}", self.settings));
        digest.update(session.canvas().library().to_json());
        // We compute light in f32, which differs between devices, but not between numbers of threads.
        digest.update(session.canvas().device_name());
        if self.script.start.is_some() {
            digest.update(crate::file::write(&session.canvas_mut().document()?)?);
        }
        Ok(digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
    }
}

/// Why a timelapse cannot be made.
#[derive(Debug, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum TimelapseError {
    /// A setting is out of range.
    #[error("{name} takes {wanted}, found `{found}`")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Range of the setting.
        wanted: &'static str,
        /// Value of the setting.
        found: f64,
    },
    /// The settings ask for too many frames.
    #[error("a timelapse has at most {most} frames, found `{found}`")]
    #[hint("take a frame less often")]
    Frames {
        /// Greatest number of frames.
        most: usize,
        /// Number of frames asked for.
        found: usize,
    },
    /// The script is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The session refuses an action.
    #[error("action {} ({kind})", .index + 1)]
    #[hint(inner)]
    Action {
        /// Index of the action, from 0.
        index: usize,
        /// Key of the action in the file.
        kind: &'static str,
        /// Error of the session.
        #[source]
        error: Box<PaintingError>,
    },
    /// A picture cannot be computed.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// The painting that the script continues cannot be encoded.
    #[error(transparent)]
    Start(#[from] PaintingFileError),
    /// A picture has colours that are no numbers.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The folder of frames cannot be used.
    #[error(transparent)]
    Sequence(#[from] SequenceError),
    /// The animation cannot be encoded.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// The animation cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

#[cfg(test)]
mod kept_tests {
    use super::*;

    const UNDO: Action = Action::Undo {};
    const REDO: Action = Action::Redo {};

    fn dry(fraction: f64) -> Action {
        Action::Dry { fraction }
    }

    #[test]
    fn what_was_undone_for_good_is_not_left() {
        let wash = Action::Wash { brush: "a".to_owned() };
        let actions =
            [dry(0.1), dry(0.2), UNDO, dry(0.3), wash, UNDO, REDO, dry(0.4), dry(0.5), UNDO, UNDO];
        assert_eq!(done_at_end(&actions), [0, 3]);
        let found = shown(&actions, false);
        let wanted = [true, false, false, true];
        assert_eq!(found[..4], wanted);
        assert_eq!(found[4..], [false; 7]);
        assert_eq!(shown(&actions, true).iter().filter(|shown| **shown).count(), 10);
    }

    #[test]
    fn the_palette_is_not_shown() {
        let found = shown(
            &[Action::Scrape { on: SurfaceId::Palette }, Action::Scrape { on: SurfaceId::Canvas }],
            true,
        );
        assert_eq!(found, [false, true]);
    }
}

#[cfg(test)]
mod moments_tests {
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
        let canvas = stroke(SurfaceId::Canvas);
        let palette = stroke(SurfaceId::Palette);
        [wash, canvas.clone(), palette, canvas.clone(), canvas, Action::Undo {}]
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

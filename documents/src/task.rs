//! Long work: how far it is, and how you end it early.

use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use crate::hint::Explain;

/// We store a share of the work as a number of these steps.
const WHOLE: u64 = 1_000_000;

/// Long work. Its code reports the stage and how much is done, and looks whether someone asked it
/// to end. If you started the work, you read [`Self::progress`] from time to time or get a call at
/// each report, and you may cancel.
///
/// All clones are one task, which any thread may use. `Task::default()` calls nobody.
///
/// ```
/// use documents::{Cancelled, Task};
///
/// fn sum(numbers: &[u64], task: &Task) -> Result<u64, Cancelled> {
///     task.stage("adding");
///     let steps = task.steps(numbers.len());
///     let mut sum = 0;
///     for number in numbers {
///         task.check()?;
///         sum += number;
///         steps.step();
///     }
///     Ok(sum)
/// }
///
/// let task = Task::observed(|progress| eprintln!("{progress}"));
/// assert_eq!(sum(&[1, 2, 3], &task), Ok(6));
/// assert_eq!(task.progress().to_string(), "adding, 3 of 3");
///
/// task.cancel();
/// assert!(sum(&[1, 2, 3], &task).is_err());
/// ```
#[derive(Clone, Default)]
pub struct Task {
    shared: Arc<Shared>,
    cancellation: Cancellation,
    part: Part,
}

/// A function that we call at each report.
type Observer = dyn Fn(&Progress) + Send + Sync;

/// State that all clones of a task share.
#[derive(Default)]
struct Shared {
    stage: Mutex<Arc<str>>,
    done: AtomicU64,
    of: AtomicU64,
    observer: Option<Box<Observer>>,
}

/// Which share of the whole work a task covers.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    start: f64,
    length: f64,
}

impl Default for Part {
    fn default() -> Self {
        Self { start: 0.0, length: 1.0 }
    }
}

impl Task {
    /// A task that calls `observer` at each report, on the thread that reports. Several threads may
    /// call it at once.
    #[must_use]
    pub fn observed(observer: impl Fn(&Progress) + Send + Sync + 'static) -> Self {
        let shared = Shared { observer: Some(Box::new(observer)), ..Shared::default() };
        Self { shared: Arc::new(shared), ..Self::default() }
    }

    /// The task with another request to end it. Use this e.g. if several tasks should end together.
    #[must_use]
    pub fn until(self, cancellation: Cancellation) -> Self {
        Self { cancellation, ..self }
    }

    /// A task without an observer, which is cancelled together with this one. Use this for work inside
    /// a stage.
    #[must_use]
    pub fn quiet(&self) -> Self {
        Self::default().until(self.cancellation.clone())
    }

    /// The task of a part of the work: 0 to 1 of the part is `range` of this task.
    ///
    /// ```
    /// let task = documents::Task::default();
    /// task.part(0.2..0.6).share(0.5);
    /// assert_eq!(task.progress().share(), Some(0.4));
    /// ```
    #[must_use]
    pub fn part(&self, range: Range<f64>) -> Self {
        let start = self.part.start + range.start * self.part.length;
        let length = (range.end - range.start) * self.part.length;
        Self { part: Part { start, length }, ..self.clone() }
    }

    /// Reports that a stage begins. This does not change how much is done.
    pub fn stage(&self, text: impl fmt::Display) {
        self.shared.begin(text.to_string().into());
        self.shared.call();
    }

    /// Reports the share of the work that is done, 0 to 1.
    pub fn share(&self, done: f64) {
        let done = self.part.start + self.part.length * done.clamp(0.0, 1.0);
        self.shared.set((done.clamp(0.0, 1.0) * WHOLE as f64).round() as u64, WHOLE);
        self.shared.call();
    }

    /// Reports the share of the work that is done, and ends a function by `?` once the work was asked to
    /// end.
    ///
    /// ```
    /// use documents::{Cancelled, Task};
    ///
    /// fn copy(task: &Task) -> Result<(), Cancelled> {
    ///     task.reach(0.0)?;
    ///     // The file is read.
    ///     task.reach(0.5)?;
    ///     // The copy is written.
    ///     Ok(())
    /// }
    ///
    /// let task = Task::default();
    /// assert_eq!(copy(&task), Ok(()));
    /// assert_eq!(task.progress().share(), Some(0.5));
    /// task.cancel();
    /// assert_eq!(copy(&task), Err(Cancelled));
    /// ```
    ///
    /// # Errors
    /// [`Cancelled`] from the first [`Self::cancel`] on.
    pub fn reach(&self, done: f64) -> Result<(), Cancelled> {
        self.share(done);
        self.check()
    }

    /// Reports that `done` of `of` steps are done.
    pub fn done(&self, done: u64, of: u64) {
        if self.part != Part::default() {
            return self.share(done as f64 / of.max(1) as f64);
        }
        self.shared.set(done, of);
        self.shared.call();
    }

    /// A counter of `of` steps that starts at 0. Threads may share it.
    #[must_use]
    pub fn steps(&self, of: usize) -> Steps {
        self.done(0, of as u64);
        Steps { task: self.clone(), stage: None, done: AtomicU64::new(0), of: of as u64 }
    }

    /// A counter of `of` steps of a stage. Each step reports the stage and the number of steps at once,
    /// and nothing is reported before the first step. Threads may share it.
    ///
    /// ```
    /// let task = documents::Task::default();
    /// let left_out = task.steps_of("mixture left out", 12);
    /// assert_eq!(&*task.progress().stage, "");
    /// left_out.step();
    /// assert_eq!(task.progress().to_string(), "mixture left out, 1 of 12");
    /// ```
    #[must_use]
    pub fn steps_of(&self, stage: impl fmt::Display, of: usize) -> Steps {
        let stage = Some(stage.to_string().into());
        if self.part == Part::default() {
            self.shared.set(0, of as u64);
        }
        Steps { task: self.clone(), stage, done: AtomicU64::new(0), of: of as u64 }
    }

    /// How much of the work is done.
    #[must_use]
    pub fn progress(&self) -> Progress {
        self.shared.progress()
    }

    /// The request to end the work, which outlives the task.
    #[must_use]
    pub fn cancellation(&self) -> &Cancellation {
        &self.cancellation
    }

    /// Asks the work to end soon.
    pub fn cancel(&self) {
        self.cancellation.cancel();
    }

    /// Whether the work was asked to end.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancellation.is_cancelled()
    }

    /// Ends your function by `?` once someone asked the work to end.
    pub fn check(&self) -> Result<(), Cancelled> {
        self.cancellation.check()
    }
}

impl From<Cancellation> for Task {
    fn from(cancellation: Cancellation) -> Self {
        Self::default().until(cancellation)
    }
}

impl fmt::Debug for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut task = f.debug_struct("Task");
        task.field("progress", &self.progress()).field("cancellation", &self.cancellation);
        task.field("is_observed", &self.shared.observer.is_some()).finish_non_exhaustive()
    }
}

impl Shared {
    fn begin(&self, stage: Arc<str>) {
        *self.stage.lock().unwrap_or_else(PoisonError::into_inner) = stage;
    }

    fn set(&self, done: u64, of: u64) {
        self.of.store(of, Ordering::Relaxed);
        self.done.store(done, Ordering::Relaxed);
    }

    fn progress(&self) -> Progress {
        let stage = Arc::clone(&self.stage.lock().unwrap_or_else(PoisonError::into_inner));
        let of = self.of.load(Ordering::Relaxed);
        Progress { stage, done: self.done.load(Ordering::Relaxed).min(of), of }
    }

    fn call(&self) {
        if let Some(observer) = &self.observer {
            observer(&self.progress());
        }
    }
}

/// Counter of the steps of a [`Task`].
#[derive(Debug)]
pub struct Steps {
    task: Task,
    stage: Option<Arc<str>>,
    done: AtomicU64,
    of: u64,
}

impl Steps {
    /// The task that has these steps.
    #[must_use]
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Reports that one more step is done.
    pub fn step(&self) {
        let done = 1 + self.done.fetch_add(1, Ordering::Relaxed);
        if let Some(stage) = &self.stage {
            self.task.shared.begin(Arc::clone(stage));
        }
        if self.task.part != Part::default() {
            return self.task.share(done as f64 / self.of.max(1) as f64);
        }
        // Another thread may have reported a later step meanwhile.
        self.task.shared.done.fetch_max(done, Ordering::Relaxed);
        self.task.shared.call();
    }
}

/// How far a [`Task`] is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Progress {
    /// The stage of the work. This is empty before the first.
    pub stage: Arc<str>,
    /// Steps that are done.
    pub done: u64,
    /// Number of all steps, or 0 while we do not know it.
    pub of: u64,
}

impl Progress {
    /// The share that is done, 0 to 1, if we know it.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        (self.of > 0).then(|| self.done as f64 / self.of as f64)
    }
}

impl fmt::Display for Progress {
    /// Writes the stage and the number of steps, or the share as per cent.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let comma = if self.stage.is_empty() { "" } else { ", " };
        match self.of {
            0 => f.write_str(&self.stage),
            WHOLE => write!(f, "{}{comma}{} %", self.stage, self.done * 100 / WHOLE),
            of => write!(f, "{}{comma}{} of {of}", self.stage, self.done),
        }
    }
}

/// A request to end long work, which that work looks for. Clones share one request, which any thread may
/// make and which stays made.
///
/// ```
/// use documents::Cancellation;
///
/// let cancellation = Cancellation::default();
/// let work = cancellation.clone();
/// assert!(work.check().is_ok());
/// cancellation.cancel();
/// assert!(work.check().is_err());
/// ```
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<AtomicBool>);

impl Cancellation {
    /// Asks the work to end soon.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the work was asked to end.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Ends a function by `?` once the work was asked to end.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

/// The work ended early because someone asked for this. It has no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error, Explain)]
#[error("the work was cancelled before its end")]
#[hint("start it again: nothing of it was kept")]
#[fault(Environment)]
pub struct Cancelled;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_observer_hears_every_report_and_clones_share_progress() {
        let heard = Arc::new(Mutex::new(Vec::new()));
        let notes = Arc::clone(&heard);
        let task = Task::observed(move |progress| notes.lock().unwrap().push(progress.to_string()));
        task.stage("reading");
        let clone = task.clone();
        clone.share(0.25);
        let steps = clone.steps(2);
        steps.step();
        task.stage(format_args!("round {}", 2));
        let wanted =
            ["reading", "reading, 25 %", "reading, 0 of 2", "reading, 1 of 2", "round 2, 1 of 2"];
        assert_eq!(*heard.lock().unwrap(), wanted);
        assert_eq!(task.progress().share(), Some(0.5));
    }

    #[test]
    fn threads_count_steps_together() {
        let task = Task::default();
        assert_eq!(task.progress().share(), None);
        let steps = task.steps(400);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| (0..100).for_each(|_| steps.step()));
            }
        });
        assert_eq!(task.progress().to_string(), "400 of 400");
    }

    #[test]
    fn the_steps_of_a_stage_are_one_report_each() {
        let heard = Arc::new(Mutex::new(Vec::new()));
        let notes = Arc::clone(&heard);
        let task = Task::observed(move |progress| notes.lock().unwrap().push(progress.to_string()));
        task.steps(7).step();
        let steps = task.steps_of("drawing", 2);
        steps.step();
        steps.step();
        task.part(0.5..1.0).steps_of("writing", 2).step();
        let wanted = ["0 of 7", "1 of 7", "drawing, 1 of 2", "drawing, 2 of 2", "writing, 75 %"];
        assert_eq!(*heard.lock().unwrap(), wanted);
    }

    #[test]
    fn parts_of_parts_lie_inside_of_the_whole() {
        let task = Task::default();
        let half = task.part(0.5..1.0);
        half.part(0.5..0.7).done(1, 2);
        assert_eq!(task.progress().share(), Some(0.8));
        half.share(2.0);
        assert_eq!(task.progress().share(), Some(1.0));
    }

    #[test]
    fn a_quiet_task_ends_with_its_own() {
        let task = Task::observed(|progress| assert!(progress.of == 0, "{progress}"));
        let quiet = task.quiet();
        quiet.share(0.5);
        assert_eq!(quiet.check(), Ok(()));
        task.cancel();
        assert_eq!((quiet.check(), task.part(0.0..0.5).is_cancelled()), (Err(Cancelled), true));
        let cancellation = Cancellation::default();
        let until = Task::from(cancellation.clone());
        cancellation.cancel();
        assert!(until.is_cancelled() && Cancelled.hint().is_some());
    }
}

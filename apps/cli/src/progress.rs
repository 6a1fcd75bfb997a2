//! Progress bar and spinner, shown on a terminal after one second.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use documents::{Task, printable};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::console::Console;

/// Time after which a bar or spinner is shown.
const DELAY: Duration = Duration::from_secs(1);
/// Time between two updates of a bar or spinner.
const TICK: Duration = Duration::from_millis(200);

/// Shows `bar` on a terminal after one second. Set the returned flag when the work is done, so that
/// a bar that has not appeared yet stays away.
fn shown_late(bar: &ProgressBar, terminal: bool) -> Arc<AtomicBool> {
    let done = Arc::new(AtomicBool::new(!terminal));
    if terminal {
        let bar = bar.clone();
        let done = Arc::clone(&done);
        std::thread::spawn(move || {
            std::thread::sleep(DELAY);
            if !done.load(Ordering::Relaxed) {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(TICK);
            }
        });
    }
    done
}

/// The style of a bar that counts steps.
fn counting() -> ProgressStyle {
    ProgressStyle::with_template("{msg} [{bar:40}] {pos}/{len} {eta}")
        .expect("the template is constant and valid")
        .progress_chars("=> ")
}

/// Progress bar that counts steps. It appears only on a terminal, after one second, even if no step
/// is done yet.
pub(crate) struct Progress {
    bar: ProgressBar,
    done: Arc<AtomicBool>,
}

impl Progress {
    pub(crate) fn new(steps: usize, label: &'static str, terminal: bool) -> Self {
        let hidden = ProgressDrawTarget::hidden();
        let bar = ProgressBar::with_draw_target(Some(steps as u64), hidden)
            .with_style(counting())
            .with_message(label);
        let done = shown_late(&bar, terminal);
        Self { bar, done }
    }

    /// A task that moves the bar by one for each of its steps, from `before` on.
    pub(crate) fn task(&self, before: usize) -> Task {
        let bar = self.bar.clone();
        Task::observed(move |progress| bar.set_position(before as u64 + progress.done))
    }

    /// A task with any number of steps. The bar shows the share of these steps that is done.
    pub(crate) fn task_of_any_steps(&self) -> Task {
        let bar = self.bar.clone();
        let length = bar.length().unwrap_or(0);
        Task::observed(move |progress| {
            bar.set_position(length * progress.done / progress.of.max(1));
        })
    }

    /// Counts one finished step. May be called from any thread.
    pub(crate) fn step(&self) {
        self.bar.inc(1);
    }

    /// Clears the bar.
    pub(crate) fn done(&self) {
        self.done.store(true, Ordering::Relaxed);
        self.bar.finish_and_clear();
    }
}

/// Does `work`, and shows a spinner if it takes longer than a second. `work` must not print.
pub(crate) fn waited<T>(label: &'static str, console: &Console<'_>, work: impl FnOnce() -> T) -> T {
    let _waiting = Waiting::new(label, console.shows_progress());
    work()
}

/// Spinner for work without countable steps. You see it only on a terminal, after one second.
/// Dropping it clears it.
pub(crate) struct Waiting {
    bar: ProgressBar,
    done: Arc<AtomicBool>,
}

impl Waiting {
    pub(crate) fn new(label: &'static str, terminal: bool) -> Self {
        let style = ProgressStyle::with_template("{spinner} {msg} ({elapsed})")
            .expect("the template is constant and valid");
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden())
            .with_style(style)
            .with_message(label);
        let done = shown_late(&bar, terminal);
        Self { bar, done }
    }

    /// A task that shows its stages after `label` on the screen.
    pub(crate) fn task(&self, label: &'static str) -> Task {
        let bar = self.bar.clone();
        Task::observed(move |progress| {
            bar.set_message(format!("{label}: {}", printable(&progress.stage)));
        })
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
        self.bar.finish_and_clear();
    }
}

/// A spinner for long work, which becomes a bar once the task counts steps. Shown only on a terminal, after one
/// second. Dropping it clears it.
pub(crate) struct Following(Waiting);

impl Following {
    pub(crate) fn new(console: &Console<'_>) -> Self {
        Self(Waiting::new("", console.shows_progress()))
    }

    /// A task that shows its stages and steps.
    pub(crate) fn task(&self) -> Task {
        let bar = self.0.bar.clone();
        Task::observed(move |progress| {
            bar.set_message(printable(&progress.stage).into_owned());
            if progress.of > 0 {
                if bar.length().is_none() {
                    bar.set_style(counting());
                }
                bar.set_length(progress.of);
                bar.set_position(progress.done);
            }
        })
    }

    /// Does work that prints, while nothing else is on the screen.
    pub(crate) fn paused<T>(&self, print: impl FnOnce() -> T) -> T {
        self.0.bar.suspend(print)
    }
}

//! Progress bar and spinner, shown on a terminal after one second.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Progress bar that counts steps. Shown only on a terminal, after one second.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    terminal: bool,
    shown: AtomicBool,
}

impl Progress {
    pub(crate) fn new(steps: usize, label: &'static str, terminal: bool) -> Self {
        let style = ProgressStyle::with_template("{msg} [{bar:40}] {pos}/{len} {eta}")
            .expect("the template is constant and valid")
            .progress_chars("=> ");
        let hidden = ProgressDrawTarget::hidden();
        let bar = ProgressBar::with_draw_target(Some(steps as u64), hidden)
            .with_style(style)
            .with_message(label);
        Self { bar, start: Instant::now(), terminal, shown: AtomicBool::new(false) }
    }

    /// Counts one finished step. May be called from any thread.
    pub(crate) fn step(&self) {
        let late = self.start.elapsed() > Duration::from_secs(1);
        if self.terminal && late && !self.shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.inc(1);
    }

    /// Adds `steps` to the expected total.
    pub(crate) fn expect(&self, steps: usize) {
        self.bar.inc_length(steps as u64);
    }

    /// Clears the bar.
    pub(crate) fn done(&self) {
        self.bar.finish_and_clear();
    }
}

/// Spinner for work without countable steps. Shown only on a terminal, after one second; cleared
/// when dropped.
pub(crate) struct Waiting {
    bar: ProgressBar,
    done: Arc<AtomicBool>,
}

impl Waiting {
    pub(crate) fn new(label: &'static str, terminal: bool) -> Self {
        let bar =
            ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()).with_message(label);
        let done = Arc::new(AtomicBool::new(!terminal));
        if terminal {
            let (bar, done) = (bar.clone(), Arc::clone(&done));
            std::thread::spawn(move || {
                std::thread::sleep(Duration::from_secs(1));
                if !done.load(Ordering::Relaxed) {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                    bar.enable_steady_tick(Duration::from_millis(200));
                }
            });
        }
        Self { bar, done }
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
        self.bar.finish_and_clear();
    }
}

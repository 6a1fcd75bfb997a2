//! Long work off the window's thread: a share of it done, a way to give it up,
//! a result.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use session::FileFailure;

/// Why work has no result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stopped {
    /// It was given up.
    Cancelled,
    /// It could not be done.
    Failed(FileFailure),
}

impl From<FileFailure> for Stopped {
    fn from(failure: FileFailure) -> Self {
        Self::Failed(failure)
    }
}

/// What the work sees of its window.
#[derive(Debug, Clone, Default)]
pub struct Progress(Arc<Shared>);

#[derive(Debug, Default)]
struct Shared {
    /// Thousandths done, and one; 0 is not known.
    thousandths: AtomicU32,
    cancelled: AtomicBool,
}

impl Progress {
    /// Tells the share that is done, 0..1. An error if the work was given up, to
    /// be handed on with `?`.
    ///
    /// # Errors
    /// [`Stopped::Cancelled`].
    pub fn tell(&self, share: f64) -> Result<(), Stopped> {
        let thousandths = 1 + (share.clamp(0.0, 1.0) * 1000.0) as u32;
        self.0.thousandths.store(thousandths, Ordering::Relaxed);
        if self.0.cancelled.load(Ordering::Relaxed) { Err(Stopped::Cancelled) } else { Ok(()) }
    }
}

/// Work under way, seen from the window.
#[derive(Debug)]
pub struct Job<T> {
    label: String,
    progress: Progress,
    result: Receiver<Result<T, Stopped>>,
}

impl<T: Send + 'static> Job<T> {
    /// Starts `work` on a thread of its own; `wake` is called when it ended.
    pub fn start(
        label: impl Into<String>,
        wake: impl FnOnce() + Send + 'static,
        work: impl FnOnce(&Progress) -> Result<T, Stopped> + Send + 'static,
    ) -> Self {
        let (told, result) = channel();
        let progress = Progress::default();
        let seen = progress.clone();
        std::thread::spawn(move || {
            let _waking = OnDrop(Some(wake));
            // Work that panics leaves the channel closed, which `poll` tells.
            let result = work(&seen);
            let _ = told.send(result);
        });
        Self { label: label.into(), progress, result }
    }

    /// What it does, for the painter.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.label
    }

    /// The share done, 0..1, where it is known.
    #[must_use]
    pub fn share(&self) -> Option<f32> {
        let thousandths = self.progress.0.thousandths.load(Ordering::Relaxed);
        thousandths.checked_sub(1).map(|thousandths| thousandths as f32 / 1000.0)
    }

    /// Asks the work to end. Its result may still come, if it was done already.
    pub fn cancel(&self) {
        self.progress.0.cancelled.store(true, Ordering::Relaxed);
    }

    /// The result, once.
    pub fn poll(&mut self) -> Option<Result<T, Stopped>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let what = format!("{}: ended by an error of this program", self.label);
                Some(Err(FileFailure::new(what, "save under another name, and start anew").into()))
            }
        }
    }

    /// Waits for the result.
    ///
    /// # Errors
    /// As the work has it.
    pub fn wait(mut self) -> Result<T, Stopped> {
        match self.result.recv() {
            Ok(result) => result,
            Err(_) => self.poll().unwrap_or(Err(Stopped::Cancelled)),
        }
    }
}

/// Calls what it holds when dropped, also while a panic unwinds.
struct OnDrop<F: FnOnce()>(Option<F>);

impl<F: FnOnce()> Drop for OnDrop<F> {
    fn drop(&mut self) {
        if let Some(wake) = self.0.take() {
            wake();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn a_job_tells_its_share_and_its_result_once() {
        let (go, wait) = channel();
        let (woken, wakes) = channel();
        let wake = move || woken.send(()).unwrap_or_default();
        let mut job = Job::start("counting", wake, move |progress| {
            progress.tell(0.5)?;
            let _ = wait.recv();
            Ok(7)
        });
        while job.share() != Some(0.5) {
            std::thread::yield_now();
        }
        assert!(job.poll().is_none(), "it waits");
        let _ = go.send(());
        wakes.recv().expect("the window is woken");
        assert_eq!(job.poll(), Some(Ok(7)));
    }

    #[test]
    fn a_job_given_up_ends() {
        let job = Job::<()>::start(
            "turning",
            || {},
            |progress| {
                loop {
                    progress.tell(0.1)?;
                }
            },
        );
        job.cancel();
        assert_eq!(job.wait(), Err(Stopped::Cancelled));
    }

    #[test]
    fn a_job_that_panics_is_told_and_wakes_the_window() {
        let (woken, wakes) = channel();
        let wake = move || woken.send(()).unwrap_or_default();
        let mut job = Job::<()>::start("falling", wake, |_| panic!("on purpose"));
        wakes.recv().expect("the window is woken");
        let ended = loop {
            if let Some(ended) = job.poll() {
                break ended;
            }
        };
        assert!(matches!(ended, Err(Stopped::Failed(_))), "{ended:?}");
    }
}

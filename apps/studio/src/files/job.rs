//! Long work on a thread of its own, with progress, cancellation and a result.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use documents::{Cancelled, Task};

use super::problem::Problem;
use session::thread;

/// The reason why a job has no result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum JobError {
    /// The job was cancelled.
    Cancelled,
    /// The task failed with this problem.
    Failed(Problem),
}

impl From<Problem> for JobError {
    fn from(problem: Problem) -> Self {
        Self::Failed(problem)
    }
}

impl From<Cancelled> for JobError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Handle with which the window observes, cancels or awaits a running job.
#[derive(Debug)]
pub(crate) struct Job<T> {
    label: String,
    task: Task,
    result: Receiver<Result<T, JobError>>,
}

impl<T: Send + 'static> Job<T> {
    /// Starts `work` on a new thread; `wake` is called when it ends.
    pub(crate) fn start(
        label: impl Into<String>,
        wake: impl FnOnce() + Send + 'static,
        work: impl FnOnce(&Task) -> Result<T, JobError> + Send + 'static,
    ) -> Self {
        let (sender, result) = channel();
        let task = Task::default();
        let of_work = task.clone();
        thread::start(move || {
            let _waking = OnDrop(Some(wake));
            // If the work panics, the channel is closed, and `poll` reports it.
            let result = work(&of_work);
            let _ = sender.send(result);
        });
        Self { label: label.into(), task, result }
    }

    /// Description of the work for the painter.
    #[must_use]
    pub(crate) fn label(&self) -> &str {
        &self.label
    }

    /// Fraction of the work that is done, 0 to 1, if it is known.
    #[must_use]
    pub(crate) fn fraction(&self) -> Option<f32> {
        self.task.progress().share().map(|share| share as f32)
    }

    /// Cancels the work at its next report. A result may still arrive if it was
    /// already done.
    pub(crate) fn cancel(&self) {
        self.task.cancel();
    }

    /// Takes the result when it is available.
    pub(crate) fn poll(&mut self) -> Option<Result<T, JobError>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let text = format!("{}: ended by an error in this program", self.label);
                let hint = "save under another name and restart the program";
                Some(Err(Problem::new(text, hint).into()))
            }
        }
    }

    /// Waits for the job to end and returns its result.
    ///
    /// # Errors
    /// The error of the work.
    pub(crate) fn wait(mut self) -> Result<T, JobError> {
        // Where there are no threads, it is done here, after those before it.
        loop {
            match self.poll() {
                Some(result) => return result,
                None if thread::next() => {}
                None => break,
            }
        }
        match self.result.recv() {
            Ok(result) => result,
            Err(_) => self.poll().unwrap_or(Err(JobError::Cancelled)),
        }
    }
}

/// Runs `work` on one core, so that the others stay free for painting.
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn on_one_core<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

/// Runs `work`: a page has one core.
#[cfg(target_arch = "wasm32")]
pub(super) fn on_one_core<T>(work: impl FnOnce() -> T) -> T {
    work()
}

/// Calls a function when dropped, also while a panic unwinds.
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
    fn a_job_reports_its_progress_and_its_result_once() {
        let (go, wait) = channel();
        let (woken, wakes) = channel();
        let mut job = Job::start(
            "counting",
            move || woken.send(()).unwrap_or_default(),
            move |task| {
                task.reach(0.5)?;
                let _ = wait.recv();
                Ok(7)
            },
        );
        while job.fraction() != Some(0.5) {
            std::thread::yield_now();
        }
        assert!(job.poll().is_none(), "it waits");
        let _ = go.send(());
        wakes.recv().expect("the window is woken");
        assert_eq!(job.poll(), Some(Ok(7)));
    }

    #[test]
    fn a_cancelled_job_ends() {
        let job = Job::<()>::start(
            "turning",
            || {},
            |task| {
                loop {
                    task.reach(0.1)?;
                }
            },
        );
        job.cancel();
        assert_eq!(job.wait(), Err(JobError::Cancelled));
    }

    #[test]
    fn a_panicking_job_is_reported_and_wakes_the_window() {
        let (woken, wakes) = channel();
        let mut job = Job::<()>::start(
            "falling",
            move || woken.send(()).unwrap_or_default(),
            |_| panic!("on purpose"),
        );
        wakes.recv().expect("the window is woken");
        let ended = loop {
            if let Some(ended) = job.poll() {
                break ended;
            }
        };
        assert!(matches!(ended, Err(JobError::Failed(_))), "{ended:?}");
    }
}

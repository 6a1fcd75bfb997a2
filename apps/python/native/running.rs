//! Long work beside Python: other threads of Python go on, Ctrl-C is obeyed, progress is reported.

use std::cell::OnceCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use documents::{Progress, Task};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Time between two checks for signals.
const LOOK: Duration = Duration::from_millis(50);

const THREAD: &str = "impasto-work";

/// Does `work` on a thread of its own. Meanwhile `progress` is called with the stage at each report, and
/// signals are looked for. After Ctrl-C, or an exception of `progress`, the task is cancelled, and the
/// call raises once its thread has ended.
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Task) -> T + Send + 'static,
) -> PyResult<T> {
    run_with(py, progress, |progress| progress.stage.to_string(), work)
}

/// Does `work` like [`run`], where `progress` is called with the `text` of each report.
pub(crate) fn run_with<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    text: fn(&Progress) -> String,
    work: impl FnOnce(&Task) -> T + Send + 'static,
) -> PyResult<T> {
    let (reports, stages) = channel();
    let (done, result) = channel();
    let task = Task::observed(move |progress| {
        // Nobody listens once the caller has given up.
        let _ = reports.send(text(progress));
    });
    let cancellation = task.cancellation().clone();
    let worker = started(move || {
        let result = catch_unwind(AssertUnwindSafe(|| work(&task)));
        // Nobody listens once the caller has given up.
        let _ = done.send(result);
    })?;
    let waited = wait(py, progress, &stages, result);
    if waited.is_err() {
        cancellation.cancel();
    }
    // If the thread went on computing, it would use processors and files of a program that has
    // moved on.
    let ended = py.detach(|| worker.join());
    ended.map_err(|_| PyRuntimeError::new_err("the thread of the work was lost"))?;
    waited?.map_err(|_| PyRuntimeError::new_err("a defect of impasto: please report it"))
}

/// Starts a thread for `work`. If rayon has only one thread (`RAYON_NUM_THREADS=1`), the new thread
/// does the parallel parts of `work` itself. Otherwise all calls would wait for this one thread of
/// rayon.
fn started(work: impl FnOnce() + Send + 'static) -> std::io::Result<JoinHandle<()>> {
    let thread = || std::thread::Builder::new().name(THREAD.to_owned());
    if rayon::current_num_threads() > 1 {
        return thread().spawn(work);
    }
    let mut worker = None;
    let pool = ThreadPoolBuilder::new().num_threads(1).spawn_handler(|own| {
        worker = Some(thread().spawn(move || own.run())?);
        Ok(())
    });
    // We drop this, and its thread ends with the work.
    pool.build().map_err(std::io::Error::other)?.spawn(work);
    worker.ok_or_else(|| std::io::Error::other("no thread was started"))
}

thread_local! {
    /// Pool of rayon with the calling thread as its only thread, or `None` if it could not be made.
    static OWN: OnceCell<Option<ThreadPool>> = const { OnceCell::new() };
}

/// Does short `work` while other threads of Python run. If rayon has only one thread, the calling
/// thread does the parallel parts of `work` itself, so that it need not wait for other calls.
pub(crate) fn beside<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
    py.detach(|| {
        if rayon::current_num_threads() == 1 && rayon::current_thread_index().is_none() {
            OWN.with(|pool| {
                pool.get_or_init(|| {
                    ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().ok()
                });
            });
        }
        work()
    })
}

fn wait<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    stages: &Receiver<String>,
    result: Receiver<T>,
) -> PyResult<T> {
    // You cannot share a receiver between threads, but you can share a lock on it.
    let result = Mutex::new(result);
    loop {
        let received = py.detach(|| match result.lock() {
            Ok(result) => result.recv_timeout(LOOK),
            Err(_) => Err(RecvTimeoutError::Disconnected),
        });
        py.check_signals()?;
        for stage in stages.try_iter() {
            if let Some(progress) = progress {
                progress.call1((stage,))?;
            }
        }
        match received {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the work ended without a result"));
            }
        }
    }
}

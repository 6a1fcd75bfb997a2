//! Long work beside Python: other threads of Python go on, Ctrl-C is obeyed, progress is told.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Time between two looks for signals.
const LOOK: Duration = Duration::from_millis(50);

/// How work tells its stages, and learns that nobody waits for it any more.
pub(crate) struct Reporter {
    told: Mutex<Sender<String>>,
    given_up: Arc<AtomicBool>,
}

impl Reporter {
    /// Tells a stage. Any thread may call it.
    pub(crate) fn tell(&self, stage: impl ToString) {
        if let Ok(told) = self.told.lock() {
            // Nobody listens once the caller has given up.
            let _ = told.send(stage.to_string());
        }
    }

    /// Whether the caller was interrupted.
    pub(crate) fn given_up(&self) -> bool {
        self.given_up.load(Ordering::Relaxed)
    }
}

/// Does `work` on a thread of its own. Meanwhile `progress` is called with each stage as text, and
/// signals are looked for: after Ctrl-C the call returns at once, and the work ends when it next asks
/// [`Reporter::given_up`], or by itself.
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Reporter) -> T + Send + 'static,
) -> PyResult<T> {
    let given_up = Arc::new(AtomicBool::new(false));
    let (told, stages) = channel();
    let (done, result) = channel();
    let reporter = Reporter { told: Mutex::new(told), given_up: given_up.clone() };
    let worker = std::thread::spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(|| work(&reporter)));
        // Nobody listens once the caller has given up.
        let _ = done.send(result);
    });
    let waited = wait(py, progress, &stages, result);
    if waited.is_err() {
        given_up.store(true, Ordering::Relaxed);
    }
    let result = waited?;
    drop(worker);
    result.map_err(|_| PyRuntimeError::new_err("a defect of impasto: please report it"))
}

fn wait<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    stages: &Receiver<String>,
    result: Receiver<T>,
) -> PyResult<T> {
    // A receiver cannot be shared between threads, a lock on it can.
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

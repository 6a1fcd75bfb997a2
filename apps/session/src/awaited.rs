//! A thread that is waited for when its owner is dropped.

use std::thread::{self, JoinHandle};
use web_time::{Duration, Instant};

/// Longest wait: a file that is being read may take longer, and nobody waits that long for a window to
/// close.
const LONGEST: Duration = Duration::from_secs(5);

/// Time between two looks whether it has ended.
const LOOK: Duration = Duration::from_millis(1);

/// A thread that works on paint. Drivers of graphics devices end with the process and crash if a thread
/// still uses them, so the owner, who has told the thread to end, waits for it.
#[derive(Debug)]
pub(crate) struct Awaited(JoinHandle<()>);

impl Awaited {
    /// Starts the thread.
    pub(crate) fn spawn(work: impl FnOnce() + Send + 'static) -> Self {
        Self(thread::spawn(work))
    }
}

impl Drop for Awaited {
    fn drop(&mut self) {
        let begun = Instant::now();
        while !self.0.is_finished() && begun.elapsed() < LONGEST {
            thread::sleep(LOOK);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Sender, channel};

    use super::*;

    #[test]
    fn the_thread_has_ended_when_its_owner_is_gone() {
        /// Told to end by the end of its sender, like the workers.
        struct Owner {
            _inputs: Sender<()>,
            _thread: Awaited,
        }
        let (inputs, receiver) = channel::<()>();
        let (ended, is_ended) = channel();
        let thread = Awaited::spawn(move || {
            let _ = receiver.recv();
            thread::sleep(Duration::from_millis(50));
            ended.send(()).unwrap();
        });
        drop(Owner { _inputs: inputs, _thread: thread });
        assert!(is_ended.try_recv().is_ok(), "the owner did not wait");
    }
}

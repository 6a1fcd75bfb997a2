//! Something that is made on a thread of its own.

use std::thread::{self, JoinHandle};

/// Something that is made on a thread of its own.
#[derive(Debug)]
pub(super) struct Making<T>(JoinHandle<T>);

impl<T: Send + 'static> Making<T> {
    /// Begins to make it.
    pub(super) fn begin(make: impl FnOnce() -> T + Send + 'static) -> Self {
        Self(thread::spawn(make))
    }

    /// Whether it is made.
    pub(super) fn is_ready(&self) -> bool {
        self.0.is_finished()
    }

    /// Waits for it. None if its thread has panicked.
    pub(super) fn result(self) -> Option<T> {
        self.0.join().ok()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn it_is_ready_when_its_thread_has_ended() {
        let (send, receive) = channel::<u32>();
        let making = Making::begin(move || receive.recv().unwrap() + 1);
        assert!(!making.is_ready(), "it waits");
        send.send(4).unwrap();
        assert_eq!(making.result(), Some(5));
        let failed = Making::<u32>::begin(|| std::panic::resume_unwind(Box::new("a fault")));
        assert_eq!(failed.result(), None);
    }
}

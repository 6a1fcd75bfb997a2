//! Something that is made beside the window.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::background;

/// Something that is made beside the window.
#[derive(Debug)]
pub(super) struct Making<T> {
    receiver: Receiver<T>,
    /// The value, once it was received; the inner `None` if the thread has panicked.
    made: Option<Option<T>>,
}

impl<T: Send + 'static> Making<T> {
    /// Begins to make it.
    pub(super) fn begin(make: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, receiver) = channel();
        background::start(move || {
            let _ = sender.send(make());
        });
        Self { receiver, made: None }
    }

    /// Whether it is made.
    pub(super) fn is_ready(&mut self) -> bool {
        if self.made.is_none() {
            self.made = match self.receiver.try_recv() {
                Ok(made) => Some(Some(made)),
                Err(TryRecvError::Empty) => None,
                Err(TryRecvError::Disconnected) => Some(None),
            };
        }
        self.made.is_some()
    }

    /// Waits for it. None if its thread has panicked.
    pub(super) fn result(mut self) -> Option<T> {
        while !self.is_ready() && background::next() {}
        self.made.unwrap_or_else(|| self.receiver.recv().ok())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn it_is_ready_when_its_thread_has_ended() {
        let (send, receive) = channel::<u32>();
        let mut making = Making::begin(move || receive.recv().unwrap() + 1);
        assert!(!making.is_ready(), "it waits");
        send.send(4).unwrap();
        assert_eq!(making.result(), Some(5));
        let failed = Making::<u32>::begin(|| std::panic::resume_unwind(Box::new("a fault")));
        assert_eq!(failed.result(), None);
    }
}

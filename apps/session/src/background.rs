//! Work beside the window: on a thread of its own, or in a page, which has none, between its frames.

/// Starts `work`: on a thread, or in a page when [`next`] is called.
pub fn start(work: impl FnOnce() + Send + 'static) {
    #[cfg(target_arch = "wasm32")]
    waiting::WAITING.with_borrow_mut(|waiting| waiting.push_back(Box::new(work)));
    #[cfg(not(target_arch = "wasm32"))]
    std::thread::spawn(work);
}

/// In a page does the work that waits longest. Returns whether there was any; where there are
/// threads, there never is.
pub fn next() -> bool {
    #[cfg(target_arch = "wasm32")]
    if let Some(work) = waiting::WAITING.with_borrow_mut(std::collections::VecDeque::pop_front) {
        work();
        return true;
    }
    false
}

#[cfg(target_arch = "wasm32")]
mod waiting {
    use std::cell::RefCell;
    use std::collections::VecDeque;

    type Work = Box<dyn FnOnce()>;

    thread_local! {
        pub(super) static WAITING: RefCell<VecDeque<Work>> = const { RefCell::new(VecDeque::new()) };
    }
}

//! A message that is shown over the window.

use web_time::{Duration, Instant};

use super::problem::Problem;

/// Time for which a message that needs no answer is shown.
const SHOWN: Duration = Duration::from_secs(5);

/// A sentence for the status line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatusNote {
    /// One sentence, beginning with a small letter.
    pub text: String,
    /// Suggests what to do.
    pub hint: Option<String>,
}

/// A message over the window.
#[derive(Debug, Clone)]
pub(super) struct Notice {
    /// The message, beginning with a capital letter.
    pub(super) text: String,
    /// Suggests what to do.
    pub(super) hint: Option<String>,
    /// When the message disappears; `None` if it stays until it is closed.
    pub(super) until: Option<Instant>,
}

impl Notice {
    /// A message about something that was done. It disappears after [`SHOWN`].
    pub(super) fn done(text: &str) -> Self {
        Self { text: capitalized(text), hint: None, until: Some(Instant::now() + SHOWN) }
    }

    /// A message about something that failed. It stays until the painter closes it.
    pub(super) fn problem(problem: Problem) -> Self {
        Self { text: capitalized(&problem.text), hint: problem.hint, until: None }
    }
}

/// `text` with a capital first letter.
fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

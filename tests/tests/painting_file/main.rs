//! Paintings as files: nothing is lost, and nothing that is not a painting is
//! taken for one.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod hostile;
mod made_up;
mod round_trip;

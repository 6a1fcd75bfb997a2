//! Paintings as files: nothing is lost, and nothing that is not a painting is
//! taken for one.

mod hostile;
mod made_up;
mod round_trip;

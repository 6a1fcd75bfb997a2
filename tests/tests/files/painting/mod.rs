//! Painting files: a painting is read back unchanged, and any other file is refused.

mod hostile;
mod made_up;
mod round_trip;

//! The history: what was done, and going back.

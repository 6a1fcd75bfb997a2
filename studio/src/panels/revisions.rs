//! Revisions of the painting, and recovery.

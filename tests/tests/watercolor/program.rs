//! `impasto watercolor`.

//! Tests of a painting at work.

mod bench;
mod masks;
mod threads;
mod tools;

//! A painting at work.

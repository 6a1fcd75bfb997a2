//! Tests of painting_file.

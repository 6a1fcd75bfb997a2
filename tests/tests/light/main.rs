//! Tests of light.

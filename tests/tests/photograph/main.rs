//! Tests of photograph.

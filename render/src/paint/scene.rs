//! A painting under a light, as numbers for the backends.

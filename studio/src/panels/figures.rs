//! Latency and speed, on demand.

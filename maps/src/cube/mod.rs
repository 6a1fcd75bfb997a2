//! Spectral scans, read in blocks of rows.

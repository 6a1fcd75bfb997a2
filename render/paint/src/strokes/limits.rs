//! How much a script may hold.

/// The most cells a script's canvas may have: 8192 x 8192. Painting takes about
/// 90 bytes a cell, and 36 more for each dry layer: 6 GB and up.
pub const MAX_CELLS: u64 = 1 << 26;

/// The most samples of all strokes together: an hour and a half of a pen that
/// tells 200 a second is a tenth of it. They take 560 MB.
pub const MAX_SAMPLES: usize = 10_000_000;

/// The most actions.
pub const MAX_ACTIONS: usize = 1_000_000;

/// The most entries of an object of names: brushes, or parts of a recipe.
pub const MAX_NAMES: usize = 1024;

/// The longest file that is read, in bytes: 128 MiB. Its samples take at most
/// six times as much in memory.
pub const MAX_FILE_BYTES: usize = 128 << 20;

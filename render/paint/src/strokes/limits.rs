//! Limits on the size of a script, so that a hostile file cannot exhaust memory.

/// Most cells of a canvas: 8192 x 8192. Painting takes about 90 bytes per cell, plus 36
/// per dry layer: 6 GB and up.
pub const MAX_CELLS: u64 = 1 << 26;

/// Most samples of all strokes together, which take 560 MB. A pen that reports 200
/// samples a second fills a tenth of it in an hour and a half.
pub const MAX_SAMPLES: usize = 10_000_000;

/// Most actions of a script.
pub const MAX_ACTIONS: usize = 1_000_000;

/// Most points of the polygon of a mask.
pub const MAX_MASK_POINTS: usize = 10_000;

/// Most entries of a JSON object with free names: brushes, or parts of a recipe.
pub const MAX_NAMES: usize = 1024;

/// Longest file that is read, in bytes: 128 MiB. Its samples take at most six times
/// that in memory.
pub const MAX_FILE_BYTES: usize = 128 << 20;

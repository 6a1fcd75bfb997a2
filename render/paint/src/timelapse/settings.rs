//! Settings of a timelapse.

use super::error::TimelapseError;

/// Most frames of a timelapse.
pub(super) const MOST_FRAMES: usize = 100_000;

/// How often a frame is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Interval {
    /// After every so many actions that change the canvas, from 1.
    Actions(usize),
    /// After every so many seconds of painting: the time that strokes on the canvas took, without
    /// pauses and without mixing on the palette. 0.01 to 86,400.
    Seconds(f64),
    /// So many frames in all, 2 and up, spread evenly over the painting time; over the actions if
    /// no stroke took time. There are fewer if so many moments differ by no sample.
    Frames(usize),
}

/// Settings of a timelapse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimelapseSettings {
    /// How often a frame is taken. The first frame shows the start, the last one the end.
    pub interval: Interval,
    /// Longest side of a frame in pixels, 16 to 16,384; a canvas with fewer cells keeps them.
    pub longest_px: usize,
    /// Whether passages that were undone later are shown. They are painted in any case.
    pub with_undone: bool,
}

impl Default for TimelapseSettings {
    fn default() -> Self {
        Self { interval: Interval::Frames(250), longest_px: 960, with_undone: false }
    }
}

impl TimelapseSettings {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`TimelapseError::Setting`], [`TimelapseError::Frames`].
    pub fn check(&self) -> Result<(), TimelapseError> {
        let setting = |name, wanted, found| Err(TimelapseError::Setting { name, wanted, found });
        match self.interval {
            Interval::Actions(0) => return setting("every", "1 action and up", 0.0),
            Interval::Seconds(found) if !(0.01..=86_400.0).contains(&found) => {
                return setting("seconds", "0.01 to 86400 s", found);
            }
            Interval::Frames(found @ 0..=1) => {
                return setting("count", "2 frames and up", found as f64);
            }
            Interval::Frames(found) if found > MOST_FRAMES => {
                return Err(TimelapseError::Frames { most: MOST_FRAMES, found });
            }
            _ => {}
        }
        match self.longest_px {
            16..=16_384 => Ok(()),
            found => setting("size", "16 to 16384 px", found as f64),
        }
    }
}

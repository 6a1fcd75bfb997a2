//! Scripts of paint volumes: the file format `paint-volumes`, version 1.
//!
//! A script is TOML with a subject, pigments, settings and what you do to the subject in time. You
//! can write it by hand, by a program, or record it in a session. Places are in the unit of the
//! subject, times in seconds.
//!
//! ```toml
//! format = "paint-volumes"
//! version = 1
//! title = "A jug wakes up"
//! subject = "shape:still-life"      # or a model or photograph beside the script
//! unit_mm = 100.0                   # left out: the longest side is 200 mm
//! seconds = 6.0
//! preset = "washed"                 # left out: sketch
//! library = "mine.pigments.json"    # of the palette, beside the script
//! illuminant = "A"                  # light on pigments, or lamp = "lamp.csv"; left out: D65
//!
//! [palette]                         # left out: colours are the subject's own
//! B = "Ultramarine"
//! Y = "Chrome Yellow"
//!
//! [ground]                          # under pigments, as of scripts of strokes; left out: a panel
//! kind = "linen"                    # linen, paper or panel
//! reflectance = 0.85                # left out: the white of the library
//!
//! [grid]                            # short for [settings.grid]
//! cell = 0.083
//!
//! [settings.motion]                 # any group of the settings
//! kick = 0.5
//!
//! [camera]                          # degrees, or `[[camera.keyframe]]` as of camera paths
//! azimuth_deg = 30.0
//! elevation_deg = 20.0
//! turntable = 60                    # frames of one turn; left out: it stands still
//!
//! [[region]]                        # left out: one region with the settings' own drawing
//! name = "glow"
//! inside = "own-colours"
//! shells = [1.0, 0.93, 0.86]
//! tint = [0.0, 0.35, 0.7, 1.0]
//! stain = "#e8d8b8"                 # colour of the drawing inside, below its own colours
//!
//! [[pour]]                          # `at` a place, or `picked` of the first picture, or a `path`
//! path = [[0.0, 0.1, 0.6, 0.3], [2.0, 0.5, 0.6, 0.2]]   # seconds from its start, then place
//! from_s = 0.5
//! for_s = 2.0
//! rate_mm3_s = 40.0                 # or amount_mm3
//! recipe = { B = 2, Y = 1 }
//! region = "glow"
//!
//! [[volume]]                        # a single volume
//! centre = [0.1, 0.6, 0.3]
//! radius = 0.2
//! detail = 4
//! recipe = { B = 1 }
//!
//! [[push]]
//! at = [0.1, 0.6, 0.3]
//! towards = [1.0, 0.0, 0.0]         # a direction
//! radius = 0.2
//! strength = 10.0                   # cells a square second
//! from_s = 3.0
//! for_s = 0.5
//!
//! [[lift]]                          # a sponge that takes paint up
//! picked = [0.42, 0.55]
//! radius = 0.1
//! rate = 0.5                        # of the paint below it, a second
//! from_s = 4.0
//! for_s = 1.0
//!
//! [[keep]]                          # volumes stay in a box, a sphere or above a plane
//! above = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
//!
//! [[split]]                         # the first single volume to volumes of the grid
//! at_s = 4.5
//! volume = 1
//!
//! [[dry]]                           # all paint, or with `at` and `radius` that of a ball
//! at_s = 5.0
//! at = [0.1, 0.6, 0.3]
//! radius = 0.2
//! ```
//!
//! We do not trust scripts. We refuse unknown keys, numbers out of range and files that are too
//! long, and report line and key. The subject must lie beside the script. We write figures with
//! six digits, and times with four decimals.
mod rows;
mod tables;
mod camera;
mod action;
mod file;
mod record;
mod text;
#[cfg(test)]
mod tests;

pub use action::{
    Action, Dry, Lift, NewVolume, PathPoint, Place, Pour, Push, Quantity, Recipe, Split,
};
pub use camera::{CameraTable, KeyframeTable, ScriptCamera};
pub use file::{RegionStyle, Script, Subject, is_light};
pub use record::{Event, Recorder, seconds_of, steps_of};
pub use rows::{
    Ball, MOST_EVENTS, MOST_FRAMES, MOST_SECONDS, Pair, Row, cells_too_small, frames_fit,
    samples_too_many,
};
pub use tables::{
    DryTable, KeepTable, LiftTable, PourTable, PushTable, RegionTable, SplitTable, VolumeTable,
};
pub use text::ScriptError;

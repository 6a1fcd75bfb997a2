//! Shades painted cells: from internal reflectance to the light that reaches the eye,
//! through surface reflection, colour, relief and gloss.
//!
//! A flat painting shows what an instrument measures: under any lamp, a cell whose
//! neighbourhood is level has exactly the colour of its film. Relief multiplies that by
//! ```text
//! f = 1 + ambient (open - 1) + (1 - ambient) (seen (n . l) / l_z - 1)
//! open = 1 / (1 + mean of s^2)     s: slopes up to what stands around, in eight directions
//! seen = 1 / (1 + (r / SOFT)^2)    r: how far what stands towards the lamp overtops it
//! ```
//! where n is the surface normal and l the direction to the lamp. `open` is the share of the
//! sky above horizons of these slopes, `seen` a cast shadow with a soft edge; both are 1 on a
//! level surface, and look [`REACH_MM`] far.
//!
//! Light beyond that of level paint is bounded by Reinhard's (2002) shoulder: with e = f - 1
//! above 0 and m the greatest channel of the colour, the factor is
//! `1 + e / (1 + e (m / (1 - m) + 1 / MOST))`. It starts with f's own slope, stays below
//! 1 + [`MOST`], and leaves m below 1, so that no hue shifts.
//!
//! Gloss is Blinn's (1977) with h = (l + v) / |l + v| and v towards the viewer:
//! `x = strength (1 - ambient) seen max(0, (n . h)^exponent - h_z^exponent)`. The mirrored
//! share `x / (1 + x)` replaces as much of the light from within. A level surface thus has no
//! highlight; what its specular reflection adds to a reading is already in Saunderson's k1.

mod tops;
mod relief_lamp;
mod row;

pub use relief_lamp::{MOST, REACH_MM, ReliefLamp, SOFT, Tap, reach};
pub use row::{TopMaterial, color_row, relieve_row, shade_row};
pub use tops::{MARGIN, Tops};

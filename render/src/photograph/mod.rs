//! From photographs to pigments, and to strokes.
//!
//! [`Photograph`] reads a picture and brings it to a canvas; [`PaintFilm`] tells
//! the colour of any film of a palette over a ground; [`Separation`] finds the film for
//! a colour; [`plan_layer`] plans such films as strokes, coarse to fine; [`Painter`] paints them.

mod source;

mod film;

mod nearest;

mod mixtures;

mod separation;

mod errors;

mod selection;

mod tones;

mod blur;

mod flow;

mod plan;

mod trace;

mod planned;

mod laydown;

mod painter;

pub use errors::{ColourErrors, rebuilt};
pub use film::{Materials, PaintFilm};
pub use flow::Flow;
pub use painter::{LevelReport, Painted, Painter, PainterError};
pub use plan::{Order, Plan, PlanError};
pub use planned::{PlannedStroke, plan_layer};
pub use selection::{ChosenPalette, choose_palette};
pub use separation::{OUT_OF_GAMUT, Separation, SeparationError, SeparationSettings};
pub use source::{Framing, MOST_PIXELS, Photograph, PhotographError, Picture};
pub use tones::black_compensated;

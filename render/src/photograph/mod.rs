//! From photographs to strokes.
//!
//! [`plan_layer`] plans films of paint as strokes, coarse to fine, along the forms;
//! [`Painter`] paints them.

mod tones;

mod plan;

mod trace;

mod planned;

mod laydown;

mod painter;

pub use graphics::orientation::OrientationField;
pub use graphics::picture::{MOST_PIXELS, Photograph, PhotographError, Picture};
pub use paint::separation::{
    ChosenPalette, ColorErrors, FilmMaterials, OUT_OF_GAMUT, PaintFilm, Separation,
    SeparationError, SeparationSettings, choose_palette, rebuild_picture,
};
pub use painter::{LevelReport, Painted, Painter, PainterError};
pub use plan::{Order, Plan, PlanError};
pub use planned::{PlannedStroke, plan_layer};
pub use tones::black_compensated;

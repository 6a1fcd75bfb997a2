//! Photographs painted in strokes, or separated into pigments.
//!
//! ```text
//! photograph -> canvas -> palette, separation -> for each brush: plan -> paint -> compare
//! ```
//!
//! [`StrokePainter`] does all of it. [`plan_layer`] plans the strokes of one brush along the
//! structure of the picture; [`Painter`] paints them, coarse to fine.

mod tones;
mod first_layer;
mod plan;
mod trace;
mod level_target;
mod planned;
mod deposit_curve;
mod painter;
mod stroke_settings;
mod stroke_painter;
mod separated_files;

pub use first_layer::{FirstLayerError, first_layer};
pub use graphics::orientation::OrientationField;
pub use graphics::picture::{MOST_PIXELS, Photograph, PhotographError, Picture};
pub use paint::separation::{
    ChosenPalette, ColorErrors, FilmMaterials, OUT_OF_GAMUT, PaintFilm, Separation,
    SeparationError, SeparationSettings, choose_palette, rebuild_picture,
};
pub use painter::{LevelReport, PaintProgress, Painter, PainterError};
pub use plan::{Order, Plan, PlanError};
pub use planned::{PlannedStroke, plan_layer};
pub use separated_files::SeparatedFiles;
pub use stroke_painter::{PaintedPhotograph, StrokePainter, StrokePainterError};
pub use stroke_settings::{StrokeSettings, StrokeSettingsError};
pub use tones::black_compensated;

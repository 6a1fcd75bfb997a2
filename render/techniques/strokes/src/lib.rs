//! Photographs painted in strokes, or separated into pigments.
//!
//! ```text
//! photograph -> canvas -> palette, separation -> for each brush: plan -> paint -> compare
//! ```
//!
//! Use [`StrokePainter`] for all of this. [`plan_layer`] plans the strokes of one brush along the
//! structure of the picture. [`Painter`] paints them, coarse to fine.

mod settings;
mod planned_strokes;
mod deposit_curve;
mod painter;
mod stroke_painter;
mod first_layer;
mod subject;

pub use first_layer::{FirstLayerError, first_layer};
pub use graphics::orientation::OrientationField;
pub use graphics::picture::{MOST_PIXELS, Photograph, PhotographError, Picture};
pub use paint::separation::{
    ChosenPalette, ColorErrors, FilmMaterials, OUT_OF_GAMUT, PaintFilm, Separation,
    SeparationError, SeparationSettings, choose_palette, rebuild_picture,
};
pub use painter::{LevelReport, Painter, PainterError};
pub use planned_strokes::{PlannedStroke, plan_layer};
pub use settings::{Order, Plan, PlanError, StrokePreset, StrokeSettings, StrokeSettingsError};
pub use stroke_painter::{
    PaintedPhotograph, SeparatedFiles, StrokePainter, StrokePainterError, black_compensated,
};
pub use subject::Subject;

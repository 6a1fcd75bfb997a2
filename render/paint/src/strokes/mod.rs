//! Stroke scripts: the file format `strokes`, version 1.
//!
//! A script is JSON with a canvas, its pigments and brushes, and a list of actions. You write it by
//! hand, by a program, or by recording a session. Units are mm, seconds and degrees.
//!
//! ```json
//! {
//!   "format": "strokes", "version": 1, "title": "A study", "licence": "CC0-1.0",
//!   "canvas": {"width_mm": 100, "height_mm": 80, "cell_mm": 0.1, "ground": {"kind": "linen",
//! "seed": 1}},   "library": "oils.json",
//!   "palette": {"W": "Zinc White", "B": "Prussian Blue"},
//!   "brushes": {"big": {"shape": "flat", "size_mm": 12}},
//!   "actions": [
//!     {"load": {"brush": "big", "recipe": {"W": 3, "B": 1}, "vehicle": 0.2, "amount_mm": 0.3}},
//!     {"stroke": {"brush": "big", "samples": [[0, 10, 10, 0.2], [0.5, 60, 12, 0.6, 10, 0, 45]]}},
//!     {"dry": {"fraction": 1}},
//!     {"save": {"path": "study.exr"}}
//!   ]
//! }
//! ```
//!
//! A sample is `[seconds, x, y, pressure, tilt x, tilt y, twist]`. If you leave out numbers at its
//! end, they are 0. A palette is an object of short names, or a list, of at most eight pigments.
//! Recipes use short names or names of the library. A layer is `"wet"`, the index of a dry layer
//! from 0, the lowest, or `{"id": 3}`. This is its identity, which stays when you move or merge
//! layers. [`Action`] lists all actions.
//!
//! With `"tool": "blend"`, `"scrape"` or `"erase"` a stroke works the wet paint with a clean head
//! ([`StrokeTool`]), and we set the paint on its brush aside. Blending and erasing have a
//! `"strength"` above 0 to 1, scraping has the `"height_mm"` of the blade over the ground:
//! `{"stroke": {"brush": "big", "tool": "erase", "strength": 0.5, "samples": [..]}}`.
//!
//! `{"mask": {"polygon_mm": [[x, y], ..]}}` covers the canvas outside a polygon, as with masking
//! film. [`MaskChange`] lists the other masks.
//!
//! The key `mixing` describes a palette on which you mix, as a second canvas with cells of the same
//! width. Strokes, heaps and scraping act on it with `"on": "palette"`. With `start`, the path of a
//! painting (`.exr`), the script continues that painting: `canvas` and `palette` must agree with
//! it, `medium` and `lighting` are left out. `"table": true` takes the palette's paint and the
//! loads of the brushes from that file as well. Otherwise the palette begins bare and the brushes
//! clean, whatever the file holds.
//!
//! We do not trust scripts. We refuse unknown and repeated keys, numbers out of range and files
//! that are too long, and tell you their location. A script saves only below a folder that you
//! choose.

mod action;
mod table;
mod script;
mod start;

use std::fmt;

use documents::hint::{Explain, Hint};

pub use crate::brush::StrokeTool;
pub use crate::document::Canvas;
pub use crate::layer::LayerRef;
pub use crate::stroke::SampleDecimals;
pub use action::{
    Action, ActionPigments, Load, MaskChange, PaletteSpec, PerSurface, Recipe, Squeeze, Stroke,
    SurfaceId,
};
pub(super) use script::action_line;
pub use script::{BrushSpec, KeptBrush, SideTable, StrokeScript};
pub(super) use start::{PigmentNames, pigment_names};
pub use start::{Resolved, ScriptLibrary, ScriptStartError};
pub(super) use table::{
    ActionLimits, CheckContext, check_brush, check_sample, check_size, check_tool, six_digits,
    unknown_brush,
};

/// Most cells of a canvas: 8192 x 8192. Painting takes about 90 bytes per cell, plus 36
/// per dry layer: 6 GB and up.
pub const MAX_CELLS: u64 = 1 << 26;

/// Most samples of all strokes together, which take 560 MB. For example, a pen that reports 200
/// samples a second fills a tenth of this in an hour and a half.
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

/// Location of a value in a script.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ValueLocation {
    /// Index of the action from 0, and its key. Messages count from 1. `None` for a value of the header.
    pub action: Option<(usize, &'static str)>,
    /// Index of the sample in its stroke, from 0.
    pub sample: Option<usize>,
    /// Path of the field, for example `pressure` or `canvas.cell_mm`.
    pub field: String,
}

impl fmt::Display for ValueLocation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((index, kind)) = self.action {
            write!(formatter, "action {} ({kind}), ", index + 1)?;
        }
        if let Some(index) = self.sample {
            write!(formatter, "sample {index}, ")?;
        }
        formatter.write_str(&self.field)
    }
}

/// A value that is out of range or does not fit the rest of the script.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[error("{location}: {wanted}, found `{found}`")]
#[hint(with = hint.clone())]
pub struct InvalidValue {
    /// Location of the value.
    pub location: ValueLocation,
    /// Description of the values that are allowed.
    pub wanted: String,
    /// The value as text.
    pub found: String,
    /// Advice for correcting the value, if there is any.
    pub hint: Option<Hint>,
}

/// Why a script cannot be read or played.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ScriptError {
    /// The file is longer than [`MAX_FILE_BYTES`].
    #[error("{file}: a script has at most {limit} bytes, found `{bytes}`")]
    #[hint("record fewer samples a second, or several scripts")]
    TooLong {
        /// Name of the file.
        file: String,
        /// Length of the file in bytes.
        bytes: usize,
        /// Longest length in bytes.
        limit: usize,
    },
    /// The file is not UTF-8.
    #[error("{file}: line {line}: no UTF-8, found byte `0x{byte:02x}`")]
    #[hint("save the script as UTF-8")]
    Encoding {
        /// Name of the file.
        file: String,
        /// Line number from 1.
        line: usize,
        /// First byte that is not part of a UTF-8 sequence.
        byte: u8,
    },
    /// The file is not JSON, or its keys and types do not fit a script.
    #[error("{file}: line {line}, column {column}: {reason}")]
    Syntax {
        /// Name of the file.
        file: String,
        /// Line number from 1.
        line: usize,
        /// Column number from 1.
        column: usize,
        /// Message of the JSON parser.
        reason: String,
    },
    /// The file is JSON of another format.
    #[error("{file}: `format` must be \"strokes\", found `{found}`")]
    Format {
        /// Name of the file.
        file: String,
        /// Value of the key `format`.
        found: String,
    },
    /// The script has a version that this program does not know.
    #[error("{file}: this program reads strokes up to version {newest}, found `{found}`")]
    #[hint("a newer impasto may read it")]
    Version {
        /// Name of the file.
        file: String,
        /// Value of the key `version`.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// A value of a file is invalid.
    #[error("{file}: {invalid}")]
    #[hint(inner = invalid)]
    Value {
        /// Name of the file.
        file: String,
        /// The value and its location.
        invalid: Box<InvalidValue>,
    },
    /// A value of a script in memory is invalid.
    #[error(transparent)]
    Invalid(#[from] Box<InvalidValue>),
}

impl ScriptError {
    /// The error of a script that was read from `file`.
    #[must_use]
    pub fn in_file(self, file: &str) -> Self {
        match self {
            Self::Invalid(invalid) => Self::Value { file: file.to_owned(), invalid },
            other => other,
        }
    }
}

#[cfg(test)]
mod tests {
    //! Tests of rounding: writing and reading leave a rounded action unchanged.

    use super::{
        Action, BrushSpec, Canvas, LayerRef, Load, MAX_MASK_POINTS, MaskChange, PaletteSpec,
        Recipe, Squeeze, Stroke, StrokeScript, StrokeTool, SurfaceId,
    };
    use crate::brush::HeadShape;
    use crate::document::{LayerId, Lighting};
    use crate::ground::GroundSpec;
    use crate::optics::Gloss;
    use crate::pose::Sample;

    const ODD: f64 = 0.123_456_789_012;

    fn odd() -> Vec<Action> {
        let sample = Sample {
            seconds: ODD,
            x_mm: -1e-5,
            y_mm: 100.0 / 3.0,
            pressure: 1.0 / 3.0,
            tilt_x_deg: -1e-9,
            tilt_y_deg: 1e-9,
            twist_deg: 359.999_99,
        };
        let gloss = Gloss { strength: 0.06, exponent: 20.123_457 };
        vec![
            Action::Load(Load { brush: brush(), recipe: recipe(), vehicle: ODD, amount_mm: ODD }),
            Action::Stroke(Stroke {
                brush: brush(),
                on: SurfaceId::Palette,
                tool: StrokeTool::Erase { strength: 1.0 / 3.0 },
                samples: vec![sample],
            }),
            Action::Wipe { brush: brush(), keep: 2.0 / 3.0 },
            Action::Dry { fraction: ODD },
            Action::Light(Lighting {
                azimuth_deg: -1e-12,
                elevation_deg: ODD,
                ambient: ODD,
                relief: 1.0 / 7.0,
                ..Lighting::default()
            }),
            Action::Opacity { layer: LayerRef::Dry(3), value: 1000.0 / 7.0 },
            Action::Squeeze(Squeeze {
                on: SurfaceId::Palette,
                recipe: recipe(),
                vehicle: ODD,
                x_mm: -1.0 / 7.0,
                y_mm: 123.456_789,
                volume_mm3: ODD,
            }),
            Action::Scrape { on: SurfaceId::Palette },
            Action::Name { layer: LayerRef::Id(LayerId(2)), name: "r\u{f6}tel \"2\"".to_owned() },
            Action::Visible { layer: LayerRef::Dry(1), value: false },
            Action::Order { layer: LayerRef::Id(LayerId(7)), to: 3 },
            Action::Merge { layer: LayerRef::Id(LayerId(7)), with: Some(LayerRef::Dry(0)) },
            Action::Mask(MaskChange::PolygonMm(vec![[ODD, 1.0], [2.0 / 3.0, -0.0], [5.0, ODD]])),
            Action::Gloss { wet: gloss, dry: gloss },
            Action::Stiffness { value: ODD },
        ]
    }

    /// Debug text of an action, in which -0 differs from 0.
    fn bits(action: &Action) -> String {
        format!("{action:?}")
    }

    fn brush() -> String {
        "big".to_owned()
    }

    fn recipe() -> Recipe {
        Recipe::from([("Zinc White".to_owned(), 1.0 / 3.0), ("B".to_owned(), ODD)])
    }

    #[test]
    fn a_rounded_action_is_read_as_it_was_written() {
        let mut script =
            StrokeScript::new("", "", canvas(), PaletteSpec::from_names(["Zinc White"]));
        script.mixing = Some(canvas());
        let big = BrushSpec { shape: HeadShape::Flat, size_mm: 3.0 };
        script.brushes.insert("big".to_owned(), big);
        script.actions = odd().iter().map(Action::rounded).collect();
        let text = script.to_json().expect("it is sound");
        let read = StrokeScript::from_json("a.json", text.as_bytes()).expect("it is sound");
        assert_eq!(read.actions.len(), script.actions.len());
        for (read, written) in read.actions.iter().zip(&script.actions) {
            assert_eq!(bits(read), bits(written));
            assert_eq!(bits(&read.rounded()), bits(read), "rounding again changes nothing");
        }
        for (odd, written) in odd().iter().zip(&script.actions) {
            let whole = matches!(
                odd,
                Action::Scrape { .. }
                    | Action::Name { .. }
                    | Action::Visible { .. }
                    | Action::Order { .. }
                    | Action::Merge { .. }
            );
            assert_eq!(bits(odd) == bits(written), whole, "{odd:?} is rounded");
        }
    }

    /// A script of these actions on a canvas of 100 x 80 mm.
    fn script(actions: Vec<Action>) -> StrokeScript {
        let canvas = Canvas {
            width_mm: 100.0,
            height_mm: 80.0,
            cell_mm: 0.1,
            ground: GroundSpec::default(),
        };
        let mut script = StrokeScript::new("", "", canvas, PaletteSpec::from_names(["Zinc White"]));
        let big = BrushSpec { shape: HeadShape::Flat, size_mm: 3.0 };
        script.brushes.insert("big".to_owned(), big);
        script.actions = actions;
        script
    }

    fn canvas() -> Canvas {
        Canvas { width_mm: 100.0, height_mm: 80.0, cell_mm: 0.1, ground: GroundSpec::default() }
    }

    #[test]
    fn masks_are_read_and_written_by_their_keys() {
        for (text, change) in [
            (
                r#"{"mask":{"polygon_mm":[[0.0,1.0],[5.0,1.5],[2.0,9.0]]}}"#,
                MaskChange::PolygonMm(vec![[0.0, 1.0], [5.0, 1.5], [2.0, 9.0]]),
            ),
            (r#"{"mask":{"layer":2}}"#, MaskChange::Layer(LayerRef::Dry(2))),
            (r#"{"mask":{"layer":"wet"}}"#, MaskChange::Layer(LayerRef::Wet)),
            (r#"{"mask":{"painted":{}}}"#, MaskChange::Painted {}),
            (r#"{"mask":{"inverse":true}}"#, MaskChange::Inverse(true)),
            (r#"{"mask":{"clear":{}}}"#, MaskChange::Clear {}),
        ] {
            let action = Action::Mask(change);
            assert_eq!(serde_json::from_str::<Action>(text).unwrap(), action);
            assert_eq!(serde_json::to_string(&action).unwrap(), text);
        }
        for text in [
            r#"{"mask":{"polygon":[]}}"#,
            r#"{"mask":{"layer":"dry"}}"#,
            r#"{"mask":{"clear":{"all":1}}}"#,
            r#"{"mask":{"polygon_mm":[[1,2,3]]}}"#,
            r#"{"mask":{"inverse":true,"clear":{}}}"#,
        ] {
            assert!(serde_json::from_str::<Action>(text).is_err(), "{text}");
        }
    }

    #[test]
    fn tools_and_masks_out_of_range_are_refused_with_their_place() {
        for (action, wanted) in [
            (polygon(vec![[0.0, 0.0], [1.0, 1.0]]), "polygon_mm"),
            (polygon(vec![[0.0, 0.0]; MAX_MASK_POINTS + 1]), "polygon_mm"),
            (polygon(vec![[f64::NAN, 0.0]; 3]), "polygon_mm, x"),
            (polygon(vec![[0.0, 1e9]; 3]), "polygon_mm, y"),
            (Action::Mask(MaskChange::Inverse(false)), "inverse"),
            (stroke_as(StrokeTool::Erase { strength: 0.0 }), "strength"),
            (stroke_as(StrokeTool::Blend { strength: 1.5 }), "strength"),
            (stroke_as(StrokeTool::Scrape { height_mm: -0.1 }), "height_mm"),
        ] {
            let error = script(vec![Action::Undo {}, action]).check().unwrap_err().to_string();
            assert!(error.contains(wanted) && error.contains("action 2"), "{wanted}: {error}");
        }
        let sound = [polygon(vec![[0.0, 0.0]; MAX_MASK_POINTS]), stroke_as(StrokeTool::Paint)];
        script(sound.to_vec()).check().unwrap();
    }

    fn stroke_as(tool: StrokeTool) -> Action {
        let samples = vec![Sample::upright(0.0, 1.0, 2.0, 0.5)];
        Action::Stroke(Stroke { brush: "big".to_owned(), on: SurfaceId::Canvas, tool, samples })
    }

    fn polygon(points: Vec<[f64; 2]>) -> Action {
        Action::Mask(MaskChange::PolygonMm(points))
    }
}

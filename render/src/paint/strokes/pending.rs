//! Stand-ins for types of `paint::ground` and `paint::brush`, until those are
//! there: then this file goes, and `script.rs` names the real ones.

/// The description of a ground, `{"kind": "linen", ..}`.
pub type GroundSpec = serde_json::Map<String, serde_json::Value>;

/// The shape of a brush's head.
pub type HeadShape = String;

/// The shapes.
pub(super) const SHAPES: [&str; 8] =
    ["round", "flat", "filbert", "bright", "fan", "rigger", "mop", "knife"];
/// The kinds of ground.
pub(super) const KINDS: [&str; 4] = ["linen", "paper", "panel", "image"];

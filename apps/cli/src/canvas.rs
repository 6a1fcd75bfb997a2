//! Options of the canvas that a picture is painted on.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use paint::ground::GroundKind;

/// Names of the grounds to paint on.
pub(crate) fn grounds() -> impl TypedValueParser<Value = GroundKind> {
    let names = PossibleValuesParser::new(GroundKind::CANVASES.map(GroundKind::name));
    names.try_map(|name| name.parse::<GroundKind>())
}

//! Fields of directions along a surface: lines of least or greatest curvature, smoothed, and arrows
//! made of them.
//!
//! ```text
//! curvature tensors -> evidence --+
//! guides -------------------------+-> smoothing -> lines -> spanning tree -> flow
//! links between tangent planes ---+
//! ```

mod links;
mod settings;
mod evidence;
mod smoothing;
mod within;
mod field;
mod spanning_tree;
mod flow;

#[cfg(test)]
mod tests;

pub use field::DirectionField;
pub use flow::FlowField;
pub use settings::{Along, DirectionFault, DirectionSettings, Guide, Line};

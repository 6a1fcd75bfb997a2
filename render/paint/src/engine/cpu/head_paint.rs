//! The paint on the head of a brush.

use super::columns::Columns;
use crate::layer::Layer;

/// Paint on a head, and the means that its coat follows.
#[derive(Debug, Clone)]
pub(super) struct HeadPaint {
    pub(super) cells: Columns,
    /// Mean volume in quanta of the hair of each cell when paint last flowed along it.
    pub(super) means: Vec<u32>,
}

impl HeadPaint {
    pub(super) fn new(layer: Layer) -> Self {
        let cells = Columns::new(layer);
        Self { means: vec![0; cells.volume().len()], cells }
    }
}

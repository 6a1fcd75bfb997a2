//! The panels. Each shows the state that the worker last reported and queues requests.
mod context;
mod controls;
mod pigments;
pub mod eyedropper;
pub mod wheel;
pub mod swatches;
pub mod history;
pub mod layers;
pub mod light;
pub mod reference;
pub mod tubes;
pub mod brushes;
pub mod pen;
pub mod own_brushes;
pub mod aids;
pub mod figures;
pub mod volumes;

pub use crate::files::FileRequest;
pub use context::{Mode, PanelContext, Request, Tools};
pub(crate) use controls::small_button;

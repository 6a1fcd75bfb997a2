//! The panels. Each shows the state that the worker last reported and queues requests.

mod tools;

mod context;

mod pending_value;

mod controls;

mod pigments;

pub mod eyedropper;

pub mod history;

pub mod layers;

pub mod light;

pub mod reference;

pub mod tubes;

pub mod brushes;

pub mod figures;

pub mod volumes;

pub mod revisions;

pub use crate::files::FileRequest;
pub use context::{PanelContext, Request};
pub use tools::{Mode, Tools};

//! The panels: each shows what the worker last told, and asks for changes.

mod desk;

mod tools;

mod draft;

mod controls;

mod pigments;

pub mod brushes;

pub mod eyedropper;

pub mod history;

pub mod layers;

pub mod light;

pub mod reference;

pub mod tubes;

pub mod figures;

pub mod revisions;

pub use crate::files::FileRequest;
pub use desk::{Desk, Request};
pub use tools::{Mode, Tools};

//! The interactive painting program: you paint by hand with calibrated pigments.
//!
//! The window thread draws and handles input. The worker thread of the crate `session` moves all
//! paint. It takes [`session::Command`]s and answers with [`session::Event`]s. A panel shows the
//! state that the worker last reported and returns commands.
//!
//! Out of scope: measuring and fitting pigments (see the program `impasto`).

pub mod theme;
pub mod language;
mod pace;
mod floating;
pub mod arrangement;
pub mod chart;
pub mod recipe_search;
pub mod keymap;
pub mod wheel_maker;
pub mod pen;
pub mod view;
pub mod files;
pub mod panels;

#[cfg(not(target_arch = "wasm32"))]
pub mod arguments;
pub mod app;

#[cfg(all(feature = "wgpu", not(target_arch = "wasm32")))]
pub mod window;

//! The interactive program: paint by hand with calibrated pigments.
//!
//! The window thread draws and listens; all paint is moved on the thread of
//! the crate `session`, which takes [`session::Command`]s and answers with
//! [`session::Event`]s. Panels are functions from what the worker last told to
//! commands.
//!
//! Out of scope: measuring and fitting pigments (the program `impasto`).

pub mod theme;

pub mod chart;

pub mod matching;

pub mod pen;

pub mod view;

pub mod files;

pub mod panels;

pub mod arguments;

pub mod app;

pub mod window;

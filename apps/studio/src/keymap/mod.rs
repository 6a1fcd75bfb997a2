//! Keys and what they do: standard keys, the painter's changes, and the table in use.
//!
//! An action is named by a text, such as `undo` or `tool-paint`; those of scenes begin with
//! `scene.`. The window installs the tables in use in egui's context, where menus, tooltips and
//! panels look keys up by these names.

mod shortcut;
mod name;
mod table;
mod changes;
mod installed;

pub use changes::{Changes, Keymap, Scope};
pub use installed::{hint, install, installed, keys, text};
pub use name::name_of;
pub use shortcut::Shortcut;
pub use table::{KeyRow, KeyTable};

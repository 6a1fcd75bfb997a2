//! Files that people write, and what every program says about them.
//!
//! | task | call |
//! |---|---|
//! | read a file whole, write it so that nothing is lost | [`file::read`], [`file::write_whole`] |
//! | say what is wrong and the way out | [`hint::Explain`] |
//! | report long work, stop it | [`Task`] |
//! | find the name that was meant | [`did_you_mean`] |
//! | declare settings, presets and their files | [`mod@settings`] |
//! | read TOML and JSON with lines in errors | [`text::Source`] |
//!
//! Every other crate may use this one; it uses none of them.

// The derive macro names this crate, also within it.
extern crate self as documents;

mod counted;
pub mod file;
pub mod hint;
mod name_list;
mod parser_reason;
pub mod settings;
pub mod settings_text;
mod similar;
mod task;
pub mod text;

pub use counted::{counted, counted_as};
pub use name_list::name_list;
pub use parser_reason::{ParserReason, plain_parser_message};
pub use similar::{did_you_mean, similar_names};
pub use task::{Cancellation, Cancelled, Progress, Steps, Task};

//! Files that people write, and what every program says about them.
//!
//! | task | call |
//! |---|---|
//! | read a file whole, write it so that nothing is lost | [`file::read`], [`file::write_whole`] |
//! | check before long work that a file can be written | [`file::Output`] |
//! | say what is wrong and the way out | [`hint::Explain`] |
//! | report long work, stop it | [`Task`] |
//! | find the name that was meant | [`did_you_mean`] |
//! | check a name, show a foreign text | [`name_violation`], [`printable`] |
//! | declare settings, presets and their files | [`mod@settings`] |
//! | read TOML and JSON with lines in errors | [`text::Source`] |
//! | read the options of a job | [`request::request_from_json`] |
//!
//! Every other crate may use this one. It uses none of them.

// The derive macro names this crate, so we need the name here too.
extern crate self as documents;

pub mod hint;
mod task;
mod names;
mod wording;
pub mod file;
pub mod text;
pub mod request;
pub mod settings;

pub use names::{
    LONGEST_NAME, column_width, excerpt, foreign_message, from_spreadsheet_cell, is_hidden,
    name_violation, plain_name, printable, spreadsheet_cell,
};
pub use task::{Cancellation, Cancelled, Progress, Steps, Task};
pub use wording::{
    ParserReason, counted, counted_as, did_you_mean, name_list, plain_parser_message, question,
    similar_names,
};

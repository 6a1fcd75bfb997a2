//! Files that people write, and what every program says about them.
//!
//! | task | call |
//! |---|---|
//! | read a file whole, write it so that nothing is lost | [`file::read`], [`file::write_whole`] |
//! | say what is wrong and the way out | [`hint::Explain`] |
//! | stop long work | [`Cancellation`] |
//! | find the name that was meant | [`did_you_mean`] |
//! | find the line of a value in a TOML text | [`settings_text`] |
//!
//! Every other crate may use this one; it uses none of them.

pub mod hint;
mod cancellation;
mod name_list;
mod counted;
mod similar;
mod parser_reason;
pub mod file;
pub mod settings_text;

pub use cancellation::{Cancellation, Cancelled};
pub use counted::{counted, counted_as};
pub use name_list::name_list;
pub use parser_reason::{ParserReason, plain_parser_message};
pub use similar::{did_you_mean, similar_names};

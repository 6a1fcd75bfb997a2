//! Errors, stages and defects as pages take them.
//!
//! Every error reaches a page as JSON: `message`, `causes`, `hint`, `fault`.

mod refusal;
mod stages;

pub use refusal::{Controls, Result, hint_text, refusal, request, setting};
pub use stages::{begin, stage, task, task_in_percent};

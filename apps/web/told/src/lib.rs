//! Errors and progress of the libraries in the form that the pages take.
//!
//! An error becomes JSON with `message`, `causes`, `hint` and `fault`. Progress goes to a function
//! of the page while a call runs.

mod refusal;
mod stages;

pub use refusal::{Controls, Result, hint_text, refusal, request, setting};
pub use stages::{begin, stage, task, task_in_percent};

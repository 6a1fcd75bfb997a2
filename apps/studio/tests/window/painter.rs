//! A scripted painter at the built program, who does everything that a guide tells of and takes a
//! picture of the screen at every station, for a person to look at.

#[expect(dead_code, reason = "the tests of the panels need more of it")]
#[path = "../panels/harness.rs"]
mod harness;
mod hand;
mod tour;
mod tools;
mod dialogs;
mod walk;

//! What panels tell of pigments, and how one is chosen.

mod catalogue;

mod card;

mod list;

mod exchange;

pub(super) use card::card;
pub(super) use catalogue::{Catalogue, Known};
pub(super) use exchange::{Exchange, Place};
pub(super) use list::PigmentList;

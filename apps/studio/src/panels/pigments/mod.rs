//! Pigment lists and cards that several panels share.

mod catalogue;
mod card;
mod list;
mod exchange;

pub(super) use card::card;
pub(super) use catalogue::{Catalogue, CatalogueCache};
pub(super) use exchange::{Exchange, ExchangeScope};
pub(super) use list::PigmentList;

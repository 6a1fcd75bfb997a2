//! From pixels searched whole to maps of all pixels: groups, survey and its book, presence.

pub(crate) mod groups;
pub(crate) mod prepared;
pub(crate) mod book;
mod palette;
pub(crate) mod survey;
mod strength;
mod presence;
pub(crate) mod open_book;
pub(crate) mod mapper;

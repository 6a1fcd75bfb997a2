//! JSEG: regions of alike colour and texture (Deng and Manjunath, "Unsupervised segmentation of
//! color-texture regions in images and video", IEEE PAMI 23, 2001).
//!
//! ```text
//! colours -> classes -> J of each pixel in four windows -> valleys -> growing -+-> merging
//!                                      ^                                       |
//!                                      +------------- next window -------------+
//! ```

mod quantised;
mod j_values;
mod valleys;
mod growing;
mod merging;
mod scales;

pub(super) use scales::jseg;

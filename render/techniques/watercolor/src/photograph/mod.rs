//! Effects on the flat colours of photographs: washes that run into each other, darks and
//! reserved whites, a ragged margin.
//!
//! They change the wash before the effects of water and paper, on the processor, and are the
//! same for colours and for glazes of pigments.

mod wet;
mod margin;
mod enlarge;
mod photograph_wash;

pub(super) use enlarge::enlarged;
pub(super) use photograph_wash::photograph_wash;

//! A few wavelengths that stand for the whole spectrum under one light.
//!
//! Baxter, Wendt and Lin 2004, section 5.3: painting carries each pigment's K
//! and S at a few wavelengths only, chosen for the light of the studio. Three
//! ways to choose them and to weight them:
//!
//! | method | nodes | weights |
//! |---|---|---|
//! | `gauss` | Gaussian, of the weight (x + y + z) E | the paper's: each node's Gaussian weight, shared out as x, y and z are there |
//! | `moments` | the same | exact for polynomials of degree n - 1 under x E, y E and z E each |
//! | `library` | fitted with the weights to what a pigment library can mix | fitted |

mod gauss;

mod mixtures;

mod fitted;

mod rule;

mod trial;

pub use gauss::GaussRule;
pub use mixtures::MixtureSet;
pub use rule::{Quadrature, QuadratureError, QuadratureFailure};
pub use trial::{QuadratureMethod, QuadratureTrial};

//! A few wavelengths that replace the whole spectrum under one light.
//!
//! Baxter, Wendt and Lin 2004, section 5.3: when you paint, you carry each pigment's K and S at a few
//! wavelengths only, chosen for the light of the studio. There are three methods to choose these
//! wavelengths and their weights:
//!
//! | method | nodes | weights |
//! |---|---|---|
//! | `gauss` | Gaussian nodes of the weight (x + y + z) E | as published: the weight of each node, divided among X, Y and Z in the ratio of x, y and z there |
//! | `moments` | the nodes of `gauss` | exact for polynomials of degree n - 1 under each of x E, y E and z E |
//! | `library` | fitted together with the weights to the mixtures of a pigment library | fitted |
//!
//! [`EffectiveQuadrature`] begins with `library`. It fits nodes and weights, and also K and S of every
//! pigment at the nodes. We use it for painting.

mod rule;
mod effective;
mod fitted;
mod effective_fit;
mod request;

pub use effective::{EffectiveQuadrature, FilmSet};
pub use fitted::{QuadratureMethod, QuadratureTrial};
pub use request::{QuadratureChoice, QuadratureOutcome, QuadratureRequest};
pub use rule::{GaussRule, MixtureSet, Quadrature, QuadratureError, QuadratureFailure};

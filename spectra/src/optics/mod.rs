//! Kubelka-Munk optics of a paint film with a surface.
//!
//! Two diffuse fluxes, no fluorescence. Reflectances are internal (below the surface) unless
//! [`Surface`] calls them measured.

mod layer;
mod infinite_film;
mod two_backings;
mod surface;
mod uneven_film;

pub use infinite_film::{
    absorption_over_scattering, infinite_film, infinite_film_from_ratio, infinite_film_slope,
};
pub use layer::Layer;
pub use surface::{Specular, Surface, SurfaceError};
pub use two_backings::{FilmOptics, OverBacking, film_over_two_backings};
pub use uneven_film::UnevenFilm;

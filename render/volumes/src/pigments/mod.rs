//! Volumes as films of measured pigments: how high each pigment stands at a visible point, and the
//! painting that these films make over a drawing of the scene.

mod lattice;

mod film_profile;

mod wetted;

mod film;

pub use film::{Film, FilmHeights, FilmScale, FilmSum};
pub use film_profile::FilmProfile;
pub use lattice::{SampleLattice, SampledSurface};
pub use wetted::Wetted;

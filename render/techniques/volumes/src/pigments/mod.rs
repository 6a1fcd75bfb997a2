//! Volumes as films of measured pigments: how high each pigment stands at a visible point, and the
//! painting that these films make over a drawing of the scene.
//!
//! ```text
//! volumes, samples of the surface -> films -> heights of pigments at each pixel --+
//!                                                                                 |
//! grey or colour of the scene, ink -> grisaille or own colours, hatching ---------+-> painting, picture
//! ```

mod lattice;
mod film_profile;
mod wetted;
mod film;
mod seen;
mod on_surface;
mod through;
mod counter;
mod glass;
mod materials;
mod toner;
mod tones;
mod grisaille;
mod pencil;
mod own_colors;
mod drawing;
mod painter;
mod view;

pub use counter::{FilmCounter, FilmKind};
pub use drawing::{Drawing, InsidePaint, UnderPainting};
pub use film::{Film, FilmHeights, FilmScale, FilmSum};
pub use film_profile::FilmProfile;
pub use glass::Glass;
pub use grisaille::Grisaille;
pub use lattice::{SampleLattice, SampledSurface};
pub use materials::{FilmMaterial, FilmPaintError};
pub use on_surface::FilmOnSurface;
pub use own_colors::OwnColors;
pub use painter::{FilmPainter, FilmPainterSettings};
pub use pencil::Pencil;
pub use seen::{Facets, SeenPlaces};
pub use through::{Density, FilmThrough, enclosed};
pub use toner::toner;
pub use view::FilmView;
pub use wetted::Wetted;

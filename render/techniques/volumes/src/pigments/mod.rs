//! Volumes as films of measured pigments. You get how high each pigment stands at a visible point,
//! and the painting that these films make over a drawing of the scene.
//!
//! ```text
//! volumes, samples of the surface -> films -> heights of pigments at each pixel --+
//!                                                                                 |
//! grey or colour of the scene, ink -> grisaille or own colours, hatching ---------+-> painting, picture
//! ```
mod film;
mod seen;
mod through;
mod counter;
mod glass;
mod materials;
mod grisaille;
mod drawing;
mod painter;
mod view;

pub use counter::{FilmCounter, FilmKind, FilmOnSurface};
pub use drawing::{Drawing, InsidePaint, UnderPainting};
pub use film::{
    Film, FilmHeights, FilmProfile, FilmScale, FilmSum, SampleLattice, SampledSurface, Wetted,
};
pub use glass::Glass;
pub use grisaille::{Grisaille, OwnColors, Pencil};
pub use materials::{FilmMaterial, FilmPaintError, toner};
pub use painter::{FilmPainter, FilmPainterSettings};
pub use seen::{Facets, SeenPlaces};
pub use through::{Density, FilmThrough, enclosed};
pub use view::FilmView;

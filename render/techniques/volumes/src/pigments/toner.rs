//! A third paint that takes the cast out of greys of white and black.

use paint::document::Slots;
use pigment::PigmentId;

use super::materials::FilmMaterial;

/// CIELAB lightness of the grey that the paint is chosen for.
const MIDDLE: f64 = 50.0;

/// Height of its film in mm.
const GREY_MM: f64 = 0.3;

/// Parts of the paint that are tried for one of black.
const PARTS: [f64; 5] = [0.05, 0.1, 0.2, 0.4, 0.8];

/// Halvings of the range in which the part of black is sought.
const HALVINGS: usize = 20;

/// The paint of the library that makes a middle grey of white and black most neutral, such as an
/// earth against a blue cast; none if no paint improves it.
///
/// # Panics
/// If the library lacks `white` or `black`.
#[must_use]
pub fn toner(material: &FilmMaterial, [white, black]: [PigmentId; 2]) -> Option<PigmentId> {
    let chroma = |third: Option<PigmentId>, parts: f64| {
        let mut slots = Slots::default();
        (slots[0], slots[1], slots[2]) = (Some(white), Some(black), third);
        let film = material.film(&slots);
        let lab = |dark: f64| {
            let third = dark * parts;
            let whole = (1.0 + dark + third) / GREY_MM;
            film.lab(&[1.0, dark, third, 0.0, 0.0, 0.0, 0.0, 0.0].map(|part| part / whole))
        };
        let mut range = [0.0, 1.0];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (range[0] + range[1]);
            range[usize::from(lab(middle).lightness < MIDDLE)] = middle;
        }
        let found = lab(range[0]);
        found.a.hypot(found.b)
    };
    let library = &material.library;
    let others = library.ids().filter(|id| library[*id].identified && ![white, black].contains(id));
    let tried = others.flat_map(|id| PARTS.map(|parts| (chroma(Some(id), parts), id)));
    let best = tried.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 < chroma(None, 0.0)).then_some(best.1)
}

//! A painting to be begun: which pigments stand on the palette, what is painted
//! on.

use calibrate::evaluate::{Viewing, lab};
use calibrate::library::PigmentLibrary;
use render::layer::SLOTS;
use render::paint::document::Slots;
use render::paint::strokes::{Canvas, Palette, Strokes};
use spectra::color::delta_e_ciede2000;
use spectra::{Illuminant, Observer};

/// The oils of Van Gogh's palette, which ship with the program.
#[must_use]
pub fn built_in_library() -> PigmentLibrary {
    const OILS: &str = include_str!("../../../measurements/van-gogh-oils.pigments.json");
    PigmentLibrary::from_json("van-gogh-oils.pigments.json", OILS).expect("a test reads it")
}

/// A script without actions for `canvas`, with the pigments of `slots`.
#[must_use]
pub fn script(title: &str, canvas: Canvas, library: &PigmentLibrary, slots: &Slots) -> Strokes {
    let names = slots.iter().flatten().filter_map(|&index| library.pigments.get(index));
    let palette = Palette::of(names.map(|pigment| pigment.name.as_str()));
    let mut script = Strokes::new(title, "", canvas, palette);
    script.library = Some(library.title.clone());
    script
}

/// Up to eight pigments for a palette: the white (the reference, else the
/// lightest), then always the one whose colour is farthest from those taken
/// (CIEDE2000 under D65, in films that hide). Pigments whose scattering is not
/// known or was guessed are taken when there are no others.
#[must_use]
pub fn varied_slots(library: &PigmentLibrary) -> Slots {
    let viewing = Viewing { illuminant: Illuminant::d65(), observer: Observer::default() };
    let Ok(weights) = viewing.weights(library.grid) else {
        return std::array::from_fn(|slot| (slot < library.pigments.len()).then_some(slot));
    };
    let colours: Vec<_> = (0..library.pigments.len())
        .map(|index| {
            let mixture = library.mix(&[(index, 1.0)]).ok()?;
            Some(lab(&weights, &mixture.hiding(library.saunderson)))
        })
        .collect();
    let sound = |index: &usize| {
        let pigment = &library.pigments[*index];
        colours[*index].is_some() && pigment.identified && !pigment.guessed
    };
    let (first, second): (Vec<usize>, Vec<usize>) =
        (0..library.pigments.len()).partition(|index| sound(index));
    let mut taken: Vec<usize> = Vec::new();
    for mut pool in [first, second] {
        while taken.len() < SLOTS && !pool.is_empty() {
            let distance = |index: usize| {
                let Some(own) = colours[index] else { return 0.0 };
                let is_white = Some(&library.pigments[index].name) == library.reference.as_ref();
                let others = taken.iter().filter_map(|&other| colours[other]);
                let nearest = others.map(|other| delta_e_ciede2000(own, other));
                match nearest.reduce(f64::min) {
                    Some(nearest) => nearest,
                    None => own.lightness + if is_white { 1000.0 } else { 0.0 },
                }
            };
            let farthest = (0..pool.len())
                .max_by(|&a, &b| distance(pool[a]).total_cmp(&distance(pool[b])).then(b.cmp(&a)));
            let Some(place) = farthest else { break };
            taken.push(pool.remove(place));
        }
    }
    std::array::from_fn(|slot| taken.get(slot).copied())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_palette_begins_with_white_and_has_each_pigment_once() {
        let library = built_in_library();
        let slots = varied_slots(&library);
        let names: Vec<_> =
            slots.iter().flatten().map(|&index| library.pigments[index].name.as_str()).collect();
        assert_eq!(Some(names[0]), library.reference.as_deref());
        assert_eq!(names.len(), SLOTS, "{names:?}");
        let mut once = names.clone();
        once.sort_unstable();
        once.dedup();
        assert_eq!(once.len(), SLOTS, "{names:?}");
    }

    #[test]
    fn a_small_library_gives_a_small_palette_of_what_is_known_first() {
        let mut library = built_in_library();
        library.pigments.truncate(3);
        library.pigments[0].guessed = true;
        let slots = varied_slots(&library);
        assert_eq!(slots.iter().flatten().count(), 3);
        assert_eq!(slots[2], Some(0), "the guessed one comes last: {slots:?}");
    }
}

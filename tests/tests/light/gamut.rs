//! Colours of thin films that no screen shows.

use paint::document::Slots;
use paint::layer::SLOTS;
use paint::scene::{picture, scene};
use spectra::color::{Lab, Lch, Rgb, RgbSpace};

use crate::made_up::{document, lay, light};

/// Thicknesses of the films in mm.
const FILMS_MM: [f64; 8] = [0.002, 0.004, 0.007, 0.01, 0.015, 0.02, 0.03, 0.05];

fn lch(rgb: Rgb) -> Lch {
    let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb.0);
    Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white()).to_lch()
}

#[test]
fn thin_films_of_every_pigment_keep_their_hue_on_a_screen() {
    let library = crate::made_up::oils();
    let light = light(&library, "D65");
    let mut outside = 0;
    let mut worst = (0.0, String::new());
    let mut least = 1.0f64;
    let mut cut_off = 0.0f64;
    let pigments: Vec<_> = library.ids().collect();
    for pigments in pigments.chunks(SLOTS) {
        let mut films = document(FILMS_MM.len(), pigments.len(), &[]);
        let slots: Slots = std::array::from_fn(|slot| pigments.get(slot).copied());
        films.slots = slots;
        for (slot, y) in (0..pigments.len()).enumerate() {
            for (x, mm) in FILMS_MM.into_iter().enumerate() {
                let mut amounts = [0.0; SLOTS];
                amounts[slot] = mm;
                lay(&mut films.wet, (x, y), &amounts);
            }
        }
        let picture = picture(&films, &scene(&films, &light));
        for (index, &[r, g, b, _]) in picture.values().iter().enumerate() {
            let exact = Rgb([r, g, b].map(f64::from));
            let shown = exact.mapped_into_gamut();
            if exact.in_gamut() {
                assert_eq!(shown, exact);
                continue;
            }
            outside += 1;
            let clipped = Rgb(exact.0.map(|value| value.clamp(0.0, 1.0)));
            let [exact, shown, clipped] = [exact, shown, clipped].map(lch);
            let pigment = &library[pigments[index / FILMS_MM.len()]].name;
            let mm = FILMS_MM[index % FILMS_MM.len()];
            let lightness = (shown.lightness - exact.lightness).abs();
            assert!(lightness < 0.1, "{pigment} {mm} mm: {exact:?} shown as {shown:?}");
            if exact.chroma.min(shown.chroma) > 5.0 {
                let turned = |to: Lch| {
                    let degrees = (to.hue_degrees - exact.hue_degrees).abs();
                    degrees.min(360.0 - degrees)
                };
                println!(
                    "{pigment} {mm} mm: {exact:?} shown as {shown:?}, turned {:.2}, cut off {:.2}",
                    turned(shown),
                    turned(clipped)
                );
                if turned(shown) > worst.0 {
                    worst = (turned(shown), format!("{pigment} {mm} mm: {exact:?} {shown:?}"));
                }
                cut_off = cut_off.max(turned(clipped));
                least = least.min(shown.chroma / exact.chroma);
            }
        }
    }
    println!("{outside} outside, turned {worst:?}, cut off {cut_off}, chroma {least}");
    assert!(outside > 10, "only {outside} films are outside the gamut");
    assert!(worst.0 < 0.5, "{worst:?}");
    assert!(cut_off > 5.0, "cutting off channels turns hues by {cut_off} degrees at most");
}

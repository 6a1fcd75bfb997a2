//! Light seen by an eye that adapted to it in part.

use paint::document::Lighting;
use paint::scene::{picture, scene};
use spectra::color::{Lab, RgbSpace, Xyz};

use crate::made_up::{document, light, oils};

/// Linear sRGB of the perfect diffuser.
fn white(rgb: &[[f32; 3]]) -> [f64; 3] {
    std::array::from_fn(|channel| rgb.iter().map(|rgb| f64::from(rgb[channel])).sum())
}

#[test]
fn an_eye_that_adapted_in_part_keeps_some_of_the_color_of_the_light() {
    for name in ["A", "3000K", "D65", "FL11"] {
        let light = light(&oils(), name);
        assert_eq!(light.rgb_at_degree(1.0), light.rgb_from_nodes, "{name}");
        let chroma = |degree| {
            let white = white(&light.rgb_at_degree(degree));
            let greatest = white.into_iter().fold(0.0, f64::max);
            assert!((greatest - 1.0).abs() < 1e-5, "{name} {degree}: {white:?}");
            let xyz: Xyz = RgbSpace::Srgb.xyz_from_linear().apply(white).into();
            Lab::from_xyz(xyz, RgbSpace::Srgb.white()).to_lch().chroma
        };
        let chromas = [1.0, 0.75, 0.5, 0.25, 0.0].map(chroma);
        if name == "D65" {
            assert!(chromas.iter().all(|chroma| *chroma < 0.1), "{chromas:?}");
        } else {
            assert!(chromas.windows(2).all(|pair| pair[0] < pair[1]), "{name}: {chromas:?}");
        }
        // Without adaptation, white has the chromaticity of the light itself.
        let found: Xyz =
            RgbSpace::Srgb.xyz_from_linear().apply(white(&light.rgb_at_degree(0.0))).into();
        let wanted = light.quadrature.rule.white;
        let [found, wanted] =
            [found, wanted].map(|v| [v.x / (v.x + v.y + v.z), v.y / (v.x + v.y + v.z)]);
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{name}: {found} {wanted}");
        }
    }
}

#[test]
fn a_painting_is_shown_with_the_adaptation_of_its_light() {
    let mut document = document(1, 1, &[]);
    let bulb = light(&document.library, "A");
    let mut shown = |adaptation| {
        document.lighting = Lighting { adaptation, ..Lighting::default() };
        picture(&document, &scene(&document, &bulb)).values()[0]
    };
    let [complete, half] = [1.0, 0.5].map(&mut shown);
    assert!((complete[0] - complete[2]).abs() < 0.01, "a grey ground: {complete:?}");
    assert!(half[0] > 1.5 * half[2], "yellow light: {half:?}");
    let text = |lighting: &Lighting| serde_json::to_string(lighting).unwrap();
    let before = text(&Lighting::default());
    assert!(!before.contains("adaptation"), "files of complete adaptation stay: {before}");
    for adaptation in [1.0, 0.5] {
        let lighting = Lighting { adaptation, ..Lighting::default() };
        let read: Lighting = serde_json::from_str(&text(&lighting)).unwrap();
        assert_eq!(read, lighting);
    }
}

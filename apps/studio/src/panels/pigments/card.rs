//! Tooltip card with the properties of a pigment.

use eframe::egui::{RichText, Ui, vec2};

use pigment::PigmentId;
use pigment::palette::Hides;

use super::catalogue::Catalogue;
use crate::chart::{Chart, Curve};
use crate::language::{tr, tr_format};
use crate::panels::controls::millimetres;

/// Width of the card, in points.
const WIDTH: f32 = 280.0;

/// Draws name, colour index, reflectance of masstone and tint, hiding power, tinting
/// strength and notes of a pigment.
pub(in crate::panels) fn card(
    ui: &mut Ui,
    catalogue: &Catalogue,
    pigment: PigmentId,
    scattering_per_mm: f64,
) {
    let known = &catalogue.library[pigment];
    ui.set_max_width(WIDTH);
    ui.horizontal(|ui| {
        ui.label(RichText::new(&known.name).strong());
        if let Some(index) = &known.color_index {
            ui.weak(index);
        }
    });
    let grid = catalogue.library.grid;
    let colors = catalogue.colors(pigment);
    let mut curves =
        vec![Curve::new(tr("full"), grid, &colors.masstone).colored(colors.masstone_srgb)];
    if let (Some(tint), Some(srgb)) = (&colors.tint, colors.tint_srgb) {
        curves.push(Curve::new(tr("one in ten"), grid, tint).colored(srgb));
    }
    let chart = Chart { curves: &curves, marks: &[], quantity: tr("reflectance"), max: Some(1.0) };
    chart.show(ui, vec2(WIDTH, 120.0));
    for line in lines(catalogue, pigment, scattering_per_mm) {
        ui.label(line);
    }
    for note in &known.notes {
        ui.weak(note);
    }
}

fn lines(catalogue: &Catalogue, pigment: PigmentId, scattering_per_mm: f64) -> Vec<String> {
    let known = &catalogue.library[pigment];
    let power = catalogue.strength(pigment);
    let mut lines = vec![match power.hides {
        Some(Hides::From(thickness)) => {
            tr_format!("hides from {height}", height = millimetres(thickness / scattering_per_mm))
        }
        Some(Hides::Never { contrast }) => {
            tr_format!(
                "hides at no height (contrast {contrast:.0} % at max)",
                contrast = 100.0 * contrast
            )
        }
        None => tr("hiding power not known").to_owned(),
    }];
    if let Some(percent) = power.tints_percent {
        lines.push(tr_format!(
            "tinting strength {percent:.0} % of the library's strongest",
            percent
        ));
    }
    if known.guessed {
        lines.push(tr("guessed from a colour, not measured").to_owned());
    }
    if !known.identified {
        lines.push(tr("scattering not identified: mixtures with it are a guess").to_owned());
    }
    lines
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use paint::light::Light;
    use pigment::library::PigmentLibrary;
    use pigment::palette::{Cards, Palette, hiding_powers};

    use super::*;

    #[test]
    fn a_card_shows_the_figures_of_the_library() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "D65", "1931-2").unwrap());
        let catalogue = Catalogue::new(&library, &light);
        let card_lines = |name: &str| lines(&catalogue, library.find(name).unwrap(), 50.0);

        let palette = Palette::new(&library, &light.viewing, Cards::standard(library.grid));
        let white = library.find("Zinc White").unwrap();
        let strengths = hiding_powers(&palette.unwrap());
        let own = strengths.iter().find(|power| power.paint == white).unwrap();
        let mm = own.hides.thickness().unwrap() / 50.0;
        assert_eq!(card_lines("Zinc White"), [format!("hides from {}", millimetres(mm))]);
        let blue = card_lines("Prussian Blue");
        assert!(blue[1].starts_with("tinting strength "), "{blue:?}");
        let unknown = card_lines("Chrome Yellow (poppyseed)");
        assert_eq!(unknown[0], "hiding power not known");
        assert!(unknown[1].contains("not identified"), "{unknown:?}");
    }
}

//! The painter's own tone of a ground: a film of up to three pigments, or a plain colour.

use eframe::egui::{Button, ComboBox, DragValue, Ui};
use paint::ground::{ColorPrimer, Primer, PrimerFilm, TonedPrimer};
use pigment::library::PigmentLibrary;
use spectra::color::Rgb;

use crate::files::dialogs::grid_row;
use crate::language::{tr, tr_format};

/// Most pigments of a film.
const MOST_PIGMENTS: usize = 3;

/// A film to begin with: the first pigment of the library whose K and S are known.
pub(super) fn first_film(library: &PigmentLibrary) -> Option<Primer> {
    let name = library.pigments.iter().find(|pigment| pigment.identified)?.name.clone();
    let film = PrimerFilm { recipe: [(name, 1.0)].into(), height_mm: 0.001 };
    Some(Primer::Toned(TonedPrimer { film }))
}

/// A plain colour to begin with.
pub(super) fn first_color() -> Primer {
    Primer::Color(ColorPrimer { rgb: "#c8b89a".to_owned() })
}

/// Adds the rows of a film: one for each pigment, and one for its thickness.
pub(super) fn film_rows(ui: &mut Ui, film: &mut PrimerFilm, library: &PigmentLibrary) {
    let names: Vec<String> = film.recipe.keys().cloned().collect();
    for (row, name) in names.iter().enumerate() {
        grid_row(ui, if row == 0 { tr("Film") } else { "" }, |ui| {
            pigment(ui, row, film, name, library);
            if let Some(part) = film.recipe.get_mut(name) {
                let drag = DragValue::new(part).range(0.0..=100.0).speed(0.1).suffix(tr(" parts"));
                let drag = ui.add(drag).accessible_name(tr_format!("Parts of {name}", name));
                drag.on_hover_text(tr("Parts by volume of this pigment"));
            }
            let remove = ui.add_enabled(names.len() > 1, Button::new("\u{2212}"));
            let remove = remove.accessible_name(tr_format!("Leave {name} out", name));
            if remove.on_hover_text(tr("Leaves this pigment out")).clicked() {
                film.recipe.remove(name);
            }
        });
    }
    grid_row(ui, "", |ui| {
        let mut microns = film.height_mm * 1000.0;
        let drag = DragValue::new(&mut microns).range(0.0..=500.0).speed(0.02).max_decimals(2);
        let drag = ui.add(drag.suffix(" \u{b5}m")).accessible_name(tr("Thickness of the film"));
        let tip =
            tr("Height of the dry paint without the medium that thinned it: 0.5 to 1 for an \
                   imprimatura, 10 and more to hide the priming");
        if drag.on_hover_text(tip).changed() {
            film.height_mm = microns / 1000.0;
        }
        let more = film.recipe.len() < MOST_PIGMENTS;
        let next = library.pigments.iter().find(|p| !film.recipe.contains_key(&p.name));
        if let Some(next) = next.filter(|_| more)
            && ui.button(tr("Add pigment")).on_hover_text(tr("Mixes another one into it")).clicked()
        {
            film.recipe.insert(next.name.clone(), 1.0);
        }
    });
}

/// Draws the choice of the pigment `name`.
fn pigment(ui: &mut Ui, row: usize, film: &mut PrimerFilm, name: &str, library: &PigmentLibrary) {
    let combo = ComboBox::from_id_salt(("film", row)).selected_text(name).width(150.0);
    let combo = combo.show_ui(ui, |ui| {
        for other in &library.pigments {
            let free = !film.recipe.contains_key(&other.name);
            let chosen = other.name == name;
            if ui.selectable_label(chosen, &other.name).clicked() && free {
                let parts = film.recipe.remove(name).unwrap_or(1.0);
                film.recipe.insert(other.name.clone(), parts);
            }
        }
    });
    combo
        .response
        .accessible_name(tr_format!("Pigment {row}", row = row + 1))
        .on_hover_text(tr("A pigment of it"));
}

/// Adds the row of a plain colour.
pub(super) fn color_row(ui: &mut Ui, color: &mut ColorPrimer) {
    grid_row(ui, "", |ui| {
        let mut bytes = Rgb::from_hex(&color.rgb).map_or([200; 3], Rgb::to_bytes);
        let button = ui.color_edit_button_srgb(&mut bytes);
        if button
            .on_hover_text(tr("Colour in daylight; it becomes the smoothest spectrum"))
            .changed()
        {
            let [red, green, blue] = bytes;
            color.rgb = format!("#{red:02x}{green:02x}{blue:02x}");
        }
        ui.weak(&color.rgb);
    });
}

//! Section on colours under other lights: colour shifts and metameric pairs.

use calibrate::palette::{
    ColorShift, Metamers, Palette, Recipe, TestLight, color_shifts, metamers, test_lights,
};

use super::cells::{columns, row};
use super::context::{NOTCH, films, measured, palette, thinner};
use super::patch::{patch, rim};
use crate::figure::{Drawing, Figure, Words};
use crate::style::{FAINT, INK, SMALL_TEXT, TEXT, WIDTH};
use crate::subject::{Section, Subject};
use crate::svg::{Anchor, Canvas};
use crate::table::{Cell, Column, Table};

/// Parts of white to one part of pigment in the tint next to the masstone.
const TINT: f64 = 3.0;
/// Maximum CIEDE2000 difference of a metameric pair under the first light; chosen by eye.
const ALIKE: f64 = 2.0;
/// Maximum number of metameric pairs shown.
const PAIRS: usize = 8;

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Under other lights");
    let Some(palette) = palette(subject) else { return section };
    let lights = test_lights(&palette);
    let section = section.with_figure(shifts(subject, &palette, &lights));
    let pairs = metamers(&palette, &lights, &measured(subject, &palette), ALIKE, PAIRS);
    if pairs.is_empty() {
        return section.with_paragraph(format!(
            "No two mixtures that were tried come within {ALIKE} CIEDE2000 of each other under {}.",
            lights[0].name
        ));
    }
    section.with_figure(metameric_pairs(subject, &palette, &lights, &pairs))
}

fn shifts(subject: &Subject<'_>, palette: &Palette<'_>, lights: &[TestLight]) -> Figure {
    let paints = palette.paints();
    let recipes: Vec<Recipe> =
        paints.iter().flat_map(|&p| [Recipe::single(p), palette.tint(p, TINT)]).collect();
    let shifts = color_shifts(palette, lights, &recipes);
    let first = &lights[0].name;
    let own = [
        Column::text("mixture"),
        Column::text("light"),
        Column::quantity(&format!("CIEDE2000 from {first}"), "1", 2),
    ];
    let mut data = Table::new(columns(own));
    for shift in &shifts {
        let name = palette.recipe_label(&shift.recipe);
        for (light, (look, far)) in lights.iter().zip(shift.colors.iter().zip(&shift.shifts)) {
            let own = [name.as_str().into(), light.name.as_str().into(), (*far).into()];
            data.push(row(own, look));
        }
    }
    let caption = format!(
        "Each pigment and its tint with {TINT} parts of {} under {}; every patch is adapted to its own white (Bradford). Below a patch: how far its colour shifts from that under {first}, in CIEDE2000, after adaptation. {} {NOTCH}",
        thinner(palette),
        listed(lights),
        films(palette)
    );
    let words = Words {
        name: "colour-shift",
        title: "Pigments under other lights",
        caption: &caption,
        alt: "For each pigment two rows of three patches: masstone and tint under each light, with the shift of colour.",
    };
    let names: Vec<String> = paints.iter().map(|&p| subject.label(p)).collect();
    subject.figure(words, Drawing::Canvas(shift_rows(lights, &names, &shifts)), data)
}

/// Draws masstone and tint of each pigment under each light, in two columns of pigments if there
/// are more than six.
fn shift_rows(lights: &[TestLight], names: &[String], shifts: &[ColorShift]) -> Canvas {
    const NAME: f64 = 160.0;
    const ROW: f64 = 40.0;
    const HEAD: f64 = 40.0;
    const APART: f64 = 12.0;
    let blocks = if names.len() > 6 { 2 } else { 1 };
    let rows = names.len().div_ceil(blocks);
    let block = f64::from(WIDTH) / blocks as f64;
    let side = ((block - NAME - 16.0 - APART) / (2 * lights.len()) as f64).min(64.0);
    let group = side * lights.len() as f64 + APART;
    let mut canvas = Canvas::new(WIDTH, (HEAD + ROW * rows as f64 + 4.0).ceil() as u32);
    for index in 0..blocks {
        for (which, name) in ["masstone".to_owned(), format!("1 : {TINT}")].iter().enumerate() {
            let x = index as f64 * block + NAME + which as f64 * group;
            let middle = x + (group - APART) / 2.0;
            canvas.text((middle, 10.0), SMALL_TEXT, Anchor::Middle, INK, name);
            for (place, light) in lights.iter().enumerate() {
                let x = x + (place as f64 + 0.5) * side;
                let space = (side, 24.0);
                let name = &light.name;
                canvas.name((x, 27.0), space, SMALL_TEXT, Anchor::Middle, FAINT, name);
            }
        }
    }
    for (index, (name, pair)) in names.iter().zip(shifts.chunks(2)).enumerate() {
        let x = (index / rows) as f64 * block + NAME;
        let y = HEAD + (index % rows) as f64 * ROW;
        let space = (NAME - 12.0, ROW - 8.0);
        canvas.name((x - 8.0, y + 11.0), space, TEXT, Anchor::End, INK, name);
        for (which, shift) in pair.iter().enumerate() {
            let x = x + which as f64 * group;
            rim(&mut canvas, (x, y), (side * lights.len() as f64, 22.0));
            for (place, (look, far)) in shift.colors.iter().zip(&shift.shifts).enumerate() {
                let left = x + place as f64 * side;
                patch(&mut canvas, (left, y), (side, 22.0), look);
                if place > 0 {
                    let at = (left + side / 2.0, y + 30.0);
                    canvas.text(at, SMALL_TEXT, Anchor::Middle, FAINT, &format!("{far:.1}"));
                }
            }
        }
    }
    canvas
}

fn metameric_pairs(
    subject: &Subject<'_>,
    palette: &Palette<'_>,
    lights: &[TestLight],
    pairs: &[Metamers],
) -> Figure {
    let own = [
        Column::quantity("pair", "1", 0),
        Column::text("mixture"),
        Column::text("light"),
        Column::quantity("CIEDE2000 of the pair", "1", 2),
        Column::quantity("metamerism index", "1", 2),
    ];
    let mut data = Table::new(columns(own));
    for (number, pair) in pairs.iter().enumerate() {
        for (light, which) in lights.iter().enumerate().flat_map(|l| [(l, 0), (l, 1)]) {
            let (at, light) = light;
            let own: [Cell; 5] = [
                (number as f64 + 1.0).into(),
                pair.names[which].as_str().into(),
                light.name.as_str().into(),
                pair.differences[at].into(),
                pair.indices[at].into(),
            ];
            data.push(row(own, &pair.colors[at][which]));
        }
    }
    let caption = format!(
        "Of all pigments, every two of them at five ratios with and without {}, and the measured samples: the pairs within {ALIKE} CIEDE2000 under {} that part most under another light, each patch adapted to its own white. Below: their difference as it is, and the special metamerism index (CIE 15:2018, 9.2), which takes off the difference they start with. {} {NOTCH}",
        thinner(palette),
        lights[0].name,
        films(palette)
    );
    let words = Words {
        name: "metamers",
        title: "Mixtures that match until the light changes",
        caption: &caption,
        alt: "Rows of two patches that touch: alike under the first light, apart under the others.",
    };
    subject.figure(words, Drawing::Canvas(pair_rows(lights, pairs)), data)
}

fn pair_rows(lights: &[TestLight], pairs: &[Metamers]) -> Canvas {
    const NAME: f64 = 396.0;
    const ROW: f64 = 62.0;
    const HEAD: f64 = 24.0;
    let each = (f64::from(WIDTH) - NAME) / lights.len() as f64;
    let half = (each - 14.0) / 2.0;
    let mut canvas = Canvas::new(WIDTH, (HEAD + ROW * pairs.len() as f64).ceil() as u32);
    for (place, light) in lights.iter().enumerate() {
        let x = NAME + place as f64 * each + half;
        canvas.text((x, 11.0), SMALL_TEXT, Anchor::Middle, INK, &light.name);
    }
    for (index, pair) in pairs.iter().enumerate() {
        let y = HEAD + index as f64 * ROW;
        for (line, name) in pair.names.iter().enumerate() {
            let at = (NAME - 10.0, y + 7.0 + 25.0 * line as f64);
            canvas.name(at, (NAME - 14.0, 25.0), SMALL_TEXT, Anchor::End, INK, name);
        }
        for (place, looks) in pair.colors.iter().enumerate() {
            let x = NAME + place as f64 * each;
            rim(&mut canvas, (x, y), (2.0 * half, 36.0));
            patch(&mut canvas, (x, y), (half, 36.0), &looks[0]);
            patch(&mut canvas, (x + half, y), (half, 36.0), &looks[1]);
            let label = if place == 0 {
                format!("{:.1}", pair.differences[0])
            } else {
                format!("{:.1}, index {:.1}", pair.differences[place], pair.indices[place])
            };
            let at = (x + half, y + 46.0);
            canvas.text(at, SMALL_TEXT, Anchor::Middle, FAINT, &label);
        }
    }
    canvas
}

fn listed(lights: &[TestLight]) -> String {
    let names: Vec<&str> = lights.iter().map(|light| light.name.as_str()).collect();
    names.join(", ")
}

//! Section on hiding power and tinting strength.

use calibrate::library::AmountKind;
use calibrate::palette::{
    HIDING_CONTRAST, Hides, Palette, Recipe, TINT_DEPTH, TINT_PARTS, hiding_powers,
    tinting_strengths,
};

use super::bars::{Bar, bars};
use super::context::{NOTCH, palette, thickness_unit, thinner};
use crate::axis::Axis;
use crate::figure::{Drawing, Figure, Words};
use crate::subject::{Section, Subject};
use crate::table::{Cell, Column, Table};

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Hiding power and tinting strength");
    let Some(palette) = palette(subject) else { return section };
    section.with_figure(hiding(subject, &palette)).with_figure(tinting(subject, &palette))
}

fn hiding(subject: &Subject<'_>, palette: &Palette<'_>) -> Figure {
    let absolute = subject.library.amounts == AmountKind::Absolute;
    let (quantity, unit) = if absolute {
        ("Amount that hides", "as in the library".to_owned())
    } else {
        ("Thickness that hides", thickness_unit(palette))
    };
    let mut powers = hiding_powers(palette);
    let sort = |hides: Hides| hides.thickness().unwrap_or(f64::INFINITY);
    powers.sort_by(|a, b| sort(a.hides).total_cmp(&sort(b.hides)));
    let known = || powers.iter().filter_map(|power| power.hides.thickness());
    let low = known().filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
    let axis = Axis::log(quantity, &unit, low, known().fold(0.0, f64::max), 6);
    let mut data = Table::new([
        Column::text("pigment"),
        Column::quantity(&quantity.to_lowercase(), &unit, 3),
        Column::quantity("contrast ratio of the thickest film", "1", 3),
    ]);
    let all = powers.iter().map(|power| {
        let name = subject.label(power.paint);
        let (label, contrast) = match power.hides {
            Hides::From(thickness) => (digits(thickness, 4), None),
            Hides::Never { contrast } => (format!("never hides ({contrast:.2})"), Some(contrast)),
        };
        let thickness = power.hides.thickness();
        data.push([name.as_str().into(), Cell::from(thickness), Cell::from(contrast)]);
        Bar {
            name,
            value: thickness,
            label,
            appearance: palette.color(&Recipe::single(power.paint)),
        }
    });
    let all: Vec<Bar> = all.collect();
    let caption = format!(
        "The least thickness from which on the luminance over the black card is {HIDING_CONTRAST} of that over the white card (ISO 6504-3) under {}; the shortest bar hides best. {} {NOTCH}",
        subject.light(),
        cards(palette)
    );
    let words = Words {
        name: "hiding-power",
        title: "Hiding power",
        caption: &caption,
        alt: "A bar for each pigment, as long as the film must be thick to hide its ground; logarithmic.",
    };
    subject.figure(words, Drawing::Canvas(bars(&axis, &all)), data)
}

fn tinting(subject: &Subject<'_>, palette: &Palette<'_>) -> Figure {
    let relative = palette.white().is_some();
    let mut strengths = tinting_strengths(palette, None);
    strengths.sort_by(|a, b| b.strength.total_cmp(&a.strength));
    let axis = Axis::linear("Tinting strength", "strongest = 100 %", 0.0, 100.0, 5);
    let measure = if relative { "K/S added to the white" } else { "K per unit of amount" };
    let mut data = Table::new([
        Column::text("pigment"),
        Column::quantity("tinting strength", "%", 1),
        Column::quantity("wavelength", "nm", 0),
        Column::quantity(measure, "1", 4),
        Column::quantity("parts of white to one for K/S = 1", "1", 1),
    ]);
    let all = strengths.iter().map(|strength| {
        let name = subject.label(strength.paint);
        data.push([
            name.as_str().into(),
            strength.percent.into(),
            strength.wavelength_nm.into(),
            strength.strength.into(),
            Cell::from(strength.white_parts),
        ]);
        let parts = strength.white_parts.map(|parts| format!("; 1 : {}", digits(parts, 1)));
        let label = format!("{} %{}", digits(strength.percent, 1), parts.unwrap_or_default());
        let appearance = palette.color(&palette.tint(strength.paint, 3.0));
        Bar { name, value: Some(strength.percent), label, appearance }
    });
    let all: Vec<Bar> = all.collect();
    let caption = if relative {
        let white = thinner(palette);
        format!(
            "What one part in {TINT_PARTS} parts of {white} adds to its K/S where the tint absorbs most (as ISO 787-24 compares tints), the strongest pigment 100 %. Behind it: the parts of {white} to one of the pigment in a tint of K/S = {TINT_DEPTH} there. Bars have the colour of the tint with three parts of {white}. {NOTCH}"
        )
    } else {
        "K of one unit of amount where the pigment absorbs most, the strongest 100 %: the library has no white paint to tint. Bars have the colour of the wash thinned with three parts of water.".to_owned()
    };
    let words = Words {
        name: "tinting-strength",
        title: "Tinting strength",
        caption: &caption,
        alt: "A bar for each pigment, as long as its tinting strength, strongest first.",
    };
    subject.figure(words, Drawing::Canvas(bars(&axis, &all)), data)
}

fn cards(palette: &Palette<'_>) -> String {
    let cards = palette.cards();
    let card = |name: &str, measured: bool, values: &[f64]| {
        let how = if measured { "measured" } else { "not measured, taken as the standard's" };
        format!("{name} card: Y = {:.1}, {how}.", palette.weights().xyz(values).y)
    };
    format!(
        "{} {}",
        card("Black", cards.black_measured, &cards.black),
        card("White", cards.white_measured, &cards.white)
    )
}

/// `value` to three significant digits, with at most `most` decimals.
fn digits(value: f64, most: i32) -> String {
    let whole = if value > 0.0 { value.log10().floor() as i32 } else { 0 };
    let behind = (2 - whole).clamp(0, most) as usize;
    format!("{value:.behind$}")
}

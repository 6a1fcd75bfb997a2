//! Sections on the palette of a library: mixtures, gamut, hiding power, tinting strength and other
//! lights. We get the numbers from `calibrate::palette`.

mod patch;
mod gamut;

use calibrate::PigmentId;
use calibrate::library::AmountKind;
use calibrate::palette::{
    CHART_TINT, GradedMixture, HIDING_CONTRAST, Hides, MeasuredSample, MixingRow, PainterRules,
    Palette, Recipe, TINT_DEPTH, TINT_PARTS, TINTS, default_pairs, graded, hiding_powers,
    mixing_chart, tint_ladders, tinting_strengths,
};
use calibrate::quadrature::{QuadratureMethod, QuadratureTrial};

use crate::figure::{Cell, Column, Drawing, Figure, Table, Words};
use crate::panel::Axis;
use crate::style::{FAINT, INK, SMALL_TEXT, TEXT, WIDTH};
use crate::subject::{Section, Subject};
use crate::svg::{Anchor, Canvas, estimated_width};
use patch::{
    Bar, NOTCH, bars, columns, films, measured, palette, patch, rim, rimmed, row, thickness_unit,
    thinner,
};

pub(crate) use gamut::{gamut_section, lights_section};

/// Width in px for the names. The other sizes are in px too.
const NAME: f64 = 170.0;

pub(crate) fn mixing_section(subject: &Subject<'_>) -> Section {
    let section = Section::new("What the paints mix");
    let Some(palette) = palette(subject) else { return section };
    let left_out: Vec<String> = palette.left_out().into_iter().map(|p| subject.label(p)).collect();
    let section = if left_out.is_empty() {
        section
    } else {
        section.with_paragraph(format!(
            "Left out of all mixtures, since their scattering is not known: {}.",
            left_out.join(", ")
        ))
    };
    section
        .with_figure(chart(subject, &palette))
        .with_figure(tints(subject, &palette))
        .with_figure(patch::figure(subject, &palette))
}

fn chart(subject: &Subject<'_>, palette: &Palette<'_>) -> Figure {
    let chart = mixing_chart(palette);
    let count = chart.paints.len();
    let names: Vec<String> = chart.paints.iter().map(|&p| subject.label(p)).collect();
    let own = [
        Column::text("first"),
        Column::text("second"),
        Column::quantity("parts of white or water to one", "1", 0),
    ];
    let mut data = Table::new(columns(own));
    for (i, first) in names.iter().enumerate() {
        for (j, second) in names.iter().enumerate().skip(i) {
            for (parts, looks) in [(0.0, &chart.colors), (CHART_TINT, &chart.tinted)] {
                let own = [first.as_str().into(), second.as_str().into(), parts.into()];
                data.push(row(own, &looks[i][j]));
            }
        }
    }
    let cell = ((f64::from(WIDTH) - NAME - 10.0) / count as f64).min(48.0);
    let longest = names.iter().map(|name| estimated_width(name, TEXT)).fold(0.0, f64::max);
    let head = longest.min(NAME) + 12.0;
    let side = cell * count as f64;
    let mut canvas = Canvas::new(WIDTH, (head + side + 8.0).ceil() as u32);
    rim(&mut canvas, (NAME, head), (side, side));
    for (i, name) in names.iter().enumerate() {
        let middle = (i as f64 + 0.5) * cell;
        let beside = (NAME - 8.0, head + middle);
        let above = (NAME + middle, head - 6.0);
        canvas.name(beside, (NAME - 12.0, cell), TEXT, Anchor::End, INK, name);
        canvas.name_upwards(above, (head - 8.0, cell), TEXT, INK, name);
        for j in 0..count {
            let at = (NAME + j as f64 * cell, head + i as f64 * cell);
            if i == j {
                patch(&mut canvas, at, (cell, cell), &chart.colors[i][i]);
            } else {
                let looks = if j < i { &chart.colors } else { &chart.tinted };
                let at = (at.0 + 1.0, at.1 + 1.0);
                patch(&mut canvas, at, (cell - 2.0, cell - 2.0), &looks[i][j]);
            }
        }
    }
    let thinner = thinner(palette);
    let caption = format!(
        "Below the diagonal every two pigments one part to one; above it the same with {CHART_TINT} parts of {thinner} to one of the mixture; on it each by itself. {} {NOTCH}",
        films(palette)
    );
    let words = Words {
        name: "mixing-chart",
        title: "Mixing chart",
        caption: &caption,
        alt: "A square of patches, each the mixture of the pigment of its row with that of its column.",
    };
    subject.figure(words, Drawing::Canvas(canvas), data)
}

fn tints(subject: &Subject<'_>, palette: &Palette<'_>) -> Figure {
    const ROW: f64 = 30.0;
    const HEAD: f64 = 22.0;
    let ladders = tint_ladders(palette);
    let own = [Column::text("pigment"), Column::quantity("parts of white or water to one", "1", 0)];
    let mut data = Table::new(columns(own));
    let blocks = if ladders.len() > 6 { 2 } else { 1 };
    let rows = ladders.len().div_ceil(blocks);
    let block = f64::from(WIDTH) / blocks as f64;
    let step = (block - NAME - 12.0) / TINTS.len() as f64;
    let mut canvas = Canvas::new(WIDTH, (HEAD + ROW * rows as f64 + 4.0).ceil() as u32);
    for index in 0..blocks {
        for (place, parts) in TINTS.iter().enumerate() {
            let label = if *parts == 0.0 { "masstone".to_owned() } else { format!("1 : {parts}") };
            let x = index as f64 * block + NAME + (place as f64 + 0.5) * step;
            canvas.text((x, HEAD - 10.0), SMALL_TEXT, Anchor::Middle, FAINT, &label);
        }
    }
    for (index, ladder) in ladders.iter().enumerate() {
        let x = (index / rows) as f64 * block + NAME;
        let y = HEAD + (index % rows) as f64 * ROW;
        let name = subject.label(ladder.paint);
        let space = (NAME - 12.0, ROW);
        canvas.name((x - 8.0, y + ROW / 2.0), space, TEXT, Anchor::End, INK, &name);
        for (place, (parts, look)) in TINTS.iter().zip(&ladder.colors).enumerate() {
            let at = (x + place as f64 * step, y + 2.0);
            rimmed(&mut canvas, at, (step, ROW - 5.0), look);
            data.push(row([name.as_str().into(), (*parts).into()], look));
        }
    }
    let thinner = thinner(palette);
    let caption = format!(
        "Each pigment by itself, then one part of it to 1, 3, 9 and 27 parts of {thinner}. {} {NOTCH}",
        films(palette)
    );
    let words = Words {
        name: "tints",
        title: "Tints of every pigment",
        caption: &caption,
        alt: "For each pigment a row of patches from the masstone to a pale tint.",
    };
    subject.figure(words, Drawing::Canvas(canvas), data)
}

const GRADED_NAME: f64 = 112.0;
const MEAN: f64 = 84.0;
const PATCH: f64 = 40.0;
const ROW: f64 = 60.0;
const HEAD: f64 = 40.0;

pub(crate) fn graded_section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Graded mixtures");
    let Some(palette) = palette(subject) else { return section };
    let measured = measured(subject, &palette);
    let pairs = match subject.pair {
        Some(pair) => vec![pair],
        None => default_pairs(&palette, &measured),
    };
    if let Some(left_out) =
        pairs.iter().flat_map(|(a, b)| [*a, *b]).find(|p: &PigmentId| !palette.paints().contains(p))
    {
        return section.with_paragraph(format!(
            "{} takes no part in mixtures: its scattering is not known.",
            subject.label(left_out)
        ));
    }
    if pairs.is_empty() {
        return section;
    }
    let rules = rules(subject, &palette);
    pairs.into_iter().enumerate().fold(section, |section, (index, pair)| {
        section.with_figure(figure(subject, &palette, (index + 1, pair), &measured, &rules))
    })
}

/// Quadratures of three and eight wavelengths. We take them from the report if it has both, and
/// compute them otherwise.
fn rules(subject: &Subject<'_>, palette: &Palette<'_>) -> PainterRules {
    let tried = [8, 3].map(|count| {
        let mut trials = subject.quadratures.iter();
        let trial = trials.find(|trial: &&QuadratureTrial| {
            trial.method == QuadratureMethod::Library && trial.rule.nodes_nm.len() == count
        });
        trial.map(|trial| trial.rule.clone())
    });
    match tried {
        [Some(eight), Some(three)] => PainterRules { eight, three },
        _ => PainterRules::of(palette).expect("three and eight wavelengths are allowed"),
    }
}

fn figure(
    subject: &Subject<'_>,
    palette: &Palette<'_>,
    (number, pair): (usize, (PigmentId, PigmentId)),
    measured: &[MeasuredSample],
    rules: &PainterRules,
) -> Figure {
    let mixture = graded(palette, pair, measured, rules);
    let first = subject.label(pair.0);
    let second = subject.label(pair.1);
    let own = [
        Column::quantity(&format!("share of {second}"), "%", 2),
        Column::text("way"),
        Column::text("sample"),
        Column::quantity("CIEDE2000", "1", 2),
        Column::text("from"),
    ];
    let mut data = Table::new(columns(own));
    for step in &mixture.steps {
        let from = if step.sample.is_some() { MixingRow::Measured } else { MixingRow::Spectrum };
        for way in MixingRow::ALL {
            let Some(look) = step.colors[way as usize] else { continue };
            let error = step.errors[way as usize];
            let own: [Cell; 5] = [
                (100.0 * step.share).into(),
                way.name().into(),
                step.sample
                    .clone()
                    .filter(|_| way == MixingRow::Measured)
                    .map_or(Cell::Empty, Cell::from),
                Cell::from(error),
                error.map_or(Cell::Empty, |_| from.name().into()),
            ];
            data.push(row(own, &look));
        }
    }
    let name = format!("graded-mixture-{number}");
    let title = format!("{first} to {second}");
    let caption = format!(
        "After Baxter, Wendt and Lin 2004, figure 10: measured swatches where there are any, Kubelka-Munk mixing at every wavelength, at 8 ({} nm) and at 3 ({} nm) fitted to the library, and straight lines in linear RGB between the two ends. Below each: CIEDE2000 from the measured swatch; grey, where there is none, from the full spectrum. On the right the means over the mixtures, ends left out. {} {}. {NOTCH}",
        nodes(&rules.eight.nodes_nm),
        nodes(&rules.three.nodes_nm),
        films(palette),
        subject.light()
    );
    let alt = format!("Rows of patches from {first} to {second}, one row for each way to mix.");
    let words = Words { name: &name, title: &title, caption: &caption, alt: &alt };
    subject.figure(words, Drawing::Canvas(rows(&mixture, [&first, &second])), data)
}

fn nodes(nodes: &[f64]) -> String {
    let whole: Vec<String> = nodes.iter().map(|nm| format!("{nm:.0}")).collect();
    whole.join(", ")
}

fn rows(mixture: &GradedMixture, ends: [&str; 2]) -> Canvas {
    let ways: Vec<MixingRow> = MixingRow::ALL
        .into_iter()
        .filter(|way: &MixingRow| {
            mixture.steps.iter().any(|step| step.colors[*way as usize].is_some())
        })
        .collect();
    let step_width = (f64::from(WIDTH) - GRADED_NAME - MEAN) / mixture.steps.len() as f64;
    let mut canvas = Canvas::new(WIDTH, (HEAD + ROW * ways.len() as f64).ceil() as u32);
    let right = f64::from(WIDTH) - MEAN;
    let space = (GRADED_NAME - 10.0, HEAD - 4.0);
    canvas.name(
        (GRADED_NAME - 8.0, HEAD / 2.0 - 2.0),
        space,
        SMALL_TEXT,
        Anchor::End,
        INK,
        ends[1],
    );
    canvas.text((right + 8.0, 12.0), SMALL_TEXT, Anchor::Start, INK, "mean");
    for (at, step) in mixture.steps.iter().enumerate() {
        let middle = GRADED_NAME + (at as f64 + 0.5) * step_width;
        let share = format!("{} %", (1000.0 * step.share).round() / 10.0);
        canvas.text((middle, 12.0), SMALL_TEXT, Anchor::Middle, INK, &share);
        if let Some(sample) = &step.sample {
            let space = (step_width - 2.0, 16.0);
            canvas.name((middle, 27.0), space, SMALL_TEXT, Anchor::Middle, FAINT, sample);
        }
    }
    for (line, way) in ways.into_iter().enumerate() {
        let y = HEAD + line as f64 * ROW;
        canvas.text((GRADED_NAME - 8.0, y + PATCH / 2.0), TEXT, Anchor::End, INK, way.name());
        for (at, step) in mixture.steps.iter().enumerate() {
            let x = GRADED_NAME + at as f64 * step_width;
            if let Some(look) = &step.colors[way as usize] {
                rimmed(&mut canvas, (x + 1.0, y), (step_width - 2.0, PATCH), look);
            }
            if let Some(error) = step.errors[way as usize] {
                let color = if step.sample.is_some() { INK } else { FAINT };
                let at = (x + step_width / 2.0, y + PATCH + 9.0);
                canvas.text(at, SMALL_TEXT, Anchor::Middle, color, &format!("{error:.1}"));
            }
        }
        for (measured, dy, color) in [(true, 12.0, INK), (false, 28.0, FAINT)] {
            let Some((mean, count)) = mixture.mean_error(way, measured) else { continue };
            let label = format!("{mean:.2} of {count}");
            canvas.text((right + 8.0, y + dy), SMALL_TEXT, Anchor::Start, color, &label);
        }
    }
    canvas
}

pub(crate) fn strength_section(subject: &Subject<'_>) -> Section {
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
    powers.sort_by(|a, b| sort(a.hides).total_cmp(&sort(b.hides)));
    let known = powers.iter().filter_map(|power| power.hides.thickness());
    let low = known.clone().filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
    let axis = Axis::log(quantity, &unit, low, known.fold(0.0, f64::max), 6);
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

fn sort(hides: Hides) -> f64 {
    hides.thickness().unwrap_or(f64::INFINITY)
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
    let texts = [
        ("Black", cards.black_measured, &cards.black),
        ("White", cards.white_measured, &cards.white),
    ];
    let texts = texts.map(|(name, is_measured, values)| {
        let how = if is_measured { "measured" } else { "not measured, taken as the standard's" };
        format!("{name} card: Y = {:.1}, {how}.", palette.weights().xyz(values).y)
    });
    texts.join(" ")
}

/// `value` to three significant digits, with at most `most` decimals.
fn digits(value: f64, most: i32) -> String {
    let whole = if value > 0.0 { value.log10().floor() as i32 } else { 0 };
    let behind = (2 - whole).clamp(0, most) as usize;
    format!("{value:.behind$}")
}

//! Sections on the gamut of a palette, and on colours under other lights.

use std::collections::BTreeMap;

use calibrate::palette::{
    Boundary, ColorShift, Gamut, GamutSample, Metamers, Palette, Recipe, TestLight, color_shifts,
    metamers, sampled_gamut, spectral_locus, srgb_primaries, test_lights,
};

use super::patch::{NOTCH, columns, films, measured, palette, patch, rim, row, thinner};
use crate::figure::{Cell, Column, Drawing, Figure, Table, Words};
use crate::panel::{Axis, Chart, KeySymbol, Mark, Panel};
use crate::style::{Color, FAINT, HAIR, INK, SERIES, SMALL_TEXT, TEXT, WIDTH};
use crate::subject::{Section, Subject};
use crate::svg::{Anchor, Canvas};

/// An outline has this many sectors.
const SECTORS: usize = 72;
/// Side of a cell, first in units of a* and b*, then of x and y.
const CELLS: [f64; 2] = [4.0, 0.015];
/// The outline of a band of lightness has fewer sectors, because a band has fewer samples.
const BAND_SECTORS: usize = 36;
/// We label masstones from this chroma on.
const NAMED: f64 = 12.0;
const BANDS: [[f64; 2]; 5] = [[0.0, 20.0], [20.0, 40.0], [40.0, 60.0], [60.0, 80.0], [80.0, 100.0]];

pub(crate) fn gamut_section(subject: &Subject<'_>) -> Section {
    let section = Section::new("The colours within reach");
    let Some(palette) = palette(subject) else { return section };
    let gamut = sampled_gamut(&palette);
    section
        .with_figure(planes(subject, &palette, &gamut))
        .with_figure(bands(subject, &palette, &gamut))
}

fn planes(subject: &Subject<'_>, palette: &Palette<'_>, gamut: &Gamut) -> Figure {
    let lab = gamut.in_lab([0.0, 100.0], SECTORS);
    let xy = gamut.in_xy(SECTORS);
    let mut data = Table::new(columns(outline_columns("plane", "u", "v")));
    push_outline(&mut data, palette, gamut, &lab, "a*, b*");
    push_outline(&mut data, palette, gamut, &xy, "x, y");

    let [a, b] = axes(&lab);
    let mut marks = field(gamut, CELLS[0], |sample| Some(lab_place(sample)));
    marks.push(outline(&lab, 1.2));
    marks.extend(masstones(subject, palette, gamut, lab_place));
    let title = format!("a*, b* (area {:.0})", lab.area());
    let plane = Panel::new(a, b, marks).with_title(title);

    let white = palette.weights().white();
    let mut marks = field(gamut, CELLS[1], |sample| {
        let xyy = sample.color.xyz.to_xyy(white);
        lit(sample).then_some([xyy.x, xyy.y])
    });
    let locus = spectral_locus(palette.viewing());
    let mut horseshoe: Vec<(f64, f64)> = locus.iter().map(|(_, [x, y])| (*x, *y)).collect();
    horseshoe.extend(horseshoe.first().copied());
    marks.push(Mark::Line { points: horseshoe, color: FAINT, width: 1.2 });
    let mut triangle = srgb_primaries(white).map(|[x, y]| (x, y)).to_vec();
    triangle.extend(triangle.first().copied());
    marks.push(Mark::Dashes { points: triangle, color: SERIES[0] });
    marks.push(outline(&xy, 1.2));
    let tens = locus.iter().filter(|(nm, _)| *nm >= 460.0 && *nm <= 620.0 && nm % 20.0 == 0.0);
    let names = tens.map(|(nm, [x, y])| ((*x, *y), format!("{nm}"))).collect();
    marks.push(Mark::Names { names, around: Vec::new(), color: FAINT });
    let chart = Panel::new(axis("Chromaticity x"), axis("Chromaticity y"), marks)
        .with_key(KeySymbol::Line, FAINT, "spectrum (nm)")
        .with_key(KeySymbol::Dashes, SERIES[0], "sRGB");

    let caption = format!(
        "Each cell has the colour of the lightest of {} mixtures in it: every two pigments at 21 ratios, alone and with {} or the darkest pigment, random mixtures of three and four, and mixtures of neighbours where there were gaps. The line joins the outermost mixture of each of {SECTORS} sectors around grey; it is not a convex hull, and what was not tried may reach a little further. Dots are the pigments by themselves, named from a chroma of {NAMED} on. {} {}.",
        gamut.samples.len(),
        thinner(palette),
        films(palette),
        subject.light()
    );
    let words = Words {
        name: "gamut",
        title: "What the palette can mix",
        caption: &caption,
        alt: "Two fields of colour: the mixtures in a* and b*, and in chromaticity x and y within the spectral locus, with the triangle of sRGB.",
    };
    subject.figure(words, Drawing::Chart(Chart::row(vec![plane, chart], 400.0)), data)
}

fn axis(name: &str) -> Axis {
    Axis { name: name.to_owned(), ..Axis::linear("", "", 0.0, 0.9, 5) }
}

fn lit(sample: &GamutSample) -> bool {
    sample.color.xyz.y >= 0.5
}

fn bands(subject: &Subject<'_>, palette: &Palette<'_>, gamut: &Gamut) -> Figure {
    let whole = gamut.in_lab([0.0, 100.0], SECTORS);
    let [a, b] = axes(&whole);
    let mut data = Table::new(columns(outline_columns("lightness", "a*", "b*")));
    let bands: Vec<[f64; 2]> = BANDS
        .into_iter()
        .filter(|[low, high]: &[f64; 2]| {
            gamut.samples.iter().any(|sample| (*low..=*high).contains(&lightness(sample)))
        })
        .collect();
    let count = bands.len();
    let panels = bands.into_iter().map(|band| {
        let [low, high] = band;
        let title = format!("L* {low} to {high}");
        let edge = gamut.in_lab(band, BAND_SECTORS);
        push_outline(&mut data, palette, gamut, &edge, &title);
        let mut marks = field(gamut, 1.5 * CELLS[0], |sample: &GamutSample| {
            (low..=high).contains(&lightness(sample)).then(|| lab_place(sample))
        });
        marks.push(Mark::Line { points: closed(&whole), color: FAINT, width: HAIR });
        marks.push(outline(&edge, 1.0));
        Panel::new(with(&a), with(&b), marks).with_title(title)
    });
    let caption = "The mixtures of the last figure by lightness, their outline dark, that of all of them thin.";
    let words = Words {
        name: "gamut-lightness",
        title: "What the palette can mix, by lightness",
        caption,
        alt: "Fields of colour in a* and b*, from dark mixtures to light ones.",
    };
    let chart =
        Chart::small_multiples(panels.collect(), count, (870.0 / count as f64 - 10.0).min(400.0));
    subject.figure(words, Drawing::Chart(chart), data)
}

fn with(axis: &Axis) -> Axis {
    Axis { ticks: few(axis), ..axis.clone() }
}

fn few(axis: &Axis) -> Vec<(f64, String)> {
    Axis::linear("", "", axis.low, axis.high, 3).ticks
}

fn lightness(sample: &GamutSample) -> f64 {
    sample.color.lab.lightness
}

fn lab_place(sample: &GamutSample) -> [f64; 2] {
    [sample.color.lab.a, sample.color.lab.b]
}

/// Axes of a* and b* with the same range, so that a circle stays round.
fn axes(whole: &Boundary) -> [Axis; 2] {
    let all = whole.polygon().into_iter().flatten();
    let low = (all.clone().fold(0.0, f64::min) / 20.0 - 0.1).floor() * 20.0;
    let high = (all.fold(0.0, f64::max) / 20.0 + 0.1).ceil() * 20.0;
    ["a*", "b*"].map(|name| Axis { name: name.to_owned(), ..Axis::linear("", "", low, high, 8) })
}

/// Square cells of side `cell`, each in the colour of its lightest sample.
fn field(gamut: &Gamut, cell: f64, place: impl Fn(&GamutSample) -> Option<[f64; 2]>) -> Vec<Mark> {
    let mut lightest: BTreeMap<(i64, i64), &GamutSample> = BTreeMap::new();
    for sample in &gamut.samples {
        let Some([x, y]) = place(sample) else { continue };
        let at = ((x / cell).floor() as i64, (y / cell).floor() as i64);
        let kept = lightest.entry(at).or_insert(sample);
        if sample.color.lab.lightness > kept.color.lab.lightness {
            *kept = sample;
        }
    }
    lightest
        .into_iter()
        .map(|((x, y), sample): ((i64, i64), &GamutSample)| {
            let from = (x as f64 * cell, y as f64 * cell);
            let color = Color::from_rgb(sample.color.srgb);
            Mark::Bar { from, to: (from.0 + cell, from.1 + cell), color }
        })
        .collect()
}

fn closed(boundary: &Boundary) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = boundary.polygon().into_iter().map(|[x, y]| (x, y)).collect();
    points.extend(points.first().copied());
    points
}

fn outline(boundary: &Boundary, width: f64) -> Mark {
    Mark::Line { points: closed(boundary), color: INK, width }
}

/// A dot for each masstone, and a label if its chroma is at least [`NAMED`].
fn masstones(
    subject: &Subject<'_>,
    palette: &Palette<'_>,
    gamut: &Gamut,
    place: impl Fn(&GamutSample) -> [f64; 2],
) -> [Mark; 2] {
    // The masstones are the first samples.
    let all = gamut.samples.iter().zip(palette.paints());
    let named = all.map(|(sample, &paint)| {
        let [x, y] = place(sample);
        ((x, y), subject.label(paint))
    });
    let mut names: Vec<((f64, f64), String)> = named.collect();
    let points: Vec<(f64, f64)> = names.iter().map(|(at, _)| *at).collect();
    let around = points.clone();
    names.retain(|name| chroma(name) >= NAMED);
    names.sort_by(|a, b| chroma(b).total_cmp(&chroma(a)));
    [Mark::Dots { points, color: INK, radius: 2.2 }, Mark::Names { names, around, color: INK }]
}

/// Chroma of a masstone. We label chromatic pigments first, because labels of greys would overlap.
fn chroma(((x, y), _): &((f64, f64), String)) -> f64 {
    x.hypot(*y)
}

fn outline_columns(group: &str, first: &str, second: &str) -> [Column; 5] {
    [
        Column::text(group),
        Column::quantity("angle from", "degrees", 0),
        Column::quantity(first, "1", 4),
        Column::quantity(second, "1", 4),
        Column::text("mixture"),
    ]
}

/// Appends the outermost sample of each sector to `data`, with `group` in the first column.
fn push_outline(
    data: &mut Table,
    palette: &Palette<'_>,
    gamut: &Gamut,
    boundary: &Boundary,
    group: &str,
) {
    let width = 360.0 / boundary.sectors.len() as f64;
    for (sector, outer) in boundary.sectors.iter().enumerate() {
        let Some(([x, y], index)) = *outer else { continue };
        let sample = &gamut.samples[index];
        let own: [Cell; 5] = [
            group.into(),
            (sector as f64 * width).into(),
            x.into(),
            y.into(),
            palette.recipe_label(&sample.recipe).into(),
        ];
        data.push(row(own, &sample.color));
    }
}

/// Parts of white to one part of pigment in the tint next to the masstone.
const TINT: f64 = 3.0;
/// A metameric pair has at most this CIEDE2000 difference under the first light (chosen by eye).
const ALIKE: f64 = 2.0;
/// We show at most this many metameric pairs.
const PAIRS: usize = 8;

pub(crate) fn lights_section(subject: &Subject<'_>) -> Section {
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

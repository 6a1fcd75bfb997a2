//! Section on the gamut of a palette.

use std::collections::BTreeMap;

use calibrate::palette::{
    Boundary, Gamut, GamutSample, Palette, sampled_gamut, spectral_locus, srgb_primaries,
};

use super::cells::{columns, row};
use super::context::{films, palette, thinner};
use crate::axis::Axis;
use crate::figure::{Drawing, Figure, Words};
use crate::panel::{Chart, KeySymbol, Mark, Panel};
use crate::style::{Color, FAINT, HAIR, INK, SERIES};
use crate::subject::{Section, Subject};
use crate::table::{Cell, Column, Table};

/// Number of sectors of an outline.
const SECTORS: usize = 72;
/// Side of a cell in units of a*, b*, and in units of x, y.
const CELLS: [f64; 2] = [4.0, 0.015];
/// Number of sectors in the outline of a band of lightness, which has fewer samples.
const BAND_SECTORS: usize = 36;
/// Minimum chroma of masstones that are labelled.
const NAMED: f64 = 12.0;
/// Bands of L*.
const BANDS: [[f64; 2]; 5] = [[0.0, 20.0], [20.0, 40.0], [40.0, 60.0], [60.0, 80.0], [80.0, 100.0]];

pub(crate) fn section(subject: &Subject<'_>) -> Section {
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

    let chromaticity = |sample: &GamutSample| {
        let white = palette.weights().white();
        let xyy = sample.color.xyz.to_xyy(white);
        [xyy.x, xyy.y]
    };
    let lit = |sample: &GamutSample| sample.color.xyz.y >= 0.5;
    let mut marks = field(gamut, CELLS[1], |sample| lit(sample).then(|| chromaticity(sample)));
    let locus = spectral_locus(palette.viewing());
    let mut horseshoe: Vec<(f64, f64)> = locus.iter().map(|(_, [x, y])| (*x, *y)).collect();
    horseshoe.extend(horseshoe.first().copied());
    marks.push(Mark::Line { points: horseshoe, color: FAINT, width: 1.2 });
    let mut triangle = srgb_primaries(palette.weights().white()).map(|[x, y]| (x, y)).to_vec();
    triangle.extend(triangle.first().copied());
    marks.push(Mark::Dashes { points: triangle, color: SERIES[0] });
    marks.push(outline(&xy, 1.2));
    let tens = locus.iter().filter(|(nm, _)| *nm >= 460.0 && *nm <= 620.0 && nm % 20.0 == 0.0);
    let names = tens.map(|(nm, [x, y])| ((*x, *y), format!("{nm}"))).collect();
    marks.push(Mark::Names { names, around: Vec::new(), color: FAINT });
    let axis = |name: &str| Axis { name: name.to_owned(), ..Axis::linear("", "", 0.0, 0.9, 5) };
    let chart = Panel::new(axis("Chromaticity x"), axis("Chromaticity y"), marks)
        .with_key(KeySymbol::Line, FAINT, "spectrum (nm)")
        .with_key(KeySymbol::Dashes, SERIES[0], "sRGB");

    let caption = format!(
        "Each cell has the colour of the lightest of {} mixtures in it: every two pigments at 21 ratios, alone and with {} or the darkest pigment, random mixtures of three and four, and mixtures of neighbours where there were gaps. The line joins the outermost mixture of each of {SECTORS} sectors around grey; it is no convex hull, and what was not tried may reach a little further. Dots are the pigments by themselves, named from a chroma of {NAMED} on. {} {}.",
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

fn bands(subject: &Subject<'_>, palette: &Palette<'_>, gamut: &Gamut) -> Figure {
    let whole = gamut.in_lab([0.0, 100.0], SECTORS);
    let [a, b] = axes(&whole);
    let mut data = Table::new(columns(outline_columns("lightness", "a*", "b*")));
    let lightness = |sample: &GamutSample| sample.color.lab.lightness;
    let held = |[low, high]: &[f64; 2]| {
        gamut.samples.iter().any(|sample| (*low..=*high).contains(&lightness(sample)))
    };
    let bands: Vec<[f64; 2]> = BANDS.into_iter().filter(held).collect();
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
        let few = |axis: &Axis| Axis::linear("", "", axis.low, axis.high, 3).ticks;
        let with = |axis: &Axis| Axis { ticks: few(axis), ..axis.clone() };
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

fn lab_place(sample: &GamutSample) -> [f64; 2] {
    [sample.color.lab.a, sample.color.lab.b]
}

/// Axes of a* and b* with one range, so that a circle stays round.
fn axes(whole: &Boundary) -> [Axis; 2] {
    let all = || whole.polygon().into_iter().flatten();
    let low = (all().fold(0.0, f64::min) / 20.0 - 0.1).floor() * 20.0;
    let high = (all().fold(0.0, f64::max) / 20.0 + 0.1).ceil() * 20.0;
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
    // Labels of greys would overlap; chromatic pigments come first.
    let far = |((x, y), _): &((f64, f64), String)| x.hypot(*y);
    names.retain(|name| far(name) >= NAMED);
    names.sort_by(|a, b| far(b).total_cmp(&far(a)));
    [Mark::Dots { points, color: INK, radius: 2.2 }, Mark::Names { names, around, color: INK }]
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

/// Appends the outermost sample of each sector to `data`; `group` goes into the first column.
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

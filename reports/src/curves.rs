//! Section with K and S of each pigment and their standard deviations.

use crate::axis::{Axis, Scale};
use crate::figure::{Drawing, Figure, Words};
use crate::panel::{Chart, Mark, Panel};
use crate::style::{CURVE, FAINT};
use crate::subject::{Section, Subject};
use crate::table::{Cell, Column, Table};

const COLUMNS: usize = 5;

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    Section::new("Absorption and scattering")
        .with_figure(absorption(subject))
        .with_figure(scattering(subject))
}

fn absorption(subject: &Subject<'_>) -> Figure {
    figure(
        subject,
        &Curves {
            words: Words {
                name: "absorption",
                title: "Absorption K of every pigment",
                caption: "Each curve has the colour of its pigment; the band is one standard deviation either way. The axis is logarithmic; what lies below it stands at its foot.",
                alt: "Small charts of absorption over wavelength, one for each pigment.",
            },
            quantity: "absorption K",
            of: |pigment| (&pigment.absorption, &pigment.absorption_sd),
            axis: |unit, low, high| Axis::log("Absorption K", unit, low, high, 7),
        },
    )
}

fn scattering(subject: &Subject<'_>) -> Figure {
    figure(
        subject,
        &Curves {
            words: Words {
                name: "scattering",
                title: "Scattering S of every pigment",
                caption: "Each curve has the colour of its pigment; the band is one standard deviation either way. The axis is logarithmic; what lies below it stands at its foot. Where S is unknown, the line at 1 stands in for it.",
                alt: "Small charts of scattering over wavelength, one for each pigment.",
            },
            quantity: "scattering S",
            of: |pigment| (&pigment.scattering, &pigment.scattering_sd),
            axis: |unit, low, high| Axis::log("Scattering S", unit, low, high, 6),
        },
    )
}

struct Curves<'a> {
    words: Words<'a>,
    quantity: &'a str,
    of: fn(&calibrate::library::Pigment) -> (&Vec<f64>, &Vec<f64>),
    axis: fn(&str, f64, f64) -> Axis,
}

fn figure(subject: &Subject<'_>, curves: &Curves<'_>) -> Figure {
    let library = subject.library;
    let unit = subject.unit();
    let all = || library.pigments.iter().flat_map(|pigment| (curves.of)(pigment).0.iter().copied());
    let high = all().fold(0.0, f64::max);
    let low = all().filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min);
    let y = (curves.axis)(&unit, low, high);
    debug_assert_eq!(y.scale, Scale::Log, "bands are cut at the foot of a log axis");
    let x = Axis::wavelength(library.grid, 100);
    let mut data = Table::new([
        Column::text("pigment"),
        Column::quantity("wavelength", "nm", 0),
        Column::quantity(curves.quantity, &unit, 4),
        Column::quantity("standard deviation", &unit, 4),
    ]);
    let panels = library.ids().map(|id| {
        let (values, deviations) = (curves.of)(&library[id]);
        let name = subject.label(id);
        let mut edges = Vec::new();
        for (at, nm) in library.grid.wavelengths_nm().enumerate() {
            let value = values[at];
            let sd = deviations.get(at).copied();
            data.push([name.as_str().into(), nm.into(), value.into(), Cell::from(sd)]);
            edges.extend(sd.map(|sd| (nm, value - sd, value + sd)));
        }
        let color = subject.masstone(id);
        let points = library.grid.wavelengths_nm().zip(values.iter().copied()).collect();
        let mut marks = Vec::new();
        if !edges.is_empty() {
            marks.push(Mark::band(&edges, color.for_line()));
        }
        let color = color.for_line();
        marks.push(if subject.mark(id).is_none() {
            Mark::Line { points, color, width: CURVE }
        } else {
            Mark::Dashes { points, color }
        });
        if let Some(mark) = subject.mark(id) {
            let corner = (x.low, 0.3 * y.high);
            let names = vec![(corner, mark.to_owned())];
            marks.push(Mark::Names { names, around: Vec::new(), color: FAINT });
        }
        let patch = [subject.masstone(id)];
        let pigment = &library[id];
        Panel::new(x.clone(), y.clone(), marks)
            .with_title(pigment.name.as_str())
            .with_patches(patch)
    });
    let panels: Vec<Panel> = panels.collect();
    let chart = Chart::small_multiples(panels, COLUMNS, 110.0);
    subject.figure(curves.words, Drawing::Chart(chart), data)
}

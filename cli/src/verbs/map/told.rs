//! Text of a survey and its maps.

use maps::pictures::Overview;
use maps::pixel_maps::Mask;
use maps::{FoundColumn, Spot, SurveyedScan};

use crate::console::Console;
use crate::failure::Result;

/// Part of the surveyed pixels below which a pigment is not named in the text.
const NAMED: f64 = 0.001;

/// Place of a pigment in the maps.
fn place<'a>(found: &FoundColumn, mapped: Option<&'a Overview>) -> Option<(&'a Overview, usize)> {
    let overview = mapped?;
    let place = overview.pigments.iter().position(|name| *name == found.column.name)?;
    Some((overview, place))
}

/// Pigments and residual of each spot, a line each.
pub(super) fn print_spots(spots: &[Spot], console: &mut Console<'_>) -> Result<()> {
    for spot in spots {
        let each = spot.pigments.iter().map(|pigment| {
            let [share, sd] = [pigment.share, pigment.share_sd].map(|part| 100.0 * part);
            format!("{} {share:.0} +- {sd:.0} %", pigment.name)
        });
        console.line(format!(
            "{}: {}; residual {:.4}, chi-square {:.2}",
            place_name(spot),
            each.collect::<Vec<_>>().join(", "),
            spot.rms,
            spot.chi2
        ))?;
    }
    Ok(())
}

/// Words for the place of a spot.
pub(super) fn place_name(spot: &Spot) -> String {
    let part = |name: &str, range: &std::ops::Range<usize>| match range.len() {
        1 => format!("{name} {}", range.start),
        _ => format!("{name}s {}..{}", range.start, range.end),
    };
    format!("{}, {}", part("row", &spot.region.rows), part("column", &spot.region.columns))
}

pub(super) fn print(
    scan: &SurveyedScan,
    mapped: Option<&Overview>,
    console: &mut Console<'_>,
) -> Result<()> {
    let cube = scan.cube();
    let [first, last] = [cube.wavelengths_nm().first(), cube.wavelengths_nm().last()];
    console.line(format!(
        "{} x {} pixels, {} from {} to {} nm; {} searched",
        cube.lines(),
        cube.samples(),
        spectra::counted(cube.wavelengths_nm().len(), "band"),
        first.copied().unwrap_or_default(),
        last.copied().unwrap_or_default(),
        spectra::counted(scan.book().entries.len(), "pixel"),
    ))?;
    for column in scan.mapper().columns().iter().filter(|column| column.pigments.len() > 1) {
        let alike = column.pigments.join(", ");
        console.line(format!("mapped as one: {alike}"))?;
    }
    let palette = scan.palette();
    let named: Vec<&FoundColumn> = palette.iter().filter(|found| found.part >= NAMED).collect();
    let width = named.iter().map(|found| found.column.name.chars().count()).max().unwrap_or(0);
    let width = width.max("pigment".len());
    let headings = if mapped.is_some() { "  survey  present  mean share" } else { "  survey" };
    console.line(format!("{:width$}{headings}", "pigment"))?;
    for found in named {
        let mut line = format!("{:width$}  {:4.1} %", found.column.name, 100.0 * found.part);
        if let Some((overview, place)) = place(found, mapped) {
            let [present, share] = [overview.present[place], overview.mean_share[place]];
            line += &format!("   {:4.1} %      {:4.1} %", 100.0 * present, 100.0 * share);
        }
        console.line(line)?;
    }
    let Some(overview) = mapped else { return Ok(()) };
    for mask in Mask::ALL.into_iter().filter(|mask| *mask != Mask::Mapped) {
        let count = overview.pixels.of(mask);
        if count > 0 {
            let all = overview.pixels.all();
            console.line(format!("not mapped: {count} of {all} pixels, {}", mask.name()))?;
        }
    }
    Ok(())
}

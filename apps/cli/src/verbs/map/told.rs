//! Text of a survey and its maps.

use maps::pictures::Overview;
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
        console.line(spot.words())?;
    }
    Ok(())
}

pub(super) fn print(
    scan: &SurveyedScan,
    mapped: Option<&Overview>,
    console: &mut Console<'_>,
) -> Result<()> {
    console.line(scan.words())?;
    for line in scan.group_words() {
        console.line(line)?;
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
    for line in overview.unmapped_words() {
        console.line(line)?;
    }
    Ok(())
}

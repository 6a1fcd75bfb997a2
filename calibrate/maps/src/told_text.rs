//! Words about a surveyed scan and its maps, which the program and the pages show.

use std::ops::Range;

use crate::pictures::Overview;
use crate::pixel_maps::Mask;
use crate::spot::Spot;
use crate::surveyed::SurveyedScan;

impl SurveyedScan {
    /// Sizes, bands and number of searched pixels of the scan.
    #[must_use]
    pub fn words(&self) -> String {
        let cube = self.cube();
        let ends = [cube.wavelengths_nm().first(), cube.wavelengths_nm().last()];
        let [first, last] = ends.map(|end| end.copied().unwrap_or_default());
        format!(
            "{} x {} pixels, {} from {first} to {last} nm; {} searched",
            cube.lines(),
            cube.samples(),
            documents::counted(cube.wavelengths_nm().len(), "band"),
            documents::counted(self.book().entries.len(), "pixel"),
        )
    }

    /// A line for each group of pigments that are mapped as one.
    #[must_use]
    pub fn group_words(&self) -> Vec<String> {
        let groups = self.mapper().columns().iter().filter(|column| column.pigments.len() > 1);
        groups.map(|column| format!("mapped as one: {}", column.pigments.join(", "))).collect()
    }
}

impl Overview {
    /// A line for each reason why pixels are not mapped.
    #[must_use]
    pub fn unmapped_words(&self) -> Vec<String> {
        let all = self.pixels.all();
        let others = Mask::ALL.into_iter().filter(|mask| *mask != Mask::Mapped);
        let counted = others.map(|mask| (mask, self.pixels.of(mask))).filter(|(_, n)| *n > 0);
        counted
            .map(|(mask, count)| format!("not mapped: {count} of {all} pixels, {}", mask.name()))
            .collect()
    }
}

impl Spot {
    /// Place of the spot.
    #[must_use]
    pub fn place_words(&self) -> String {
        let part = |name: &str, range: &Range<usize>| match range.len() {
            1 => format!("{name} {}", range.start),
            _ => format!("{name}s {}..{}", range.start, range.end),
        };
        format!("{}, {}", part("row", &self.region.rows), part("column", &self.region.columns))
    }

    /// Place, pigments and residual.
    #[must_use]
    pub fn words(&self) -> String {
        let each = self.pigments.iter().map(|pigment| {
            let [share, sd] = [pigment.share, pigment.share_sd].map(|part| 100.0 * part);
            format!("{} {share:.0} +- {sd:.0} %", pigment.name)
        });
        format!(
            "{}: {}; residual {:.4}, chi-square {:.2}",
            self.place_words(),
            each.collect::<Vec<_>>().join(", "),
            self.rms,
            self.chi2
        )
    }
}

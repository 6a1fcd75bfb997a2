//! A surveyed scan and its maps as JSON, and as lines of text. The program and the pages show both.

use std::ops::Range;

use serde_json::{Map, Value, json};

use crate::pictures::Overview;
use crate::pixel_maps::Mask;
use crate::surveyed::{FoundColumn, Spot, SpotPigment, SurveyedScan};

impl SurveyedScan {
    /// The survey as JSON: scan, hashes, settings, groups and palette. If you pass finished maps,
    /// this adds the number of pixels by mask, and if you pass spots, it adds them too.
    #[must_use]
    pub fn to_json(&self, mapped: Option<&Overview>, spots: &[Spot]) -> Value {
        let about = self.about();
        let grouped = self.mapper().columns().iter().filter(|column| column.pigments.len() > 1);
        let groups: Map<String, Value> =
            grouped.map(|column| (column.name.clone(), json!(column.pigments))).collect();
        let pixels = mapped.map(|overview| {
            let each = Mask::ALL.iter().map(|mask| (mask.name(), overview.pixels.of(*mask)));
            each.map(|(name, count)| (name.to_owned(), json!(count))).collect::<Map<_, _>>()
        });
        json!({
            "scan": {
                "lines": self.cube().lines(),
                "samples": self.cube().samples(),
                "wavelengths_nm": self.cube().wavelengths_nm(),
                "sign": about.scan,
            },
            "library_sha256": about.library_sha256,
            "survey_sha256": about.book_sha256,
            "settings": about.settings,
            "effective_bands": self.mapper().effective_bands(),
            "usual_chi2": self.book().usual_chi2,
            "groups": groups,
            "left_out": self.mapper().left_out(),
            "palette": self.palette_json(mapped),
            "pixels": pixels,
            "spots": spots.iter().map(Spot::to_json).collect::<Vec<Value>>(),
        })
    }

    /// An object for each pigment or group, the most frequent first: `survey_part`, and for
    /// finished maps the parts `present` and `mean_share`.
    #[must_use]
    pub fn palette_json(&self, mapped: Option<&Overview>) -> Vec<Value> {
        self.palette()
            .iter()
            .map(|found: &FoundColumn| {
                let mut entry = json!({
                    "pigment": found.column.name,
                    "survey_part": found.part,
                });
                if let Some(overview) = mapped
                    && let mut names = overview.pigments.iter()
                    && let Some(place) = names.position(|name| *name == found.column.name)
                {
                    entry["present"] = json!(overview.present[place]);
                    entry["mean_share"] = json!(overview.mean_share[place]);
                }
                entry
            })
            .collect()
    }

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

    /// A line for each group of pigments that we map as one.
    #[must_use]
    pub fn group_words(&self) -> Vec<String> {
        let groups = self.mapper().columns().iter().filter(|column| column.pigments.len() > 1);
        groups.map(|column| format!("mapped as one: {}", column.pigments.join(", "))).collect()
    }
}

impl Overview {
    /// A line for each reason why we do not map pixels.
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
    /// The spot as JSON: place, pigments with their shares, residuals, and both spectra.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let pigments = self.pigments.iter().map(SpotPigment::to_json);
        json!({
            "rows": [self.region.rows.start, self.region.rows.end],
            "columns": [self.region.columns.start, self.region.columns.end],
            "pixels": self.pixels,
            "pigments": pigments.collect::<Vec<Value>>(),
            "chi2": self.chi2,
            "rms": self.rms,
            "measured_nm": self.measured_nm,
            "measured": self.measured,
            "mapped_nm": self.mapped_nm,
            "mapped": self.mapped,
        })
    }

    /// Place of the spot.
    #[must_use]
    pub fn place_words(&self) -> String {
        format!(
            "{}, {}",
            range_words("row", &self.region.rows),
            range_words("column", &self.region.columns)
        )
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

impl SpotPigment {
    /// The pigment with share, deviation and probability as JSON.
    #[must_use]
    pub fn to_json(&self) -> Value {
        json!({
            "pigment": self.name,
            "share": self.share,
            "share_sd": self.share_sd,
            "presence": self.presence,
        })
    }
}

/// A share in percent, with a decimal where it is below 1 %.
pub(crate) fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0".to_owned(),
        trace if trace < 0.05 => "<0.1".to_owned(),
        small if small < 0.95 => format!("{small:.1}"),
        other => format!("{other:.0}"),
    }
}

/// Names with their shares in percent.
pub(crate) fn parts_words(parts: &[(String, f64)]) -> String {
    let each = parts.iter().map(|(name, share)| format!("{name} {} %", percent(*share)));
    each.collect::<Vec<_>>().join(", ")
}

fn range_words(name: &str, range: &Range<usize>) -> String {
    match range.len() {
        1 => format!("{name} {}", range.start),
        _ => format!("{name}s {}..{}", range.start, range.end),
    }
}

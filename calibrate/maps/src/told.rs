//! A surveyed scan and its maps as JSON for programs.

use serde_json::{Map, Value, json};

use crate::pictures::Overview;
use crate::pixel_maps::Mask;
use crate::spot::Spot;
use crate::surveyed::{FoundColumn, SurveyedScan};

impl SurveyedScan {
    /// The survey as JSON: scan, hashes, settings, groups and palette; of finished maps also the pixels by
    /// the mask that each has; and spots, if any were asked for.
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
            "palette": self.palette_json(mapped),
            "pixels": pixels,
            "spots": spots.iter().map(Spot::to_json).collect::<Vec<Value>>(),
        })
    }

    /// An object for each pigment or group, the most frequent first: `survey_part`, and of finished maps
    /// the parts `present` and `mean_share`.
    #[must_use]
    pub fn palette_json(&self, mapped: Option<&Overview>) -> Vec<Value> {
        let entry = |found: &FoundColumn| {
            let mut entry = json!({
                "pigment": found.column.name,
                "survey_part": found.part,
            });
            let of = |overview: &Overview| {
                overview.pigments.iter().position(|name| *name == found.column.name)
            };
            if let Some((overview, place)) = mapped.and_then(|o| Some((o, of(o)?))) {
                entry["present"] = json!(overview.present[place]);
                entry["mean_share"] = json!(overview.mean_share[place]);
            }
            entry
        };
        self.palette().iter().map(entry).collect()
    }
}

impl Spot {
    /// The spot as JSON: place, pigments with their shares, residuals, and both spectra.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let pigments = self.pigments.iter().map(|pigment| {
            json!({
                "pigment": pigment.name,
                "share": pigment.share,
                "share_sd": pigment.share_sd,
                "presence": pigment.presence,
            })
        });
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
}

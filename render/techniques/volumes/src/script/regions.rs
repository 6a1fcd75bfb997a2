//! Regions of a script: names, and how their volumes show what they hold.

use documents::similar_names;
use spectra::color::Rgb;

use super::file::Script;
use super::ranges::check_name;
use super::tables::RegionTable;
use crate::settings::{Inside, Settings, check_shells, even_tints};
use crate::toml_text::{Checked, Fault, KeyPath};

/// How the volumes of a region show what they hold.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionStyle {
    /// Its name; empty for the only region of a script that lists none.
    pub name: String,
    /// Appearance of the scene inside of its volumes.
    pub inside: Inside,
    /// Sizes of the shells, falling from 1.
    pub shells: Vec<f32>,
    /// Share of colour by the number of shells, one more than there are shells.
    pub tints: Vec<f32>,
    /// Colour that the drawing is multiplied by inside, below the share of colour: `#rrggbb`, white
    /// for a drawing that stays grey.
    pub stain: String,
}

impl Script {
    /// The regions in order, at least one. `settings` give what a region leaves out.
    #[must_use]
    pub fn region_styles(&self, settings: &Settings) -> Vec<RegionStyle> {
        let unnamed = [RegionTable::default()];
        let regions = if self.regions.is_empty() { &unnamed } else { &self.regions[..] };
        let narrow = |list: &[f64]| list.iter().map(|&value| value as f32).collect::<Vec<_>>();
        let style = |region: &RegionTable| {
            let drawing = &settings.drawing;
            let shells = region.shells.as_deref().map_or(drawing.shells.clone(), narrow);
            let tints = match (&region.tint, &region.shells) {
                (Some(tint), _) => narrow(tint),
                (None, Some(_)) => Vec::new(),
                (None, None) => drawing.tint.clone(),
            };
            let even = || narrow(&even_tints(shells.len()));
            let tints = if tints.is_empty() { even() } else { tints };
            let inside = region.inside.unwrap_or(drawing.inside);
            let stain = region.stain.as_ref().unwrap_or(&drawing.stain).clone();
            RegionStyle { name: region.name.clone(), inside, shells, tints, stain }
        };
        regions.iter().map(style).collect()
    }

    /// Index of the region with this name; the first without a name.
    pub(super) fn region_index(&self, name: Option<&str>) -> Option<usize> {
        match name {
            None => Some(0),
            Some(name) => self.regions.iter().position(|region| region.name == name),
        }
    }

    pub(super) fn check_region_name(&self, table: &KeyPath, name: Option<&str>) -> Checked {
        if self.region_index(name).is_some() {
            return Ok(());
        }
        let name = name.unwrap_or_default();
        let names: Vec<&str> = self.regions.iter().map(|region| region.name.as_str()).collect();
        let similar = similar_names(name, names.iter().copied());
        let hint = match (similar.is_empty(), names.is_empty()) {
            (false, _) => format!("did you mean {}?", similar.join(" or ")),
            (true, false) => format!("regions are {}", documents::name_list(&names, 8, ", ")),
            (true, true) => format!("add [[region]] with name = \"{}\"", name.escape_debug()),
        };
        Err(Fault::new(&table.key("region"), "the name of a [[region]]", name, hint))
    }

    pub(super) fn check_regions(&self, settings: &Settings) -> Checked {
        let plain = |list: &[f32]| list.iter().map(|&value| f64::from(value)).collect::<Vec<_>>();
        let shells = plain(&settings.drawing.shells);
        let tints = plain(&settings.drawing.tint);
        for (index, region) in self.regions.iter().enumerate() {
            let table = KeyPath::of("region").index(index);
            check_name(&table.key("name"), &region.name)?;
            if self.region_index(Some(&region.name)) != Some(index) {
                let hint = "give each region its own name";
                let wanted = "a name that no other region has";
                return Err(Fault::new(&table.key("name"), wanted, &region.name, hint));
            }
            let tint = match (&region.tint, &region.shells) {
                (Some(tint), _) => &tint[..],
                (None, Some(_)) => &[],
                (None, None) => &tints,
            };
            if let Some(stain) = region.stain.as_ref().filter(|own| Rgb::from_hex(own).is_none()) {
                let key = table.key("stain");
                let hint = "#ffffff leaves the drawing grey";
                return Err(Fault::new(
                    &key,
                    "a colour written #rrggbb",
                    stain.escape_debug(),
                    hint,
                ));
            }
            check_shells(&table, region.shells.as_deref().unwrap_or(&shells), tint)?;
        }
        Ok(())
    }
}

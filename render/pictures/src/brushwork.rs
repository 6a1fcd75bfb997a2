//! The brushwork of a subject: maps from files or made of a style, and the parts that each is for.

use std::path::{Path, PathBuf};

use artmap::{
    map::ArtMap,
    painted::{PaintedSettings, Style, SwatchPainter},
    synthesis::SynthesisSettings,
};
use documents::{Task, text::is_toml};
use paint::technique::Technique;
use painterly::{Brushwork, Region, RegionArea, Regions};

use crate::error::{PictureError, SettingError};
use crate::request::PainterlyRequest;

/// Name of the regions that the request gives by its key `map`, not by a file. It is part of the
/// digest of all frames, so a new name would make finished frames invalid.
const OF_KEY: &str = concat!("-", "-map");

/// The maps with their names. Regions refer to a map by its name.
#[derive(Debug)]
pub(crate) struct Maps {
    named: Vec<(String, ArtMap)>,
    regions: Regions,
}

/// The maps that a request names: one for everything, and one for each material that has its own.
struct Chosen<'a> {
    base: Option<&'a str>,
    of_material: Vec<(&'a str, &'a str)>,
}

impl PainterlyRequest {
    /// Files that the maps are made from.
    pub(crate) fn map_files(&self) -> Vec<PathBuf> {
        let style = self.style.iter().filter(|style| is_toml(Path::new(style))).cloned();
        let maps = self.map.iter().map(|map| file_of(map).1.to_owned());
        maps.chain(style).map(PathBuf::from).chain(self.regions.clone()).collect()
    }

    /// Reads the maps and regions. If the request names no map, this makes one of its style or,
    /// without a style, of the style `usual`.
    pub(crate) fn maps(&self, usual: &str, task: &Task) -> Result<Maps, PictureError> {
        let chosen = self.chosen()?;
        let mut regions = match &self.regions {
            Some(path) => Regions::open(path)?,
            None => Regions { name: OF_KEY.to_owned(), ..Regions::default() },
        };
        for (material, file) in chosen.of_material {
            let area = RegionArea::Material(material.to_owned());
            let region = Region::new(&format!("{OF_KEY} {material}"), area);
            regions.list.push(Region { map: Some(file.to_owned()), ..region });
        }
        let base = match chosen.base {
            Some(file) => ArtMap::open(Path::new(file))?,
            None => styled(self.style.as_deref().unwrap_or(usual), task)?,
        };
        let mut named = vec![(String::new(), base)];
        for name in regions.list.iter().filter_map(|region| region.map.as_deref()) {
            if named.iter().all(|(other, _)| other != name) {
                named.push((name.to_owned(), self.map_of_region(name, task)?));
            }
        }
        Ok(Maps { named, regions })
    }

    /// The map that a region names. `name` is a file beside the file of regions, or else a path as
    /// in the request, or else a style.
    fn map_of_region(&self, name: &str, task: &Task) -> Result<ArtMap, PictureError> {
        let folder = self.regions.as_deref().and_then(Path::parent);
        let beside = folder.map(|folder| folder.join(name)).filter(|path| path.exists());
        let path = beside.unwrap_or_else(|| PathBuf::from(name));
        match !path.exists() && Style::named(name).is_ok() {
            true => styled(name, task),
            false => Ok(ArtMap::open(&path)?),
        }
    }

    fn chosen(&self) -> Result<Chosen<'_>, SettingError> {
        let files: Vec<(Option<&str>, &str)> = self.map.iter().map(|text| file_of(text)).collect();
        let base = files.iter().filter(|(material, _)| material.is_none());
        let base: Vec<&str> = base.map(|(_, file)| *file).collect();
        if base.len() + usize::from(self.style.is_some()) > 1 {
            return Err(SettingError::whole(
                "two maps are for the same parts",
                "give one [map] or [style] for everything, and [map=MATERIAL=FILE] for parts",
            ));
        }
        let of_material =
            files.iter().filter_map(|&(material, file)| Some((material?, file))).collect();
        Ok(Chosen { base: base.first().copied(), of_material })
    }
}

impl Maps {
    /// The brushwork for a painter.
    pub(crate) fn brushwork(&self) -> Brushwork<'_> {
        let maps = self.named.iter().map(|(name, map)| (name.as_str(), map)).collect();
        Brushwork { maps, regions: self.regions.clone() }
    }
}

/// The style of samples that ships with this name, or the style in a file, with its path.
///
/// # Errors
/// [`PictureError::Style`] if there is no such style, or the file has a fault.
pub fn style_of(named: &Path) -> Result<(Style, Option<PathBuf>), PictureError> {
    if is_toml(named) {
        return Ok((Style::open(named)?, Some(named.to_owned())));
    }
    Ok((Style::named(&named.to_string_lossy())?, None))
}

/// A map of samples painted in a style.
fn styled(style: &str, task: &Task) -> Result<ArtMap, PictureError> {
    let (style, _) = style_of(Path::new(style))?;
    let colors = PaintedSettings::default();
    let samples = SwatchPainter::prepare(&colors, &style, task)?.paint((), task)?;
    task.stage("painting samples");
    task.check()?;
    Ok(ArtMap::of(&samples, &SynthesisSettings::default())?)
}

/// Splits a text `[MATERIAL=]FILE` into the material, if there is one, and the file.
fn file_of(text: &str) -> (Option<&str>, &str) {
    match text.split_once('=') {
        Some((material, file)) if !Path::new(text).exists() => (Some(material), file),
        _ => (None, text),
    }
}

//! The brushwork of a subject: maps from files or made of a style, and the parts that each is for.

use std::path::{Path, PathBuf};

use artmap::{
    map::ArtMap,
    painted::{PaintedSettings, Style, SwatchPainter},
    synthesis::SynthesisSettings,
};
use documents::{
    Task,
    file::{NamedFiles, Outside},
    text::is_toml,
};
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

/// The regions of a subject, and the maps that their file names.
#[derive(Debug, Default)]
pub(crate) struct OpenRegions {
    regions: Regions,
    /// Maps by their names in the file. A style has no file.
    maps: Vec<(String, PathBuf)>,
    labels: Vec<PathBuf>,
}

impl OpenRegions {
    /// Files that the file of regions names.
    pub(crate) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.labels.iter().chain(self.maps.iter().map(|(_, file)| file))
    }
}

impl PainterlyRequest {
    /// Reads the file of regions, if there is one, and finds the files that it names. The name of a map is a file
    /// beside the file of regions, or else a path as in the request, or else a style.
    pub(crate) fn open_regions(&self, outside: Outside) -> Result<OpenRegions, PictureError> {
        let Some(path) = &self.regions else {
            let regions = Regions { name: OF_KEY.to_owned(), ..Regions::default() };
            return Ok(OpenRegions { regions, ..OpenRegions::default() });
        };
        let mut files = NamedFiles::of(path, outside);
        let regions = Regions::open(path, &mut files)?;
        let labels = files.found().to_vec();
        let mut maps = Vec::new();
        let folder = path.parent().unwrap_or(Path::new(""));
        for name in regions.list.iter().filter_map(|region| region.map.as_deref()) {
            let own = Path::new(name);
            let found = match (folder.join(name).exists(), own.exists()) {
                (true, _) => files.find("map", name)?,
                (false, true) => {
                    let whole = std::path::absolute(own).unwrap_or_else(|_| own.to_owned());
                    files.find("map", &whole.to_string_lossy())?
                }
                _ => continue,
            };
            maps.push((name.to_owned(), found));
        }
        Ok(OpenRegions { regions, maps, labels })
    }

    /// Files that the maps are made from.
    pub(crate) fn map_files(&self) -> Vec<PathBuf> {
        let style = self.style.iter().filter(|style| is_toml(Path::new(style))).cloned();
        let maps = self.map.iter().map(|map| file_of(map).1.to_owned());
        maps.chain(style).map(PathBuf::from).chain(self.regions.clone()).collect()
    }

    /// Reads the maps. If the request names no map, this makes one of its style or, without a style, of the style
    /// `usual`.
    pub(crate) fn maps(
        &self,
        open: OpenRegions,
        usual: &str,
        task: &Task,
    ) -> Result<Maps, PictureError> {
        let chosen = self.chosen()?;
        let OpenRegions { mut regions, maps, .. } = open;
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
                let file = maps.iter().find(|(other, _)| other == name).map(|(_, file)| file);
                named.push((name.to_owned(), map_of_region(name, file, task)?));
            }
        }
        Ok(Maps { named, regions })
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

/// The map that a region names: its `file`, or else a path of the request, or else a style.
fn map_of_region(name: &str, file: Option<&PathBuf>, task: &Task) -> Result<ArtMap, PictureError> {
    let path = file.map_or(Path::new(name), PathBuf::as_path);
    match !path.exists() && Style::named(name).is_ok() {
        true => styled(name, task),
        false => Ok(ArtMap::open(path)?),
    }
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

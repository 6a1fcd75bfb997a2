//! Options for the brushwork: maps from files or painted in a style, and the regions they are for.

use std::path::{Path, PathBuf};

use artmap::map::ArtMap;
use artmap::painted::{PaintedSettings, Style, painted_samples};
use artmap::synthesis::SynthesisSettings;
use clap::Args;
use painterly::{Brushwork, Region, RegionArea, Regions};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::is_toml;
use crate::progress::Waiting;

#[derive(Debug, Args)]
#[command(next_help_heading = "Brushwork")]
pub(super) struct BrushworkOptions {
    /// The map (.exr, as `artmap build` writes it). MATERIAL=FILE is for the parts of a model with
    /// that material; may be repeated
    #[arg(long, value_name = "[MATERIAL=]FILE")]
    map: Vec<String>,
    /// Paint samples in this style and make a map of them, with the defaults of `artmap paint` and
    /// `artmap build`: oil-flat, oil-long, dabs, knife, hatching, dry-brush, or a file (.toml)
    /// [default: that of the preset, or oil-flat]
    #[arg(long, value_name = "NAME|FILE")]
    style: Option<String>,
    /// Regions with a map, direction, size, flow or tones of their own (.toml)
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
}

/// Maps with the names by which regions call them.
pub(super) struct Maps {
    named: Vec<(String, ArtMap)>,
    regions: Regions,
}

/// The map of everything else, and those of materials.
struct Chosen<'a> {
    base: Option<&'a str>,
    of_material: Vec<(&'a str, &'a str)>,
}

impl BrushworkOptions {
    /// Files that the maps are made from.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        let style = self.style.iter().filter(|style| is_toml(Path::new(style))).cloned();
        let maps = self.map.iter().map(|option| file_of(option).1.to_owned());
        maps.chain(style).map(PathBuf::from).chain(self.regions.clone()).collect()
    }

    /// Whether regions may have settings of their own.
    pub(super) fn has_regions(&self) -> bool {
        self.regions.is_some()
    }

    /// Reads the maps and regions, and makes the map of a style: of `usual` if none is named.
    pub(super) fn maps(&self, usual: &str, console: &Console<'_>) -> Result<Maps> {
        let chosen = self.chosen()?;
        let mut regions = match &self.regions {
            Some(path) => Regions::open(path)?,
            None => Regions { name: "--map".to_owned(), ..Regions::default() },
        };
        for (material, file) in chosen.of_material {
            let area = RegionArea::Material(material.to_owned());
            let region = Region::new(&format!("--map {material}"), area);
            regions.list.push(Region { map: Some(file.to_owned()), ..region });
        }
        let base = match chosen.base {
            Some(file) => ArtMap::open(Path::new(file))?,
            None => styled(self.style.as_deref().unwrap_or(usual), console)?,
        };
        let mut named = vec![(String::new(), base)];
        for name in regions.list.iter().filter_map(|region| region.map.as_deref()) {
            if named.iter().all(|(other, _)| other != name) {
                named.push((name.to_owned(), self.map_of_region(name, console)?));
            }
        }
        Ok(Maps { named, regions })
    }

    /// The map that a region calls: a file beside the file of regions or as on the command line, or a
    /// style.
    fn map_of_region(&self, name: &str, console: &Console<'_>) -> Result<ArtMap> {
        let folder = self.regions.as_deref().and_then(Path::parent);
        let beside = folder.map(|folder| folder.join(name)).filter(|path| path.exists());
        let path = beside.unwrap_or_else(|| PathBuf::from(name));
        match !path.exists() && Style::named(name).is_ok() {
            true => styled(name, console),
            false => Ok(ArtMap::open(&path)?),
        }
    }

    fn chosen(&self) -> Result<Chosen<'_>> {
        let files: Vec<(Option<&str>, &str)> = self.map.iter().map(|text| file_of(text)).collect();
        let base: Vec<&str> = files
            .iter()
            .filter(|(material, _)| material.is_none())
            .map(|(_, file)| *file)
            .collect();
        if base.len() + usize::from(self.style.is_some()) > 1 {
            return Err(Failure::usage(
                "two maps are for the same parts",
                "give one --map or --style for everything, and --map MATERIAL=FILE for parts",
            ));
        }
        let of_material =
            files.iter().filter_map(|&(material, file)| Some((material?, file))).collect();
        Ok(Chosen { base: base.first().copied(), of_material })
    }
}

impl Maps {
    /// The brushwork for a painter.
    pub(super) fn brushwork(&self) -> Brushwork<'_> {
        let maps = self.named.iter().map(|(name, map)| (name.as_str(), map)).collect();
        Brushwork { maps, regions: self.regions.clone() }
    }
}

/// A map of samples painted in a style.
fn styled(style: &str, console: &Console<'_>) -> Result<ArtMap> {
    let style = match is_toml(Path::new(style)) {
        true => Style::open(Path::new(style))?,
        false => Style::named(style)?,
    };
    let _waiting = Waiting::new("painting samples", console.shows_progress());
    let samples = painted_samples(&style, &PaintedSettings::default())?;
    Ok(ArtMap::of(&samples, &SynthesisSettings::default())?)
}

/// Material, if one is named, and file of an option `--map`.
fn file_of(option: &str) -> (Option<&str>, &str) {
    match option.split_once('=') {
        Some((material, file)) if !Path::new(option).exists() => (Some(material), file),
        _ => (None, option),
    }
}

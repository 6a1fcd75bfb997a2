//! One run of `impasto painterly`: the subject, the files to write, and the options for the
//! brushwork (maps from files or from a style, and the regions that use them) and for paintings
//! with pigments.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use artmap::map::ArtMap;
use artmap::painted::{PaintedSettings, Style};
use artmap::synthesis::SynthesisSettings;
use calibrate::library::PigmentLibrary;
use clap::Args;
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::encoding::{linear_from_encoded, over_white};
use graphics::export::frame_of;
use paint::document::Slots;
use paint::engine::PaintEngine;
use paint::ground::{GroundKind, GroundSpec};
use paint::light::Light;
use paint::painting::Painting;
use painterly::{Brushwork, Form, Painter, Region, RegionArea, Regions, Settings, Subject, View};
use serde_json::json;
use spectra::Viewing;

use crate::animation::{Animation, FramesDigest};
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::quietly_chosen;
use crate::output::{Output, OutputFolder, StageFolder};
use crate::palette::palette;
use crate::pictures::{OpenExports, PX_MM, grounds};
use crate::progress::waited;
use crate::readings::is_toml;
use crate::technique::{painted, prepared, samples, style_of, write_stages};

/// A subject, and the pictures of it.
pub(super) struct Scene {
    pub(super) form: Form,
    /// The cameras of all frames, at least one.
    pub(super) cameras: Vec<Camera>,
    /// Width and height of a picture in pixels.
    pub(super) size: (usize, usize),
}

/// A subject, and its outputs.
pub(super) struct Job {
    pub(super) settings: Settings,
    pub(super) scene: Scene,
    /// Where pictures are made.
    pub(super) compute: Compute,
    /// Title, ground and pigments, if it is a painting.
    pub(super) painting: Option<Materials>,
    pub(super) exports: OpenExports,
    pub(super) stages: Option<StageFolder>,
    pub(super) exr_frames: Option<ExrFrames>,
    pub(super) animation: Option<Animation>,
}

impl Job {
    pub(super) fn paint(self, maps: &Maps, console: &mut Console<'_>) -> Result<Summary> {
        let Self { compute, settings, scene, painting, exports, stages, exr_frames, animation } =
            self;
        let Scene { form, cameras, size } = scene;
        let brushwork = maps.brushwork();
        let backend = compute.name().to_owned();
        let subject = Subject { form: &form, brushwork: &brushwork, compute };
        let mut painter = prepared::<Painter>(subject, &settings, console)?;
        let recording = match animation {
            None => None,
            Some(animation) => {
                let digest = FramesDigest::default()
                    .add(&env!("CARGO_PKG_VERSION"))
                    .add(&settings)
                    .add(&cameras)
                    .add(&form)
                    .add(&brushwork)
                    .add(&backend);
                Some(animation.begin(digest, cameras.len(), size)?)
            }
        };
        let first = View { camera: &cameras[0], size, seconds: 0.0 };
        let layers = painter.splats(&cameras[0], size, 0.0)?.1.iter().map(Vec::len).collect();
        if let Some(folder) = stages {
            write_stages(&mut painter, first, &folder, console)?;
        }
        match painting {
            _ if !exports.any() => {}
            Some(Materials { title, ground, pigments }) => {
                if let Some((library, palette)) = pigments {
                    painter.set_pigments(library, palette);
                }
                let document = waited("painting", console, || {
                    painter.painting(&cameras[0], size, 0.0, (&title, &ground))
                })?;
                let engine = PaintEngine::on_cpu(document.ground.height.clone());
                let light = Light::new(&document.library, &Viewing::default())?;
                exports.write(&mut Painting::open_under(document, light, engine, 0)?, console)?;
            }
            None => {
                let picture = painted(&mut painter, first, console)?;
                let linear = linear_from_encoded(&over_white(&picture.color));
                exports.write_picture(&linear, PX_MM, console)?;
            }
        }
        // One loop of the flow over all frames.
        let count = cameras.len();
        let time =
            |index: usize| f64::from(settings.flow.loop_seconds) * index as f64 / count as f64;
        if let Some(folder) = exr_frames {
            folder.write(console, |index| {
                Ok(painter.exr_frame(&cameras[index], size, time(index))?)
            })?;
        }
        let mut frames = None;
        if let Some(recording) = recording {
            let found = recording.paint(console, |index| {
                let painted = painter.paint(&cameras[index], size, time(index))?;
                Ok(frame_of(&over_white(&painted.color)))
            })?;
            frames = Some((count, found));
        }
        let maps = brushwork.maps.len();
        let regions = brushwork.regions.list.len();
        Ok(Summary { size, backend, layers, matched: painter.matched(), maps, regions, frames })
    }
}

/// Summary of a finished run.
pub(super) struct Summary {
    /// Width and height in pixels.
    size: (usize, usize),
    /// Device of the pictures.
    backend: String,
    /// Number of strokes of each layer of the first picture.
    layers: Vec<usize>,
    /// Share of strokes that continue a neighbour.
    matched: f64,
    /// Numbers of maps and regions.
    maps: usize,
    regions: usize,
    /// Number of frames of an animation, and the number of these that existed already.
    frames: Option<(usize, usize)>,
}

impl Summary {
    pub(super) fn print(&self, as_json: bool, console: &mut Console<'_>) -> Result<()> {
        let Self { size: (width, height), backend, layers, matched, maps, regions, frames } = self;
        let strokes: usize = layers.iter().sum();
        if as_json {
            return console.json(&json!({
                "size": [width, height],
                "backend": backend,
                "strokes": strokes,
                "layers": layers,
                "matched": matched,
                "maps": maps,
                "regions": regions,
                "frames": frames.map(|(frames, _)| frames),
                "frames_found": frames.map(|(_, found)| found),
            }));
        }
        let strokes = documents::counted(strokes, "stroke");
        let mut line = format!(
            "{width} x {height} pixels, {strokes}, {:.0} % continue a neighbour",
            100.0 * matched
        );
        if let Some((frames, found)) = frames {
            line += &format!(", {}", documents::counted(*frames, "frame"));
            if *found > 0 {
                line += &format!(" ({found} of them existed already)");
            }
        }
        console.line(line)
    }
}

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

/// The maps of `--map`: one for everything, and one for each material that has its own.
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

    /// Opens the map that a region names: a file beside the file of regions or as on the command
    /// line, or a style.
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
    let (style, _) = style_of(Path::new(style))?;
    let samples = samples(&style, &PaintedSettings::default(), console)?;
    let made =
        waited("painting samples", console, || ArtMap::of(&samples, &SynthesisSettings::default()));
    Ok(made?)
}

/// Material, if one is named, and file of an option `--map`.
fn file_of(option: &str) -> (Option<&str>, &str) {
    match option.split_once('=') {
        Some((material, file)) if !Path::new(option).exists() => (Some(material), file),
        _ => (None, option),
    }
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Paint the first picture with pigments, and show it as a painting, with relief and gloss; exports
    /// other than --picture imply it
    #[arg(long)]
    with_pigments: bool,
    /// Library of the pigments for the colours of a model or photograph [default: that of the map, else
    /// that of IMPASTO_LIBRARY, else the Van Gogh oils that ship]
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments for those colours, separated by commas [default: those that come nearest]
    #[arg(long, value_name = "PIGMENTS")]
    palette: Vec<String>,
    /// Ground: linen, paper or panel
    #[arg(long, value_name = "KIND", default_value = "panel", value_parser = grounds())]
    ground: GroundKind,
}

/// Title, ground and pigments of a painting.
pub(super) struct Materials {
    pub(super) title: String,
    pub(super) ground: GroundSpec,
    /// Pigments for the colours of the subject, if they were chosen.
    pub(super) pigments: Option<(Arc<PigmentLibrary>, Option<Slots>)>,
}

impl PigmentOptions {
    fn path(&self) -> Option<&PathBuf> {
        self.pigments.as_ref().or(self.pigments_before.as_ref())
    }

    /// File of the library, if one is given.
    pub(super) fn input(&self) -> Option<PathBuf> {
        self.path().cloned()
    }

    /// Title, ground and pigments, if the picture becomes a painting. This is so if `wanted` is
    /// true or if options ask for it.
    pub(super) fn materials(
        &self,
        title: &str,
        wanted: bool,
        console: &mut Console<'_>,
    ) -> Result<Option<Materials>> {
        let chosen = self.path().is_some() || !self.palette.is_empty();
        if !(wanted || self.with_pigments || chosen) {
            return Ok(None);
        }
        let pigments = match chosen {
            false => None,
            true => {
                let path = self.path().map(PathBuf::as_path);
                let library = quietly_chosen(path, console)?.library;
                let slots = match self.palette.is_empty() {
                    true => None,
                    false => Some(palette(&self.palette, &library)?),
                };
                Some((Arc::new(library), slots))
            }
        };
        Ok(Some(Materials { title: title.to_owned(), ground: self.ground.spec(1), pigments }))
    }
}

/// A folder that a number of frames can be written to.
pub(super) struct ExrFrames {
    folder: OutputFolder,
    frames: usize,
    inputs: Vec<PathBuf>,
}

impl ExrFrames {
    /// Checks that the frames can be written, and that the folder has none beyond them, which would be
    /// of another animation.
    pub(super) fn open(folder: &Path, frames: usize, inputs: &[PathBuf]) -> Result<Self> {
        let folder = OutputFolder::open(folder, inputs)?;
        let beyond = folder.file(&name(frames));
        if beyond.exists() {
            return Err(Failure::usage(
                format!("{}: a frame of another animation", beyond.display()),
                "name an empty folder, or remove its frames",
            ));
        }
        folder.check((0..frames).map(name))?;
        Ok(Self { folder, frames, inputs: inputs.to_vec() })
    }

    /// Writes the frames in order, each whole. The folder is made when the first is ready.
    pub(super) fn write(
        self,
        console: &mut Console<'_>,
        mut frame: impl FnMut(usize) -> Result<Vec<u8>>,
    ) -> Result<()> {
        for index in 0..self.frames {
            let content = frame(index)?;
            self.folder.make()?;
            Output::open(&self.folder.file(&name(index)), &self.inputs)?.put(content)?;
        }
        self.folder.told(console)
    }
}

/// Name of the frame with this index, counted from 1.
fn name(index: usize) -> String {
    format!("frame-{:04}.exr", index + 1)
}

//! All options of the verb. For example, you say how much paint to pour and for how long, which
//! measured pigments to paint with, which preset, file or single settings to use, and which files
//! to write beside an animation.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use calibrate::Backing;
use calibrate::library::PigmentLibrary;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use documents::{counted, file};
use paint::document::Lighting;
use paint::ground::{GroundKind, GroundSpec, MeasuredPrimer, Primer, PrimerSpectrum};
use pictures::{listed, name_in_recipe, pigment_names};
use volumes::painter::{Show, VolumePainter, VolumePigments};
use volumes::script::{PourTable, Row, Script};
use volumes::settings::{Inside, Preset, Settings};
use volumes::toml_text::Fault;

use crate::animation::{AnimationOptions, SubjectOptions};
use crate::console::Console;
use crate::engine::BackendOption;
use crate::failure::{Failure, Result};
use crate::output::{Output, OutputFolder, StageFolder};
use crate::pictures::{Exports, OpenExports, grounds};
use crate::readings::{library, text, viewing};
use crate::surface::ground;
use crate::technique::{ShowPreset, StyleOptions, Styled};

/// Pour paint over a scene drawn in pencil: what it reaches turns to colour
///
/// Paint is held by volumes: closed meshes of particles that grow over the surfaces of a model, or
/// over a photograph, and spill from one place to the next. What they hold is shown in colour, all
/// else as a grey drawing (ten Bosch 2005). With a library of pigments they lie as films of measured
/// paint, and the result is a painting. A script (.toml) says what is poured, pushed, lifted and
/// dried, and when.
#[derive(Debug, Args)]
pub(crate) struct Stencil {
    /// A mesh (.obj, .gltf, .glb, .ply), a photograph (.png, .jpg, .tif, .webp), a built-in shape
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere), or a script (.toml)
    #[arg(required_unless_present = "show_preset")]
    pub(super) subject: Option<PathBuf>,
    #[command(flatten)]
    pub(super) show_preset: ShowPreset<VolumePainter>,
    /// Content of pictures: `final`, the result; `volumes`, the volumes over the grey drawing; `mask`,
    /// white where volumes are and black elsewhere; `grey`, the drawing without volumes; `colour`, the
    /// scene in colour; `hatching`, the pencil strokes
    #[arg(long, value_name = "WHAT", default_value = "final", value_parser = shows())]
    pub(super) show: Show,
    /// Time of single pictures in seconds [default: the end]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub(super) at: Option<f64>,
    /// Print JSON: size, backend, seconds, volumes, particles, cells, paint in mm3, frames,
    /// frames_found, from_seconds (of the snapshot that an interrupted run went on from),
    /// steps_computed
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) backend: BackendOption,
    #[command(flatten)]
    pub(super) pours: PourOptions,
    #[command(flatten)]
    pub(super) settings: StyleOptions<VolumePainter>,
    #[command(flatten)]
    pub(super) subject_options: SubjectOptions,
    #[command(flatten)]
    pub(super) outputs: OutputOptions,
    #[command(flatten)]
    pub(super) animation: AnimationOptions,
    #[command(flatten)]
    pub(super) pigments: PigmentOptions,
}

/// Parses the subject of pictures. Errors list the names.
fn shows() -> impl TypedValueParser<Value = Show> {
    let names = PossibleValuesParser::new(Show::ALL.map(Show::name));
    names.try_map(|name| name.parse::<Show>())
}

/// Paint in mm3 of a pour if you give no amount. This is a film of 0.02 mm on a disc 60 mm wide.
const AMOUNT_MM3: f64 = 60.0;
/// Longest time over which such paint flows, in seconds.
const FLOW_S: f64 = 3.0;
/// Duration without a script and without `--seconds`.
const SECONDS: f64 = 4.0;

#[derive(Debug, Args)]
#[command(next_help_heading = "Paint")]
pub(super) struct PourOptions {
    /// Pour paint at a place of the first picture: shares of its width and height, and the amount in
    /// mm3 [default: 60], such as `0.5,0.6` or `0.5,0.6,200`; may be repeated
    #[arg(long = "pour", value_name = "X,Y[,MM3]", allow_hyphen_values = true)]
    pours: Vec<String>,
    /// Paint of the pours, as pigments with their parts, such as `Ultramarine=2,White=1`: one for all
    /// of them, or one for each [default: the pigments of --palette, or of the script, in turn]
    #[arg(long = "paint", value_name = "RECIPE", requires = "pigments")]
    paints: Vec<String>,
    /// How long paint spreads, in seconds [default: 4, or as the script says]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    seconds: Option<f64>,
}

impl PourOptions {
    /// Seconds of a scene without a script.
    pub(super) fn usual_seconds(&self) -> f64 {
        self.seconds.unwrap_or(SECONDS)
    }

    /// Whether the duration is given.
    pub(super) fn has_seconds(&self) -> bool {
        self.seconds.is_some()
    }

    /// Adds what the options pour to a script. If there is a library, `palette` lists pigments of
    /// it.
    pub(super) fn apply(
        &self,
        script: &mut Script,
        palette: &[String],
        library: Option<&PigmentLibrary>,
    ) -> Result<()> {
        self.check_counts()?;
        if let Some(seconds) = self.seconds {
            script.seconds = seconds;
        }
        let names = library.map(|library| pigment_names(palette, library)).unwrap_or_default();
        for name in &names {
            letter(script, name);
        }
        let in_turn: Vec<String> = match names.is_empty() {
            true => script.palette.values().cloned().collect(),
            false => names,
        };
        let paints = self
            .paints
            .iter()
            .filter_map(|text: &String| library.map(|library| parts(text, library)))
            .collect::<Result<Vec<_>>>()?;
        for (index, text) in self.pours.iter().enumerate() {
            let recipe = match &paints[..] {
                [] => in_turn.iter().cycle().nth(index).map(|name| vec![(name.clone(), 1.0)]),
                [one] => Some(one.clone()),
                each => Some(each[index].clone()),
            };
            let (picked, amount_mm3) = place(text)?;
            let mut pour = PourTable {
                picked: Some(Row(picked)),
                for_s: script.seconds.min(FLOW_S),
                amount_mm3: Some(amount_mm3),
                ..PourTable::default()
            };
            for (name, part) in recipe.into_iter().flatten() {
                *pour.recipe.entry(letter(script, &name)).or_default() += part;
            }
            script.pours.push(pour);
        }
        Ok(())
    }

    /// Checks that there is paint for every pour, and a pour for every paint.
    fn check_counts(&self) -> Result<()> {
        match (self.paints.len(), self.pours.len()) {
            (0, _) | (1, 1..) => Ok(()),
            (paints, pours) if paints == pours => Ok(()),
            (_, 0) => Err(Failure::usage(
                "--paint is the paint of pours, but there is no --pour",
                "add --pour 0.5,0.5",
            )),
            (paints, pours) => Err(Failure::usage(
                format!("{} for {}", counted(paints, "recipe"), counted(pours, "pour")),
                "give one --paint for all pours, or one for each",
            )),
        }
    }
}

/// The key of a pigment in the palette of a script, which is added if it is new.
fn letter(script: &mut Script, pigment: &str) -> String {
    if let Some((key, _)) = script.palette.iter().find(|(_, name)| *name == pigment) {
        return key.clone();
    }
    let mut keys = (1..).map(|number| format!("P{number}"));
    let key = keys.find(|key| !script.palette.contains_key(key)).unwrap_or_default();
    script.palette.insert(key.clone(), pigment.to_owned());
    key
}

/// Reads `X,Y[,MM3]`.
fn place(text: &str) -> Result<([f64; 2], f64)> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let (x, y, amount) = match numbers.as_deref() {
        Ok(&[x, y]) => (x, y, AMOUNT_MM3),
        Ok(&[x, y, amount]) => (x, y, amount),
        _ => (f64::NAN, f64::NAN, AMOUNT_MM3),
    };
    let inside = [x, y].iter().all(|share| (0.0..=1.0).contains(share));
    if inside && amount > 0.0 && amount.is_finite() {
        return Ok(([x, y], amount));
    }
    Err(Failure::usage(
        format!(
            "--pour takes X,Y or X,Y,MM3 with shares of 0 to 1 and more than 0 mm3, found `{text}`"
        ),
        "try --pour 0.5,0.6 or --pour 0.5,0.6,200",
    ))
}

/// Reads `NAME=PART,NAME=PART`. A name alone has one part.
fn parts(text: &str, library: &PigmentLibrary) -> Result<Vec<(String, f64)>> {
    let wrong = || {
        Failure::usage(
            format!("--paint takes pigments with their parts above 0, found `{text}`"),
            "try --paint \"Ultramarine=2,Titanium White=1\"",
        )
    };
    listed(text, library, name_in_recipe)
        .into_iter()
        .map(|part: &str| {
            let (name, share) = part.rsplit_once('=').unwrap_or((part, "1"));
            let share: f64 = share.trim().parse().map_err(|_| wrong())?;
            let name = name.trim();
            let fits = !name.is_empty() && share > 0.0 && share.is_finite();
            if fits { Ok((name.to_owned(), share)) } else { Err(wrong()) }
        })
        .collect()
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Paint with this library: volumes become films of measured pigments, and the picture a painting.
    /// The setting drawing.inside is then glaze or both, as in the preset grisaille [default: the
    /// library that a script names, if its volumes show glazes]
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments of the volumes, separated by commas
    #[arg(long, value_name = "PIGMENTS", requires = "library_of_paint")]
    palette: Vec<String>,
    /// Ground: linen, paper or panel [default: that of the script, or panel]
    #[arg(long, value_name = "KIND", value_parser = grounds())]
    ground: Option<GroundKind>,
    /// Reflectance of the ground as measured, 0 to 1, white or black, or one spectrum of a file
    /// [default: that of the script, or the white of the library]
    #[arg(long, value_name = "GROUND")]
    over: Option<String>,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp [default: that of the script, or D65]
    #[arg(long, value_name = "LIGHT")]
    illuminant: Option<String>,
}

impl PigmentOptions {
    /// Path of the library, if given.
    pub(super) fn input(&self) -> Option<&PathBuf> {
        self.pigments.as_ref().or(self.pigments_before.as_ref())
    }

    /// Whether a library is given.
    pub(super) fn any(&self) -> bool {
        self.input().is_some()
    }

    /// The light of `--illuminant`, or of a script, which lies in `folder`.
    pub(super) fn light(&self, script: &Script, folder: &Path) -> Option<String> {
        self.illuminant.clone().or_else(|| script.light(folder))
    }

    /// Gives a script the ground of the options.
    pub(super) fn apply(&self, script: &mut Script, console: &mut Console<'_>) -> Result<()> {
        if let Some(kind) = self.ground {
            let reflectance = script.ground.take().and_then(|own| own.reflectance);
            script.ground = Some(GroundSpec { reflectance, ..kind.spec(1) });
        }
        let Some(text) = &self.over else { return Ok(()) };
        let primer = match ground(text, console)? {
            Backing::Even(reflectance) => Primer::Grey(reflectance),
            Backing::Measured(spectrum) => {
                let grid = spectrum.grid();
                let values = spectrum.values().to_vec();
                Primer::Measured(MeasuredPrimer { spectrum: PrimerSpectrum { grid, values } })
            }
        };
        let before = script.ground.take().unwrap_or_else(|| GroundKind::Panel.spec(1));
        script.ground = Some(GroundSpec { reflectance: Some(primer), ..before });
        Ok(())
    }

    /// The lists of `--palette`.
    pub(super) fn palette(&self) -> &[String] {
        &self.palette
    }

    /// The library, if one is given.
    pub(super) fn library(&self) -> Result<Option<PigmentLibrary>> {
        self.input().map(|path| library(path)).transpose()
    }

    /// Pigments, ground and light of a script's palette. The library is the given one. Without it,
    /// if the script shows films, we open the one that the script names, in `folder`. `located`
    /// adds file and line to a fault of the script.
    pub(super) fn materials(
        &self,
        (script, settings): (&Script, &Settings),
        (given, folder): (Option<PigmentLibrary>, &Path),
        located: impl Fn(Box<Fault>) -> Failure,
    ) -> Result<Option<VolumePigments>> {
        let styles = script.region_styles(settings);
        let shows_films = styles.iter().any(|style| style.inside != Inside::OwnColors);
        let library = match given {
            Some(library) => Some(library),
            None if shows_films && !script.palette.is_empty() => script.open_library(folder)?,
            None => None,
        };
        let Some(library) = library else { return self.without_library() };
        if script.palette.is_empty() {
            let path = self.input().map_or(folder, PathBuf::as_path);
            return Err(Failure::usage(
                format!("{}: no pigment of this library is chosen", path.display()),
                "add --palette with up to eight of its pigments, or --paint for each pour",
            ));
        }
        let slots = script.slots(&library).map_err(&located)?;
        let ground = script.ground_under(&library).map_err(located)?;
        // Films are thinner than the relief of a ground, which would only hide the drawing.
        let usual = Lighting::default();
        let illuminant = self.light(script, folder).unwrap_or(usual.illuminant);
        let lighting = Lighting { illuminant, relief: 0.0, ..Lighting::default() };
        // An unknown light is refused before anything is painted.
        viewing(&lighting.illuminant, &lighting.observer)?;
        let library = Arc::new(library);
        Ok(Some(VolumePigments { library, slots, own_colors: None, ground, lighting }))
    }

    /// Refuses options for pigments, since there are none.
    fn without_library(&self) -> Result<Option<VolumePigments>> {
        let given = [
            ("--ground", self.ground.is_some()),
            ("--over", self.over.is_some()),
            ("--illuminant", self.illuminant.is_some()),
        ];
        match given.iter().find(|(_, is_given)| *is_given) {
            None => Ok(None),
            Some((option, _)) => Err(Failure::usage(
                format!("{option} needs pigments, but no library is given"),
                "name a LIBRARY after the subject, and give --palette",
            )),
        }
    }
}

impl Styled for VolumePainter {
    const USUAL: &'static str =
        "that of the script, or sketch; with a LIBRARY and no script, grisaille";
}

/// Changes the settings of a script by options. `usual` is the preset of a script that names none.
pub(super) fn apply_style(
    style: &StyleOptions<VolumePainter>,
    script: &mut Script,
    usual: Option<Preset>,
) -> Result<()> {
    script.preset = style.preset().or(script.preset).or(usual);
    if let Some(path) = style.input() {
        script.change_settings(&path.display().to_string(), &text(path)?)?;
    }
    style.each_set(|name, toml| Ok(script.change_settings(name, toml)?))
}

#[derive(Debug, Args)]
pub(super) struct OutputOptions {
    #[command(flatten)]
    exports: Exports,
    /// Write the picture in layers for compositing, as OpenEXR of several parts: colour, grey, count
    /// and tint of each region, ink, place, normal, and heights of pigments
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    passes: Option<PathBuf>,
    /// Write a mask as PNG or OpenEXR: white where volumes bring colour
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    mask: Option<PathBuf>,
    /// Write intermediate stages of the picture into this folder as PNG: the colours seen, light, hatching,
    /// colour, grey, count and tint of each region, volumes, mask, picture
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Write the volumes of each frame into this folder as PLY
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    volumes: Option<PathBuf>,
    /// Write the pours and other events of the scene, and all settings that differ from the preset, as a
    /// script (.toml)
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    script_out: Option<PathBuf>,
}

/// Files of single pictures that were checked to be writable.
pub(super) struct PictureFiles {
    pub(super) exports: OpenExports,
    pub(super) passes: Option<Output>,
    pub(super) mask: Option<Output>,
    pub(super) stages: Option<StageFolder>,
}

/// Files that were checked to be writable.
pub(super) struct OpenOutputs {
    pub(super) pictures: PictureFiles,
    pub(super) script: Option<Output>,
    pub(super) volumes: Option<MeshFolder>,
}

impl OutputOptions {
    /// Whether anything is to be written.
    pub(super) fn any(&self) -> bool {
        let others = [&self.passes, &self.mask, &self.stages, &self.volumes, &self.script_out];
        self.exports.any() || others.into_iter().any(Option::is_some)
    }

    /// First option present that needs layers of pigments.
    pub(super) fn layer_option(&self) -> Option<String> {
        self.exports.layer_option()
    }

    /// Folder of the script that is written, if one is.
    pub(super) fn script_folder(&self) -> Option<PathBuf> {
        self.script_out.as_ref().map(|path| path.parent().unwrap_or(Path::new("")).to_owned())
    }

    /// Checks that all files can be written, with `frames` frames, but does not create them.
    pub(super) fn open(
        self,
        inputs: &[PathBuf],
        frames: usize,
        animation: Option<&file::Output>,
    ) -> Result<OpenOutputs> {
        let open = |path: &Option<PathBuf>, endings: &[&'static str]| {
            path.as_ref().map(|path| Output::with_ending(path, endings, inputs)).transpose()
        };
        let passes = open(&self.passes, &["exr"])?;
        let mask = open(&self.mask, &["png", "exr"])?;
        let script = open(&self.script_out, &["toml"])?;
        let files = [&passes, &mask, &script].map(|output| output.as_deref());
        file::refuse_same(&[&files[..], &[animation]].concat())?;
        let exports = self.exports.open(inputs)?;
        let own = files.into_iter().flatten().chain(animation);
        if let Some(twice) = own.into_iter().find(|output| exports.writes(output)) {
            return Err(twice.used_twice().into());
        }
        let volumes = self.volumes.as_deref();
        let volumes = volumes.map(|folder| MeshFolder::open(folder, frames, inputs)).transpose()?;
        let stages = self.stages.as_deref();
        let stages = stages.map(|folder| StageFolder::open(folder, inputs)).transpose()?;
        let pictures = PictureFiles { exports, passes, mask, stages };
        Ok(OpenOutputs { pictures, script, volumes })
    }
}

/// A folder for the volumes of each frame.
pub(super) struct MeshFolder {
    folder: OutputFolder,
    frames: usize,
}

impl MeshFolder {
    /// Checks that `frames` files can be written, and that the folder has no frame beyond the last,
    /// which would be of another animation.
    fn open(folder: &Path, frames: usize, inputs: &[PathBuf]) -> Result<Self> {
        let folder = OutputFolder::open(folder, inputs)?;
        let beyond = folder.file(&file_name(frames));
        if beyond.exists() {
            return Err(Failure::usage(
                format!("{}: a frame of another animation", beyond.display()),
                "name an empty folder, or remove its frames",
            ));
        }
        folder.check((0..frames).map(file_name))?;
        Ok(Self { folder, frames })
    }

    /// Reports that the folder was written.
    pub(super) fn told(&self, console: &mut Console<'_>) -> Result<()> {
        self.folder.told(console)
    }

    /// One file for each frame.
    pub(super) fn outputs(&self) -> Result<Vec<Output>> {
        self.folder.outputs((0..self.frames).map(file_name))
    }
}

/// Name of the file of a frame. Indices count from 0, names from 1.
fn file_name(index: usize) -> String {
    format!("frame-{:04}.ply", index + 1)
}

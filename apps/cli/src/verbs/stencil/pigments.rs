//! Options for painting with measured pigments.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use calibrate::Backing;
use calibrate::library::PigmentLibrary;
use clap::Args;
use paint::document::Lighting;
use paint::ground::{GroundKind, GroundSpec, MeasuredPrimer, Primer, PrimerSpectrum};
use volumes::painter::VolumePigments;
use volumes::script::Script;
use volumes::settings::{Inside, Settings};
use volumes::toml_text::Fault;

use crate::canvas::grounds;
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::ground::ground;
use crate::input::{library, viewing};

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Paint with this library: volumes become films of measured pigments, and the picture a painting.
    /// The setting drawing.inside is then glaze or both, as in the preset grisaille [default: the
    /// library that a script names, if its volumes show glazes]
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// The library, as it was named before
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

    /// Pigments, ground and light of a script's palette, if a `library` is given, or named by the
    /// script, which lies in `folder`, and seen by `settings`. `located` adds file and line to a
    /// fault of the script.
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

    /// No pigments; refuses options that are of pigments.
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

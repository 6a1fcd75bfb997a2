//! Options of a map: which pigments take part, and how far the library may err.

use std::path::PathBuf;

use calibrate::remark::Remark;
use calibrate::{PigmentLibrary, Residuals};
use clap::Args;
use maps::{Cube, Ground, MapSettings, ModelError, PigmentGroup, Region, SurveyedScan};

use crate::failure::{Failure, Result};

/// Which pigments take part, and how they are told.
#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Most pigments of one pixel, 1 to 4 [default: 3]
    #[arg(long, value_name = "N")]
    at_most: Option<usize>,
    /// A pigment that may take part; may be repeated [default: all whose S is known]
    #[arg(long, value_name = "NAME")]
    palette: Vec<String>,
    /// Pigments that are mapped as one, such as `whites=Lead White,Zinc White`; may be repeated
    #[arg(long, value_name = "NAME=PIGMENT,..")]
    group: Vec<String>,
    /// Map each pigment by itself, also those that the bands cannot tell apart
    #[arg(long)]
    apart: bool,
    /// Standard deviation of the noise of a band, as a fraction [default: that of the white reading, else
    /// 0.003]
    #[arg(long, value_name = "SD")]
    noise: Option<f64>,
    /// Errors of mixtures that the library had not seen, from `impasto validate READINGS --residuals FILE`
    /// [default: for the oils that ship their own]
    #[arg(long, value_name = "FILE")]
    residuals: Option<PathBuf>,
    /// How far K and S of the library may be off, as a fraction [default: 0.1 for a library without
    /// residuals]
    #[arg(long, value_name = "0.05", conflicts_with = "residuals")]
    model_error: Option<f64>,
    /// The bare ground, whose pixels are told as ground rather than mapped as paint: rows and columns of the scan,
    /// such as 0..20,0..100, or a file with its reflectance
    #[arg(long, value_name = "ROWS,COLUMNS|FILE")]
    ground: Option<String>,
    /// Amount by which a pigment that the survey does not find in the palette must lower chi-square to be told
    /// [default: 2]
    #[arg(long, value_name = "N")]
    penalty: Option<f64>,
}

impl PigmentOptions {
    /// Settings of a map of the scan `cube` with `library`.
    pub(super) fn settings(&self, cube: &Cube, library: &PigmentLibrary) -> Result<MapSettings> {
        let usual = MapSettings::default();
        let groups = self.group.iter().map(|text| group(text)).collect::<Result<_>>()?;
        let of_white = cube.noise_of_white().map(|noise| noise.max(usual.sensor_noise));
        let residuals = self.residuals.as_ref().map(|path| -> Result<ModelError> {
            Ok(ModelError::Residuals(Residuals::open(path)?))
        });
        let stated = self.model_error.map(ModelError::Stated);
        let settings = MapSettings {
            at_most: self.at_most.unwrap_or(usual.at_most),
            palette: self.palette.clone(),
            groups,
            group_alike: !self.apart,
            sensor_noise: self.noise.or(of_white).unwrap_or(usual.sensor_noise),
            penalty: self.penalty.unwrap_or(usual.penalty),
            model_error: residuals.transpose()?.or(stated),
            ground: self.ground.as_deref().map(|text| ground(text, cube)).transpose()?,
        };
        if let (Err(error), Some(path)) = (settings.model_error_of(library), &self.residuals) {
            return Err(Failure::from(error).within(format!("{} cannot be used", path.display())));
        }
        Ok(settings)
    }

    /// Remark on a library about whose errors nothing is known.
    pub(super) fn remark(&self, scan: &SurveyedScan) -> Option<Remark> {
        let assumed = self.model_error.is_none()
            && matches!(scan.mapper().model_error(), ModelError::Stated(_));
        assumed.then(|| {
            let words = scan.mapper().model_error().words();
            Remark::note(format!("this library is taken to have {words}")).with_hint(
                "`impasto validate READINGS [residuals=FILE.json]` measures its errors, and [residuals=FILE.json] gives them to the map",
            )
        })
    }
}

/// The ground of a map: the mean of a region of the scan, or the reflectance in a file.
fn ground(text: &str, cube: &Cube) -> Result<Ground> {
    if let Some(region) = rectangle(text) {
        return Ok(region.ground(cube)?);
    }
    let opened = spectra::read_spectrum(text)
        .map_err(|error| Failure::from(error).within("--ground takes a region or a file"))?;
    let reflectance = opened.spectrum.reflectance().map_err(Failure::from)?;
    let nm = reflectance.grid().wavelengths_nm().collect();
    Ok(Ground::new(nm, reflectance.values().to_vec())?)
}

/// Parses `ROWS,COLUMNS`, each `FIRST..END`; `None` for any other text.
pub(super) fn rectangle(text: &str) -> Option<Region> {
    let range = |part: &str| {
        let (first, end) = part.split_once("..")?;
        Some(first.trim().parse().ok()?..end.trim().parse().ok()?)
    };
    let (rows, columns) = text.split_once(',')?;
    Some(Region { rows: range(rows)?, columns: range(columns)? })
}

/// Parses a group, `NAME=PIGMENT,..`.
fn group(text: &str) -> Result<PigmentGroup> {
    let found = text.split_once('=').map(|(name, pigments)| PigmentGroup {
        name: name.trim().to_owned(),
        pigments: pigments.split(',').map(|name| name.trim().to_owned()).collect(),
    });
    found
        .filter(|group: &PigmentGroup| {
            !group.name.is_empty() && group.pigments.iter().all(|name| !name.is_empty())
        })
        .ok_or_else(|| {
            Failure::usage(
                format!("--group takes NAME=PIGMENT,PIGMENT.., found `{text}`"),
                "try --group \"whites=Lead White,Zinc White\"",
            )
        })
}

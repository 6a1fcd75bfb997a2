//! White and dark readings of a scan, by the settings or the folder that names them.

use std::path::{Path, PathBuf};

use super::error::CubeError;
use super::opened::Opened;
use super::options::{CubeOptions, DarkReading};
use super::readings::{Reading, Readings};

/// Readings that lie beside a scan.
#[derive(Debug, Default)]
pub(crate) struct OwnReadings {
    /// White of the camera.
    pub(crate) white: Option<PathBuf>,
    /// Dark of the scan.
    pub(crate) dark: Option<PathBuf>,
    /// Dark of the white, where the camera took one.
    pub(crate) white_dark: Option<PathBuf>,
}

/// White and dark readings of a scan: those of the settings, else those of its folder. `open` opens a reading.
pub(crate) fn readings(
    scan: &Opened,
    own: Option<&OwnReadings>,
    options: &CubeOptions,
    open: &dyn Fn(&Path) -> Result<Opened, CubeError>,
) -> Result<Option<Readings>, CubeError> {
    let asked = options.white_reading.as_ref();
    let Some(white) = asked.or_else(|| own.and_then(|own| own.white.as_ref())) else {
        if options.dark_reading != DarkReading::Missing {
            let problem = "a dark reading is given, but no white reading";
            let way_out = "add [white_reading=FILE] of the same settings";
            return Err(CubeError::format(&scan.path, problem, way_out));
        }
        return Ok(None);
    };
    let white_scan = open(white)?;
    let (dark, white_dark) = match (&options.dark_reading, own) {
        (DarkReading::File(dark), _) => (Some(dark), None),
        (DarkReading::Subtracted, _) => (None, None),
        (DarkReading::Missing, Some(own)) if own.dark.is_some() => {
            let white_dark = own.white_dark.as_ref().filter(|_| asked.is_none());
            (own.dark.as_ref(), white_dark)
        }
        (DarkReading::Missing, _) => {
            return Err(CubeError::Reading {
                path: white.clone(),
                role: "white",
                problem: "needs a dark reading".to_owned(),
                way_out: "add [dark_reading=FILE] (the same settings, shutter closed), or [dark_reading=0] if the dark is subtracted already".to_owned(),
            });
        }
    };
    let times = [scan.integration_time, white_scan.integration_time];
    let time_ratio = match times {
        [Some(of_scan), Some(of_white)] if of_scan > 0.0 && of_white > 0.0 => of_scan / of_white,
        _ => 1.0,
    };
    if time_ratio != 1.0 && dark.is_some() && white_dark.is_none() {
        return Err(CubeError::Reading {
            path: white.clone(),
            role: "white",
            problem: format!(
                "was integrated for {} (`tint`), the scan for {}: the dark fits one of them only",
                times[1].unwrap_or(0.0),
                times[0].unwrap_or(0.0)
            ),
            way_out: "take the white at the integration time of the scan: a dark does not scale with time".to_owned(),
        });
    }
    let reading = |path: &PathBuf, role| Reading::of(&open(path)?, scan, role);
    Ok(Some(Readings {
        white: Reading::of(&white_scan, scan, "white")?,
        dark: dark.map(|path| reading(path, "dark")).transpose()?,
        white_dark: white_dark.map(|path| reading(path, "dark")).transpose()?,
        tile: options.tile,
        time_ratio,
    }))
}

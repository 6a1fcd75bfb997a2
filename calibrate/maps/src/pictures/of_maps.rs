//! Pictures of all maps of a scan, each with the name of its file.

use pigment::PigmentLibrary;
use spectra::Viewing;

use super::encoded::{PictureError, picture_png};
use super::overview::Overview;
use super::ramp::Ramp;
use crate::surveyed::SurveyedScan;

/// Darkest lightness of the ink of a pigment's picture, so that pale pigments are seen.
const DARKEST: u8 = 150;

/// Pictures of one pigment or group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PigmentPictures {
    /// Place in [`Overview::pigments`].
    pub place: usize,
    /// Name of the file of its presence.
    pub presence_file: String,
    /// PNG of its presence: white for 0, the ink of the pigment for 1.
    pub presence: Vec<u8>,
    /// Name of the file of its share.
    pub share_file: String,
    /// PNG of its share.
    pub share: Vec<u8>,
}

/// Pictures of all maps of a scan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MapPictures {
    /// Those of pigments and groups, the ones that are present most often first.
    pub pigments: Vec<PigmentPictures>,
    /// PNG of chi-square: white for 0, red for 4 and more.
    pub chi2: Vec<u8>,
    /// PNG of the residual: white for 0, blue for 0.05 and more of reflectance.
    pub residual: Vec<u8>,
}

impl MapPictures {
    /// Name of the file of chi-square.
    pub const CHI2_FILE: &str = "chi2.png";
    /// Name of the file of the residual.
    pub const RESIDUAL_FILE: &str = "residual.png";

    /// Draws the maps `overview` of `scan`; `library` is that of the survey.
    ///
    /// # Errors
    /// [`PictureError`] if a picture cannot be encoded.
    pub fn of(
        scan: &SurveyedScan,
        overview: &Overview,
        library: &PigmentLibrary,
    ) -> Result<Self, PictureError> {
        let size = (overview.width, overview.height);
        let mut order: Vec<usize> = (0..overview.pigments.len()).collect();
        order.sort_by(|&a, &b| overview.present[b].total_cmp(&overview.present[a]));
        let drawn = |place: usize| {
            let name = &overview.pigments[place];
            let file = |kind: &str| format!("{kind}-{}.png", file_name(name));
            let ink = Ramp::of_ink(ink(library, scan, name));
            Ok(PigmentPictures {
                place,
                presence_file: file("presence"),
                presence: picture_png(&overview.presence[place], size, &ink)?,
                share_file: file("share"),
                share: picture_png(&overview.share[place], size, &ink)?,
            })
        };
        let chi2 = Ramp { from: (0.0, [255; 3]), to: (4.0, [150, 20, 20]) };
        let rms = Ramp { from: (0.0, [255; 3]), to: (0.05, [20, 20, 150]) };
        Ok(Self {
            pigments: order.into_iter().map(drawn).collect::<Result<_, PictureError>>()?,
            chi2: picture_png(&overview.chi2, size, &chi2)?,
            residual: picture_png(&overview.rms, size, &rms)?,
        })
    }
}

/// The colour of a pigment's masstone, made dark enough to be seen on white.
fn ink(library: &PigmentLibrary, scan: &SurveyedScan, column: &str) -> [u8; 3] {
    let columns = scan.mapper().columns();
    let first = columns.iter().find(|c| c.name == column).and_then(|c| c.pigments.first());
    let color = first.and_then(|name| library.color([(name, 1.0)], &Viewing::default()).ok());
    let rgb = color.map_or([0; 3], |color| color.srgb.0.map(|v| (255.0 * v.clamp(0.0, 1.0)) as u8));
    let brightest = rgb.iter().copied().max().unwrap_or(0).max(1);
    match brightest > DARKEST && rgb.iter().copied().min().unwrap_or(0) > DARKEST {
        true => rgb.map(|v| (f64::from(v) * f64::from(DARKEST) / f64::from(brightest)) as u8),
        false => rgb,
    }
}

/// A name with letters and digits alone, for a file.
fn file_name(name: &str) -> String {
    let kept =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' });
    let text: String = kept.collect();
    text.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}

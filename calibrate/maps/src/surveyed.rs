//! A surveyed scan. It holds all that its maps depend on, so that one process or several can map
//! it.
//!
//! A spot shows the measured spectrum of a pixel or a region beside the spectrum of its mapped
//! mixture.

use std::ops::Range;

use documents::{Task, hint::Explain};
use pigment::library::Input;
use pigment::{PigmentLibrary, RecipeError};
use serde_json::{Map, Value, json};

use crate::cube::{Block, Cube, CubeError};
use crate::films::bands::Ground;
use crate::films::settings::MapSettings;
use crate::mapping::Mapper;
use crate::mapping::book::{Book, OpenBook};
use crate::mapping::groups::Column;
use crate::mapping::survey::SURVEYED;
use crate::pixel_maps::{BlockMaps, MapError, MapsAbout};

/// A rectangle of a scan, in rows and columns from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Region {
    /// Rows, from the first to before the last.
    pub rows: Range<usize>,
    /// Columns, from the first to before the last.
    pub columns: Range<usize>,
}

/// A pigment or group that the survey found.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundColumn {
    /// Pigment or group.
    pub column: Column,
    /// Part of the surveyed pixels that hold it, 0 to 1. Each pixel counts with the probability of
    /// its sets.
    pub part: f64,
}

/// A scan that was surveyed with a library.
///
/// ```no_run
/// use documents::Task;
/// use maps::{Cube, MapSettings, StoreMode, SurveyedScan};
/// use pigment::PigmentLibrary;
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let cube = Cube::open("scan.hdr")?;
/// let task = Task::default();
/// let scan = SurveyedScan::survey(cube, &oils, &MapSettings::default(), None, &task)?;
/// for found in scan.palette() {
///     println!("{:5.1} % {}", 100.0 * found.part, found.column.name);
/// }
/// let store = scan.store("maps.zarr", StoreMode::New)?;
/// scan.map(&store, &task)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SurveyedScan {
    cube: Cube,
    mapper: Mapper,
    book: Book,
    opened: OpenBook,
    about: MapsAbout,
}

impl SurveyedScan {
    /// Surveys `region` of a scan, by default all of it. `task` counts the surveyed pixels.
    ///
    /// # Errors
    /// [`SurveyError`] if the scan cannot be read, does not fit the library and the settings, or `task`
    /// was cancelled.
    pub fn survey(
        cube: Cube,
        library: &PigmentLibrary,
        settings: &MapSettings,
        region: Option<Region>,
        task: &Task,
    ) -> Result<Self, SurveyError> {
        let cube = within(cube, library)?;
        let mapper = Mapper::new(library, cube.wavelengths_nm(), settings)?;
        let region = inside(&cube, region)?;
        let pixels = cube.spread(region.rows.clone(), region.columns.clone(), SURVEYED)?;
        let book = mapper.survey(&pixels.values, task)?;
        Self::of(cube, library, mapper, settings, region, book)
    }

    /// Takes the book of an earlier survey instead of surveying the scan.
    ///
    /// # Errors
    /// [`SurveyError`] if you made the book with another library, other wavelengths or other
    /// settings.
    pub fn with_book(
        cube: Cube,
        library: &PigmentLibrary,
        settings: &MapSettings,
        region: Option<Region>,
        book: Book,
    ) -> Result<Self, SurveyError> {
        let cube = within(cube, library)?;
        let mapper = Mapper::new(library, cube.wavelengths_nm(), settings)?;
        let region = inside(&cube, region)?;
        Self::of(cube, library, mapper, settings, region, book)
    }

    fn of(
        cube: Cube,
        library: &PigmentLibrary,
        mapper: Mapper,
        settings: &MapSettings,
        region: Region,
        book: Book,
    ) -> Result<Self, SurveyError> {
        let opened = mapper.open_book(&book)?;
        let about = MapsAbout {
            pigments: mapper.columns().iter().map(|column| column.name.clone()).collect(),
            library_sha256: Input::new("", library.to_json().as_bytes()).sha256,
            book_sha256: book.sha256()?,
            scan: cube.sign()?,
            rows: region.rows,
            columns: region.columns,
            settings: stored_settings(settings, &mapper),
        };
        Ok(Self { cube, mapper, book, opened, about })
    }

    /// The scan that was surveyed.
    #[must_use]
    pub fn cube(&self) -> &Cube {
        &self.cube
    }

    /// The library on the wavelengths of the scan.
    #[must_use]
    pub fn mapper(&self) -> &Mapper {
        &self.mapper
    }

    /// The book of the survey.
    #[must_use]
    pub fn book(&self) -> &Book {
        &self.book
    }

    /// Description of the run that we store with the maps: hashes, region, settings.
    #[must_use]
    pub fn about(&self) -> &MapsAbout {
        &self.about
    }

    /// Pigments and groups that the survey found, the most frequent first.
    #[must_use]
    pub fn palette(&self) -> Vec<FoundColumn> {
        let columns = self.mapper.columns().iter();
        let mut found: Vec<FoundColumn> = columns
            .map(|column: &Column| {
                let sets = self.book.sets.iter().filter(|set| {
                    set.pigments.iter().any(|place: &u8| {
                        let name = self.book.pigments.get(usize::from(*place));
                        name.is_some_and(|name| column.pigments.contains(name))
                    })
                });
                // A sum of nothing would be -0.
                let part = sets.fold(0.0, |sum, set| sum + f64::from(set.part));
                FoundColumn { column: column.clone(), part }
            })
            .collect();
        found.sort_by(|a, b| b.part.total_cmp(&a.part));
        found
    }

    /// Maps pixels. Pass their reflectances pixel after pixel, all bands of each.
    ///
    /// # Errors
    /// [`MapError`] for a broken pixel.
    pub fn map_pixels(&self, spectra: &[f32]) -> Result<BlockMaps, MapError> {
        self.mapper.map(&self.opened, spectra, &[])
    }

    /// Pigments of the best set of one pixel with their shares, the greatest first. You get `None`
    /// if we cannot map the pixel.
    ///
    /// # Errors
    /// [`MapError`] unless `spectrum` has one reflectance a band.
    pub fn best_set(&self, spectrum: &[f32]) -> Result<Option<Vec<(String, f64)>>, MapError> {
        self.mapper.best_set(&self.opened, spectrum)
    }

    /// Maps one block of the scan.
    ///
    /// # Errors
    /// [`MapError`] if the block has other bands than the scan.
    pub fn map_block(&self, block: &Block) -> Result<BlockMaps, MapError> {
        self.mapper.map(&self.opened, &block.values, &block.mask)
    }
}

impl Region {
    /// Mean reflectance of this region of `cube`. Use it as the ground of a map.
    ///
    /// # Errors
    /// [`SurveyError`] if the region does not lie within the scan, we cannot read it, or none of
    /// its pixels holds a reflectance.
    pub fn ground(&self, cube: &Cube) -> Result<Ground, SurveyError> {
        let region = inside(cube, Some(self.clone()))?;
        let (pixels, mean) = cube.mean(region.rows.clone(), region.columns.clone())?;
        if pixels == 0 {
            let problem = "has no pixel that holds a reflectance".to_owned();
            return Err(MapError::Ground(problem).into());
        }
        Ok(Ground::new(cube.wavelengths_nm().to_vec(), mean)?)
    }
}

/// Cuts the cube to the library's wavelengths, so that other bands do not decide whether a pixel
/// can be mapped.
fn within(cube: Cube, library: &PigmentLibrary) -> Result<Cube, CubeError> {
    let range = library.grid.start_nm()..=library.grid.end_nm();
    // Without any, the mapper says which it needs.
    match cube.wavelengths_nm().iter().any(|nm| range.contains(nm)) {
        true => cube.between(range),
        false => Ok(cube),
    }
}

/// Returns `region` if it lies within the cube, or all of the cube if there is none.
fn inside(cube: &Cube, region: Option<Region>) -> Result<Region, SurveyError> {
    let whole = Region { rows: 0..cube.lines(), columns: 0..cube.samples() };
    let Some(region) = region else { return Ok(whole) };
    if fits(&region.rows, &whole.rows) && fits(&region.columns, &whole.columns) {
        return Ok(region);
    }
    Err(SurveyError::Region { region, lines: whole.rows.end, samples: whole.columns.end })
}

fn fits(part: &Range<usize>, all: &Range<usize>) -> bool {
    !part.is_empty() && part.end <= all.end
}

/// The settings that we store with the maps.
fn stored_settings(settings: &MapSettings, mapper: &Mapper) -> Map<String, Value> {
    let groups: Map<String, Value> = (mapper.columns().iter())
        .filter(|column| column.pigments.len() > 1)
        .map(|column| (column.name.clone(), json!(column.pigments)))
        .collect();
    let all = json!({
        "at_most": settings.at_most,
        "palette": mapper.pigments(),
        "groups": groups,
        "sensor_noise": settings.sensor_noise,
        "model_error": mapper.model_error().to_json(),
        "penalty": settings.penalty,
        "ground": settings.ground,
    });
    match all {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// We cannot survey a scan.
#[derive(Debug, thiserror::Error, Explain)]
pub enum SurveyError {
    /// The scan cannot be read.
    #[error(transparent)]
    Cube(#[from] CubeError),
    /// Scan, library and settings do not fit together.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The region does not lie within the scan.
    #[error(
        "the region {}..{},{}..{} (rows, columns) does not lie within the scan's {lines} x {samples} pixels",
        region.rows.start, region.rows.end, region.columns.start, region.columns.end
    )]
    #[hint("leave [region] out to map all of the scan")]
    #[fault(Setting)]
    Region {
        /// Region that you asked for.
        region: Region,
        /// Rows of the scan.
        lines: usize,
        /// Columns of the scan.
        samples: usize,
    },
}

/// A pigment with a smaller share takes no part in the mapped mixture of a spot.
const LEAST_SHARE: f32 = 1e-4;

/// A pigment or group in a spot.
#[derive(Debug, Clone, PartialEq)]
pub struct SpotPigment {
    /// Name of the pigment or group.
    pub name: String,
    /// Share of the paint, 0 to 1.
    pub share: f64,
    /// Standard deviation of the share.
    pub share_sd: f64,
    /// Probability that it is there, 0 to 1.
    pub presence: f64,
}

/// A pixel or region of a scan. We map its mean spectrum as one pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// Rows and columns.
    pub region: Region,
    /// Number of pixels in the mean. We leave out pixels that cannot be mapped.
    pub pixels: usize,
    /// Wavelengths of the scan's bands in nm.
    pub measured_nm: Vec<f64>,
    /// Mean measured reflectance of each band.
    pub measured: Vec<f64>,
    /// Wavelengths of the library in nm.
    pub mapped_nm: Vec<f64>,
    /// Reflectance of the mapped mixture of single pigments.
    pub mapped: Vec<f64>,
    /// Pigments and groups with a share, the greatest first. If the spectrum is out of gamut, there
    /// are none.
    pub pigments: Vec<SpotPigment>,
    /// Chi-square per degree of freedom.
    pub chi2: f64,
    /// Root mean square difference in reflectance.
    pub rms: f64,
}

impl SurveyedScan {
    /// Maps the mean spectrum of `region`. Pass the library of the survey as `library`.
    ///
    /// # Errors
    /// [`SpotError`] if the region is not within the scan, or we cannot map any of its pixels.
    pub fn spot(&self, library: &PigmentLibrary, region: Region) -> Result<Spot, SpotError> {
        let (pixels, measured) = self.cube().mean(region.rows.clone(), region.columns.clone())?;
        if pixels == 0 {
            return Err(SpotError::NothingMapped(region));
        }
        let mean: Vec<f32> = measured.iter().map(|value| *value as f32).collect();
        let maps = self.map_pixels(&mean)?;
        if !maps.mask[0].is_compared() {
            return Err(SpotError::NothingMapped(region));
        }
        let columns = self.mapper().columns();
        let Some(set) = self.best_set(&mean)? else {
            return Err(SpotError::NothingMapped(region));
        };
        let library = self.mapper().with_ground(library)?;
        let mixture = library.mix(library.recipe(set)?)?;
        let told = columns.iter().enumerate().map(|(place, column)| SpotPigment {
            name: column.name.clone(),
            share: f64::from(maps.share[place]),
            share_sd: f64::from(maps.share_sd[place]),
            presence: f64::from(maps.presence[place]),
        });
        let mut pigments: Vec<SpotPigment> =
            told.filter(|pigment| pigment.share > f64::from(LEAST_SHARE)).collect();
        pigments.sort_by(|a, b| b.share.total_cmp(&a.share));
        Ok(Spot {
            region,
            pixels,
            measured_nm: self.cube().wavelengths_nm().to_vec(),
            measured,
            mapped_nm: library.grid.wavelengths_nm().collect(),
            mapped: mixture.hiding(library.saunderson),
            pigments,
            chi2: f64::from(maps.chi2[0]),
            rms: f64::from(maps.rms[0]),
        })
    }
}

/// We cannot map a spot.
#[derive(Debug, thiserror::Error, Explain)]
pub enum SpotError {
    /// The region is not within the scan, or we cannot read the scan.
    #[error(transparent)]
    Cube(#[from] CubeError),
    /// The spectrum does not fit the survey.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The library lacks a pigment of the survey.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// We cannot map any pixel of the region.
    #[error("rows {}..{}, columns {}..{}: none of these pixels can be mapped", .0.rows.start, .0.rows.end, .0.columns.start, .0.columns.end)]
    #[hint("choose another [spot]")]
    #[fault(Setting)]
    NothingMapped(Region),
}

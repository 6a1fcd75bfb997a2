//! Which pigments to map, and where: the options of a map, which every program fills in its own way.
//!
//! Comments of the fields are the help texts of the command line and the descriptions of the schema.

use std::ops::Range;
use std::path::PathBuf;

use calibrate::{Residuals, ResidualsError};
use documents::request::{RequestError, from_text, from_text_or_keys};
use documents::{Task, excerpt, hint::Explain};
use pigment::PigmentLibrary;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::cube::Cube;
use crate::films::bands::Ground;
use crate::films::settings::{MapSettings, ModelError, PigmentGroup};
use crate::mapping::book::Book;
use crate::pixel_maps::MapError;
use crate::surveyed::{Region, Spot, SpotError, SurveyError, SurveyedScan};
#[cfg(feature = "files")]
use crate::{
    blocks::{MapOutcome, RunError},
    store::{StoreError, StoreMode},
};

/// Options of a map of a scan. [`Self::survey`] surveys the scan, and [`Self::run`] also maps it.
///
/// ```
/// use documents::request::request_from_json;
/// use maps::{MapRequest, Region};
///
/// let json = r#"{"at_most": 2, "groups": ["whites=Lead White,Zinc White"], "region": "0..512,100..300"}"#;
/// let request: MapRequest = request_from_json(json)?;
/// assert_eq!(request.groups[0].pigments, ["Lead White", "Zinc White"]);
/// assert_eq!(request.region, Some(Region { rows: 0..512, columns: 100..300 }));
/// # Ok::<(), documents::request::RequestError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a map of a scan")]
pub struct MapRequest {
    /// Most pigments of one pixel, 1 to 4 [default: 4]
    pub at_most: usize,
    /// A pigment that may take part; may be repeated [default: all whose S is known]
    pub palette: Vec<String>,
    /// Pigments that are mapped as one, such as `whites=Lead White,Zinc White`; may be repeated
    #[serde(deserialize_with = "read_groups")]
    #[schemars(schema_with = "groups_schema")]
    pub groups: Vec<PigmentGroup>,
    /// Map each pigment by itself, also those that the bands cannot tell apart
    pub apart: bool,
    /// Standard deviation of the noise of a band, as a fraction [default: the noise of the white reading, else
    /// 0.003]
    pub noise: Option<f64>,
    /// Errors of mixtures that the library had not seen, from the residuals of `impasto validate`
    /// [default: for the Van Gogh oils, the residuals that ship with them]
    #[schemars(with = "Option<String>")]
    pub residuals: Option<PathBuf>,
    /// How far K and S of the library may be off, as a fraction [default: 0.1 for a library without
    /// residuals]
    pub model_error: Option<f64>,
    /// The bare ground, which is then mapped as ground instead of paint, also where it shows through thin
    /// paint: rows and columns of the scan, such as 0..20,0..100, or a file with its reflectance
    #[schemars(schema_with = "ground_schema")]
    pub ground: Option<GroundSource>,
    /// Amount by which a further pigment must lower chi-square for the survey to find it
    /// [default: 2]
    pub penalty: f64,
    /// Rows and columns to map, from 0 and without the last, such as 0..512,100..300 [default: all]
    #[serde(serialize_with = "write_region", deserialize_with = "read_region")]
    #[schemars(schema_with = "region_schema")]
    pub region: Option<Region>,
    /// A pixel or region to compare, such as 120,40 or 120..124,40..44: you see its measured spectrum
    /// beside the spectrum of its mapped mixture (may be repeated)
    #[serde(serialize_with = "write_spots", deserialize_with = "read_spots")]
    #[schemars(with = "Vec<String>")]
    pub spots: Vec<Region>,
}

impl Default for MapRequest {
    fn default() -> Self {
        let MapSettings { at_most, penalty, .. } = MapSettings::default();
        Self {
            at_most,
            palette: Vec::new(),
            groups: Vec::new(),
            apart: false,
            noise: None,
            residuals: None,
            model_error: None,
            ground: None,
            penalty,
            region: None,
            spots: Vec::new(),
        }
    }
}

/// The bare ground of a map. In JSON it is rows and columns, the path of a file, or an object with `nm` and
/// `reflectance`.
#[derive(Debug, Clone, PartialEq)]
pub enum GroundSource {
    /// Rows and columns of the scan that show it.
    Region(Region),
    /// The file with its reflectance, `FILE` or `FILE#NAME`.
    #[cfg(feature = "files")]
    File(String),
    /// Its reflectance.
    Measured(Ground),
}

/// A scan that was surveyed and mapped.
#[cfg(feature = "files")]
#[derive(Debug)]
pub struct MappedScan {
    /// The scan with the pigments that the survey found in it.
    pub scan: SurveyedScan,
    /// Counts of the run.
    pub outcome: MapOutcome,
    /// The spots of the request.
    pub spots: Vec<Spot>,
}

impl MapRequest {
    /// Settings of a map of `cube` with `library`. This reads the files of residuals and of the ground.
    ///
    /// # Errors
    /// [`MapRequestError`] for a file that cannot be read, residuals that do not suit the library, or a
    /// ground without a reflectance.
    pub fn settings(
        &self,
        cube: &Cube,
        library: &PigmentLibrary,
    ) -> Result<MapSettings, MapRequestError> {
        let ground = self.ground.as_ref().map(|ground| ground.of(cube)).transpose()?;
        self.settings_with(cube.noise_of_white(), ground, library)
    }

    /// Settings for spectra with this `ground`, and this noise where the request states none.
    pub(crate) fn settings_with(
        &self,
        noise: Option<f64>,
        ground: Option<Ground>,
        library: &PigmentLibrary,
    ) -> Result<MapSettings, MapRequestError> {
        if self.residuals.is_some() && self.model_error.is_some() {
            return Err(MapRequestError::TwoErrors);
        }
        let usual = MapSettings::default();
        let of_white = noise.map(|noise| noise.max(usual.sensor_noise));
        let residuals = self.residuals.as_ref().map(Residuals::open).transpose()?;
        let stated = self.model_error.map(ModelError::Stated);
        let settings = MapSettings {
            at_most: self.at_most,
            palette: self.palette.clone(),
            groups: self.groups.clone(),
            group_alike: !self.apart,
            sensor_noise: self.noise.or(of_white).unwrap_or(usual.sensor_noise),
            model_error: residuals.map(ModelError::Residuals).or(stated),
            penalty: self.penalty,
            ground,
        };
        if let (Err(reason), Some(path)) = (settings.model_error_of(library), &self.residuals) {
            return Err(MapRequestError::Unsuitable(path.clone(), reason));
        }
        Ok(settings)
    }

    /// Surveys a scan, or takes the `book` of an earlier survey. `task` counts the surveyed pixels.
    ///
    /// # Errors
    /// [`MapRequestError`] if the scan cannot be read, does not fit the library, the request or the book, or
    /// `task` was cancelled.
    pub fn survey(
        &self,
        cube: Cube,
        library: &PigmentLibrary,
        book: Option<Book>,
        task: &Task,
    ) -> Result<SurveyedScan, MapRequestError> {
        let settings = self.settings(&cube, library)?;
        let region = self.region.clone();
        let surveyed = match book {
            Some(book) => SurveyedScan::with_book(cube, library, &settings, region, book),
            None => SurveyedScan::survey(cube, library, &settings, region, task),
        };
        Ok(surveyed?)
    }

    /// Maps the spots of the request. Pass the library of the survey as `library`.
    ///
    /// # Errors
    /// [`SpotError`] if a spot is not within the scan, or we cannot map any of its pixels.
    pub fn spots_of(
        &self,
        scan: &SurveyedScan,
        library: &PigmentLibrary,
    ) -> Result<Vec<Spot>, SpotError> {
        let spots = self.spots.iter().map(|region| scan.spot(library, region.clone())).collect();
        #[cfg(feature = "files")]
        scan.cube().check_unchanged()?;
        spots
    }

    /// Surveys a scan, maps every pixel of it into the folder `maps`, and maps the spots. `task` counts the
    /// surveyed pixels, then those that are mapped. If it is cancelled while we map, the run ends, and
    /// [`StoreMode::Resume`] continues it.
    ///
    /// ```no_run
    /// use documents::Task;
    /// use maps::{Cube, MapRequest, StoreMode};
    /// use pigment::PigmentLibrary;
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let request = MapRequest { at_most: 2, ..MapRequest::default() };
    /// let cube = Cube::open("scan.hdr")?;
    /// let mapped = request.run(cube, &oils, "maps.zarr", StoreMode::New, &Task::default())?;
    /// println!("{}", mapped.scan.to_json(None, &mapped.spots));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MapRequestError`] if the scan cannot be surveyed or mapped, or the maps cannot be written.
    #[cfg(feature = "files")]
    pub fn run(
        &self,
        cube: Cube,
        library: &PigmentLibrary,
        maps: impl AsRef<std::path::Path>,
        mode: StoreMode,
        task: &Task,
    ) -> Result<MappedScan, MapRequestError> {
        let scan = self.survey(cube, library, None, task)?;
        let store = scan.store(maps, mode)?;
        let outcome = scan.map(&store, task)?;
        let spots = self.spots_of(&scan, library)?;
        Ok(MappedScan { scan, outcome, spots })
    }
}

impl GroundSource {
    /// The reflectance of the ground, from `cube` or from the file.
    fn of(&self, cube: &Cube) -> Result<Ground, MapRequestError> {
        match self {
            Self::Region(region) => Ok(region.ground(cube)?),
            #[cfg(feature = "files")]
            Self::File(file) => {
                let opened = spectra::read_spectrum(file).map_err(MapRequestError::GroundFile)?;
                let reflectance = opened.spectrum.reflectance()?;
                let nm = reflectance.grid().wavelengths_nm().collect();
                let ground = Ground::new(nm, reflectance.values().to_vec());
                Ok(ground.map_err(SurveyError::from)?)
            }
            Self::Measured(ground) => Ok(ground.clone()),
        }
    }

    #[cfg(feature = "files")]
    fn of_text(text: &str) -> Result<Self, RequestError> {
        Ok(rectangle(text).map_or_else(|| Self::File(text.to_owned()), Self::Region))
    }

    #[cfg(not(feature = "files"))]
    fn of_text(text: &str) -> Result<Self, RequestError> {
        rectangle(text).map(Self::Region).ok_or_else(|| {
            let reason = format!("takes rows and columns, found `{text}`");
            RequestError::value(reason, "try [ground=0..20,0..100]")
        })
    }
}

impl Serialize for GroundSource {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Region(region) => text_of(region).serialize(serializer),
            #[cfg(feature = "files")]
            Self::File(file) => file.serialize(serializer),
            Self::Measured(ground) => ground.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for GroundSource {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text_or_keys(deserializer, Self::of_text, Self::Measured)
    }
}

/// Parses `ROWS,COLUMNS`, each `FIRST..END`; `None` for any other text.
fn rectangle(text: &str) -> Option<Region> {
    let (rows, columns) = text.split_once(',')?;
    Some(Region { rows: range(rows)?, columns: range(columns)? })
}

fn range(part: &str) -> Option<Range<usize>> {
    let (first, end) = part.split_once("..")?;
    Some(first.trim().parse().ok()?..end.trim().parse().ok()?)
}

/// Parses `ROW,COLUMN` or `ROWS,COLUMNS`; `None` for any other text, and for a region without pixels.
fn pixel_or_rectangle(text: &str) -> Option<Region> {
    let (rows, columns) = text.split_once(',')?;
    let region = Region { rows: one_or_range(rows)?, columns: one_or_range(columns)? };
    Some(region).filter(|region| !region.rows.is_empty() && !region.columns.is_empty())
}

fn one_or_range(part: &str) -> Option<Range<usize>> {
    if part.contains("..") {
        return range(part);
    }
    let place: usize = part.trim().parse().ok()?;
    Some(place..place.checked_add(1)?)
}

/// Parses a group, `NAME=PIGMENT,..`.
fn group(text: &str) -> Result<PigmentGroup, RequestError> {
    let found = text.split_once('=').map(|(name, pigments)| PigmentGroup {
        name: name.trim().to_owned(),
        pigments: pigments.split(',').map(|name| name.trim().to_owned()).collect(),
    });
    let named = found.filter(|group| {
        !group.name.is_empty() && group.pigments.iter().all(|name| !name.is_empty())
    });
    named.ok_or_else(|| {
        RequestError::value(
            format!("takes NAME=PIGMENT,PIGMENT.., found `{}`", excerpt(text)),
            "try [group=\"whites=Lead White,Zinc White\"]",
        )
    })
}

/// Text of a region, for example `0..512,100..300`.
fn text_of(region: &Region) -> String {
    let Region { rows, columns } = region;
    format!("{}..{},{}..{}", rows.start, rows.end, columns.start, columns.end)
}

fn write_region<S: Serializer>(region: &Option<Region>, serializer: S) -> Result<S::Ok, S::Error> {
    region.as_ref().map(text_of).serialize(serializer)
}

fn read_region<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Region>, D::Error> {
    from_text(deserializer, |text| {
        let region = rectangle(text).ok_or_else(|| {
            RequestError::value(
                format!("takes rows and columns, found `{text}`"),
                "try [region=0..512,100..300]",
            )
        });
        region.map(Some)
    })
}

fn write_spots<S: Serializer>(spots: &[Region], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(spots.iter().map(text_of))
}

fn read_spots<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Region>, D::Error> {
    let spots = Vec::<SpotEntry>::deserialize(deserializer)?;
    Ok(spots.into_iter().map(|SpotEntry(region)| region).collect())
}

/// An entry of the list of spots.
struct SpotEntry(Region);

impl<'de> Deserialize<'de> for SpotEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text(deserializer, |text| {
            pixel_or_rectangle(text).map(Self).ok_or_else(|| {
                RequestError::value(
                    format!("takes a row and a column, or rows and columns, found `{text}`"),
                    "try [spot=120,40] or [spot=120..124,40..44]",
                )
            })
        })
    }
}

pub(crate) fn read_groups<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<PigmentGroup>, D::Error> {
    let groups = Vec::<GroupEntry>::deserialize(deserializer)?;
    Ok(groups.into_iter().map(|GroupEntry(group)| group).collect())
}

/// An entry of the list of groups.
struct GroupEntry(PigmentGroup);

impl<'de> Deserialize<'de> for GroupEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text_or_keys(deserializer, |text| group(text).map(Self), Self)
    }
}

pub(crate) fn groups_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": "array",
        "items": {
            "anyOf": [
                { "type": "string" },
                {
                    "type": "object",
                    "additionalProperties": false,
                    "properties": {
                        "name": { "type": "string" },
                        "pigments": { "type": "array", "items": { "type": "string" } },
                    },
                    "required": ["name", "pigments"],
                },
            ],
        },
    })
}

fn ground_schema(_: &mut SchemaGenerator) -> Schema {
    let numbers = json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": 2 });
    json_schema!({
        "anyOf": [
            { "type": "string" },
            {
                "type": "object",
                "additionalProperties": false,
                "properties": { "nm": numbers, "reflectance": numbers },
                "required": ["nm", "reflectance"],
            },
            { "type": "null" },
        ],
    })
}

fn region_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": ["string", "null"] })
}

/// We cannot map a scan as the request says.
#[derive(Debug, thiserror::Error, Explain)]
pub enum MapRequestError {
    /// The scan cannot be surveyed, or its ground has no reflectance.
    #[error(transparent)]
    Survey(#[from] SurveyError),
    /// The file of residuals cannot be read.
    #[error(transparent)]
    Residuals(#[from] ResidualsError),
    /// The residuals do not suit the library.
    #[error("{} cannot be used", .0.display())]
    #[hint(inner = 1)]
    Unsuitable(PathBuf, #[source] ResidualsError),
    /// The request gives both residuals and a model error.
    #[error("residuals and model_error exclude each other")]
    #[hint("leave one of them out")]
    #[fault(Setting)]
    TwoErrors,
    /// The ground is neither a region nor the file of a spectrum.
    #[cfg(feature = "files")]
    #[error("ground takes a region or a file")]
    #[hint(inner)]
    GroundFile(#[source] spectra::instrument::OpenError),
    /// The file of the ground holds another quantity than a reflectance.
    #[cfg(feature = "files")]
    #[error(transparent)]
    GroundQuantity(#[from] spectra::instrument::ReflectanceError),
    /// A spot of the request cannot be mapped.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Spot(#[from] SpotError),
    /// The maps cannot be begun or resumed.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The run failed. Shards that it wrote before are whole.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Run(#[from] RunError<MapError>),
}

impl MapRequestError {
    pub(crate) fn of(error: MapError) -> Self {
        Self::Survey(error.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::request::request_from_json;

    fn whites() -> PigmentGroup {
        let pigments = ["Lead White", "Zinc White"].map(str::to_owned).to_vec();
        PigmentGroup { name: "whites".to_owned(), pigments }
    }

    #[test]
    fn a_request_is_the_same_after_json() {
        let region = Region { rows: 0..20, columns: 5..100 };
        let request = MapRequest {
            at_most: 2,
            palette: vec!["Viridian".to_owned()],
            groups: vec![whites()],
            apart: true,
            noise: Some(0.1),
            residuals: Some("residuals.json".into()),
            model_error: Some(0.05),
            ground: Some(GroundSource::Region(region.clone())),
            penalty: 0.3,
            region: Some(region.clone()),
            spots: vec![region, Region { rows: 3..4, columns: 5..6 }],
        };
        let measured = Ground::new(vec![400.0, 700.0], vec![0.3, 0.1]).unwrap();
        let grounds =
            [GroundSource::File("linen.csv".to_owned()), GroundSource::Measured(measured)];
        let [file, measured] =
            grounds.map(|ground| MapRequest { ground: Some(ground), ..request.clone() });
        for request in [request, file, measured, MapRequest::default()] {
            let json = serde_json::to_string(&request).unwrap();
            assert_eq!(request_from_json::<MapRequest>(&json).unwrap(), request, "{json}");
        }
        assert_eq!(request_from_json::<MapRequest>("{}").unwrap(), MapRequest::default());
    }

    #[test]
    fn the_defaults_are_those_of_the_settings() {
        let settings = MapSettings::default();
        let MapRequest { at_most, apart, penalty, .. } = MapRequest::default();
        assert_eq!(
            (at_most, !apart, penalty),
            (settings.at_most, settings.group_alike, settings.penalty)
        );
    }

    #[test]
    fn values_may_be_text_as_on_a_command_line() {
        let text = r#"{
            "groups": [" whites = Lead White , Zinc White", {"name": "whites", "pigments": ["Lead White", "Zinc White"]}],
            "region": "0..512, 100..300",
            "ground": "0..20,0..100",
            "spots": ["120,40", "120..124,40..44"]
        }"#;
        let request: MapRequest = request_from_json(text).unwrap();
        assert_eq!(request.groups, [whites(), whites()]);
        assert_eq!(request.region, Some(Region { rows: 0..512, columns: 100..300 }));
        let bare = Region { rows: 0..20, columns: 0..100 };
        assert_eq!(request.ground, Some(GroundSource::Region(bare)));
        let pixel = Region { rows: 120..121, columns: 40..41 };
        assert_eq!(request.spots, [pixel, Region { rows: 120..124, columns: 40..44 }]);
        let request: MapRequest = request_from_json(r#"{"ground": "linen.csv#bare"}"#).unwrap();
        assert_eq!(request.ground, Some(GroundSource::File("linen.csv#bare".to_owned())));
    }

    #[test]
    fn what_a_key_does_not_take_is_refused_with_a_way_out() {
        let numbers = "write a value of the kind that the key takes";
        for (json, message, hint) in [
            (
                r#"{"groups": ["a=Viridian", "whites"]}"#,
                "[[groups]] 2 takes NAME=PIGMENT,PIGMENT.., found `whites`",
                "try `group = \"whites=Lead White,Zinc White\"`",
            ),
            (
                r#"{"groups": ["whites=Lead White,"]}"#,
                "[[groups]] 1 takes NAME=PIGMENT,PIGMENT.., found `whites=Lead White,`",
                "try `group = \"whites=Lead White,Zinc White\"`",
            ),
            (
                r#"{"region": "120,40"}"#,
                "region takes rows and columns, found `120,40`",
                "try `region = 0..512,100..300`",
            ),
            (
                r#"{"spots": ["5..5,0..2"]}"#,
                "[[spots]] 1 takes a row and a column, or rows and columns, found `5..5,0..2`",
                "try `spot = 120,40` or `spot = 120..124,40..44`",
            ),
            (
                r#"{"spots": ["18446744073709551615,0"]}"#,
                "[[spots]] 1 takes a row and a column, or rows and columns, found `18446744073709551615,0`",
                "try `spot = 120,40` or `spot = 120..124,40..44`",
            ),
            (
                r#"{"ground": {"nm": [400, 700], "reflectance": [0.3, 3]}}"#,
                "ground: the spectrum of the ground reflects 3 at 700 nm",
                numbers,
            ),
            (r#"{"palettes": []}"#, "unknown key `palettes`", "did you mean palette?"),
        ] {
            let error = request_from_json::<MapRequest>(json).unwrap_err();
            let found = error.hint().map(|hint| hint.to_string());
            assert_eq!((error.to_string().as_str(), found.as_deref()), (message, Some(hint)));
        }
    }
}

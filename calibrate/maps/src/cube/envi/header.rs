//! The text header of an ENVI cube: its fields, and what they mean for the numbers.

use std::path::{Path, PathBuf};

use crate::cube::error::{CubeError, shortened};
use crate::cube::raw_file::{Interleave, Layout};
use crate::numbers::{ByteOrder, NumberType};

/// Keys that name the quantity of the values.
const QUANTITY_KEYS: [&str; 2] = ["data units", "z plot titles"];

/// We accept at most this many bands, so that a wrong header takes no memory.
const MOST_BANDS: usize = 65_536;

/// The checked header of an ENVI file.
#[derive(Debug, Clone, PartialEq)]
pub struct EnviHeader {
    pub(crate) layout: Layout,
    /// Wavelength of each band in nm, if the header has them.
    pub wavelengths_nm: Option<Vec<f64>>,
    /// Full width at half maximum of each band in nm, if the header has them.
    pub fwhm_nm: Option<Vec<f64>>,
    /// Whether each band is good (`bbl`).
    pub good: Vec<bool>,
    /// Value that marks pixels without data.
    pub ignore: Option<f64>,
    /// Divide values by this number to get reflectance.
    pub scale_factor: Option<f64>,
    /// Factor and summand that turn the values of each band into reflectance.
    pub gains: Option<Vec<(f64, f64)>>,
    /// Texts on the values and the scan, each with the name of its key.
    pub(crate) told: Vec<(String, String)>,
    /// Whether the header says that the values are a radiance.
    pub is_radiance: bool,
    /// Integration time, in the unit of the camera.
    pub integration_time: Option<f64>,
    /// Sentences about the header that you should show to the user.
    pub remarks: Vec<String>,
}

impl EnviHeader {
    /// Reads the header in `bytes`. Messages call it `path`.
    ///
    /// # Errors
    /// [`CubeError`] with line and key, if we cannot read the data with this header.
    pub fn parse(bytes: &[u8], path: &Path) -> Result<Self, CubeError> {
        let fields = Fields::parse(bytes, path)?;
        refuse_other_kinds(&fields)?;
        let [samples, lines, bands] = ["samples", "lines", "bands"].map(|key| size(&fields, key));
        let samples = samples?;
        let lines = lines?;
        let bands = bands?;
        if bands > MOST_BANDS {
            let problem = format!("must be at most {MOST_BANDS}, found `{bands}`");
            return Err(fields.fault("bands", problem, "correct the header"));
        }
        let number_type = number_type(&fields)?;
        let mut remarks = Vec::new();
        let wavelengths = fields.list("wavelength", bands)?;
        let unit = fields.text("wavelength units")?;
        let wavelengths = wavelengths
            .map(|values| {
                spectra::WavelengthList::of(&values, unit).map_err(|problem| {
                    let way_out = "write wavelengths in nm, with `wavelength units = Nanometers`";
                    fields.fault("wavelength", problem, way_out)
                })
            })
            .transpose()?;
        remarks.extend(wavelengths.as_ref().and_then(|found| found.remark.clone()));
        let factor = wavelengths.as_ref().map_or(1.0, |found| found.factor);
        let fwhm = fields.list("fwhm", bands)?;
        let fwhm_nm = fwhm.map(|list| list.into_iter().map(|width| width * factor).collect());
        Ok(Self {
            layout: Layout {
                lines,
                samples,
                bands,
                offset: fields.whole("header offset")?.unwrap_or(0),
                number_type,
                byte_order: byte_order(&fields, number_type, &mut remarks)?,
                interleave: interleave(&fields, bands)?,
            },
            wavelengths_nm: wavelengths.map(|found| found.nm),
            fwhm_nm,
            good: good_bands(&fields, bands, &mut remarks)?,
            ignore: fields.number("data ignore value")?,
            scale_factor: scale_factor(&fields)?,
            gains: gains(&fields, bands)?,
            told: told(&fields)?,
            is_radiance: says(&fields, "radiance")?,
            integration_time: fields.number("tint").ok().flatten(),
            remarks,
        })
    }
}

/// Refuses spectral libraries, classifications, compressed data and data with gaps.
fn refuse_other_kinds(fields: &Fields) -> Result<(), CubeError> {
    let kind = fields.text("file type")?.unwrap_or_default().to_lowercase();
    let kinds = [
        (
            "library",
            "spectra of points: `impasto identify` names their pigments, `impasto color` their colours",
        ),
        ("classification", "name a scan of type ENVI Standard"),
    ];
    if let Some((_, way_out)) = kinds.iter().find(|(word, _)| kind.contains(word)) {
        let problem = format!("is `{}`, which is not a scan", shortened(&kind));
        return Err(fields.fault("file type", problem, *way_out));
    }
    if fields.whole("file compression")?.unwrap_or(0) != 0 {
        let way_out = "save the scan without compression";
        return Err(fields.fault("file compression", "says that the data are packed", way_out));
    }
    for key in ["major frame offsets", "minor frame offsets"] {
        let frames = fields.text(key)?.unwrap_or_default();
        if frames.chars().any(|c| c.is_ascii_digit() && c != '0') {
            let problem = format!("is `{}`: data with gaps are not read", shortened(frames));
            return Err(fields.fault(
                key,
                problem,
                "save the scan as ENVI Standard without frames",
            ));
        }
    }
    for key in QUANTITY_KEYS {
        let words = fields.text(key)?.unwrap_or_default().to_lowercase();
        if words.contains("transmi") || words.contains("absorb") {
            let problem = format!("is `{}`, no reflectance", shortened(&words));
            let way_out = "export the scan as reflectance";
            return Err(fields.fault(key, problem, way_out));
        }
    }
    Ok(())
}

/// Whether the text of one of the [`QUANTITY_KEYS`] contains `word`.
fn says(fields: &Fields, word: &str) -> Result<bool, CubeError> {
    for key in QUANTITY_KEYS {
        if fields.text(key)?.is_some_and(|text| text.to_lowercase().contains(word)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Texts that may name the quantity of the values, each with its key.
fn told(fields: &Fields) -> Result<Vec<(String, String)>, CubeError> {
    let mut told = Vec::new();
    for key in QUANTITY_KEYS.into_iter().chain(["description"]) {
        told.extend(fields.text(key)?.map(|text| (key.to_owned(), text.to_owned())));
    }
    Ok(told)
}

fn size(fields: &Fields, key: &str) -> Result<usize, CubeError> {
    let number = fields.required(key)?;
    usize::try_from(number).ok().filter(|size| *size > 0).ok_or_else(|| {
        fields.fault(key, format!("must be at least 1, found `{number}`"), "correct the header")
    })
}

fn number_type(fields: &Fields) -> Result<NumberType, CubeError> {
    Ok(match fields.required("data type")? {
        1 => NumberType::U8,
        2 => NumberType::I16,
        3 => NumberType::I32,
        4 => NumberType::F32,
        5 => NumberType::F64,
        12 => NumberType::U16,
        13 => NumberType::U32,
        14 => NumberType::I64,
        15 => NumberType::U64,
        complex @ (6 | 9) => {
            let problem = format!("is `{complex}`, complex numbers, which are not reflectances");
            return Err(fields.fault("data type", problem, "save real numbers"));
        }
        other => {
            let problem = format!("must be 1, 2, 3, 4, 5, 12, 13, 14 or 15, found `{other}`");
            return Err(fields.fault("data type", problem, "correct the header"));
        }
    })
}

/// The order of bytes. A header without one means 0, little endian, as for ENVI itself.
fn byte_order(
    fields: &Fields,
    number_type: NumberType,
    remarks: &mut Vec<String>,
) -> Result<ByteOrder, CubeError> {
    match fields.whole("byte order")? {
        Some(0) => Ok(ByteOrder::Little),
        Some(1) => Ok(ByteOrder::Big),
        None => {
            if number_type.bytes() > 1 {
                remarks.push(
                    "the header names no byte order: 0 (little endian) is taken, as ENVI does"
                        .to_owned(),
                );
            }
            Ok(ByteOrder::Little)
        }
        Some(other) => {
            let problem = format!("must be 0 or 1, found `{other}`");
            Err(fields.fault("byte order", problem, "correct the header"))
        }
    }
}

fn interleave(fields: &Fields, bands: usize) -> Result<Interleave, CubeError> {
    let text = fields.text("interleave")?.unwrap_or_default();
    match text.to_lowercase().as_str() {
        "bsq" => Ok(Interleave::Bsq),
        "bil" => Ok(Interleave::Bil),
        "bip" => Ok(Interleave::Bip),
        "" if bands == 1 => Ok(Interleave::Bsq),
        _ => {
            let problem = match text {
                "" => "is missing".to_owned(),
                text => format!("must be bsq, bil or bip, found `{}`", shortened(text)),
            };
            Err(fields.fault("interleave", problem, "add `interleave = bil`, or the order it has"))
        }
    }
}

fn good_bands(
    fields: &Fields,
    bands: usize,
    remarks: &mut Vec<String>,
) -> Result<Vec<bool>, CubeError> {
    let Some(list) = fields.list("bbl", bands)? else { return Ok(vec![true; bands]) };
    let good: Vec<bool> = list.iter().map(|value| *value != 0.0).collect();
    match good.iter().filter(|good| !**good).count() {
        0 => {}
        all if all == bands => {
            let way_out = "set good bands to 1, or remove `bbl`";
            return Err(fields.fault("bbl", "marks every band as bad", way_out));
        }
        bad => remarks.push(format!("{bad} of {bands} bands are marked as bad and left out (bbl)")),
    }
    Ok(good)
}

fn scale_factor(fields: &Fields) -> Result<Option<f64>, CubeError> {
    const KEY: &str = "reflectance scale factor";
    match fields.number(KEY)? {
        Some(factor) if !(factor.is_finite() && factor > 0.0) => {
            let problem = format!("must be above 0, found `{factor}`");
            Err(fields.fault(KEY, problem, "correct the header"))
        }
        factor => Ok(factor),
    }
}

fn gains(fields: &Fields, bands: usize) -> Result<Option<Vec<(f64, f64)>>, CubeError> {
    const GAINS: &str = "data reflectance gain values";
    const OFFSETS: &str = "data reflectance offset values";
    let Some(gains) = fields.list(GAINS, bands)? else { return Ok(None) };
    let offsets = fields.list(OFFSETS, bands)?.unwrap_or_else(|| vec![0.0; bands]);
    let pairs: Vec<_> = gains.into_iter().zip(offsets).collect();
    match pairs.iter().position(|(gain, offset)| !(gain.is_finite() && offset.is_finite())) {
        None => Ok(Some(pairs)),
        Some(at) => {
            let problem = format!("must be finite numbers, found `{:?}`", pairs[at]);
            Err(fields.fault(GAINS, problem, "correct the header"))
        }
    }
}

#[derive(Debug)]
struct Field {
    /// Key in lower case, with one space between words.
    key: String,
    value: String,
    line: usize,
}

/// Keys and values of a header. The case of a key does not matter.
#[derive(Debug)]
pub(crate) struct Fields {
    path: PathBuf,
    fields: Vec<Field>,
}

/// Whether a file that begins with these bytes is an ENVI header.
pub(crate) fn is_header(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.starts_with(b"ENVI") && bytes.get(4).is_none_or(u8::is_ascii_whitespace)
}

/// Whether the text is the header of an Esri grid, which also ends in `.hdr`.
fn is_esri(text: &str) -> bool {
    let mut first_words = text.lines().filter_map(|line| line.split_whitespace().next());
    let mut again = first_words.clone();
    first_words.any(|word| word.eq_ignore_ascii_case("ncols"))
        && again.any(|word| word.eq_ignore_ascii_case("nrows"))
}

impl Fields {
    pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Self, CubeError> {
        let text = String::from_utf8_lossy(bytes);
        if !is_header(bytes) {
            return Err(match is_esri(&text) {
                true => CubeError::format(
                    path,
                    "the header of an Esri grid (ncols, nrows), not of ENVI",
                    "export the scan as ENVI: an Esri grid has no wavelengths",
                ),
                false => CubeError::format(
                    path,
                    "no ENVI header: the first line is not `ENVI`",
                    "name the .hdr file that belongs to the data",
                ),
            });
        }
        let mut fields = Vec::new();
        let mut lines = text.lines().zip(1..).skip(1);
        while let Some((text, line)) = lines.next() {
            let text = text.trim();
            // Lines without an equals sign, such as comments of other programs, hold no key.
            let Some((key, value)) = text.split_once('=').filter(|_| !text.starts_with(';')) else {
                continue;
            };
            let key = key.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
            let mut value = value.trim().to_owned();
            if let Some(inside) = value.strip_prefix('{') {
                let mut list = inside.to_owned();
                while !list.contains('}') {
                    let Some((more, _)) = lines.next() else {
                        return Err(CubeError::Key {
                            path: path.to_owned(),
                            line,
                            key,
                            problem: "opens a brace that is never closed".to_owned(),
                            way_out: "close the list with }".to_owned(),
                        });
                    };
                    if !more.trim_start().starts_with(';') {
                        list.push('\n');
                        list.push_str(more.trim());
                    }
                }
                value = list.split('}').next().unwrap_or_default().trim().to_owned();
            }
            fields.push(Field { key, value, line });
        }
        Ok(Self { path: path.to_owned(), fields })
    }

    /// The value of a key and its line. This fails if the header has the key twice with different
    /// values.
    fn find(&self, key: &str) -> Result<Option<&Field>, CubeError> {
        let mut found = self.fields.iter().filter(|field| field.key == key);
        let Some(first) = found.next() else { return Ok(None) };
        match found.find(|other| other.value != first.value) {
            None => Ok(Some(first)),
            Some(other) => Err(self
                .fault(
                    key,
                    format!("has another value than in line {}", first.line),
                    "remove one of the two lines",
                )
                .at(other.line)),
        }
    }

    /// An error about the key `key`, at its line.
    pub(crate) fn fault(
        &self,
        key: &str,
        problem: impl Into<String>,
        way_out: impl Into<String>,
    ) -> CubeError {
        let line = self.fields.iter().find(|field| field.key == key).map_or(0, |field| field.line);
        CubeError::Key {
            path: self.path.clone(),
            line,
            key: key.to_owned(),
            problem: problem.into(),
            way_out: way_out.into(),
        }
    }

    /// Text of a key, or `None` if it is missing or empty.
    pub(crate) fn text(&self, key: &str) -> Result<Option<&str>, CubeError> {
        let found = self.find(key)?;
        Ok(found.map(|field| field.value.as_str()).filter(|value| !value.is_empty()))
    }

    pub(crate) fn whole(&self, key: &str) -> Result<Option<u64>, CubeError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        let number = text.parse().map_err(|_| {
            self.fault(
                key,
                format!("must be a whole number, found `{}`", shortened(text)),
                format!("correct `{key}` in the header"),
            )
        })?;
        Ok(Some(number))
    }

    /// Whole number of a key that every header has.
    pub(crate) fn required(&self, key: &str) -> Result<u64, CubeError> {
        self.whole(key)?.ok_or_else(|| {
            self.fault(key, "is missing", format!("add the line `{key} = ..` to the header"))
        })
    }

    /// Number of a key, which must be finite.
    pub(crate) fn number(&self, key: &str) -> Result<Option<f64>, CubeError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        match text.parse::<f64>() {
            Ok(number) => Ok(Some(number)),
            Err(_) => Err(self.fault(
                key,
                format!("must be a number, found `{}`", shortened(text)),
                format!("correct `{key}` in the header"),
            )),
        }
    }

    /// Numbers of a list of `bands` numbers.
    pub(crate) fn list(&self, key: &str, bands: usize) -> Result<Option<Vec<f64>>, CubeError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        let words = text.split([',', ' ', '\t', '\n']).map(str::trim);
        let mut numbers = Vec::new();
        for word in words.filter(|word| !word.is_empty()) {
            let number = word.parse::<f64>().map_err(|_| {
                let found = shortened(word);
                let problem = format!("has `{found}` as number {}", numbers.len() + 1);
                self.fault(key, problem, "write numbers with commas between them")
            })?;
            numbers.push(number);
        }
        if numbers.len() != bands {
            let problem = format!("has {} numbers, but `bands` is {bands}", numbers.len());
            return Err(self.fault(key, problem, "give one number a band"));
        }
        Ok(Some(numbers))
    }
}

impl CubeError {
    /// Changes the line number of an error about a key.
    fn at(self, at: usize) -> Self {
        match self {
            Self::Key { path, key, problem, way_out, .. } => {
                Self::Key { path, line: at, key, problem, way_out }
            }
            other => other,
        }
    }
}

//! ENVI spectral libraries: a text header (`.hdr`) and a file of plain numbers (`.sli`), one spectrum a line.
//!
//! The header states the number of wavelengths as `samples` and the number of spectra as `lines`. You may name
//! either file: the other one lies beside it.

use std::path::{Path, PathBuf};

use documents::file::is_there;

use super::decode::{Decimal, decode_text, lines, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Point, ordered};
use super::quantity::MeasuredQuantity;

const TITLE: &str = "ENVI spectral library";
/// Endings of the data beside a header.
const ENDINGS: [&str; 6] = ["sli", "SLI", "img", "dat", "bsq", "lib"];
/// Numbers of at least this size mark wavelengths without a value: -1.23e34 is usual.
const NO_VALUE: f64 = 1e30;
/// Wavelengths up to this number are micrometres if the header names no unit.
const MOST_MICROMETRES: f64 = 30.0;

/// Whether a text is a header of ENVI.
pub(super) fn is_header(text: &str) -> bool {
    lines(text).next().is_some_and(|(_, line)| line.trim() == "ENVI")
}

/// Whether a file is the data of a library, by its ending.
pub(super) fn is_data(file: &str) -> bool {
    Path::new(file).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("sli"))
}

/// Reads the library with the header `text`, the content of `file`.
pub(super) fn read_header(
    file: &str,
    text: &str,
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let header = Header::parse(file, text)?;
    let stem = Path::new(file).with_extension("");
    let added = |ending: &&str| PathBuf::from(format!("{}.{ending}", stem.display()));
    let places = std::iter::once(stem.clone()).chain(ENDINGS.iter().map(added));
    let Some(place) = places.into_iter().find(|place| is_there(place)) else {
        return Err(not_read(
            file,
            "the header of an ENVI spectral library without its data",
            DATA,
        ));
    };
    let bytes = documents::file::read(&place).map_err(|error| {
        InstrumentError::faulty(&place.display().to_string(), TITLE, error.to_string())
    })?;
    header.spectra(file, &place.display().to_string(), &bytes)
}

/// Reads the library with the data `bytes`, the content of `file`.
pub(super) fn read_data(
    file: &str,
    bytes: &[u8],
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let replaced = ["hdr", "HDR"].map(|ending| Path::new(file).with_extension(ending));
    let added = ["hdr", "HDR"].map(|ending| PathBuf::from(format!("{file}.{ending}")));
    let Some(place) = replaced.into_iter().chain(added).find(|place| is_there(place)) else {
        return Err(not_read(
            file,
            "the data of an ENVI spectral library without its header",
            HEADER,
        ));
    };
    let name = place.display().to_string();
    let text = documents::file::read(&place)
        .map_err(|error| InstrumentError::faulty(&name, TITLE, error.to_string()))?;
    Header::parse(&name, &decode_text(&text).0)?.spectra(&name, file, bytes)
}

const DATA: &str = "put the data beside it, with the same name and the ending .sli";
const HEADER: &str = "put the header beside it, with the same name and the ending .hdr";

fn not_read(file: &str, kind: &'static str, way: &'static str) -> InstrumentError {
    InstrumentError::NotRead { file: file.to_owned(), kind, way }
}

/// The fields of a header: line, key in lower case, and text.
struct Header {
    fields: Vec<(usize, String, String)>,
}

impl Header {
    fn parse(file: &str, text: &str) -> Result<Self, InstrumentError> {
        let mut fields = Vec::new();
        let mut lines = lines(text);
        while let Some((number, line)) = lines.next() {
            let Some((key, value)) = line.split_once('=') else { continue };
            let key = key.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
            let mut value = value.trim().to_owned();
            // A list goes on to its closing brace.
            while value.starts_with('{') && !value.contains('}') {
                let Some((_, more)) = lines.next() else {
                    let expected = "a closing brace of the list";
                    return Err(InstrumentError::line(file, number, expected, line));
                };
                value += " ";
                value += more.trim();
            }
            fields.push((number, key, value.trim_matches(['{', '}', ' ']).to_owned()));
        }
        let header = Self { fields };
        let kind = header.text("file type").map_or("", |(_, kind)| kind).to_lowercase();
        if !kind.contains("library") {
            let way = "`impasto map` reads scans; a spectral library has `file type = ENVI Spectral Library`";
            return Err(not_read(file, "the header of an ENVI scan", way));
        }
        Ok(header)
    }

    fn text(&self, key: &str) -> Option<(usize, &str)> {
        let found = self.fields.iter().find(|(_, known, text)| known == key && !text.is_empty());
        found.map(|(line, _, text)| (*line, text.as_str()))
    }

    fn number(
        &self,
        file: &str,
        key: &str,
        expected: &'static str,
    ) -> Result<Option<f64>, InstrumentError> {
        let found = self.text(key);
        found
            .map(|(line, text)| required_number(file, line, expected, text, Decimal::Point))
            .transpose()
    }

    /// A whole number of 1 or more, such as the number of spectra.
    fn size(
        &self,
        file: &str,
        key: &str,
        expected: &'static str,
    ) -> Result<usize, InstrumentError> {
        let number = self.number(file, key, expected)?.unwrap_or(0.0);
        let is_size = number >= 1.0 && number.fract() == 0.0 && number < 1e9;
        match is_size {
            true => Ok(number as usize),
            false => {
                let line = self.text(key).map_or(1, |(line, _)| line);
                Err(InstrumentError::line(file, line, expected, &number.to_string()))
            }
        }
    }

    /// Numbers of a list, with the line on which it begins.
    fn list(
        &self,
        file: &str,
        key: &str,
        expected: &'static str,
    ) -> Result<Option<(usize, Vec<f64>)>, InstrumentError> {
        let Some((line, text)) = self.text(key) else { return Ok(None) };
        let words = text.split([',', ' ', '\t']).filter(|word| !word.is_empty());
        let numbers = words.map(|word| required_number(file, line, expected, word, Decimal::Point));
        Ok(Some((line, numbers.collect::<Result<_, _>>()?)))
    }

    /// The spectra in `bytes`, the content of `data`. Messages about the header call it `file`.
    fn spectra(
        &self,
        file: &str,
        data: &str,
        bytes: &[u8],
    ) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
        let count = self.size(file, "samples", "the number of wavelengths (samples)")?;
        let spectra = self.size(file, "lines", "the number of spectra (lines)")?;
        let kind = self.size(file, "data type", "a type of number (data type)")?;
        let is_big = self.number(file, "byte order", "0 or 1 (byte order)")?.unwrap_or(0.0) == 1.0;
        let offset = self.number(file, "header offset", "a number of bytes (header offset)")?;
        let offset = offset.unwrap_or(0.0).max(0.0) as usize;
        let (size, number): (usize, Decode) = decoder(kind).ok_or_else(|| {
            let line = self.text("data type").map_or(1, |(line, _)| line);
            let expected = "a type of real number (data type 1 to 5 or 12 to 15)";
            InstrumentError::line(file, line, expected, &kind.to_string())
        })?;
        let wanted = count.saturating_mul(spectra).saturating_mul(size).saturating_add(offset);
        if bytes.len() != wanted {
            let fault = format!(
                "the header describes {spectra} spectra of {count} wavelengths, {wanted} bytes, found {}",
                bytes.len()
            );
            return Err(InstrumentError::faulty(data, TITLE, fault));
        }
        let nm = self.wavelengths(file, count)?;
        let names = self.names(file, spectra);
        let factor =
            self.number(file, "reflectance scale factor", "a number (reflectance scale factor)")?;
        let factor = factor.filter(|factor| *factor > 0.0);
        let ignored = self.number(file, "data ignore value", "a number (data ignore value)")?;
        let words: Vec<&str> = ["data units", "z plot titles"]
            .iter()
            .filter_map(|key| Some(self.text(key)?.1))
            .collect();
        let quantity = MeasuredQuantity::of_words(&words.join(", "));
        let is_percent =
            words.iter().any(|text| text.contains('%') || text.to_lowercase().contains("percent"));
        let unit = match (factor, is_percent) {
            (Some(_), _) => Unit::Fraction,
            (None, true) => Unit::Percent,
            (None, false) => Unit::Unstated,
        };
        let bad = self.list(file, "bbl", "0 or 1 for each wavelength (bbl)")?.unwrap_or_default().1;
        let is_bad = |at: usize| bad.len() == count && bad[at] == 0.0;
        let mut found = Vec::new();
        let records = bytes[offset..].chunks_exact(size * count);
        for (record, name) in records.zip(names) {
            let values = record.chunks_exact(size).map(|bytes| number(bytes, is_big));
            let points: Vec<Point> = (values.zip(&nm.values).enumerate())
                .filter(|(at, (value, _))| {
                    let is_value = value.is_finite() && value.abs() < NO_VALUE;
                    is_value && Some(*value) != ignored && !is_bad(*at)
                })
                .map(|(_, (value, &nm_of))| Point {
                    line: nm.line,
                    nm: nm_of,
                    value: value / factor.unwrap_or(1.0),
                })
                .collect();
            if points.is_empty() {
                let fault = format!("`{name}` has no value at any wavelength");
                return Err(InstrumentError::faulty(data, TITLE, fault));
            }
            let left_out = count - points.len();
            let mut ordered = ordered(file, points, Duplicates::Average)?;
            ordered.remarks.extend(nm.remark.clone());
            if left_out > 0 {
                let left_out = documents::counted(left_out, "wavelength");
                ordered.remarks.push(format!("{left_out} without a value left out"));
            }
            found.push(MeasuredSpectrum {
                name,
                quantity,
                role: Role::Main,
                unit,
                wavelengths_nm: ordered.wavelengths_nm,
                values: ordered.values,
                line: nm.line,
                point_lines: Vec::new(),
                details: Vec::new(),
                remarks: ordered.remarks,
            });
        }
        Ok(found)
    }

    /// Names of the spectra, or numbers where the header names none.
    fn names(&self, file: &str, spectra: usize) -> Vec<String> {
        let listed = self.text("spectra names").map_or("", |(_, text)| text);
        let names: Vec<String> = listed
            .split(',')
            .map(|name| name.trim().to_owned())
            .filter(|name| !name.is_empty())
            .collect();
        match (names.len() == spectra, spectra) {
            (true, _) => names,
            (false, 1) => vec![stem(file)],
            (false, _) => (1..=spectra).map(|number| format!("{} {number}", stem(file))).collect(),
        }
    }

    fn wavelengths(&self, file: &str, count: usize) -> Result<Wavelengths, InstrumentError> {
        const EXPECTED: &str = "a list of wavelengths (wavelength)";
        let Some((line, values)) = self.list(file, "wavelength", EXPECTED)? else {
            return Err(InstrumentError::line(file, 1, EXPECTED, "none"));
        };
        if values.len() != count {
            return Err(InstrumentError::Count {
                file: file.to_owned(),
                line,
                what: "wavelengths",
                expected: count,
                found: values.len(),
            });
        }
        let unit = self.text("wavelength units").map(|(_, unit)| unit.to_lowercase());
        let most = values.iter().copied().fold(0.0, f64::max);
        let (factor, remark) = match unit.as_deref() {
            Some("nanometers" | "nanometres" | "nm") => (1.0, None),
            Some("micrometers" | "micrometres" | "microns" | "um") => (1000.0, None),
            None | Some("unknown" | "") if most <= MOST_MICROMETRES => {
                (1000.0, Some(format!("wavelengths up to {most} are taken for micrometres")))
            }
            None | Some("unknown" | "") => {
                (1.0, Some(format!("wavelengths up to {most} are taken for nm")))
            }
            Some(other) => {
                let line = self.text("wavelength units").map_or(line, |(line, _)| line);
                return Err(InstrumentError::line(file, line, "nanometers or micrometers", other));
            }
        };
        // A micrometre of a header with few digits is a rounded number of nm.
        let values = values.into_iter().map(|value| (value * factor * 1e6).round() / 1e6).collect();
        Ok(Wavelengths { line, values, remark })
    }
}

struct Wavelengths {
    line: usize,
    values: Vec<f64>,
    remark: Option<String>,
}

type Decode = fn(&[u8], bool) -> f64;

/// Bytes of a number of this ENVI type, and its decoder, which takes the bytes and whether the most significant
/// comes first.
fn decoder(kind: usize) -> Option<(usize, Decode)> {
    macro_rules! number {
        ($type:ty) => {
            (size_of::<$type>(), |bytes, is_big| {
                let mut own = [0; size_of::<$type>()];
                own.copy_from_slice(bytes);
                (if is_big { <$type>::from_be_bytes(own) } else { <$type>::from_le_bytes(own) })
                    as f64
            })
        };
    }
    Some(match kind {
        1 => number!(u8),
        2 => number!(i16),
        3 => number!(i32),
        4 => number!(f32),
        5 => number!(f64),
        12 => number!(u16),
        13 => number!(u32),
        14 => number!(i64),
        15 => number!(u64),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Format, InstrumentFile, bytes_of, read};
    use super::*;

    const HEADER: &str = "ENVI\ndescription = {two paints}\nsamples = 4\nlines = 2\nbands = 1\n\
        header offset = 0\nfile type = ENVI Spectral Library\ndata type = 4\ninterleave = bsq\n\
        wavelength units = Nanometers\nspectra names = {\n Madder, lake\n}\nwavelength = {\n 400, 500,\n 600, 700}\n";

    fn names(header: &str) -> String {
        header.replace("Madder, lake", "Madder, Slate")
    }

    fn written(folder: &Path, header: &str, data: &[u8]) -> [String; 2] {
        let files = ["paints.hdr", "paints.sli"].map(|name| folder.join(name));
        std::fs::write(&files[0], header).unwrap();
        std::fs::write(&files[1], data).unwrap();
        files.map(|path| path.display().to_string())
    }

    fn opened(path: &str) -> Result<InstrumentFile, InstrumentError> {
        read(path, &bytes_of(path).unwrap(), None)
    }

    fn floats(values: &[f32]) -> Vec<u8> {
        values.iter().flat_map(|value| value.to_le_bytes()).collect()
    }

    const VALUES: [f32; 8] = [0.1, 0.2, 0.6, 0.7, 0.5, 0.4, 0.3, 0.25];

    #[test]
    fn a_library_is_read_from_its_header_and_from_its_data() {
        let folder = tempfile::tempdir().unwrap();
        for path in written(folder.path(), &names(HEADER), &floats(&VALUES)) {
            let found = opened(&path).unwrap();
            assert_eq!(found.format, Format::EnviLibrary, "{path}");
            let names: Vec<&str> = found.spectra.iter().map(|s| s.name.as_str()).collect();
            assert_eq!(names, ["Madder", "Slate"], "{path}");
            for (spectrum, values) in found.spectra.iter().zip(VALUES.chunks_exact(4)) {
                assert_eq!(spectrum.wavelengths_nm, [400.0, 500.0, 600.0, 700.0]);
                assert_eq!(
                    spectrum.values,
                    values.iter().map(|v| f64::from(*v)).collect::<Vec<_>>()
                );
                assert_eq!((spectrum.unit, spectrum.role), (Unit::Unstated, Role::Main));
            }
        }
    }

    #[test]
    fn types_orders_factors_and_missing_values_are_understood() {
        let folder = tempfile::tempdir().unwrap();
        let big: Vec<u8> =
            VALUES.iter().flat_map(|v| ((v * 10_000.0) as i16).to_be_bytes()).collect();
        let header = names(HEADER).replace("data type = 4", "data type = 2\nbyte order = 1")
            + "reflectance scale factor = 10000\n";
        let [path, _] = written(folder.path(), &header, &big);
        let found = opened(&path).unwrap().spectra;
        assert!((found[1].values[3] - 0.25).abs() < 1e-9 && found[1].unit == Unit::Fraction);
        let header =
            names(HEADER).replace("Nanometers", "Micrometers").replace("400, 500", "0.4, 0.5");
        let header = header.replace("600, 700", "0.6, 0.7") + "bbl = {1, 1, 1, 0}\n";
        let mut values = VALUES;
        values[1] = -1.23e34;
        let [path, _] = written(folder.path(), &header, &floats(&values));
        let found = opened(&path).unwrap().spectra;
        assert_eq!(found[0].wavelengths_nm, [400.0, 600.0]);
        assert_eq!(found[0].remarks, ["2 wavelengths without a value left out"]);
        assert_eq!(found[1].wavelengths_nm, [400.0, 500.0, 600.0]);
    }

    #[test]
    fn faults_name_the_file_and_the_way_out() {
        let folder = tempfile::tempdir().unwrap();
        for (from, to, words) in [
            ("ENVI Spectral Library", "ENVI Standard", "the header of an ENVI scan"),
            ("samples = 4", "samples = 5", "160 bytes"),
            ("600, 700", "600", "the file states 4 wavelengths, found `3`"),
            ("data type = 4", "data type = 6", "a type of real number"),
            ("lines = 2", "lines = 0", "the number of spectra"),
            ("Nanometers", "Wavenumber", "nanometers or micrometers"),
            ("wavelength = ", "waves = ", "a list of wavelengths"),
            ("600, 700}", "600, 700", "a closing brace"),
        ] {
            let [path, _] =
                written(folder.path(), &names(HEADER).replace(from, to), &floats(&VALUES));
            let error = opened(&path).unwrap_err().to_string();
            let words = if words == "160 bytes" {
                "2 spectra of 5 wavelengths, 40 bytes, found 32"
            } else {
                words
            };
            assert!(error.contains("paints.") && error.contains(words), "{to}: {error}");
        }
        let alone = tempfile::tempdir().unwrap();
        let header = alone.path().join("alone.hdr");
        std::fs::write(&header, HEADER).unwrap();
        let error = opened(&header.display().to_string()).unwrap_err().to_string();
        assert!(error.contains("without its data"), "{error}");
        let data = alone.path().join("other.sli");
        std::fs::write(&data, floats(&VALUES)).unwrap();
        let error = opened(&data.display().to_string()).unwrap_err().to_string();
        assert!(error.contains("without its header"), "{error}");
    }
}

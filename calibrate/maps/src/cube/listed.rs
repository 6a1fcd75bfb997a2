//! Opens scans in files that the caller reads, for example in a browser.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::envi::{self, EnviHeader};
use super::error::{CubeError, refuse_other_kinds};
use super::interpret::{Reading, Readings};
use super::options::{CubeOptions, DarkReading};
use super::raw_file::{PositionalFile, ReadAt};
use super::scan::Cube;
use super::window::Opened;

/// We tell the kind of a file by this many first bytes.
const START: usize = 4096;
/// Advice if a header or its data are missing.
const BOTH: &str = "give the header (.hdr) and its data file together";

/// A file that you read for us, e.g. in a browser.
#[derive(Debug, Clone)]
pub struct ScanFile {
    /// Name of the file, as messages show it.
    pub name: PathBuf,
    /// Contents.
    pub contents: Arc<dyn ReadAt>,
}

impl ScanFile {
    fn start(&self, bytes: u64) -> Result<Vec<u8>, CubeError> {
        let mut start = vec![0; self.contents.bytes().min(bytes) as usize];
        PositionalFile::with(self.contents.clone(), &self.name).read_at(&mut start, 0)?;
        Ok(start)
    }

    fn is_header(&self) -> Result<bool, CubeError> {
        let named = self.name.extension().is_some_and(|end| end.eq_ignore_ascii_case("hdr"));
        Ok(named || envi::is_header(&self.start(START as u64)?))
    }
}

impl Cube {
    /// Opens the ENVI scan among `files`: a header and its data. Readings of white and dark that `options` name
    /// are among them too.
    pub fn of_files(files: &[ScanFile], options: &CubeOptions) -> Result<Self, CubeError> {
        let dark = match &options.dark_reading {
            DarkReading::File(path) => Some(path),
            _ => None,
        };
        let given = [options.white_reading.as_ref(), dark];
        let mut headers = Vec::new();
        for file in files {
            if file.is_header()? && !given.contains(&Some(&file.name)) {
                headers.push(file);
            }
        }
        let header = match &headers[..] {
            [header] => header,
            [] => return Err(without_header(files)?),
            [first, ..] => {
                let problem = format!("is one of {} headers of ENVI", headers.len());
                return Err(CubeError::format(&first.name, problem, "give those of one scan"));
            }
        };
        options.check(&header.name)?;
        let scan = open(files, &header.name)?;
        let readings = readings(&scan, None, options, &|path| open(files, path))?;
        Self::of(scan, readings.as_ref(), options)
    }
}

/// The error if none of the files is a header.
fn without_header(files: &[ScanFile]) -> Result<CubeError, CubeError> {
    let Some(first) = files.first() else {
        return Ok(CubeError::format(Path::new("scan"), "no file is given", BOTH));
    };
    refuse_other_kinds(&first.name, &first.start(START as u64)?)?;
    Ok(CubeError::format(
        &first.name,
        "is not a cube that can be read, and no header of ENVI is beside it",
        BOTH,
    ))
}

/// Opens the header `path` among `files`, and its data.
fn open(files: &[ScanFile], path: &Path) -> Result<Opened, CubeError> {
    let Some(file) = files.iter().find(|file| file.name == path) else {
        return Err(CubeError::format(path, "is not among the files", BOTH));
    };
    envi::check_length(path, file.contents.bytes())?;
    let header = EnviHeader::parse(&file.start(u64::MAX)?, path)?;
    let data = data_of(files, path, &header)?;
    envi::check_size(&data.name, path, &header, data.contents.bytes())?;
    let data = PositionalFile::with(data.contents.clone(), &data.name);
    Ok(envi::opened(path, header, data))
}

/// Finds the data of a header by name, and among several files by size. If no name fits, the data
/// are the only other file.
fn data_of<'f>(
    files: &'f [ScanFile],
    path: &Path,
    header: &EnviHeader,
) -> Result<&'f ScanFile, CubeError> {
    let places = envi::places(path);
    let named: Vec<&ScanFile> =
        places.iter().filter_map(|place| files.iter().find(|f| f.name == *place)).collect();
    if let Some(file) = named
        .iter()
        .find(|file: &&&ScanFile| header.layout.file_bytes() == Some(file.contents.bytes()))
        .or(named.first())
    {
        return Ok(file);
    }
    let mut others = Vec::new();
    for file in files {
        if !file.is_header()? {
            others.push(file);
        }
    }
    match &others[..] {
        [only] if files.len() == 2 => Ok(only),
        _ => Err(CubeError::format(path, "the data of this header are not beside it", BOTH)),
    }
}

/// Readings that lie beside a scan.
#[derive(Debug, Default)]
pub(crate) struct OwnReadings {
    pub(crate) white: Option<PathBuf>,
    pub(crate) dark: Option<PathBuf>,
    /// Separate dark reading of the white, if the camera took one.
    pub(crate) white_dark: Option<PathBuf>,
}

/// White and dark readings of a scan. They come from the settings, or else from its folder. `open`
/// opens a reading.
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
    let white = Reading::of(&white_scan, scan, "white")?;
    let dark = dark.map(|path| Reading::of(&open(path)?, scan, "dark")).transpose()?;
    let white_dark = white_dark.map(|path| Reading::of(&open(path)?, scan, "dark")).transpose()?;
    Ok(Some(Readings { white, dark, white_dark, tile: options.tile, time_ratio }))
}

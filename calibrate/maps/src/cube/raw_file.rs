//! Numbers in a plain file, in any order of lines, samples and bands. Several threads can read by
//! position.

use std::fmt::Debug;
#[cfg(feature = "files")]
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::error::CubeError;
use super::window::{Conversion, Pixels, Source, Window};
use crate::numbers::{ByteOrder, NumberType};

/// Order of lines, samples and bands in the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interleave {
    /// Band after band: band, line, sample.
    Bsq,
    /// Line after line, in each band after band: line, band, sample.
    Bil,
    /// Pixel after pixel: line, sample, band.
    Bip,
}

/// Sizes and order of the numbers of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) lines: usize,
    pub(crate) samples: usize,
    pub(crate) bands: usize,
    /// Bytes before the first number.
    pub(crate) offset: u64,
    pub(crate) number_type: NumberType,
    pub(crate) byte_order: ByteOrder,
    pub(crate) interleave: Interleave,
}

impl Layout {
    /// Bytes of the file, or `None` if this number is too large.
    pub(crate) fn file_bytes(&self) -> Option<u64> {
        let sizes = [self.lines, self.samples, self.bands, self.number_type.bytes()];
        let sizes = sizes.into_iter().map(|size| size as u64);
        let numbers = sizes.into_iter().try_fold(1_u64, u64::checked_mul)?;
        numbers.checked_add(self.offset)
    }

    /// Position of a number. It must lie in the file, so nothing overflows.
    pub(crate) fn position(&self, line: usize, sample: usize, band: usize) -> u64 {
        let [lines, samples, bands] =
            [self.lines, self.samples, self.bands].map(|size| size as u64);
        let line = line as u64;
        let sample = sample as u64;
        let band = band as u64;
        let number = match self.interleave {
            Interleave::Bsq => (band * lines + line) * samples + sample,
            Interleave::Bil => (line * bands + band) * samples + sample,
            Interleave::Bip => (line * samples + sample) * bands + band,
        };
        self.offset + number * self.number_type.bytes() as u64
    }
}

#[derive(Debug)]
pub(crate) struct RawFile {
    file: PositionalFile,
    layout: Layout,
    /// Memory for the bands of a block that is stored band after band.
    planes: Mutex<Vec<u8>>,
}

/// We transpose this many pixels together, so that their values stay in the fastest cache.
const TILE: usize = 32;

impl RawFile {
    /// Takes a file. It must have the size that `layout` describes.
    pub(crate) fn new(file: PositionalFile, layout: Layout) -> Self {
        Self { file, layout, planes: Mutex::new(Vec::new()) }
    }

    /// Converts numbers that lie band after band. `raw(band)` holds a row of the window.
    fn transpose<'b>(&self, raw: impl Fn(usize) -> &'b [u8], bands: usize, values: &mut [f32]) {
        let Layout { number_type, byte_order, .. } = self.layout;
        let tile_bytes = TILE * number_type.bytes();
        for (tile, values) in values.chunks_mut(TILE * bands).enumerate() {
            for band in 0..bands {
                let row = &raw(band)[tile * tile_bytes..];
                let row = &row[..tile_bytes.min(row.len())];
                number_type.convert(byte_order, row, &mut values[band..], bands);
            }
        }
    }

    /// Reads a row that the file stores band after band.
    fn bil_row(
        &self,
        line: usize,
        window: &Window,
        bands: &[usize],
        raw: &mut Vec<u8>,
        values: &mut [f32],
    ) -> Result<(), CubeError> {
        let first = bands.iter().copied().min().unwrap_or(0);
        let count = bands.iter().copied().max().unwrap_or(0) + 1 - first;
        let bytes = self.layout.number_type.bytes();
        let is_whole = window.width() == self.layout.samples && count <= 2 * bands.len();
        let row_bytes = window.width() * bytes;
        // All bands of the row at once where few are left out, else one by one.
        raw.resize(row_bytes * if is_whole { count } else { bands.len() }, 0);
        if is_whole {
            self.file.read_at(raw, self.layout.position(line, 0, first))?;
            self.transpose(
                |band: usize| &raw[(bands[band] - first) * row_bytes..][..row_bytes],
                bands.len(),
                values,
            );
        } else {
            for (row, &band) in raw.chunks_exact_mut(row_bytes).zip(bands) {
                let position = self.layout.position(line, window.columns.start, band);
                self.file.read_at(row, position)?;
            }
            self.transpose(|band| &raw[band * row_bytes..][..row_bytes], bands.len(), values);
        }
        Ok(())
    }

    /// Reads a row that the file stores pixel after pixel.
    fn bip_row(
        &self,
        line: usize,
        window: &Window,
        bands: &[usize],
        raw: &mut Vec<u8>,
        values: &mut [f32],
    ) -> Result<(), CubeError> {
        let Layout { number_type, byte_order, .. } = self.layout;
        let pixel_bytes = self.layout.bands * number_type.bytes();
        raw.resize(window.width() * pixel_bytes, 0);
        self.file.read_at(raw, self.layout.position(line, window.columns.start, 0))?;
        if bands.iter().copied().eq(0..self.layout.bands) {
            number_type.convert(byte_order, raw, values, 1);
            return Ok(());
        }
        let mut all = vec![0.0; self.layout.bands];
        for (pixel, values) in raw.chunks_exact(pixel_bytes).zip(values.chunks_mut(bands.len())) {
            number_type.convert(byte_order, pixel, &mut all, 1);
            for (value, &band) in values.iter_mut().zip(bands) {
                *value = all[band];
            }
        }
        Ok(())
    }

    /// Reads a block of rows that the file stores band after band. This reads the rows of each band
    /// at once.
    fn bsq_rows(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError> {
        let row_bytes = window.width() * self.layout.number_type.bytes();
        let plane_bytes = row_bytes * window.rows.len();
        // Memory that was used before is not cleared again.
        let mut raw =
            std::mem::take(&mut *self.planes.lock().unwrap_or_else(PoisonError::into_inner));
        raw.resize(plane_bytes * bands.len(), 0);
        let is_whole = window.width() == self.layout.samples;
        let planes = raw.par_chunks_mut(plane_bytes).zip(bands);
        planes.try_for_each(|(plane, &band)| {
            if is_whole {
                return self.file.read_at(plane, self.layout.position(window.rows.start, 0, band));
            }
            for (row, line) in plane.chunks_exact_mut(row_bytes).zip(window.rows.clone()) {
                let position = self.layout.position(line, window.columns.start, band);
                self.file.read_at(row, position)?;
            }
            Ok(())
        })?;
        pixels.rows(window, bands.len()).for_each(|(line, row)| {
            let start = (line - window.rows.start) * row_bytes;
            self.transpose(
                |band: usize| &raw[band * plane_bytes + start..][..row_bytes],
                bands.len(),
                row.values,
            );
            conversion.row(window.columns.start, row.values, row.mask);
        });
        *self.planes.lock().unwrap_or_else(PoisonError::into_inner) = raw;
        Ok(())
    }
}

impl Source for RawFile {
    fn read(
        &self,
        window: &Window,
        bands: &[usize],
        conversion: &Conversion,
        pixels: Pixels<'_>,
    ) -> Result<(), CubeError> {
        if pixels.values.is_empty() {
            return Ok(());
        }
        if self.layout.interleave == Interleave::Bsq {
            return self.bsq_rows(window, bands, conversion, pixels);
        }
        pixels.rows(window, bands.len()).try_for_each_init(Vec::new, |raw, (line, row)| {
            match self.layout.interleave {
                Interleave::Bip => self.bip_row(line, window, bands, raw, row.values)?,
                _ => self.bil_row(line, window, bands, raw, row.values)?,
            }
            conversion.row(window.columns.start, row.values, row.mask);
            Ok(())
        })
    }

    fn scratch_bytes(&self, rows: usize, columns: usize) -> usize {
        let row = columns * self.layout.bands * self.layout.number_type.bytes();
        match self.layout.interleave {
            Interleave::Bsq => row * rows,
            // Each thread holds one row.
            _ => row * rows.min(rayon::current_num_threads()),
        }
    }

    fn full_scale(&self) -> Option<f64> {
        self.layout.number_type.full_scale()
    }

    #[cfg(feature = "files")]
    fn check_unchanged(&self) -> Result<(), CubeError> {
        self.file.check_unchanged()
    }
}

/// Bytes that you can read by position, e.g. a file on a disk or slices of one that a browser
/// holds.
pub trait ReadAt: Debug + Send + Sync {
    /// Number of bytes.
    fn bytes(&self) -> u64;

    /// Fills `buffer` from the byte `position` on.
    ///
    /// # Errors
    /// [`io::ErrorKind::UnexpectedEof`] if the bytes end too early, or any other error of reading.
    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()>;
}

/// Size and time of a file when it was opened, or of all files below a folder.
#[cfg(feature = "files")]
#[derive(Debug, Clone)]
pub(crate) struct FileStamp {
    path: PathBuf,
    files: StampedFiles,
}

/// Number of some files, their bytes, and the time of the newest.
#[cfg(feature = "files")]
#[derive(Debug, Clone, Default, PartialEq)]
struct StampedFiles {
    count: u64,
    bytes: u64,
    newest: Option<std::time::SystemTime>,
}

#[cfg(feature = "files")]
impl StampedFiles {
    fn add(&mut self, path: &Path) -> io::Result<()> {
        let about = std::fs::metadata(path)?;
        if !about.is_dir() {
            self.count += 1;
            self.bytes += about.len();
            self.newest = self.newest.max(about.modified().ok());
            return Ok(());
        }
        for entry in std::fs::read_dir(path)? {
            let entry = entry?;
            // A link to a folder may lead back to this one.
            if !entry.file_type()?.is_symlink() || entry.path().is_file() {
                self.add(&entry.path())?;
            }
        }
        Ok(())
    }
}

#[cfg(feature = "files")]
impl FileStamp {
    pub(crate) fn of(path: &Path) -> Result<Self, CubeError> {
        let mut files = StampedFiles::default();
        files.add(path).map_err(|reason| CubeError::reading(path, reason))?;
        Ok(Self { path: path.to_owned(), files })
    }

    /// Refuses a file, or a folder with a file, that was changed or removed since.
    pub(crate) fn check(&self) -> Result<(), CubeError> {
        let problem = match Self::of(&self.path) {
            Ok(now) if now.files == self.files => return Ok(()),
            Ok(_) => "was changed while it was read",
            Err(_) => "was removed while it was read",
        };
        Err(CubeError::data(&self.path, problem, "read the scan again from the start"))
    }
}

#[derive(Debug, Clone)]
pub(crate) struct PositionalFile {
    path: PathBuf,
    source: Arc<dyn ReadAt>,
    /// `None` for a temporary file, which has no name, and for bytes in memory.
    #[cfg(feature = "files")]
    stamp: Option<FileStamp>,
}

impl PositionalFile {
    #[cfg(feature = "files")]
    pub(crate) fn open(path: &Path) -> Result<Self, CubeError> {
        let stamp = Some(FileStamp::of(path)?);
        let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
        Ok(Self { stamp, ..Self::of(file, path)? })
    }

    /// Takes an open file. Messages call it `path`.
    #[cfg(feature = "files")]
    pub(crate) fn of(file: File, path: &Path) -> Result<Self, CubeError> {
        let about = file.metadata().map_err(|reason| CubeError::reading(path, reason))?;
        if !about.is_file() {
            let way_out = "name a file on a disk: a cube is read in any order";
            return Err(CubeError::format(path, "not a regular file", way_out));
        }
        #[cfg(not(unix))]
        let file = std::sync::Mutex::new(file);
        Ok(Self::with(Arc::new(DiskFile { bytes: about.len(), file }), path))
    }

    /// Takes bytes that lie anywhere. Messages call them `path`.
    pub(crate) fn with(source: Arc<dyn ReadAt>, path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            source,
            #[cfg(feature = "files")]
            stamp: None,
        }
    }

    /// Refuses a file that was changed or removed since it was opened.
    #[cfg(feature = "files")]
    fn check_unchanged(&self) -> Result<(), CubeError> {
        self.stamp.as_ref().map_or(Ok(()), FileStamp::check)
    }

    /// Bytes of the file when it was opened.
    #[cfg(feature = "files")]
    pub(crate) fn bytes(&self) -> u64 {
        self.source.bytes()
    }

    pub(crate) fn read_at(&self, buffer: &mut [u8], position: u64) -> Result<(), CubeError> {
        self.source.read_exact_at(buffer, position).map_err(|reason| match reason.kind() {
            io::ErrorKind::UnexpectedEof => CubeError::data(
                &self.path,
                format!("ends before byte {}", position.saturating_add(buffer.len() as u64)),
                "the file became shorter while it was read: copy it again",
            ),
            _ => CubeError::reading(&self.path, reason),
        })
    }
}

#[cfg(feature = "files")]
#[derive(Debug)]
struct DiskFile {
    bytes: u64,
    #[cfg(unix)]
    file: File,
    #[cfg(not(unix))]
    file: std::sync::Mutex<File>,
}

#[cfg(feature = "files")]
impl ReadAt for DiskFile {
    fn bytes(&self) -> u64 {
        self.bytes
    }

    #[cfg(unix)]
    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        std::os::unix::fs::FileExt::read_exact_at(&self.file, buffer, position)
    }

    #[cfg(not(unix))]
    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        use std::io::{Read, Seek, SeekFrom};
        let mut file = self.file.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        file.seek(SeekFrom::Start(position))?;
        file.read_exact(buffer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_read_by_position_and_the_end_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cube.raw");
        std::fs::write(&path, [0, 1, 2, 3, 4]).unwrap();
        let file = PositionalFile::open(&path).unwrap();
        let mut part = [0; 2];
        file.read_at(&mut part, 3).unwrap();
        assert_eq!((part, file.bytes()), ([3, 4], 5));
        let error = file.read_at(&mut part, 4).unwrap_err().to_string();
        assert!(error.ends_with("cube.raw: ends before byte 6"), "{error}");
        file.check_unchanged().unwrap();
        std::fs::write(&path, [0, 1, 2, 3, 4, 5]).unwrap();
        let error = file.check_unchanged().unwrap_err().to_string();
        assert!(error.ends_with("cube.raw: was changed while it was read"), "{error}");
        std::fs::remove_file(&path).unwrap();
        let error = file.check_unchanged().unwrap_err().to_string();
        assert!(error.ends_with("cube.raw: was removed while it was read"), "{error}");
        let error = PositionalFile::open(folder.path()).unwrap_err().to_string();
        assert!(error.ends_with("not a regular file"), "{error}");
    }
}

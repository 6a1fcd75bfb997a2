//! Zip archives in which programs keep their data.

use std::io::{Cursor, Read};

use zip::ZipArchive;

use super::error::InstrumentError;

/// Most bytes that a file in an archive may unpack to; spectra have less by far.
const MOST_BYTES: u64 = 64 << 20;

/// An archive in memory.
pub(super) struct Archive<'a> {
    file: &'a str,
    archive: ZipArchive<Cursor<&'a [u8]>>,
}

pub(super) fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

impl<'a> Archive<'a> {
    pub(super) fn open(file: &'a str, bytes: &'a [u8]) -> Result<Self, InstrumentError> {
        let archive = ZipArchive::new(Cursor::new(bytes));
        let archive = archive
            .map_err(|_| InstrumentError::faulty(file, "zip", "its directory is missing"))?;
        Ok(Self { file, archive })
    }

    /// The first name of a file for which `is_wanted` holds.
    pub(super) fn find(&self, is_wanted: impl Fn(&str) -> bool) -> Option<String> {
        self.archive.file_names().find(|name| is_wanted(name)).map(str::to_owned)
    }

    /// The content of the file `name` of the archive.
    pub(super) fn read(&mut self, name: &str) -> Result<Vec<u8>, InstrumentError> {
        let faulty = |fault: String| InstrumentError::faulty(self.file, "zip", fault);
        let entry = self.archive.by_name(name);
        let entry = entry.map_err(|_| faulty(format!("`{name}` cannot be unpacked")))?;
        let mut bytes = Vec::new();
        let read = entry.take(MOST_BYTES + 1).read_to_end(&mut bytes);
        read.map_err(|_| faulty(format!("`{name}` cannot be unpacked")))?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(faulty(format!("`{name}` unpacks to more than {MOST_BYTES} bytes")));
        }
        Ok(bytes)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::io::Write;

    use zip::write::SimpleFileOptions;
    use zip::{CompressionMethod, ZipWriter};

    use super::*;

    /// An archive of these files, compressed.
    pub(in super::super) fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        for (name, bytes) in files {
            writer.start_file(*name, options).unwrap();
            writer.write_all(bytes).unwrap();
        }
        writer.finish().unwrap().into_inner()
    }

    #[test]
    fn files_are_found_and_unpacked() {
        let bytes = archive(&[("a.txt", b"one"), ("b.xml", b"two")]);
        assert!(is_zip(&bytes));
        let mut found = Archive::open("f", &bytes).unwrap();
        let name = found.find(|name| name.ends_with(".xml")).unwrap();
        assert_eq!((name.as_str(), found.read(&name).unwrap()), ("b.xml", b"two".to_vec()));
        assert!(found.read("c").unwrap_err().to_string().contains("`c` cannot be unpacked"));
        for length in 4..bytes.len() {
            assert!(Archive::open("f", &bytes[..length]).is_err(), "{length}");
        }
    }
}

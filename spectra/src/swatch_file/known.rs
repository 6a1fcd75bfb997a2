//! Reading a swatch file of any format.

use super::aco::read_aco;
use super::ase::read_ase;
use super::entries::SwatchFile;
use super::error::SwatchFileError;
use super::gpl::read_gpl;

/// Reads `bytes`, the content of `file`, if it is a swatch file: by its first bytes, and `.aco`, which has
/// none of its own, by the name. `None` for other files.
///
/// # Errors
/// [`SwatchFileError`] with the line, or the offset in bytes.
pub fn read_swatch_file(file: &str, bytes: &[u8]) -> Result<Option<SwatchFile>, SwatchFileError> {
    let ends_in = |ending: &str| file.to_ascii_lowercase().ends_with(ending);
    if bytes.starts_with(b"ASEF") || ends_in(".ase") {
        return read_ase(file, bytes).map(Some);
    }
    if bytes.starts_with(b"GIMP Palette") || ends_in(".gpl") {
        return read_gpl(file, bytes).map(Some);
    }
    if ends_in(".aco") {
        return read_aco(file, bytes).map(Some);
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::super::entries::{SwatchColor, SwatchEntry};
    use super::super::{write_aco, write_ase, write_gpl};
    use super::*;
    use crate::color::Rgb;

    #[test]
    fn every_format_is_known_and_other_files_are_none() {
        let color = SwatchColor::Rgb(Rgb([1.0, 0.0, 0.0]));
        let red = SwatchEntry { name: "Red".to_owned(), group: String::new(), color };
        let palette = SwatchFile { name: "One".to_owned(), swatches: vec![red] };
        let files = [
            ("a.bin", write_ase(&palette).unwrap()),
            ("a.txt", write_gpl(&palette).unwrap().into_bytes()),
            ("a.ACO", write_aco(&palette).unwrap()),
        ];
        for (file, bytes) in files {
            let read = read_swatch_file(file, &bytes).unwrap().unwrap();
            assert_eq!(read.swatches[0].color.srgb().unwrap().to_hex(), "#ff0000", "{file}");
        }
        assert_eq!(read_swatch_file("a.csv", b"sample,400,410\n").unwrap(), None);
        let error = read_swatch_file("b.ase", b"no").unwrap_err().to_string();
        assert!(error.starts_with("b.ase, byte 0"), "{error}");
    }
}

//! Formats of pictures that are read: their names in messages, endings of file names, first bytes.

use std::path::Path;

use image::ImageFormat;

/// Names of the formats, for messages and help.
pub const NAMES: &str = "PNG, JPEG, TIFF or WebP";

/// Endings of the names of such files, in lower case.
pub const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "tif", "tiff", "webp"];

/// Whether a file name ends like that of a picture, in letters of either case.
#[must_use]
pub fn has_picture_ending(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| ENDINGS.contains(&ending.to_ascii_lowercase().as_str()))
}

/// Whether `bytes` begin like a picture in one of the formats.
#[must_use]
pub fn begins_like_picture(bytes: &[u8]) -> bool {
    use ImageFormat::{Jpeg, Png, Tiff, WebP};
    matches!(image::guess_format(bytes), Ok(Png | Jpeg | Tiff | WebP))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::picture::Photograph;

    #[test]
    fn each_ending_is_that_of_a_picture_that_is_known_by_its_bytes_and_read() {
        let picture = image::RgbImage::from_pixel(4, 4, image::Rgb([9, 80, 200]));
        for ending in ENDINGS {
            let path = format!("a/b.{}", ending.to_uppercase());
            assert!(has_picture_ending(path.as_ref()), "{path}");
            let format = ImageFormat::from_extension(ending).unwrap();
            let mut file = Cursor::new(Vec::new());
            picture.write_to(&mut file, format).unwrap();
            let bytes = file.into_inner();
            assert!(begins_like_picture(&bytes[..64.min(bytes.len())]), "{ending}");
            assert_eq!(Photograph::from_bytes("a", &bytes).unwrap().size(), (4, 4), "{ending}");
        }
        for other in ["a.exr", "png", "a.toml", "tif"] {
            assert!(!has_picture_ending(other.as_ref()), "{other}");
        }
        for other in [&b"\x76\x2f\x31\x01"[..], b"{\"format\"", b"RIFF\x24\0\0\0WAVEfmt ", b""] {
            assert!(!begins_like_picture(other), "{other:?}");
        }
    }
}

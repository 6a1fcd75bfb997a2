//! Formats of pictures that we read: their names in messages, endings of file names and first
//! bytes. Also checks for JPEG files that were cut off or damaged, because decoders paint the missing
//! part grey, and for colour profiles that would fill the memory.

use std::io::{self, Cursor, Read};
use std::path::Path;

use documents::foreign_message;
use flate2::read::ZlibDecoder;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Names of the formats. Use this in messages and help.
pub const NAMES: &str = "PNG, JPEG, TIFF or WebP";

/// Endings of the names of picture files, in lower case.
pub const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "tif", "tiff", "webp"];

/// Whether a file name ends like the name of a picture. This ignores case.
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

/// Most pixels of a side of a picture: 2^16. Longer sides are stripes that a header makes up, and one row of
/// them takes gigabytes.
pub const MOST_SIDE: u32 = 1 << 16;

/// First bytes of every PNG file.
pub(crate) const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Most MB of an ICC profile. Those of presses with many inks take 4 MB.
const MOST_PROFILE_MB: u64 = 16;

/// First bytes of every JPEG file, which start the picture.
const START: [u8; 2] = [0xff, 0xd8];
/// Second byte of the marker that ends the picture.
const END: u8 = 0xd9;

/// We look for damage in JPEG files of at most this many pixels. Larger ones are refused elsewhere.
const MOST_CHECKED: usize = 1 << 27;
/// Words of the decoder about bytes between the segments of a header, which do no harm.
const EXTRA_BYTES: &str = "Extra bytes";

/// Why the coded data of a JPEG file cannot be decoded to their end. A decoder that goes on paints the rest grey.
/// You get `None` for other files, and for a JPEG file that is whole.
///
/// A changed bit that leaves valid codes is not seen: the picture is then decoded as it stands.
#[must_use]
pub fn damage_of_jpeg(bytes: &[u8]) -> Option<String> {
    if !bytes.starts_with(&START) {
        return None;
    }
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(usize::MAX)
        .set_max_height(usize::MAX);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    // The decoder of pictures tells what is wrong with headers.
    decoder.decode_headers().ok()?;
    let (width, height) = decoder.dimensions()?;
    if width.saturating_mul(height) > MOST_CHECKED {
        return None;
    }
    let reason = decoder.decode().err()?.to_string().trim_matches('"').to_owned();
    (!reason.contains(EXTRA_BYTES)).then_some(reason)
}

/// Whether the ICC profile of a PNG file unpacks to more than any profile holds. We unpack it to its limit
/// without keeping it.
fn has_huge_profile(bytes: &[u8]) -> bool {
    let Some(mut chunks) = bytes.strip_prefix(PNG_SIGNATURE) else { return false };
    // A chunk is its length, its name, its data and a checksum (PNG Specification, section 5.3).
    while let Some((head, rest)) = chunks.split_first_chunk::<8>() {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        match &head[4..] {
            b"iCCP" => {
                let data = &rest[..length.min(rest.len())];
                // A name, a zero, the method of compression.
                let Some(name) = data.iter().position(|byte| *byte == 0) else { return false };
                let packed = data.get(name + 2..).unwrap_or_default();
                let most = MOST_PROFILE_MB << 20;
                let mut unpacked = ZlibDecoder::new(packed).take(most + 1);
                let mut count = CountedBytes(0);
                // A decoder reports a damaged profile.
                let _ = io::copy(&mut unpacked, &mut count);
                return count.0 > most;
            }
            b"IDAT" => return false,
            _ => chunks = rest.get(length + 4..).unwrap_or_default(),
        }
    }
    false
}

/// Counts what is written to it, also of a stream that ends in an error.
struct CountedBytes(u64);

impl io::Write for CountedBytes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Why a PNG file would take the memory: its colour profile unpacks to more than 16 MB. You get `None` for
/// other files.
pub(crate) fn fault_of_profile(bytes: &[u8]) -> Option<String> {
    has_huge_profile(bytes).then(|| format!("it unpacks to more than {MOST_PROFILE_MB} MB"))
}

/// Why we do not hand a file to its decoder: a JPEG file that is cut off or damaged shows only a part of its
/// picture, and the colour profile of a PNG file can fill the memory. You get `None` for other files, and for
/// files that are whole.
#[must_use]
fn fault_of_coding(bytes: &[u8]) -> Option<String> {
    if is_cut_off_jpeg(bytes) {
        return Some("the JPEG file is cut off: its end marker is missing".to_owned());
    }
    if let Some(reason) = fault_of_profile(bytes) {
        return Some(format!("the colour profile cannot be used: {reason}"));
    }
    damage_of_jpeg(bytes).map(|reason| format!("the JPEG file is damaged: {reason}"))
}

/// Most pixels of [`small_picture`]: 8192 x 8192.
const MOST_SMALL: u64 = 1 << 26;
/// Longest side of [`small_picture`] in pixels: the usual limit of graphics devices.
const LONGEST_SMALL: u32 = 1 << 14;

/// Decodes a texture, a relief or another picture of at most 64 Mpixel and 16,384 pixels a side, as its
/// samples are: we do not apply its colour profile.
///
/// ```
/// use graphics::picture_formats::small_picture;
///
/// assert!(small_picture(b"no picture").is_err());
/// ```
///
/// # Errors
/// The reason in words. The caller adds the name of the file.
pub fn small_picture(bytes: &[u8]) -> Result<DynamicImage, String> {
    if let Some(fault) = fault_of_coding(bytes) {
        return Err(fault);
    }
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| foreign_message(&error))?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(LONGEST_SMALL);
    limits.max_image_height = Some(LONGEST_SMALL);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|error| foreign_message(&error))?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MOST_SMALL {
        return Err(format!("it has {width} x {height} pixels, more than 64 Mpixel"));
    }
    let picture = DynamicImage::from_decoder(decoder);
    picture.map_err(|error| foreign_message(&error))
}

/// Whether `bytes` are a JPEG file that stops before its end marker (ISO/IEC 10918-1, B.1.1). You
/// need this only for JPEG: decoders of other formats refuse cut files.
#[must_use]
pub fn is_cut_off_jpeg(bytes: &[u8]) -> bool {
    if !bytes.starts_with(&START) {
        return false;
    }
    let mut at = START.len();
    // Between markers lie segments and the coded data of scans. A segment states its length and
    // may hold a whole thumbnail. In coded data, 0xff is followed by 0.
    while let Some(found) = bytes[at..].windows(2).position(|pair| is_marker(pair[0], pair[1])) {
        let marker = at + found;
        if bytes[marker + 1] == END {
            return false;
        }
        let Some(length) = bytes.get(marker + 2..marker + 4) else { return true };
        at = marker + 2 + usize::from(u16::from_be_bytes([length[0], length[1]]));
        if at >= bytes.len() {
            return true;
        }
    }
    true
}

/// Whether `bytes` are a JPEG file of four components: inks (CMYK or YCCK). The frame header gives
/// this number (ISO/IEC 10918-1, B.2.2).
#[must_use]
pub fn is_of_inks(bytes: &[u8]) -> bool {
    let mut at = START.len();
    while bytes.starts_with(&START) {
        let Some(head) = bytes.get(at..at + 10) else { return false };
        let frame = matches!(head[1], 0xc0..=0xcf) && !matches!(head[1], 0xc4 | 0xc8 | 0xcc);
        match head {
            [0xff, 0xff, ..] => at += 1,
            [0xff, _, _, _, .., components] if frame => return *components == 4,
            [0xff, _, high, low, ..] => at += 2 + usize::from(u16::from_be_bytes([*high, *low])),
            _ => return false,
        }
    }
    false
}

/// Whether two bytes are a marker other than padding, stuffed data, a restart or the start.
fn is_marker(first: u8, second: u8) -> bool {
    first == 0xff && !matches!(second, 0x00 | 0x01 | 0xd0..=0xd8 | 0xff)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Photograph;
    use image::codecs::jpeg::JpegEncoder;
    use image::codecs::png::PngEncoder;
    use image::{ExtendedColorType, ImageEncoder};

    #[test]
    fn profiles_that_fill_the_memory_are_refused() {
        fn png(profile_bytes: usize) -> Vec<u8> {
            let mut file = Vec::new();
            let mut encoder = PngEncoder::new(&mut file);
            encoder.set_icc_profile(vec![0; profile_bytes]).unwrap();
            encoder.write_image(&[9; 12], 2, 2, ExtendedColorType::Rgb8).unwrap();
            file
        }
        let most = (MOST_PROFILE_MB << 20) as usize;
        assert_eq!(fault_of_coding(&png(most)), None, "as large as a profile may be");
        let huge = png(most + 1);
        assert!(huge.len() < 1 << 20, "a small file: {} bytes", huge.len());
        let fault = fault_of_coding(&huge).unwrap();
        assert_eq!(fault, "the colour profile cannot be used: it unpacks to more than 16 MB");
        let error = Photograph::from_bytes("sky.png", &huge).unwrap_err().to_string();
        let wanted = "sky.png: its colour profile cannot be used: it unpacks to more than 16 MB";
        assert_eq!(error, wanted);
        // A file that ends within any chunk is no reason to panic.
        for length in 0..200 {
            assert_eq!(fault_of_coding(&huge[..length]), None, "{length} bytes");
        }
    }

    #[test]
    fn small_pictures_have_64_mpixel_at_most() {
        fn black(width: u32, height: u32) -> Vec<u8> {
            let mut file = Vec::new();
            let mut encoder = png::Encoder::new(&mut file, width, height);
            encoder.set_depth(png::BitDepth::One);
            let row = width.div_ceil(8) as usize;
            let mut writer = encoder.write_header().unwrap();
            writer.write_image_data(&vec![0; row * height as usize]).unwrap();
            writer.finish().unwrap();
            file
        }
        assert_eq!(small_picture(&black(16_384, 4)).unwrap().height(), 4);
        let reason = small_picture(&black(9000, 9000)).unwrap_err();
        assert_eq!(reason, "it has 9000 x 9000 pixels, more than 64 Mpixel");
        assert!(small_picture(&black(16_385, 4)).is_err(), "a side is too long");
    }

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

    #[test]
    fn a_jpeg_is_cut_off_wherever_its_end_is_missing() {
        let picture = image::RgbImage::from_fn(64, 48, |x, y| {
            let [r, g, b, _] = (x * 7919 + y * 104_729).wrapping_mul(2_654_435_761).to_le_bytes();
            image::Rgb([r, g, b])
        });
        let mut whole = Vec::new();
        JpegEncoder::new_with_quality(&mut whole, 100).encode_image(&picture).unwrap();
        // Coded data hold bytes of 0xff, each with a 0 behind it.
        assert!(whole.windows(2).any(|pair| pair == [0xff, 0]), "no such byte");
        assert!(!is_cut_off_jpeg(&whole));
        for length in 2..whole.len() {
            assert!(is_cut_off_jpeg(&whole[..length]), "{length} of {} bytes", whole.len());
        }
        // A camera's preview has an end marker of its own, inside a segment.
        let preview: Vec<u8> =
            [&[0xff, 0xe1, 0, 6, 0xff, 0xd9, 0xff, 0xd9][..], &whole[2..]].concat();
        let with_preview = [&START[..], &preview].concat();
        assert!(!is_cut_off_jpeg(&with_preview));
        assert!(is_cut_off_jpeg(&with_preview[..with_preview.len() - 2]));
        assert!(!is_cut_off_jpeg(b"\x89PNG"));
    }

    /// A noisy picture as JPEG.
    fn noisy() -> Vec<u8> {
        let picture = image::RgbImage::from_fn(160, 120, |x, y| {
            let [r, g, b, _] = (x * 7919 + y * 104_729).wrapping_mul(2_654_435_761).to_le_bytes();
            image::Rgb([r, g, b])
        });
        let mut whole = Vec::new();
        JpegEncoder::new_with_quality(&mut whole, 90).encode_image(&picture).unwrap();
        whole
    }

    #[test]
    fn a_jpeg_with_a_broken_block_is_damaged() {
        let whole = noisy();
        assert_eq!(damage_of_jpeg(&whole), None);
        // What follows the end, as in files with several pictures, does no harm.
        assert_eq!(damage_of_jpeg(&[&whole[..], &[0; 40], &whole[..]].concat()), None);
        // Bytes between two segments do no harm either.
        let spaced = [&whole[..20], &[0; 8], &whole[20..]].concat();
        assert_eq!(damage_of_jpeg(&spaced), None, "{:x?}", &whole[..24]);
        for place in 1..20 {
            let at = whole.len() / 2 + place * whole.len() / 50;
            // Ones throughout are no code.
            let mut broken = whole.clone();
            broken[at..at + 6].copy_from_slice(&[0xff, 0, 0xff, 0, 0xff, 0]);
            let damage = damage_of_jpeg(&broken).unwrap();
            assert_eq!(
                fault_of_coding(&broken),
                Some(format!("the JPEG file is damaged: {damage}"))
            );
            let error = Photograph::from_bytes("a.jpg", &broken).unwrap_err().to_string();
            assert_eq!(error, format!("a.jpg: the JPEG file is damaged: {damage}"));
            // A marker of a frame has no place in coded data.
            broken[at..at + 2].copy_from_slice(&[0xff, 0xc7]);
            let error = Photograph::from_bytes("a.jpg", &broken).unwrap_err().to_string();
            assert!(error.starts_with("a.jpg: the JPEG file is "), "{error}");
        }
        assert_eq!(damage_of_jpeg(b"\x89PNG"), None);
    }

    #[test]
    fn components_are_counted_in_the_frame_header_behind_other_segments() {
        fn file(kind: u8, components: u8) -> Vec<u8> {
            let mut file = START.to_vec();
            // A segment that holds a marker, and a table with a tenth byte of 4.
            file.extend([0xff, 0xe0, 0, 6, 0xff, 0xc0, 0, 8]);
            file.extend([0xff, 0xc4, 0, 12, 0, 1, 2, 3, 3, 4, 5, 6, 7, 8]);
            // Markers may have bytes of 0xff before them.
            file.extend([0xff, 0xff, 0xff, kind, 0, 20, 8, 0, 8, 0, 8, components, 1, 0x11, 0]);
            file
        }
        for kind in [0xc0, 0xc1, 0xc2, 0xc9] {
            assert!(is_of_inks(&file(kind, 4)), "{kind:x}");
            assert!(!is_of_inks(&file(kind, 3)) && !is_of_inks(&file(kind, 1)), "{kind:x}");
        }
        for length in 0..file(0xc0, 4).len() - 4 {
            assert!(!is_of_inks(&file(0xc0, 4)[..length]), "cut off after {length} bytes");
        }
        assert!(!is_of_inks(b"\x89PNG\r\n\x1a\n\x04\x04\x04"), "no JPEG");
    }
}

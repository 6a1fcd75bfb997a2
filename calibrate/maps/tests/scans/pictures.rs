//! Stacks of pictures, pages of TIFF files, and spectral OpenEXR files.

use std::fs::File;
use std::path::{Path, PathBuf};

use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    WritableImage,
};
use maps::cube::{Cube, CubeOptions, CubeScale};
use tiff::encoder::{self, TiffEncoder, colortype};
use tiff::tags::{ExtraSamples, Tag};

use crate::written::{BANDS, LINES, SAMPLES, check, header, in_order, refused, value, write_envi};

const LIST: &str = "400\n500\n600.5\n700\n";

/// Settings under which counts of 16 bits, 100 times the test scan, are its reflectances.
fn by_20000() -> CubeOptions {
    CubeOptions { scale: CubeScale::White(20_000.0), ..CubeOptions::default() }
}

fn plane(band: usize) -> Vec<u16> {
    let pixels = (0..LINES).flat_map(|line| (0..SAMPLES).map(move |sample| (line, sample)));
    pixels.map(|(line, sample)| u16::from(value(line, sample, band)) * 100).collect()
}

fn write_png(path: &Path, values: &[u16]) {
    let file = File::create(path).unwrap();
    let mut encoder = png::Encoder::new(file, SAMPLES as u32, LINES as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_be_bytes()).collect();
    encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
}

fn write_tiff(path: &Path, pages: &[Vec<u16>]) {
    let mut encoder = TiffEncoder::new(File::create(path).unwrap()).unwrap();
    for (at, page) in pages.iter().enumerate() {
        // Pages are packed in turns, in strips of two rows.
        encoder = encoder.with_compression(match at % 3 {
            0 => encoder::Compression::Uncompressed,
            1 => encoder::Compression::Deflate(encoder::DeflateLevel::Fast),
            _ => encoder::Compression::Lzw,
        });
        let mut image =
            encoder.new_image::<colortype::Gray16>(SAMPLES as u32, LINES as u32).unwrap();
        image.rows_per_strip(2).unwrap();
        image.write_data(page).unwrap();
    }
}

#[test]
fn a_folder_of_pictures_is_read_in_the_order_of_numbers() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("wavelengths.txt"), LIST).unwrap();
    for (band, name) in
        ["band 8.png", "band 9.tif", "band 10.PNG", "band 11.tiff"].iter().enumerate()
    {
        let path = folder.path().join(name);
        match name.to_lowercase().ends_with("png") {
            true => write_png(&path, &plane(band)),
            false => write_tiff(&path, &[plane(band)]),
        }
    }
    let cube = Cube::open_with(folder.path(), &by_20000()).unwrap();
    check(&cube, 1.0 / 200.0, "pictures");
    let remark =
        "4 pictures from band 8.png (400 nm) to band 11.tiff (700 nm), in the order of their names";
    assert_eq!(cube.remarks().iter().map(|told| told.text.as_str()).collect::<Vec<_>>(), [remark]);
    let (found, hint) = refused(folder.path(), &CubeOptions::default());
    assert!(found.contains("the values are not reflectances"), "{found}: {hint}");
    // The list may lie elsewhere.
    let elsewhere = tempfile::tempdir().unwrap();
    let list = elsewhere.path().join("filters.csv");
    std::fs::rename(folder.path().join("wavelengths.txt"), &list).unwrap();
    let options = CubeOptions { wavelengths: Some(list), ..by_20000() };
    check(&Cube::open_with(folder.path(), &options).unwrap(), 1.0 / 200.0, "another list");
}

fn folder_of_png() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("wavelengths.csv"), LIST).unwrap();
    for band in 0..BANDS {
        write_png(&folder.path().join(format!("{band}.png")), &plane(band));
    }
    folder
}

#[test]
fn pictures_that_do_not_fit_are_refused() {
    let folder = folder_of_png();
    std::fs::remove_file(folder.path().join("2.png")).unwrap();
    let (found, _) = refused(folder.path(), &by_20000());
    assert!(found.ends_with("has 4 wavelengths, the folder 3 pictures"), "{found}");

    let folder = folder_of_png();
    let file = File::create(folder.path().join("2.png")).unwrap();
    let mut encoder = png::Encoder::new(file, 3, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&[1; 6]).unwrap();
    let (found, _) = refused(folder.path(), &by_20000());
    let words = "2.png: the picture has 3 x 2 pixels of U8, the first picture of the stack 7 x 5 pixels of U16";
    assert!(found.ends_with(words), "{found}");

    let folder = folder_of_png();
    let file = File::create(folder.path().join("0.png")).unwrap();
    let mut encoder = png::Encoder::new(file, 3, 2);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[1; 18]).unwrap();
    let (found, _) = refused(folder.path(), &by_20000());
    assert!(found.contains("0.png: the picture is of kind") && found.contains("gray"), "{found}");

    let folder = folder_of_png();
    let path = folder.path().join("1.png");
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() - 30]).unwrap();
    let (found, _) = refused(folder.path(), &by_20000());
    assert!(found.contains("1.png"), "{found}");

    let folder = folder_of_png();
    let options = CubeOptions { scratch: Some("/no/such/folder".into()), ..by_20000() };
    let (found, hint) = refused(folder.path(), &options);
    assert!(found.starts_with("/no/such/folder: unpacked values cannot be written"), "{found}");
    assert!(hint.contains("`scratch = FOLDER`"), "{hint}");
}

#[test]
fn pages_of_a_tiff_file_are_bands() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scan.tif");
    let pages: Vec<_> = (0..BANDS).map(plane).collect();
    write_tiff(&path, &pages);
    let (found, hint) = refused(&path, &by_20000());
    assert!(
        found.contains(
            "has 4 pages, but no list of their wavelengths is beside it, nor do metadata of GDAL"
        ),
        "{found}"
    );
    assert!(hint.contains("scan.txt"), "{hint}");
    std::fs::write(folder.path().join("scan.txt"), LIST).unwrap();
    check(&Cube::open_with(&path, &by_20000()).unwrap(), 1.0 / 200.0, "pages");
    std::fs::write(folder.path().join("scan.txt"), "400\n500\n").unwrap();
    let (found, _) = refused(&path, &by_20000());
    assert!(found.ends_with("scan.txt: has 2 wavelengths, the stack 4 pages"), "{found}");
}

/// The XML of GDAL with the wavelengths of the test scan, in its two forms.
fn gdal(is_beside: bool) -> String {
    let bands = [400.0, 500.0, 600.5, 700.0].iter().enumerate().map(|(band, nm)| match is_beside {
        true => format!(
            "<PAMRasterBand band=\"{}\"><Metadata><MDI key=\"wavelength\">{nm}</MDI>\
             <MDI key=\"wavelength_units\">Nanometers</MDI></Metadata></PAMRasterBand>",
            band + 1
        ),
        false => format!(
            "<Item name=\"wavelength\" sample=\"{band}\">{nm}</Item>\
             <Item name=\"wavelength_units\" sample=\"{band}\">Nanometers</Item>\
             <Item name=\"SCALE\" sample=\"{band}\" role=\"scale\">0.00005</Item>"
        ),
    });
    let root = if is_beside { "PAMDataset" } else { "GDALMetadata" };
    format!("<{root}>{}</{root}>", bands.collect::<String>())
}

#[test]
fn metadata_of_gdal_name_wavelengths_and_scales() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scan.tif");
    let mut encoder = TiffEncoder::new(File::create(&path).unwrap()).unwrap();
    let mut image = encoder.new_image::<colortype::Gray16>(SAMPLES as u32, LINES as u32).unwrap();
    image.extra_samples(&[ExtraSamples::Unspecified; BANDS - 1]).unwrap();
    image.encoder().write_tag(Tag::Unknown(42112), gdal(false).as_str()).unwrap();
    image.encoder().write_tag(Tag::GdalNodata, "-9999").unwrap();
    let planes: Vec<_> = (0..BANDS).map(plane).collect();
    let pixels = (0..LINES * SAMPLES).flat_map(|pixel| planes.iter().map(move |band| band[pixel]));
    image.write_data(&pixels.collect::<Vec<u16>>()).unwrap();
    // The tag states the scale too.
    check(&Cube::open(&path).unwrap(), 1.0 / 200.0, "tag");

    let pages = folder.path().join("pages.tif");
    write_tiff(&pages, &planes);
    std::fs::write(folder.path().join("pages.tif.aux.xml"), gdal(true)).unwrap();
    check(&Cube::open_with(&pages, &by_20000()).unwrap(), 1.0 / 200.0, "beside a TIFF file");

    let text = header("bil", 12, "").replace("wavelength", "lost");
    let counts =
        in_order("bil").into_iter().flat_map(|value| (u16::from(value) * 100).to_le_bytes());
    let scan = write_envi(folder.path(), "scan", &text, &counts.collect::<Vec<u8>>());
    let (found, _) = refused(&scan, &by_20000());
    assert!(found.ends_with("names no wavelengths of its 4 bands"), "{found}");
    std::fs::write(folder.path().join("scan.raw.aux.xml"), gdal(true)).unwrap();
    let cube = Cube::open_with(&scan, &by_20000()).unwrap();
    check(&cube, 1.0 / 200.0, "beside data of ENVI");
    let remark = &cube.remarks()[0].text;
    assert!(
        remark.starts_with("wavelengths are read from ") && remark.ends_with("scan.raw.aux.xml")
    );
    let part = gdal(true).replacen("wavelength", "other", 1);
    std::fs::write(folder.path().join("scan.raw.aux.xml"), part).unwrap();
    let (found, _) = refused(&scan, &by_20000());
    assert!(found.ends_with("names no wavelengths of its 4 bands"), "{found}");
}

#[test]
fn spectra_of_points_are_refused_with_the_verb_that_reads_them() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in [
        ("spots.csv", &b"sample,400,410,420\nred,0.1,0.1,0.2\n"[..]),
        ("spot.txt", b"400\t0.1\n410\t0.2\n"),
        ("spots.xlsx", b"PK\x03\x04\x14\0\0\0"),
        ("leaf.asd", b"as7 \0\0\0"),
    ] {
        let path = folder.path().join(name);
        let mut bytes = bytes.to_vec();
        if name.ends_with("asd") {
            bytes = [b"ASD", &[0_u8; 481][..]].concat();
        }
        std::fs::write(&path, bytes).unwrap();
        let (found, hint) = refused(&path, &CubeOptions::default());
        assert!(found.ends_with("holds spectra of points, not a scan"), "{name}: {found}");
        assert!(hint.contains("impasto identify"), "{hint}");
    }
    let noise: Vec<u8> = (0..200).collect();
    let path = folder.path().join("scan.dat");
    std::fs::write(&path, noise).unwrap();
    let (found, hint) = refused(&path, &CubeOptions::default());
    assert!(found.contains("not a cube that can be read") && hint.contains("scan.hdr"), "{found}");
}

fn write_exr(path: &Path, names: &[(&str, Option<usize>)], compression: Compression) {
    let channels = names.iter().map(|(name, band)| {
        let values = match band {
            Some(band) => {
                plane(*band).into_iter().map(|count| f32::from(count) / 20_000.0).collect()
            }
            None => vec![0.25; LINES * SAMPLES],
        };
        AnyChannel::new(*name, FlatSamples::F32(values))
    });
    let channels = AnyChannels::sort(channels.collect());
    let encoding = Encoding { compression, ..Encoding::FAST_LOSSLESS };
    let layer = Layer::new((SAMPLES, LINES), LayerAttributes::default(), encoding, channels);
    Image::from_layer(layer).write().to_file(path).unwrap();
}

/// Channels of a painting that was exported with its spectra.
const CHANNELS: [(&str, Option<usize>); 7] = [
    ("R", None),
    ("G", None),
    ("B", None),
    ("T.400,000000nm", Some(0)),
    ("T.500,000000nm", Some(1)),
    ("T.600,500000nm", Some(2)),
    ("T.700,000000nm", Some(3)),
];

#[test]
fn spectral_exr_files_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("painting.exr");
    for compression in [Compression::ZIP16, Compression::Uncompressed, Compression::PIZ] {
        write_exr(&path, &CHANNELS, compression);
        check(&Cube::open(&path).unwrap(), 1.0 / 200.0, &format!("{compression:?}"));
    }
    let glowing = [("T.400,000000nm.500,000000nm", None), ("T.400,000000nm.600,500000nm", None)];
    write_exr(&path, &[&CHANNELS[..], &glowing].concat(), Compression::ZIP16);
    let cube = Cube::open(&path).unwrap();
    check(&cube, 1.0 / 200.0, "with fluorescence");
    let remark = cube.remarks()[0].to_string();
    let start =
        "warning: fluorescence is left out (2 channels, such as T.400,000000nm.500,000000nm)";
    assert!(remark.starts_with(start), "{remark}");
    write_exr(&path, &CHANNELS[..3], Compression::ZIP16);
    let (found, hint) = refused(&path, &CubeOptions::default());
    assert!(found.contains("without channels of reflectance"), "{found}: {hint}");
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let (found, _) = refused(&path, &CubeOptions::default());
    assert!(found.contains("painting.exr"), "{found}");
}

#[test]
fn a_spectral_exr_file_that_announces_more_than_it_can_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("painting.exr");
    let channels = CHANNELS
        .map(|(name, _)| AnyChannel::new(name, FlatSamples::F32(vec![0.25; LINES * SAMPLES])));
    let encoding = Encoding::SMALL_LOSSLESS;
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let layer = Layer::new((SAMPLES, LINES), LayerAttributes::default(), encoding, channels);
    Image::from_layer(layer).write().to_file(&path).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    // The window of the data: left, top, right and bottom, the last ones inclusive.
    let name = b"dataWindow\0box2i\0";
    let at = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 4;
    let window = [0, 0, (1 << 28) - 1, 7].map(i32::to_le_bytes).concat();
    bytes[at..at + 16].copy_from_slice(&window);
    std::fs::write(&path, &bytes).unwrap();
    let (found, hint) = refused(&path, &CubeOptions::default());
    // Seven channels of four bytes.
    let announced = (7_u64 * 4 * 8) << 28;
    let wanted = format!("{} bytes cannot hold the {announced} that", bytes.len());
    assert!(found.contains("painting.exr") && found.contains(&wanted), "{found}");
    assert!(hint.contains("export it again"), "{hint}");
}

/// Pages of two bands each, with neighbouring numbers in a pixel.
fn write_chunky(path: &Path) {
    let mut encoder = TiffEncoder::new(File::create(path).unwrap()).unwrap();
    encoder = encoder.with_compression(encoder::Compression::Lzw);
    for first in [0, 2] {
        let pair = [plane(first), plane(first + 1)];
        let pixels = pair[0].iter().zip(&pair[1]).flat_map(|(a, b)| [*a, *b]);
        let mut image =
            encoder.new_image::<colortype::Gray16>(SAMPLES as u32, LINES as u32).unwrap();
        image.extra_samples(&[ExtraSamples::Unspecified]).unwrap();
        image.rows_per_strip(2).unwrap();
        image.write_data(&pixels.collect::<Vec<u16>>()).unwrap();
    }
}

/// A page of all bands in tiles of 16 x 16 pixels, band after band or side by side.
fn tiled(is_planar: bool) -> Vec<u8> {
    const SIDE: usize = 16;
    let mut tiles: Vec<Vec<u16>> = vec![Vec::new(); if is_planar { BANDS } else { 1 }];
    for line in 0..SIDE {
        for sample in 0..SIDE {
            for band in 0..BANDS {
                let number = match line < LINES && sample < SAMPLES {
                    true => u16::from(value(line, sample, band)) * 100,
                    false => 9999,
                };
                tiles[if is_planar { band } else { 0 }].push(number);
            }
        }
    }
    let mut bytes = b"II*\0\0\0\0\0".to_vec();
    let sizes: Vec<u32> = tiles.iter().map(|tile| tile.len() as u32 * 2).collect();
    let offsets: Vec<u32> = tiles
        .iter()
        .map(|tile| {
            let at = bytes.len() as u32;
            bytes.extend(tile.iter().flat_map(|number| number.to_le_bytes()));
            at
        })
        .collect();
    let [offsets_at, sizes_at] = [offsets, sizes].map(|values| match values[..] {
        [one] => one,
        _ => {
            let at = bytes.len() as u32;
            bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
            at
        }
    });
    let [bits_at, extra_at] = [16_u16, 0].map(|value| {
        let at = bytes.len() as u32;
        bytes.extend([value; BANDS].into_iter().flat_map(u16::to_le_bytes));
        at
    });
    let count = tiles.len() as u32;
    let short = 3_u16;
    let long = 4_u16;
    let planar = if is_planar { 2 } else { 1 };
    let entries: [(u16, u16, u32, u32); 12] = [
        (256, long, 1, SAMPLES as u32),
        (257, long, 1, LINES as u32),
        (258, short, BANDS as u32, bits_at),
        (259, short, 1, 1),
        (262, short, 1, 1),
        (277, short, 1, BANDS as u32),
        (284, short, 1, planar),
        (322, long, 1, SIDE as u32),
        (323, long, 1, SIDE as u32),
        (324, long, count, offsets_at),
        (325, long, count, sizes_at),
        (338, short, BANDS as u32 - 1, extra_at),
    ];
    with_directory(bytes, &entries)
}

/// A TIFF file of one page: its tags with type, count and value.
fn with_directory(mut bytes: Vec<u8>, entries: &[(u16, u16, u32, u32)]) -> Vec<u8> {
    let directory = bytes.len() as u32;
    bytes[4..8].copy_from_slice(&directory.to_le_bytes());
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend(count.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    bytes
}

#[test]
fn strips_that_are_too_large_are_told() {
    let short = 3_u16;
    let long = 4_u16;
    let side = 20_000_u32;
    let entries = [
        (256, long, 1, side),
        (257, long, 1, side),
        (258, short, 1, 16),
        (259, short, 1, 1),
        (262, short, 1, 1),
        (273, long, 1, 8),
        (277, short, 1, 1),
        (278, long, 1, side),
        (279, long, 1, side * side * 2),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scan.tif");
    std::fs::write(&path, with_directory(b"II*\0\0\0\0\0".to_vec(), &entries)).unwrap();
    std::fs::write(folder.path().join("scan.txt"), "400\n").unwrap();
    let (found, hint) = refused(&path, &by_20000());
    assert!(found.contains("more than 256 MB") && hint.contains("rowsperstrip"), "{found}: {hint}");
}

#[test]
fn values_of_a_pixel_are_bands() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scan.tif");
    write_chunky(&path);
    let (found, hint) = refused(&path, &by_20000());
    assert!(found.contains("has 4 bands") && hint.contains("a band"), "{found}: {hint}");
    std::fs::write(folder.path().join("scan.txt"), LIST).unwrap();
    check(&Cube::open_with(&path, &by_20000()).unwrap(), 1.0 / 200.0, "two bands a page");
    for is_planar in [true, false] {
        std::fs::write(&path, tiled(is_planar)).unwrap();
        check(&Cube::open_with(&path, &by_20000()).unwrap(), 1.0 / 200.0, "tiles");
    }
    std::fs::write(folder.path().join("scan.txt"), "400\n500\n").unwrap();
    let (found, _) = refused(&path, &by_20000());
    assert!(found.ends_with("scan.txt: has 2 wavelengths, the stack 4 bands"), "{found}");
    // A folder holds one picture a file.
    std::fs::write(folder.path().join("wavelengths.txt"), "400\n").unwrap();
    let (found, hint) = refused(folder.path(), &by_20000());
    assert!(found.ends_with("has 4 values a pixel, expected one picture a file"), "{found}");
    assert!(hint.contains("the file itself"), "{hint}");
}

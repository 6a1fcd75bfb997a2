//! Sound files, from which the damaged ones are made.

use std::io::{Cursor, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use calibrate::curation;
use calibrate::library::PigmentLibrary;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageFormat};
use maps::pixel_maps::{BlockMaps, Mask};
use maps::truth::{PaintClass, TruthAbout, TruthRows, TruthWriter};
use maps::{MapStore, MapsAbout, StoreMode};
use moxcms::ColorProfile;
use serde_json::{Map, Value, json};
use spectra::color::{Lab, Rgb};
use spectra::swatch_file::{SwatchColor, SwatchEntry, SwatchFile, write_aco, write_ase};
use tiff::encoder::{TiffEncoder, colortype};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::input::{Files, joined, joined_folder, parts};

/// Files below the fixtures.
pub(crate) fn fixtures(names: &[&str]) -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    names.iter().map(|name| file(&folder.join(name))).collect()
}

fn file(path: &Path) -> (String, Vec<u8>) {
    let name = path.file_name().unwrap().to_str().unwrap().to_owned();
    (name, std::fs::read(path).unwrap())
}

/// All files of a folder below the fixtures but its README.
pub(crate) fn folder(name: &str) -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_none_or(|ending| ending != "md"));
    paths.sort();
    paths.iter().map(|path| file(path)).collect()
}

pub(crate) fn made(name: &str, content: &str) -> (String, Vec<u8>) {
    (name.to_owned(), content.as_bytes().to_vec())
}

/// The heading and some rows of the oils that ship.
pub(crate) fn oils() -> Files {
    let all = include_str!("../../../measurements/van-gogh-oils.csv");
    let rows: Vec<&str> = all.lines().take(24).collect();
    let table = "sample;film;backing;thickness_mm;Red (g);White (g);400;500;600;700\n\
        a;paint;white;0,1;1;0;0,1;0,2;0,3;0,4\nb;none;white;;;;0,9;0,9;0,9;0,9\n";
    vec![made("oils.csv", &rows.join("\n")), made("table.csv", table)]
}

pub(crate) fn pictures() -> Files {
    let picture =
        image::RgbImage::from_fn(9, 7, |x, y| image::Rgb([x as u8 * 20, y as u8 * 30, 99]));
    let mut files: Files =
        [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Tiff, ImageFormat::WebP]
            .into_iter()
            .map(|format| {
                let mut bytes = Cursor::new(Vec::new());
                picture.write_to(&mut bytes, format).unwrap();
                (format!("picture.{}", format.extensions_str()[0]), bytes.into_inner())
            })
            .collect();
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    encoder.set_icc_profile(ColorProfile::new_adobe_rgb().encode().unwrap()).unwrap();
    encoder.write_image(&picture, 9, 7, ExtendedColorType::Rgb8).unwrap();
    files.push(("profile.png".to_owned(), bytes));
    files
}

pub(crate) fn linear_pictures() -> Files {
    let mut picture = graphics::field::Field::filled(9, 7, [0.5_f32, 0.25, 0.125, 1.0]);
    picture[(3, 4)] = [12.0, 0.0, 1.0, 1.0];
    vec![("picture.exr".to_owned(), graphics::export::linear_exr(&picture, 0.1).unwrap())]
}

/// Values of the scans: 3 lines, 4 samples and 4 bands.
const SCAN: [usize; 3] = [3, 4, 4];
const BANDS_NM: [f64; 4] = [400.0, 500.0, 600.0, 700.0];

/// A scan as ENVI, as pages of TIFF, as spectral EXR and as an array of Zarr.
pub(crate) fn scans() -> Files {
    let header = "ENVI\nlines = 3\nsamples = 4\nbands = 4\nheader offset = 0\ndata type = 1\ninterleave = bil\n\
        byte order = 0\nwavelength units = nm\nwavelength = {400, 500, 600, 700}\n";
    let data: Vec<u8> = (0..48).map(|at| 40 + 3 * at).collect();
    vec![
        ("scan.hdr".to_owned(), joined(header.as_bytes(), [("scan.bil", &data[..])])),
        ("scan.tif".to_owned(), pages()),
        ("scan.exr".to_owned(), spectral_exr()),
        ("scan.zarr".to_owned(), array()),
    ]
}

/// A page for each band, with metadata of GDAL that name the wavelengths.
fn pages() -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    for band in 0..4_u8 {
        let page: Vec<u8> = (0..12).map(|at| 40 + 3 * at + band).collect();
        encoder.new_image::<colortype::Gray8>(4, 3).unwrap().write_data(&page).unwrap();
    }
    let items = BANDS_NM.iter().zip(1..).map(|(nm, band)| {
        format!(
            "<PAMRasterBand band=\"{band}\"><Metadata><MDI key=\"wavelength\">{nm}</MDI>\
             <MDI key=\"wavelength_units\">nm</MDI></Metadata></PAMRasterBand>"
        )
    });
    let metadata = format!("<PAMDataset>{}</PAMDataset>", items.collect::<String>());
    joined(&bytes.into_inner(), [("scan.tif.aux.xml", metadata.as_bytes())])
}

fn spectral_exr() -> Vec<u8> {
    let channels = BANDS_NM.map(|nm| {
        let name = format!("T.{nm:.0},000000nm");
        exr::prelude::AnyChannel::new(
            name.as_str(),
            exr::prelude::FlatSamples::F32((0..12).map(|at| 0.2 + 0.05 * at as f32).collect()),
        )
    });
    let layer = exr::prelude::Layer::new(
        (4, 3),
        exr::prelude::LayerAttributes::default(),
        exr::prelude::Encoding::FAST_LOSSLESS,
        exr::prelude::AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    exr::prelude::WritableImage::write(&exr::prelude::Image::from_layer(layer))
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

/// A cube of reflectance and its wavelengths, each in one chunk that is not packed.
fn array() -> Vec<u8> {
    let described = |shape: &[usize], axes: &[&str]| {
        let document = json!({
            "zarr_format": 3, "node_type": "array", "shape": shape, "data_type": "float32",
            "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": shape}},
            "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
            "fill_value": "NaN", "attributes": {"units": "nm"}, "dimension_names": axes,
            "codecs": [{"name": "bytes", "configuration": {"endian": "little"}}],
        });
        document.to_string()
    };
    let group = json!({"zarr_format": 3, "node_type": "group", "attributes": {}}).to_string();
    let values: Vec<u8> = (0..48).flat_map(|at| (0.1 + 0.01 * at as f32).to_le_bytes()).collect();
    let nm: Vec<u8> = BANDS_NM.iter().flat_map(|nm| (*nm as f32).to_le_bytes()).collect();
    let cube = described(&SCAN, &["y", "x", "wavelength"]);
    let wavelengths = described(&[4], &["wavelength"]);
    joined(
        &[],
        [
            ("scan.zarr/zarr.json", group.as_bytes()),
            ("scan.zarr/reflectance/zarr.json", cube.as_bytes()),
            ("scan.zarr/reflectance/c/0/0/0", &values),
            ("scan.zarr/wavelength/zarr.json", wavelengths.as_bytes()),
            ("scan.zarr/wavelength/c/0", &nm),
        ],
    )
}

/// Maps of 2 x 3 pixels and the truth of as many.
pub(crate) fn maps_and_truth() -> Files {
    let folder = tempfile::tempdir().unwrap();
    let pigments = ["Red".to_owned(), "White".to_owned()];
    let about = MapsAbout {
        pigments: pigments.to_vec(),
        library_sha256: "a1".to_owned(),
        book_sha256: "b2".to_owned(),
        scan: "c3".to_owned(),
        rows: 0..2,
        columns: 0..3,
        settings: Map::new(),
    };
    let maps = folder.path().join("maps.zarr");
    let store = MapStore::create(&maps, &about, StoreMode::New).unwrap();
    let mut block = BlockMaps::without_values(6, 2, Mask::Mapped);
    for values in [&mut block.share, &mut block.share_sd, &mut block.presence] {
        values.fill(0.5);
    }
    for values in [&mut block.chi2, &mut block.rms] {
        values.fill(0.01);
    }
    for shard in store.shards() {
        let mut writer = store.writer(shard);
        writer.add(0..2, &block).unwrap();
        writer.finish().unwrap();
    }
    let truth = folder.path().join("truth.zarr");
    let about =
        TruthAbout { lines: 2, samples: 3, pigments: pigments.to_vec(), settings: Map::new() };
    let mut writer = TruthWriter::create(&truth, about).unwrap();
    let rows = TruthRows {
        pigments: 2,
        share: vec![0.5; 12],
        ground: vec![0.0; 6],
        mean_reflectance: vec![0.4; 6],
        class: vec![PaintClass::Hiding; 6],
    };
    writer.add(&rows).unwrap();
    writer.finish().unwrap();
    [maps, truth].map(|path| (name_of(&path), joined_folder(&path))).to_vec()
}

/// The autosave of a studio that was ended in the middle of its work.
pub(crate) fn autosaves() -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/formats/autosaves");
    vec![(name_of(&folder), joined_folder(&folder))]
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap().to_str().unwrap().to_owned()
}

/// A workbook, once packed and once as its files, so that damage reaches the cells.
pub(crate) fn workbooks() -> Files {
    let office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    let package = "http://schemas.openxmlformats.org/package/2006/relationships";
    let files = [
        (
            "_rels/.rels",
            format!(
                "<Relationships xmlns=\"{package}\"><Relationship Id=\"rId1\" Type=\"{office}/officeDocument\" \
                 Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml",
            format!(
                "<workbook xmlns=\"{main}\" xmlns:r=\"{office}\"><sheets><sheet name=\"Readings\" sheetId=\"1\" \
                 r:id=\"rId1\"/></sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            format!(
                "<Relationships xmlns=\"{package}\"><Relationship Id=\"rId1\" Type=\"{office}/worksheet\" \
                 Target=\"worksheets/sheet1.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/sharedStrings.xml",
            format!("<sst xmlns=\"{main}\"><si><t>nm</t></si><si><t>Red</t></si></sst>"),
        ),
        (
            "xl/worksheets/sheet1.xml",
            format!(
                "<worksheet xmlns=\"{main}\"><sheetData><row r=\"1\"><c r=\"A1\" t=\"s\"><v>0</v></c>\
                 <c r=\"B1\" t=\"s\"><v>1</v></c></row><row r=\"2\"><c r=\"A2\"><v>400</v></c>\
                 <c r=\"B2\"><v>0.25</v></c></row><row r=\"3\"><c r=\"A3\"><v>500</v></c>\
                 <c r=\"B3\"><v>0.5</v></c></row><row r=\"4\"><c r=\"A4\"><v>600</v></c>\
                 <c r=\"B4\"><v>0.75</v></c></row></sheetData></worksheet>"
            ),
        ),
    ];
    let files = files.iter().map(|(name, text)| (*name, text.as_bytes()));
    let open = joined(&[], files);
    vec![("packed.xlsx".to_owned(), zipped(&open)), ("open.xlsx".to_owned(), open)]
}

/// Packs the files of an input, unless the input is an archive itself.
pub(crate) fn zipped(bytes: &[u8]) -> Vec<u8> {
    let (main, files) = parts(bytes);
    if !main.is_empty() {
        return main.to_vec();
    }
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        // A damaged input may name a file twice.
        if writer.start_file(name, SimpleFileOptions::default()).is_ok() {
            writer.write_all(&content).unwrap();
        }
    }
    writer.finish().unwrap().into_inner()
}

/// Palettes of Adobe programs.
pub(crate) fn palettes() -> Files {
    let swatch = |name: &str, group: &str, color| SwatchEntry {
        name: name.to_owned(),
        group: group.to_owned(),
        color,
    };
    let palette = SwatchFile {
        name: "three".to_owned(),
        swatches: vec![
            swatch("Red", "", SwatchColor::Rgb(Rgb([1.0, 0.0, 0.1]))),
            swatch("Sky", "blues", SwatchColor::Lab(Lab { lightness: 60.0, a: -5.0, b: -30.0 })),
            swatch("Ink", "blues", SwatchColor::Cmyk([0.9, 0.5, 0.0, 0.1])),
            swatch("Grey", "", SwatchColor::Grey(0.5)),
        ],
    };
    vec![
        ("three.ase".to_owned(), write_ase(&palette).unwrap()),
        ("three.aco".to_owned(), write_aco(&palette).unwrap()),
    ]
}

/// Curves of some pigments of a library as a table.
pub(crate) fn library_tables() -> Files {
    let (name, text) = fixtures(&["formats/library.json"]).remove(0);
    let mut library =
        PigmentLibrary::from_json(&name, std::str::from_utf8(&text).unwrap()).unwrap();
    library.pigments.truncate(3);
    vec![made("library.csv", &curation::to_csv(&library))]
}

/// A square with a texture as glTF and OBJ, a triangle as PLY in text and in bytes.
pub(crate) fn models() -> Files {
    let corners = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.5]];
    let faces: [u16; 6] = [0, 1, 2, 0, 2, 3];
    let places = corners.iter().flatten().flat_map(|value| value.to_le_bytes());
    let data: Vec<u8> =
        places.chain(faces.iter().flat_map(|corner| corner.to_le_bytes())).collect();
    let mut texels = Cursor::new(Vec::new());
    let picture = image::RgbImage::from_raw(2, 1, vec![255, 0, 0, 0, 0, 255]).unwrap();
    picture.write_to(&mut texels, ImageFormat::Png).unwrap();
    let texels = texels.into_inner();
    let document = |buffer: &str, image: Value| {
        json!({
            "asset": {"version": "2.0"},
            "buffers": [{"uri": buffer, "byteLength": data.len()}],
            "bufferViews": [{"buffer": 0, "byteLength": 48},
                {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [image],
            "nodes": [{"mesh": 0, "translation": [1, 2, 3], "children": [1]}, {"mesh": 0, "scale": [1, 2, 1]}],
            "scenes": [{"nodes": [0]}], "scene": 0
        })
        .to_string()
    };
    let beside = document("data.bin", json!({"uri": "two.png"}));
    let inline = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&data));
    let texture = format!("data:image/png;base64,{}", STANDARD.encode(&texels));
    let inline = document(&inline, json!({"uri": texture}));
    let mut packed = inline.clone().into_bytes();
    packed.resize(packed.len().next_multiple_of(4), b' ');
    let size = (packed.len() as u32).to_le_bytes();
    let length = (packed.len() as u32 + 20).to_le_bytes();
    let packed = [&b"glTF\x02\0\0\0"[..], &length, &size, b"JSON", &packed].concat();
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nvt 0 0\nvt 1 1\nvn 0 0 1\no one\nusemtl red\n\
        f 1/1/1 2/2/1 3/1/1 4/2/1\ng two\nf -4 -3 -2\nl 1 2\n";
    let materials = "newmtl red\nKd 1 0 0\nmap_Kd two.png\n";
    let head = |format: &str, list: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list {list} int vertex_indices\nend_header\n"
        )
    };
    let text = head("ascii", "uchar") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let mut bytes = head("binary_little_endian", "uint").into_bytes();
    for value in [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    vec![
        (
            "beside.gltf".to_owned(),
            joined(beside.as_bytes(), [("data.bin", &data[..]), ("two.png", &texels)]),
        ),
        made("inline.gltf", &inline),
        ("packed.glb".to_owned(), packed),
        (
            "model.obj".to_owned(),
            joined(obj.as_bytes(), [("a.mtl", materials.as_bytes()), ("two.png", &texels)]),
        ),
        made("text.ply", &text),
        ("bytes.ply".to_owned(), bytes),
    ]
}

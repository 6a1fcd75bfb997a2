//! Tests of what a file keeps besides paint: names of layers, the palette and the brushes.

use exr::prelude::{ReadChannels, ReadLayers, WritableImage};
use pigment::PigmentId;
use pigment::library::PigmentLibrary;

use super::{PaintingFileError, read, read_table, write, write_with_table};
use crate::brush::HeadShape;
use crate::document::{Document, LayerId, Lighting, Medium, Slots};
use crate::ground::GroundSpec;
use crate::layer::{Cell, Layer};
use crate::strokes::{BrushSpec, KeptBrush, SideTable, SurfaceId};

/// A painting that was saved before layers had identities: two dry layers, of which the lower is
/// hidden by an opacity of 0.
const EARLIER: &[u8] = include_bytes!("../../../../tests/fixtures/paintings/earlier.exr");

fn paint(width: usize, height: usize, seed: u32) -> Layer {
    let mut layer = Layer::empty(width, height);
    for index in 0..width * height {
        let amount = (index as u32 * 7919 + seed * 104_729) % 5000;
        let pigments = [amount, 0, amount / 3, 0, 0, 0, 0, 0];
        layer.set_cell(index, Cell { pigments, vehicle: amount / 2 });
    }
    layer
}

fn document(width: usize, height: usize) -> Document {
    let library = PigmentLibrary::van_gogh_oils();
    let ground = GroundSpec::default().build(width, height, 0.2, &library).unwrap();
    let slots: Slots = std::array::from_fn(|slot| (slot < 4).then_some(PigmentId(slot)));
    let medium = Medium::default();
    let lighting = Lighting::default();
    let mut document = Document::bare("table", 0.2, ground, library, medium, slots, lighting);
    document.wet = paint(width, height, 1);
    document.push_dry(slots, paint(width, height, 2));
    document.push_dry(slots, paint(width, height, 3));
    document
}

fn table() -> SideTable {
    let brush = |name: &str, at, paint| KeptBrush {
        name: name.to_owned(),
        spec: BrushSpec { shape: HeadShape::Flat, size_mm: 4.5 },
        at,
        paint,
    };
    // The cells of a head can reach beyond the palette.
    let brushes = vec![
        brush("big", SurfaceId::Palette, Some(paint(40, 9, 4))),
        brush("clean", SurfaceId::Canvas, None),
        brush("r\u{f6}und", SurfaceId::Canvas, Some(paint(3, 50, 5))),
    ];
    SideTable { palette: document(30, 20), brushes }
}

fn with_table(canvas: &Document, table: &SideTable) -> Result<Vec<u8>, PaintingFileError> {
    write_with_table(canvas, &table.palette, &table.brushes)
}

#[test]
fn layers_keep_identity_name_and_visibility() {
    let mut named = document(30, 20);
    named.dry.swap(0, 1);
    named.dry[0].name = "r\u{f6}tel, \"first\"".to_owned();
    named.dry[1].visible = false;
    named.next_layer = LayerId(9);
    let bytes = write(&named).unwrap();
    assert!(read("a.exr", &bytes).unwrap() == named, "not the same painting");
    assert!(write(&named).unwrap() == bytes, "not the same bytes");
    named.dry[0].name = "two\nlines".to_owned();
    assert!(write(&named).unwrap_err().to_string().contains("on one line"), "written");
}

#[test]
fn a_file_of_an_earlier_version_has_its_layers_numbered_from_the_lowest() {
    let document = read("earlier.exr", EARLIER).unwrap();
    let found: Vec<_> = document
        .dry
        .iter()
        .map(|layer: &crate::document::DryLayer| (layer.id, layer.name.clone(), layer.visible))
        .collect();
    assert_eq!(found, [1, 2].map(|id| (LayerId(id), String::new(), true)));
    assert_eq!((document.dry[0].opacity, document.next_layer), (0.0, LayerId(3)));
    assert!(document.wet.totals()[1] > 0, "half of the second stroke is wet");
    assert!(read_table("earlier.exr", EARLIER).unwrap().is_none(), "it has no table");
    // Saved again it is the same painting.
    assert!(read("again.exr", &write(&document).unwrap()).unwrap() == document, "changed");
}

#[test]
fn layers_whose_attributes_another_program_dropped_are_numbered_anew() {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes();
    let bytes = with_table(&document(30, 20), &table()).unwrap();
    let mut image = image.from_buffered(std::io::Cursor::new(&bytes)).unwrap();
    for layer in &mut image.layer_data {
        let base = layer.attributes.layer_name.as_ref().is_some_and(|name| name.eq("base"));
        if !base {
            layer.attributes.other.clear();
        }
    }
    let mut bare = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut bare).unwrap();
    let back = read("a.exr", bare.get_ref()).unwrap();
    assert_eq!(back.dry.iter().map(|layer| layer.id.0).collect::<Vec<_>>(), [1, 2]);
    assert!(read_table("a.exr", bare.get_ref()).unwrap().is_none(), "the table was dropped");
}

#[test]
fn palette_and_brushes_come_back_and_the_painting_is_the_same_without_them() {
    let canvas = document(50, 40);
    let table = table();
    let bytes = with_table(&canvas, &table).unwrap();
    assert!(read("a.exr", &bytes).unwrap() == canvas, "not the same canvas");
    assert!(read_table("a.exr", &bytes).unwrap() == Some(table.clone()), "not the same table");
    assert!(with_table(&canvas, &table).unwrap() == bytes, "not the same bytes");
    assert!(read_table("a.exr", &write(&canvas).unwrap()).unwrap().is_none(), "no table");
}

#[test]
fn a_damaged_table_is_told_of_and_leaves_the_painting_readable() {
    let canvas = document(50, 40);
    let table = table();
    let bytes = with_table(&canvas, &table).unwrap();
    let inner = write::encode(&table.palette, &table.brushes, None).unwrap();
    let at = bytes.windows(inner.len()).position(|window| window == inner).unwrap();
    let mut damaged = bytes.clone();
    let middle = at + inner.len() * 3 / 4;
    damaged[middle..middle + 200].fill(0x55);
    assert!(read("a.exr", &damaged).unwrap() == canvas, "the canvas is not touched");
    let error = read_table("a.exr", &damaged).unwrap_err().to_string();
    assert!(error.starts_with("a.exr: palette: "), "{error}");
    // Paint of a pigment that the palette lacks.
    let mut stray = table;
    stray.brushes[0].paint.as_mut().unwrap().pigments[(0, 0)][7] = 1;
    let error = with_table(&canvas, &stray).unwrap_err().to_string();
    assert!(error.contains("brush `big` has paint of no pigment"), "{error}");
}

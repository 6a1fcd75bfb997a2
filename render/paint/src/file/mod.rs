//! Painting files: OpenEXR, format `impasto-painting`, version 2. Callers usually use
//! [`Document::open`](crate::document::Document::open) and
//! [`Document::save`](crate::document::Document::save).
//!
//! A file has a part per layer, with scan lines of 32-bit float channels. You can show and edit
//! them in any program that reads OpenEXR. Compression is PIZ, which is lossless. It encodes wet
//! paint in half the time of ZIP and to two thirds of the bytes. We also read files with ZIP or
//! without compression.
//!
//! | part | channels, in mm |
//! | --- | --- |
//! | `base` | `height` of the ground above the plane of the canvas |
//! | `wet`, `dry.000`, `dry.001` .. (lowest first) | one channel per pigment: height of its paint. `vehicle`. `thickness`: their sum, for other programs, not read |
//! | `wet.skin`, `dry.000.skin` .. | the skin over the paint of this layer, in the same channels. A layer without a skin has no such part |
//!
//! A file without a skin has version 1, which earlier programs read too.
//!
//! The display window is the canvas. The data window of a layer is the rectangle that has
//! paint. Attribute `impasto` of part `base` is JSON in ASCII: format and version, title,
//! cell size, ground, medium, lighting, the layers with the channel of each pigment, their
//! opacity, and the pigment library.
//!
//! The part of a dry layer has an attribute `impasto.layer`: JSON in ASCII with its identity
//! (`id`), the identity of the next layer (`next`), its `name` and whether it is `visible`. If a
//! file of an earlier version does not have this attribute, we number its layers from the lowest,
//! 1, and show all. Older programs leave the attribute alone, so you see hidden layers in them.
//!
//! The studio also keeps the palette and the brushes. Attribute `impasto.table` of part `wet` holds
//! them as the bytes of a file of this format. The layers of that file are the layers of the
//! palette. A part `brush.000`, `brush.001` .. has the paint on the cells of a brush's head, and
//! the JSON the name, shape and size of each brush. If you only show the painting, you need not
//! decode this.
//!
//! A pigment's channel has the pigment's name. Characters outside ASCII and dots (which OpenEXR
//! reads as layers within the part) become `_`, and we add a number to a name that is taken. In the
//! JSON you find the channel of each pigment.
//!
//! Amounts are whole quanta (see [`crate::amount`]), and we restore them exactly. A 32-bit float
//! distinguishes quanta below 2^23, enough for paint up to four cell widths high. If a layer holds
//! more, channel `NAME.rest` has the rounding residue in mm, and the amount is the sum of both.

mod channels;
mod header;
mod read;
mod write;

use documents::file::FileError;
use documents::hint::Explain;
use pigment::library::LibraryError;

pub use channels::{ChannelNames, PigmentChannel, channels_of_slots, slots_of_channels};
pub use header::{ATTRIBUTE, ascii_json};
pub use read::{MEMORY_LIMIT, read, read_table, read_within};
pub use write::{write, write_with_table};

/// A painting's file cannot be read, or a painting cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum PaintingFileError {
    /// The file cannot be read from or written to the disk.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is not OpenEXR, or is damaged.
    #[error("{file}: not an intact OpenEXR file: {reason}")]
    #[hint("the file is truncated, damaged or not OpenEXR: restore it from a backup")]
    Container {
        /// Path of the file.
        file: String,
        /// Reason given by the decoder.
        reason: String,
    },
    /// The file is OpenEXR, but not a painting of impasto.
    #[error("{file}: not a painting of impasto: {reason}")]
    #[hint("choose a painting that was saved by impasto")]
    Format {
        /// Path of the file.
        file: String,
        /// Reason, with what was found.
        reason: String,
    },
    /// The file has a version that this program does not know.
    #[error("{file}: this program reads paintings up to version {newest}, found `{found}`")]
    #[hint("a newer impasto may read it")]
    Version {
        /// Path of the file.
        file: String,
        /// Version of the file.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// The description in attribute `impasto` is invalid.
    #[error("{file}: attribute `impasto`: {reason}")]
    Header {
        /// Path of the file.
        file: String,
        /// Reason, with the key.
        reason: String,
    },
    /// The pigment library in the file is invalid.
    #[error(transparent)]
    #[fault(Input)]
    Library(#[from] LibraryError),
    /// A part of the file is missing or malformed.
    #[error("{file}: part `{part}` {reason}")]
    Part {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Reason, continuing the sentence that starts with the part.
        reason: String,
    },
    /// A channel is missing or malformed.
    #[error("{file}: part `{part}`, channel `{channel}` {reason}")]
    #[hint("another program changed the file: keep channels as they were, in mm")]
    Channel {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Name of the channel.
        channel: String,
        /// Reason, continuing the sentence that starts with the channel.
        reason: String,
    },
    /// A value is not a possible amount or height.
    #[error("{file}: part `{part}`, channel `{channel}`, x {x}, y {y}: {wanted}, found `{found}`")]
    #[hint("another program changed the file: keep channels as they were, in mm")]
    Value {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Name of the channel.
        channel: String,
        /// Column on the canvas, from 0.
        x: u32,
        /// Row on the canvas, from 0.
        y: u32,
        /// Range of values allowed.
        wanted: &'static str,
        /// Value found, in mm.
        found: String,
    },
    /// The painting would take more memory than allowed.
    #[error("{file}: the painting takes {bytes} bytes in memory, the limit is {limit}")]
    #[hint("reduce the canvas, or merge dry layers")]
    TooLarge {
        /// Path of the file.
        file: String,
        /// Bytes that the painting needs.
        bytes: u64,
        /// Most bytes allowed.
        limit: u64,
    },
    /// The system does not give the memory that the painting needs.
    #[error("{file}: the painting needs `{mb}` MB of memory, which the system does not give")]
    #[hint("close other programs, or raise the limit of memory")]
    #[fault(Environment)]
    Memory {
        /// Path of the file.
        file: String,
        /// Memory in MB.
        mb: u64,
    },
    /// The painting contradicts itself, so we cannot write a file of it.
    #[error("the painting cannot be saved: {0}")]
    Unwritable(String),
}

impl PaintingFileError {
    fn unwritable(reason: String) -> Self {
        Self::Unwritable(reason)
    }

    fn header(file: &str, reason: String) -> Self {
        Self::Header { file: file.to_owned(), reason }
    }

    fn container(file: &str, reason: String) -> Self {
        Self::Container { file: file.to_owned(), reason }
    }
}

#[cfg(test)]
mod tests {
    //! These tests check what a file keeps besides paint: names of layers, the palette and the
    //! brushes.

    use super::{PaintingFileError, read, read_table, write, write_with_table};
    use crate::brush::HeadShape;
    use crate::document::{Document, LayerId, Lighting, Medium, Slots};
    use crate::ground::GroundSpec;
    use crate::layer::{Cell, Layer};
    use crate::strokes::{BrushSpec, KeptBrush, SideTable, SurfaceId};
    use exr::prelude::{ReadChannels, ReadLayers, WritableImage};
    use pigment::PigmentId;
    use pigment::library::PigmentLibrary;

    /// A painting from the time before layers had identities: it has two dry layers, and an opacity
    /// of 0 hides the lower one.
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
        // The cells of a head can reach beyond the palette.
        let brushes = vec![
            kept_brush("big", SurfaceId::Palette, Some(paint(40, 9, 4))),
            kept_brush("clean", SurfaceId::Canvas, None),
            kept_brush("r\u{f6}und", SurfaceId::Canvas, Some(paint(3, 50, 5))),
        ];
        SideTable { palette: document(30, 20), brushes }
    }

    fn with_table(canvas: &Document, table: &SideTable) -> Result<Vec<u8>, PaintingFileError> {
        write_with_table(canvas, &table.palette, &table.brushes)
    }

    fn kept_brush(name: &str, at: SurfaceId, paint: Option<Layer>) -> KeptBrush {
        KeptBrush {
            name: name.to_owned(),
            spec: BrushSpec { shape: HeadShape::Flat, size_mm: 4.5 },
            at,
            paint,
        }
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
        // If you save it again, you get an equal painting.
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
}

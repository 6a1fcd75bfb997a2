//! OpenEXR files of texels: parts of scan lines with named channels of 32-bit floats, compressed
//! by PIZ, which is lossless, and a description in JSON.
//!
//! We store samples and art maps in such files. Their modules name the parts and channels, and
//! this module encodes, checks and decodes them. The description is in attribute `impasto` of the
//! first part, in ASCII. It begins with the keys `format` and `version`. Parts are in the order of
//! the description. We allocate memory only after all parts match the description.

mod texels;
mod kind;

use std::io::Cursor;

use documents::file::check_expansion;
use documents::foreign_message;
use exr::block::UncompressedBlock;
use exr::block::chunk::Chunk;
use exr::block::reader::Reader;
use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{
    AttributeValue, Compression, IntegerBounds, LineOrder, SampleType, Text,
};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use exr::meta::{BlockDescription, MetaData};
use paint::file::ATTRIBUTE;
use rayon::prelude::*;

pub use kind::TexelFileError;
pub(crate) use kind::{Origin, TexelFileKind, decoded, encoded, encoded_library, paint_of, proven};
pub(crate) use texels::{COLOR, HEIGHT, PartPlan, PartPlanes, Texels, VEHICLE, of_planes, of_text};
pub use texels::{PaintOfSamples, TexelPaint};

#[derive(Debug)]
struct PartLayout {
    plan: PartPlan,
    /// For each channel, in the order of the file, its index in the plan.
    places: Vec<usize>,
}

/// Checks the parts against their plans, in their order.
///
/// # Errors
/// [`TexelFileError`] for parts and channels that are not as planned, and for more numbers than
/// `file_bytes` can hold.
fn layout(
    origin: Origin<'_>,
    parts: &[Header],
    plans: Vec<PartPlan>,
    file_bytes: usize,
) -> Result<Vec<PartLayout>, TexelFileError> {
    let found = parts.len();
    let wanted = plans.len();
    if found != wanted {
        let reason = format!("it names {wanted} parts, the file has `{found}`");
        return Err(origin.header(reason));
    }
    let layouts = parts.iter().zip(plans).map(|(part, plan)| check_part(origin, part, plan));
    let layouts = layouts.collect::<Result<Vec<_>, _>>()?;
    let stored = layouts.iter().map(|PartLayout { plan, .. }| {
        let texels = (plan.width as u64).saturating_mul(plan.height as u64);
        texels.saturating_mul((size_of::<f32>() * plan.channels.len()) as u64)
    });
    let stored = stored.fold(0, u64::saturating_add);
    check_expansion(stored, file_bytes as u64)
        .map_err(|error| origin.damaged(error.to_string()))?;
    Ok(layouts)
}

fn check_part(
    origin: Origin<'_>,
    part: &Header,
    plan: PartPlan,
) -> Result<PartLayout, TexelFileError> {
    let name = part.own_attributes.layer_name.as_ref();
    if !name.is_some_and(|name| name.eq(&plan.name)) {
        return Err(origin.part(&plan.name, "is missing at its place"));
    }
    if part.blocks != BlockDescription::ScanLines || part.deep {
        return Err(origin.part(&plan.name, "has tiles or is deep; expected scan lines"));
    }
    let size = (part.layer_size.width(), part.layer_size.height());
    let width = plan.width;
    let height = plan.height;
    if size != (width, height) {
        let found = format!("{} x {}", size.0, size.1);
        let reason = format!("has `{found}` texels, attribute `impasto` says {width} x {height}");
        return Err(origin.part(&plan.name, reason));
    }
    let list = &part.channels.list;
    let names: Vec<String> = list.iter().map(|channel| channel.name.chars().collect()).collect();
    let wrong = |channel: &str, reason: &str| {
        Err(origin.channel(&plan.name, (channel.to_owned(), reason.to_owned())))
    };
    let mut places = Vec::with_capacity(names.len());
    for (at, (name, channel)) in names.iter().zip(list).enumerate() {
        match plan.channels.iter().position(|wanted| wanted == name) {
            Some(place) => places.push(place),
            None => return wrong(name, "is none that attribute `impasto` names"),
        }
        if names[..at].contains(name) {
            return wrong(name, "occurs twice");
        }
        if channel.sample_type != SampleType::F32 {
            return wrong(name, "must hold 32-bit floats");
        }
        if (channel.sampling.x(), channel.sampling.y()) != (1, 1) {
            return wrong(name, "must have a value for every texel");
        }
    }
    match plan.channels.iter().find(|name| !names.contains(name)) {
        Some(name) => wrong(name, "is missing"),
        None => Ok(PartLayout { plan, places }),
    }
}

/// We read this many blocks as a batch and then decompress them in parallel.
const BATCH: usize = 64;

pub(crate) struct Opened<'a> {
    origin: Origin<'a>,
    reader: Reader<Cursor<&'a [u8]>>,
    bytes: usize,
}

impl<'a> Opened<'a> {
    /// Reads the headers in `bytes`, the content of the file.
    ///
    /// # Errors
    /// [`TexelFileError::Container`] if they are not OpenEXR or truncated.
    pub(crate) fn new(origin: Origin<'a>, bytes: &'a [u8]) -> Result<Self, TexelFileError> {
        let reader = exr::block::read(Cursor::new(bytes), false)
            .map_err(|error| origin.damaged(foreign_message(&error)))?;
        Ok(Self { origin, reader, bytes: bytes.len() })
    }

    /// Text of attribute `impasto` of the first part that has it.
    ///
    /// # Errors
    /// [`TexelFileError::Format`] if there is none.
    pub(crate) fn description(&self) -> Result<String, TexelFileError> {
        let key = Text::from(ATTRIBUTE);
        let mut parts = self.reader.headers().iter();
        match parts.find_map(|part| part.own_attributes.other.get(&key)) {
            Some(AttributeValue::Text(text)) => Ok(text.chars().collect()),
            Some(_) => Err(self.origin.other_format("attribute `impasto` is not text")),
            None => Err(self.origin.other_format("attribute `impasto` is missing")),
        }
    }

    /// The numbers of all parts, which must be as planned.
    ///
    /// # Errors
    /// [`TexelFileError`] for other parts or channels, damaged blocks, and rows that are missing
    /// or occur twice.
    pub(crate) fn planes(self, plans: Vec<PartPlan>) -> Result<Vec<PartPlanes>, TexelFileError> {
        let Self { origin, reader, bytes } = self;
        let damaged = |error: exr::error::Error| origin.damaged(foreign_message(&error));
        let layouts = layout(origin, reader.headers(), plans, bytes)?;
        let mut parts: Vec<Filling> = layouts.into_iter().map(Filling::new).collect();
        let meta = reader.meta_data().clone();
        let mut chunks = reader.all_chunks(false).map_err(damaged)?;
        loop {
            let batch: Vec<Chunk> =
                chunks.by_ref().take(BATCH).collect::<Result<_, _>>().map_err(damaged)?;
            if batch.is_empty() {
                break;
            }
            let blocks: Vec<_> =
                batch.into_par_iter().map(|chunk| block(origin, chunk, &meta, &parts)).collect();
            for block in blocks {
                let block = block?;
                parts[block.index.layer].fill(origin, &block)?;
            }
        }
        parts.into_iter().map(|part| part.finished(origin)).collect()
    }
}

struct Filling {
    layout: PartLayout,
    planes: Vec<Vec<f32>>,
    rows: Vec<bool>,
}

impl Filling {
    fn new(layout: PartLayout) -> Self {
        let width = layout.plan.width;
        let height = layout.plan.height;
        let planes = vec![vec![0.0; width * height]; layout.plan.channels.len()];
        Self { layout, planes, rows: vec![false; height] }
    }

    fn fill(
        &mut self,
        origin: Origin<'_>,
        UncompressedBlock { index, data }: &UncompressedBlock,
    ) -> Result<(), TexelFileError> {
        let PartLayout { plan, places } = &self.layout;
        let count = places.len();
        for (line, bytes) in data.chunks(plan.width * size_of::<f32>()).enumerate() {
            let row = index.pixel_position.y() + line / count;
            let channel = line % count;
            if channel == 0 && std::mem::replace(&mut self.rows[row], true) {
                return Err(origin.part(&plan.name, format!("has row `{row}` twice")));
            }
            let numbers = bytes.as_chunks().0.iter().map(|bytes| f32::from_ne_bytes(*bytes));
            let row = &mut self.planes[places[channel]][row * plan.width..][..plan.width];
            row.iter_mut().zip(numbers).for_each(|(value, number)| *value = number);
        }
        Ok(())
    }

    /// Returns the finished part. This fails if a row is missing.
    fn finished(self, origin: Origin<'_>) -> Result<PartPlanes, TexelFileError> {
        let plan = self.layout.plan;
        match self.rows.iter().position(|filled| !filled) {
            Some(row) => Err(origin.part(&plan.name, format!("lacks row `{row}`"))),
            None => Ok(PartPlanes { plan, planes: self.planes }),
        }
    }
}

/// Decompresses a block and checks its size.
fn block(
    origin: Origin<'_>,
    chunk: Chunk,
    meta: &MetaData,
    parts: &[Filling],
) -> Result<UncompressedBlock, TexelFileError> {
    let block = UncompressedBlock::decompress_chunk(chunk, meta, false)
        .map_err(|error| origin.damaged(foreign_message(&error)))?;
    let PartLayout { plan, places } = &parts[block.index.layer].layout;
    let height = block.index.pixel_size.height();
    let wanted = plan.width * places.len() * height * size_of::<f32>();
    let bottom = block.index.pixel_position.y() + height;
    let fits = block.index.pixel_size.width() == plan.width && bottom <= plan.height;
    if !fits || block.data.len() != wanted {
        let part = &plan.name;
        let found = block.data.len();
        let reason = format!("block of part `{part}` with `{found}` bytes for {wanted}");
        return Err(origin.damaged(reason));
    }
    Ok(block)
}

const ENCODING: Encoding = Encoding {
    compression: Compression::PIZ,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// Encodes parts as a file with their description. If you pass equal parts, you get equal bytes.
///
/// # Errors
/// [`TexelFileError::Unwritable`] if the encoder refuses the parts.
pub(crate) fn write(
    kind: &TexelFileKind,
    description: &str,
    parts: Vec<PartPlanes>,
) -> Result<Vec<u8>, TexelFileError> {
    let widest = parts.iter().map(|part| part.plan.width).max().unwrap_or(1);
    let highest = parts.iter().map(|part| part.plan.height).max().unwrap_or(1);
    let mut layers = Vec::with_capacity(parts.len());
    for PartPlanes { plan, planes } in parts {
        let mut own = LayerAttributes::named(plan.name.as_str());
        if layers.is_empty() {
            // The encoder may change the order of several custom attributes.
            let text = AttributeValue::Text(description.into());
            own.other.extend([(Text::from(ATTRIBUTE), text)]);
        }
        let channels = plan.channels.iter().zip(planes);
        let channels = channels
            .map(|(name, plane)| AnyChannel::new(name.as_str(), FlatSamples::F32(plane)))
            .collect();
        let size = (plan.width, plan.height);
        layers.push(Layer::new(size, own, ENCODING, AnyChannels::sort(channels)));
    }
    let display = ImageAttributes::new(IntegerBounds::new((0, 0), (widest, highest)));
    let image = Image::from_layers(display, layers);
    let mut bytes = Vec::new();
    let written = image.write().to_buffered(Cursor::new(&mut bytes));
    written.map_err(|error| kind.unwritable(error.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::file::EXPANSION;
    use documents::hint::Explain;
    use paint::file::ATTRIBUTE;

    const KIND: TexelFileKind = TexelFileKind {
        format: "impasto-test",
        version: 3,
        content: "test",
        reserved: &["a", "b"],
    };
    const ORIGIN: Origin<'_> = Origin { kind: &KIND, file: "a.exr" };

    fn plans() -> Vec<PartPlan> {
        vec![PartPlan::new("p.000", (5, 64), &["b", "a"]), PartPlan::new("p.001", (7, 3), &["a"])]
    }

    /// Two parts in which all numbers differ.
    fn parts() -> Vec<PartPlanes> {
        plans()
            .into_iter()
            .map(|plan: PartPlan| {
                let count = plan.width * plan.height;
                plan.with(|channel| {
                    let first = channel.len() as f32 + if channel == "b" { 0.5 } else { 0.25 };
                    (0..count).map(|index| first + index as f32).collect()
                })
            })
            .collect()
    }

    fn bytes() -> Vec<u8> {
        write(&KIND, "some words", parts()).unwrap()
    }

    fn refused(bytes: &[u8], plans: Vec<PartPlan>) -> String {
        let error = Opened::new(ORIGIN, bytes).unwrap().planes(plans).unwrap_err();
        assert!(error.hint().is_some(), "{error}");
        error.to_string()
    }

    fn place(bytes: &[u8], wanted: &[u8]) -> usize {
        bytes.windows(wanted.len()).position(|window| window == wanted).unwrap()
    }

    #[test]
    fn parts_come_back_with_their_description() {
        let bytes = bytes();
        let opened = Opened::new(ORIGIN, &bytes).unwrap();
        assert_eq!(opened.description().unwrap(), "some words");
        assert_eq!(opened.planes(plans()).unwrap(), parts());
        let part = &parts()[0];
        assert_eq!((part.of("b")[1], part.of("c")), (2.5, &[][..]));
    }

    #[test]
    fn descriptions_of_other_formats_and_versions_are_told_apart() {
        fn decode(json: &str) -> String {
            decoded::<serde_json::Value>(ORIGIN, json).unwrap_err().to_string()
        }
        let other = decode(r#"{"format": "impasto-painting", "version": 3}"#);
        let wanted = "`format` must be \"impasto-test\", found `\"impasto-painting\"`";
        assert_eq!(other, format!("a.exr: no test of impasto: {wanted}"));
        let newer = decode(r#"{"format": "impasto-test", "version": 4}"#);
        assert_eq!(newer, "a.exr: test of version `4`, this program reads versions up to 3");
        assert!(decode("{").starts_with("a.exr: attribute `impasto`: EOF"), "{}", decode("{"));
        let mut bytes = bytes();
        let at = place(&bytes, format!("{ATTRIBUTE}\0").as_bytes());
        bytes[at] = b'I';
        let error = Opened::new(ORIGIN, &bytes).unwrap().description().unwrap_err();
        assert_eq!(error.to_string(), "a.exr: no test of impasto: attribute `impasto` is missing");
    }

    #[test]
    fn parts_and_channels_that_are_not_planned_are_named() {
        let with = |change: &dyn Fn(&mut Vec<PartPlan>)| {
            let mut plans = plans();
            change(&mut plans);
            refused(&bytes(), plans)
        };
        let fewer = with(&|plans| drop(plans.pop()));
        assert_eq!(fewer, "a.exr: attribute `impasto`: it names 1 parts, the file has `2`");
        let named = with(&|plans| plans[1].name = "q".to_owned());
        assert_eq!(named, "a.exr: part `q` is missing at its place");
        let larger = with(&|plans| plans[0].width = 6);
        assert_eq!(
            larger,
            "a.exr: part `p.000` has `5 x 64` texels, attribute `impasto` says 6 x 64"
        );
        let missing = with(&|plans| plans[1].channels.push("c".to_owned()));
        assert_eq!(missing, "a.exr: part `p.001`, channel `c` is missing");
        let unknown = with(&|plans| drop(plans[0].channels.pop()));
        assert!(unknown.starts_with("a.exr: part `p.000`, channel `b` is none that"), "{unknown}");
    }

    #[test]
    fn channels_of_other_numbers_are_refused() {
        let mut whole = bytes();
        // A channel has these parts: its name, a zero, the type of its numbers (0 whole, 1 half, 2
        // float), a byte and three for its use, and its steps in x and y.
        let at = place(&whole, b"\0b\0\x02\0\0\0");
        whole[at + 3] = 0;
        let error = refused(&whole, plans());
        assert_eq!(error, "a.exr: part `p.000`, channel `b` must hold 32-bit floats");
    }

    #[test]
    fn rows_that_occur_twice_are_named() {
        let mut bytes = bytes();
        // A block begins with part, row and number of bytes: part 0 has blocks at rows 0 and 32.
        let at = place(&bytes, &[0, 0, 0, 0, 32, 0, 0, 0]);
        bytes[at + 4] = 0;
        assert_eq!(refused(&bytes, plans()), "a.exr: part `p.000` has row `0` twice");
    }

    #[test]
    fn sizes_that_the_file_cannot_hold_are_refused_before_memory_is_taken() {
        let width = 1_000_000;
        let mut bytes = bytes();
        // The data window of the first part: left, top, right and bottom, the last ones inclusive.
        fn window(right: i32) -> Vec<u8> {
            [0, 0, right, 63].map(i32::to_le_bytes).concat()
        }
        let at = place(&bytes, b"dataWindow\0box2i\0") + 21;
        assert_eq!(bytes[at..at + 16], window(4));
        bytes[at..at + 16].copy_from_slice(&window(width - 1));
        let mut plans = plans();
        plans[0].width = width as usize;
        assert!(8 * 64 * width as u64 > EXPANSION * bytes.len() as u64);
        let error = refused(&bytes, plans);
        assert!(error.contains("bytes cannot hold the 512000084"), "{error}");
    }

    #[test]
    fn a_description_that_does_not_come_back_is_not_written() {
        let proven = |back: Result<u8, TexelFileError>| {
            proven(&KIND, 7, None, back.map(|back| (back, None))).map_err(|error| error.to_string())
        };
        assert_eq!(proven(Ok(7)), Ok(7));
        let other = proven(Ok(8)).unwrap_err();
        assert!(other.starts_with("the test cannot be saved: the description does not"), "{other}");
        let fault = proven(Err(ORIGIN.header("a reason"))).unwrap_err();
        assert_eq!(fault, "the test cannot be saved: a reason");
    }
}

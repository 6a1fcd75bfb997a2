//! Decoding of a file of texels.

use std::io::Cursor;

use exr::block::UncompressedBlock;
use exr::block::chunk::Chunk;
use exr::block::reader::Reader;
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Text};
use paint::file::ATTRIBUTE;
use rayon::prelude::*;

use super::error::TexelFileError;
use super::kind::Origin;
use super::layout::{PartLayout, layout};
use super::part::{PartPlan, PartPlanes};

/// Number of blocks that are read as a batch and then decompressed in parallel.
const BATCH: usize = 64;

/// A file whose headers were read.
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
            .map_err(|error| origin.damaged(error.to_string()))?;
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
            Some(_) => Err(self.origin.other_format("attribute `impasto` is no text")),
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
        let damaged = |error: exr::error::Error| origin.damaged(error.to_string());
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
        parts.into_iter().map(|part| part.whole(origin)).collect()
    }
}

/// A part that is filled row by row.
struct Filling {
    layout: PartLayout,
    /// Numbers of the channels in the order of the plan.
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

    /// Takes over the rows of a block.
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

    /// The part, if no row is missing.
    fn whole(self, origin: Origin<'_>) -> Result<PartPlanes, TexelFileError> {
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
        .map_err(|error| origin.damaged(error.to_string()))?;
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

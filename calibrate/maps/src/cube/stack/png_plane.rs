//! PNG pictures of a stack.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use png::{BitDepth, ColorType, Decoder, DecodingError, Reader};

use super::plane::{Plane, not_gray};
use crate::cube::error::CubeError;
use crate::cube::spool::Spool;
use crate::numbers::NumberType;

fn fault(path: &Path, error: DecodingError) -> CubeError {
    match error {
        DecodingError::IoError(reason) => CubeError::unpacking(path, reason),
        other => CubeError::data(path, format!("cannot be unpacked: {other}"), "export it again"),
    }
}

fn reader(path: &Path) -> Result<Reader<BufReader<File>>, CubeError> {
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    Decoder::new(BufReader::new(file)).read_info().map_err(|error| fault(path, error))
}

/// Size and numbers of the picture.
pub(crate) fn plane(path: &Path) -> Result<Plane, CubeError> {
    let reader = reader(path)?;
    let info = reader.info();
    let number_type = match (info.color_type, info.bit_depth) {
        (ColorType::Grayscale, BitDepth::Eight) => NumberType::U8,
        (ColorType::Grayscale, BitDepth::Sixteen) => NumberType::U16,
        other => return Err(not_gray(path, "the picture", other)),
    };
    let samples = info.width as usize;
    let lines = info.height as usize;
    Ok(Plane { samples, lines, bands: 1, number_type })
}

/// Unpacks the picture row after row as the band `band`.
pub(crate) fn unpack(
    path: &Path,
    plane: Plane,
    band: usize,
    spool: &mut Spool,
) -> Result<(), CubeError> {
    let mut reader = reader(path)?;
    if reader.info().interlaced {
        let problem = "is interlaced, so that its rows do not follow each other";
        return Err(CubeError::format(path, problem, "save it without interlacing"));
    }
    let mut line = 0;
    while let Some(row) = reader.next_row().map_err(|error| fault(path, error))? {
        match plane.number_type {
            NumberType::U16 => {
                let (numbers, _) = row.data().as_chunks::<2>();
                let bytes: Vec<u8> = numbers
                    .iter()
                    .flat_map(|&bytes| u16::from_be_bytes(bytes).to_ne_bytes())
                    .collect();
                spool.write((line, 0, band), &bytes)?;
            }
            _ => spool.write((line, 0, band), row.data())?,
        }
        line += 1;
    }
    Ok(())
}

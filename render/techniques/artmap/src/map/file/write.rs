//! Encoding of a file of an art map.

use rayon::prelude::*;

use super::header::{FileHeader, KIND};
use super::planes::{check, check_tone, part, texels};
use crate::map::art_map::ArtMap;
use crate::texel_file::{PartPlanes, TexelFileError, of_planes, write as write_parts};

/// Encodes a map as a file. Equal maps always give equal bytes.
///
/// # Errors
/// [`TexelFileError::Unwritable`] for a map without tiles, tiles that are no squares of one size
/// or not in order of tone, paint without pigment, and impossible numbers.
pub fn write(map: &ArtMap) -> Result<Vec<u8>, TexelFileError> {
    check_tiles(map).map_err(|reason| KIND.unwritable(reason))?;
    let mut header = FileHeader::of(map)?;
    let pigments = header.pigments.as_deref();
    let parts: Vec<PartPlanes> = map
        .keys
        .par_iter()
        .zip(header.plans())
        .map(|(key, plan)| part(key, plan, pigments))
        .collect();
    for (key, part) in map.keys.iter().zip(&parts) {
        check(part, pigments).map_err(|(channel, reason)| {
            KIND.unwritable(format!("tile `{}`, channel `{channel}` {reason}", key.name))
        })?;
        check_tone(&key.tile, key.tone)
            .map_err(|reason| KIND.unwritable(format!("tile `{}` {reason}", key.name)))?;
    }
    let digests: Vec<String> = parts.par_iter().map(of_planes).collect();
    for (key, digest) in header.keys.iter_mut().zip(digests) {
        key.digest = digest;
    }
    write_parts(&KIND, &header.sealed(map.paint.as_ref())?, parts)
}

fn check_tiles(map: &ArtMap) -> Result<(), String> {
    let size = map.size();
    if size == 0 {
        return Err("it has no texels".to_owned());
    }
    for key in &map.keys {
        let whose = format!("tile `{}`", key.name);
        let width = key.tile.color.width();
        let height = key.tile.color.height();
        if (width, height) != (size, size) {
            return Err(format!("{whose} has `{width} x {height}` texels for {size} x {size}"));
        }
        if key.sources.bounds() != key.tile.color.bounds() {
            return Err(format!("fields of {whose} differ in size"));
        }
        texels(&key.tile).check(&whose, map.paint.as_ref())?;
    }
    Ok(())
}

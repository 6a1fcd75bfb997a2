//! Decoding of a file of an art map.

use rayon::prelude::*;

use super::header::{FileHeader, KIND, KeyHeader};
use super::planes::{check, check_tone, key_map};
use crate::map::art_map::{ArtMap, KeyMap};
use crate::texel_file::{Opened, Origin, PartPlanes, TexelFileError, of_planes};

/// Decodes a map from `bytes`, the content of `file`. The name is used in errors only.
///
/// # Errors
/// [`TexelFileError`] if the content is not OpenEXR, holds no art map, is of a newer version,
/// truncated, inconsistent, or not what was written.
pub fn read(file: &str, bytes: &[u8]) -> Result<ArtMap, TexelFileError> {
    let origin = Origin { kind: &KIND, file };
    let opened = Opened::new(origin, bytes)?;
    let (header, paint) = FileHeader::from_json(origin, &opened.description()?)?;
    let pigments = header.pigments.as_deref();
    let decoded = |(part, of): (PartPlanes, &KeyHeader)| -> Result<KeyMap, TexelFileError> {
        check(&part, pigments).map_err(|fault| origin.channel(&of.part, fault))?;
        if of_planes(&part) != of.digest {
            return Err(origin.changed(&of.part));
        }
        let key = key_map(of, &part, pigments);
        check_tone(&key.tile, key.tone).map_err(|reason| origin.part(&of.part, reason))?;
        Ok(key)
    };
    let parts = opened.planes(header.plans())?;
    let keys: Vec<_> = parts.into_par_iter().zip(&header.keys).map(decoded).collect();
    Ok(ArtMap {
        keys: keys.into_iter().collect::<Result<_, _>>()?,
        first: header.first,
        paint,
        spacing: header.spacing,
        mm_per_texel: header.mm_per_texel,
        guessed_relief: header.guessed_relief,
        patch: header.patch,
        levels: header.levels,
        settings: header.settings,
        provenance: header.provenance,
    })
}

//! Decoding of a file of samples.

use rayon::prelude::*;

use super::header::{FileHeader, KIND};
use super::planes::{check, sample};
use crate::sample::passage::SampleSet;
use crate::texel_file::{Opened, Origin, TexelFileError};

/// Decodes samples from `bytes`, the content of `file`. The name is used in errors only.
///
/// # Errors
/// [`TexelFileError`] if the content is not OpenEXR, holds no samples, is of a newer version,
/// truncated or inconsistent.
pub fn read(file: &str, bytes: &[u8]) -> Result<SampleSet, TexelFileError> {
    let origin = Origin { kind: &KIND, file };
    let opened = Opened::new(origin, bytes)?;
    let (header, paint) = FileHeader::from_json(origin, &opened.description()?)?;
    let pigments = header.pigments.as_deref();
    let parts = opened.planes(header.plans())?.into_par_iter().zip(&header.samples);
    let samples: Vec<_> = parts
        .map(|(part, header)| {
            check(&part, pigments).map_err(|fault| origin.channel(&header.part, fault))?;
            Ok(sample(header, &part, pigments))
        })
        .collect();
    let samples = samples.into_iter().collect::<Result<_, TexelFileError>>()?;
    Ok(SampleSet { samples, paint, provenance: header.provenance })
}

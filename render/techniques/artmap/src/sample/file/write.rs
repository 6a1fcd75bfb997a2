//! Encoding of a file of samples.

use super::header::{FileHeader, KIND};
use super::planes::{check, part, texels};
use crate::sample::passage::SampleSet;
use crate::texel_file::{TexelFileError, write as write_parts};

/// Encodes samples as a file. The same samples always give the same bytes.
///
/// # Errors
/// [`TexelFileError::Unwritable`] for a set without samples or with fields of different sizes,
/// samples with paint in a set without pigments or the other way round, paint in slots without
/// pigment, and numbers that are not finite.
pub fn write(set: &SampleSet) -> Result<Vec<u8>, TexelFileError> {
    if set.samples.is_empty() {
        return Err(KIND.unwritable("there are none"));
    }
    for sample in &set.samples {
        let whose = format!("sample `{}`", sample.name);
        if sample.mask.bounds() != sample.color.bounds() {
            return Err(KIND.unwritable(format!("fields of {whose} differ in size")));
        }
        texels(sample)
            .check(&whose, set.paint.as_ref())
            .map_err(|reason| KIND.unwritable(reason))?;
    }
    let header = FileHeader::of(set)?;
    let pigments = header.pigments.as_deref();
    let mut parts = Vec::with_capacity(set.samples.len());
    for (sample, plan) in set.samples.iter().zip(header.plans()) {
        let part = part(sample, plan, pigments);
        check(&part, pigments).map_err(|(channel, reason)| {
            KIND.unwritable(format!("sample `{}`, channel `{channel}` {reason}", sample.name))
        })?;
        parts.push(part);
    }
    write_parts(&KIND, &header.to_json()?, parts)
}

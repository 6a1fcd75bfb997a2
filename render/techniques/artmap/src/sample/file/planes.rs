//! Samples as parts of the file.

use paint::file::PigmentChannel;

use super::header::{MASK, SampleHeader};
use crate::sample::passage::Sample;
use crate::texel_file::{PartPlan, PartPlanes, Texels};

/// Texels of a sample.
pub(super) fn texels(sample: &Sample) -> Texels<'_> {
    Texels {
        color: &sample.color,
        paint: sample.paint.as_ref(),
        height_mm: sample.height_mm.as_ref(),
    }
}

/// The part of a sample.
pub(super) fn part(
    sample: &Sample,
    plan: PartPlan,
    pigments: Option<&[PigmentChannel]>,
) -> PartPlanes {
    plan.with(|channel| match channel {
        MASK => sample.mask.values().iter().map(|inside| f32::from(u8::from(*inside))).collect(),
        _ => texels(sample).plane(channel, pigments),
    })
}

/// Checks the numbers of a part. Texels outside the mask may hold anything.
///
/// # Errors
/// The channel whose numbers are impossible, and the reason.
pub(super) fn check(
    part: &PartPlanes,
    pigments: Option<&[PigmentChannel]>,
) -> Result<(), (String, String)> {
    part.check(MASK, "is 0 or 1, found another number", |_, number| [0.0, 1.0].contains(&number))?;
    let mask = part.of(MASK);
    part.check_texels(pigments, |index| mask[index] == 1.0)
}

/// The sample of a part that passed the check.
pub(super) fn sample(
    header: &SampleHeader,
    part: &PartPlanes,
    pigments: Option<&[PigmentChannel]>,
) -> Sample {
    Sample {
        name: header.name.clone(),
        color: part.color(),
        paint: pigments.map(|pigments| part.paint(pigments)),
        height_mm: part.height_mm(),
        mask: part.field(part.of(MASK).iter().map(|value| *value == 1.0).collect()),
        spacing: header.spacing,
        mm_per_texel: header.mm_per_texel,
        guessed_relief: header.guessed_relief,
    }
}

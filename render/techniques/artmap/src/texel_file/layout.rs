//! Check of the parts of a file against its description, before memory is allocated.

use exr::meta::BlockDescription;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use paint::file::EXPANSION;

use super::error::TexelFileError;
use super::kind::Origin;
use super::part::PartPlan;

/// A part of the file that passed the checks.
#[derive(Debug)]
pub(super) struct PartLayout {
    pub(super) plan: PartPlan,
    /// For each channel in the order of the file its place in the plan.
    pub(super) places: Vec<usize>,
}

/// Checks the parts against their plans, in their order.
///
/// # Errors
/// [`TexelFileError`] for parts and channels that are not as planned, and for more numbers than
/// `file_bytes` can hold.
pub(super) fn layout(
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
    if stored > EXPANSION.saturating_mul(file_bytes as u64) {
        return Err(origin.damaged(format!(
            "{file_bytes} bytes cannot hold the {stored} that its header tells of"
        )));
    }
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

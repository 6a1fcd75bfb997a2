//! Planes of numbers of a sample, by the names of their channels.

use graphics::field::Field;
use paint::layer::SLOTS;

use super::header::{COLOR, HEIGHT, MASK, PigmentHeader, SampleHeader, VEHICLE};
use crate::sample::passage::{Sample, TexelPaint};

/// Numbers of a channel of `sample`, row by row. An unknown channel has zeros.
pub(super) fn plane(sample: &Sample, channel: &str, pigments: &[PigmentHeader]) -> Vec<f32> {
    if let Some(color) = COLOR.iter().position(|name| *name == channel) {
        return sample.color.values().iter().map(|rgb| rgb[color]).collect();
    }
    if channel == MASK {
        return sample.mask.values().iter().map(|inside| f32::from(u8::from(*inside))).collect();
    }
    if channel == HEIGHT {
        return sample.height_mm.as_ref().map_or_else(Vec::new, |height| height.values().to_vec());
    }
    let slot = pigments.iter().find(|pigment| pigment.channel == channel);
    let amount = |texel: &TexelPaint| match slot {
        Some(pigment) => texel.pigments_mm[pigment.slot],
        None => texel.vehicle_mm,
    };
    sample.paint.as_ref().map_or_else(Vec::new, |paint| paint.values().iter().map(amount).collect())
}

/// Sample of the `planes` of the `channels` of a part.
///
/// # Errors
/// The channel whose numbers are impossible, and the reason.
pub(super) fn sample(
    header: &SampleHeader,
    pigments: Option<&[PigmentHeader]>,
    channels: &[String],
    planes: &[Vec<f32>],
) -> Result<Sample, (String, String)> {
    let (width, height) = (header.width, header.height);
    let of = |name: &str| -> &[f32] {
        channels.iter().position(|channel| channel == name).map_or(&[], |at| &planes[at])
    };
    if let Some(at) = of(MASK).iter().position(|value| ![0.0, 1.0].contains(value)) {
        let (x, y) = (at % width, at / width);
        let found = of(MASK)[at];
        return Err((MASK.to_owned(), format!("is 0 or 1, found `{found}` at x {x}, y {y}")));
    }
    let mask: Vec<bool> = of(MASK).iter().map(|value| *value == 1.0).collect();
    for (channel, plane) in channels.iter().zip(planes) {
        // Colours outside the gamut of sRGB are below 0; heights and amounts are not.
        let least = if COLOR.contains(&channel.as_str()) { f32::MIN } else { 0.0 };
        let possible = |value: f32| value.is_finite() && value >= least;
        let bad = plane.iter().zip(&mask).position(|(value, inside)| *inside && !possible(*value));
        if let Some(at) = bad {
            let (x, y, found) = (at % width, at / width, plane[at]);
            return Err((channel.clone(), format!("is impossible at x {x}, y {y}: `{found}`")));
        }
    }
    let field = |values: &[f32]| Field::from_values(width, height, values.to_vec());
    let [red, green, blue] = COLOR.map(of);
    let color = (0..width * height).map(|at| [red[at], green[at], blue[at]]).collect();
    let paint = pigments.map(|pigments| {
        let mut paint = Field::filled(width, height, TexelPaint::default());
        for (texel, amount) in paint.values_mut().iter_mut().zip(of(VEHICLE)) {
            texel.vehicle_mm = *amount;
        }
        for pigment in pigments.iter().filter(|pigment| pigment.slot < SLOTS) {
            for (texel, amount) in paint.values_mut().iter_mut().zip(of(&pigment.channel)) {
                texel.pigments_mm[pigment.slot] = *amount;
            }
        }
        paint
    });
    Ok(Sample {
        name: header.name.clone(),
        color: Field::from_values(width, height, color),
        paint,
        height_mm: header.relief.then(|| field(of(HEIGHT))),
        mask: Field::from_values(width, height, mask),
        spacing: header.spacing,
        mm_per_texel: header.mm_per_texel,
        guessed_relief: header.guessed_relief,
    })
}

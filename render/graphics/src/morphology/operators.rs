//! Openings and closings.

use super::extremum::extremum;
use super::structuring_element::{Extremum, StructuringElement};
use crate::compute::{ColorImage, Compute};
use crate::gpu::DeviceError;

/// Removes light details that a round element of `radius_px` does not fit into; a radius
/// of 0 changes nothing. No pixel becomes lighter, and a second opening changes nothing.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn opening(
    compute: &mut Compute,
    color: &ColorImage,
    radius_px: u32,
) -> Result<ColorImage, DeviceError> {
    let element = StructuringElement::round(radius_px);
    let eroded = extremum(compute, color, element, Extremum::Minimum, None)?;
    extremum(compute, &eroded, element, Extremum::Maximum, None)
}

/// Removes dark details that a round element of `radius_px` does not fit into; a radius of
/// 0 changes nothing. No pixel becomes darker, and a second closing changes nothing.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn closing(
    compute: &mut Compute,
    color: &ColorImage,
    radius_px: u32,
) -> Result<ColorImage, DeviceError> {
    let element = StructuringElement::round(radius_px);
    let dilated = extremum(compute, color, element, Extremum::Maximum, None)?;
    extremum(compute, &dilated, element, Extremum::Minimum, None)
}

/// An [`opening`] followed by a [`closing`], in three passes rather than four.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn opening_then_closing(
    compute: &mut Compute,
    color: &ColorImage,
    radius_px: u32,
) -> Result<ColorImage, DeviceError> {
    let element = StructuringElement::round(radius_px);
    let eroded = extremum(compute, color, element, Extremum::Minimum, None)?;
    // The last pass of the opening and the first of the closing are one dilation.
    let dilated = extremum(compute, &eroded, element.twice(), Extremum::Maximum, None)?;
    extremum(compute, &dilated, element, Extremum::Minimum, Some(eroded))
}

//! Colour, paint and height of texels as the channels of a part. Digests tell you whether a file
//! still holds what was written.

use std::sync::Arc;

use graphics::field::Field;
use graphics::picture::Picture;
use paint::file::PigmentChannel;
use paint::layer::{SLOTS, Slots};
use pigment::library::PigmentLibrary;
use sha2::{Digest, Sha256};

pub(crate) const COLOR: [&str; 3] = ["R", "G", "B"];
pub(crate) const HEIGHT: &str = "height";
pub(crate) const VEHICLE: &str = "vehicle";

#[derive(Debug, Clone, Copy)]
pub(crate) struct Texels<'a> {
    pub(crate) color: &'a Picture,
    pub(crate) paint: Option<&'a Field<TexelPaint>>,
    pub(crate) height_mm: Option<&'a Field<f32>>,
}

impl Texels<'_> {
    pub(crate) fn channels(relief: bool, pigments: Option<&[PigmentChannel]>) -> Vec<&str> {
        let mut names = COLOR.to_vec();
        names.extend(relief.then_some(HEIGHT));
        if let Some(pigments) = pigments {
            names.push(VEHICLE);
            names.extend(pigments.iter().map(|pigment| pigment.channel.as_str()));
        }
        names
    }

    /// Numbers of a channel, row by row. If the channel is not a colour, a height or a pigment, it
    /// is the vehicle.
    pub(crate) fn plane(&self, channel: &str, pigments: Option<&[PigmentChannel]>) -> Vec<f32> {
        if let Some(color) = COLOR.iter().position(|name| *name == channel) {
            return self.color.values().iter().map(|rgb| rgb[color]).collect();
        }
        if channel == HEIGHT {
            return self.height_mm.map_or_else(Vec::new, |height| height.values().to_vec());
        }
        let mut pigments = pigments.unwrap_or_default().iter();
        let pigment = pigments.find(|pigment| pigment.channel == channel);
        self.paint.map_or_else(Vec::new, |paint| {
            paint
                .values()
                .iter()
                .map(|texel: &TexelPaint| match pigment {
                    Some(pigment) => texel.pigments_mm[pigment.slot],
                    None => texel.vehicle_mm,
                })
                .collect()
        })
    }

    /// Checks that all fields have one size, that there is paint where there is a library, and
    /// that each slot with paint has a pigment. `whose` names the sample or tile in the reason.
    ///
    /// # Errors
    /// The reason in words.
    pub(crate) fn check(&self, whose: &str, of: Option<&PaintOfSamples>) -> Result<(), String> {
        let bounds = self.color.bounds();
        let paint_fits = self.paint.is_none_or(|paint| paint.bounds() == bounds);
        let height_fits = self.height_mm.is_none_or(|height| height.bounds() == bounds);
        if !paint_fits || !height_fits {
            return Err(format!("fields of {whose} differ in size"));
        }
        match (self.paint, of) {
            (None, None) => Ok(()),
            (Some(_), None) => Err(format!("{whose} has paint of no library")),
            (None, Some(_)) => Err(format!("{whose} has no paint")),
            (Some(paint), Some(of)) => {
                match (0..of.slots.len()).find(|slot: &usize| {
                    let mut amounts = paint.values().iter().map(|texel| texel.pigments_mm[*slot]);
                    of.slots[*slot].is_none() && amounts.any(|amount| amount != 0.0)
                }) {
                    Some(slot) => Err(format!("{whose} has paint of no pigment in slot {slot}")),
                    None => Ok(()),
                }
            }
        }
    }
}

impl PartPlanes {
    /// Checks that the numbers of colour, height and paint are possible where `inside` is true.
    /// Colours may be below 0 outside the gamut of sRGB. Heights and amounts may not.
    ///
    /// # Errors
    /// Channel and reason.
    pub(crate) fn check_texels(
        &self,
        pigments: Option<&[PigmentChannel]>,
        inside: impl Fn(usize) -> bool,
    ) -> Result<(), (String, String)> {
        for channel in &self.plan.channels {
            let name = channel.as_str();
            let color = COLOR.contains(&name);
            let mut pigments = pigments.unwrap_or_default().iter();
            let paint = name == VEHICLE || pigments.any(|pigment| pigment.channel == name);
            if color || paint || name == HEIGHT {
                let least = if color { f32::MIN } else { 0.0 };
                self.check(name, "is impossible", |index, number| {
                    !inside(index) || (number.is_finite() && number >= least)
                })?;
            }
        }
        Ok(())
    }

    pub(crate) fn color(&self) -> Picture {
        let [red, green, blue] = COLOR.map(|name| self.of(name));
        let texels = red.iter().zip(green).zip(blue);
        self.field(texels.map(|((red, green), blue)| [*red, *green, *blue]).collect())
    }

    pub(crate) fn paint(&self, pigments: &[PigmentChannel]) -> Field<TexelPaint> {
        let vehicle = self.of(VEHICLE).iter();
        fn texel(&vehicle_mm: &f32) -> TexelPaint {
            TexelPaint { vehicle_mm, ..TexelPaint::default() }
        }
        let mut paint: Vec<TexelPaint> = vehicle.map(texel).collect();
        for PigmentChannel { slot, channel, .. } in pigments {
            for (texel, amount) in paint.iter_mut().zip(self.of(channel)) {
                texel.pigments_mm[*slot] = *amount;
            }
        }
        self.field(paint)
    }

    /// Height of the texels. `None` if the part has no channel of heights.
    pub(crate) fn height_mm(&self) -> Option<Field<f32>> {
        let relief = self.plan.channels.iter().any(|channel| channel == HEIGHT);
        relief.then(|| self.field(self.of(HEIGHT).to_vec()))
    }

    pub(crate) fn field<T: Clone>(&self, values: Vec<T>) -> Field<T> {
        Field::from_values(self.plan.width, self.plan.height, values)
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PartPlan {
    pub(crate) name: String,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Names of the channels, sorted as OpenEXR requires.
    pub(crate) channels: Vec<String>,
}

impl PartPlan {
    pub(crate) fn new(name: &str, (width, height): (usize, usize), channels: &[&str]) -> Self {
        let mut channels = channels.to_vec();
        channels.sort_unstable();
        let channels = channels.into_iter().map(str::to_owned).collect();
        Self { name: name.to_owned(), width, height, channels }
    }

    pub(crate) fn with(self, plane: impl Fn(&str) -> Vec<f32>) -> PartPlanes {
        let planes = self.channels.iter().map(|channel| plane(channel)).collect();
        PartPlanes { plan: self, planes }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartPlanes {
    pub(crate) plan: PartPlan,
    pub(crate) planes: Vec<Vec<f32>>,
}

impl PartPlanes {
    /// Numbers of a channel. If the part has no such channel, this is empty.
    pub(crate) fn of(&self, channel: &str) -> &[f32] {
        let place = self.plan.channels.iter().position(|name| name == channel);
        place.map_or(&[], |place| &self.planes[place])
    }

    /// Looks for the first number of a channel that `possible` refuses. The reason is `wanted`
    /// with the place of this number.
    ///
    /// # Errors
    /// Channel and reason, continuing a sentence that starts with the channel.
    pub(crate) fn check(
        &self,
        channel: &str,
        wanted: &str,
        possible: impl Fn(usize, f32) -> bool,
    ) -> Result<(), (String, String)> {
        let numbers = self.of(channel).iter().enumerate();
        match numbers.into_iter().find(|&(index, number)| !possible(index, *number)) {
            None => Ok(()),
            Some((index, found)) => {
                let x = index % self.plan.width;
                let y = index / self.plan.width;
                Err((channel.to_owned(), format!("{wanted} at x {x}, y {y}: `{found}`")))
            }
        }
    }
}

/// SHA-256 of the numbers of a part, in hexadecimal digits. It covers the channels sorted by name,
/// each row by row, with four bytes per number, least first.
pub(crate) fn of_planes(part: &PartPlanes) -> String {
    let mut digest = Sha256::new();
    let mut bytes = Vec::with_capacity(size_of::<f32>() * part.plan.width);
    for row in part.planes.iter().flat_map(|plane| plane.chunks(part.plan.width)) {
        bytes.clear();
        bytes.extend(row.iter().flat_map(|number| number.to_le_bytes()));
        digest.update(&bytes);
    }
    hexadecimal(&digest.finalize())
}

pub(crate) fn of_text(text: &str) -> String {
    hexadecimal(&Sha256::digest(text))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Paint in one texel, in mm of height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TexelPaint {
    /// Paint of each pigment, by slot of [`PaintOfSamples::slots`].
    pub pigments_mm: [f32; SLOTS],
    /// Transparent vehicle.
    pub vehicle_mm: f32,
}

/// Pigments that the samples of a set, or the tiles of a map, were painted with.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintOfSamples {
    /// Library of the pigments.
    pub library: Arc<PigmentLibrary>,
    /// Pigments of the samples by slot.
    pub slots: Slots,
}

impl PaintOfSamples {
    /// Names of the pigments, in the order of their slots.
    #[must_use]
    pub fn pigment_names(&self) -> Vec<String> {
        let used = self.slots.iter().flatten();
        used.map(|&pigment| self.library[pigment].name.clone()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digests_are_sha_256_of_the_bytes() {
        // This is the example of FIPS 180-4, "abc", as text and as the bytes of a number after it.
        let wanted = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(of_text("abc"), wanted);
        let numbers = vec![f32::from_le_bytes(*b"abcd"), f32::from_le_bytes(*b"efgh")];
        let part = PartPlan::new("p", (1, 2), &["v"]).with(|_| numbers.clone());
        assert_eq!(of_planes(&part), of_text("abcdefgh"));
    }
}

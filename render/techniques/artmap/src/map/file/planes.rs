//! Tiles as parts of the file.

use graphics::field::Field;
use paint::file::PigmentChannel;

use super::header::{KeyHeader, SOURCE};
use crate::map::art_map::KeyMap;
use crate::map::tile::Tile;
use crate::texel_file::{PartPlan, PartPlanes, Texels};

/// Largest difference of a tone and the mean L* of its tile: colours differ in their last bits
/// between machines.
const TONE: f64 = 0.01;

/// Texels of a tile.
pub(super) fn texels(tile: &Tile) -> Texels<'_> {
    Texels { color: &tile.color, paint: tile.paint.as_ref(), height_mm: tile.height_mm.as_ref() }
}

/// The part of a tile.
pub(super) fn part(
    key: &KeyMap,
    plan: PartPlan,
    pigments: Option<&[PigmentChannel]>,
) -> PartPlanes {
    plan.with(|channel| match SOURCE.iter().position(|name| *name == channel) {
        Some(axis) => key.sources.values().iter().map(|place| f32::from(place[axis])).collect(),
        None => texels(&key.tile).plane(channel, pigments),
    })
}

/// Checks the numbers of a part.
///
/// # Errors
/// The channel whose numbers are impossible, and the reason.
pub(super) fn check(
    part: &PartPlanes,
    pigments: Option<&[PigmentChannel]>,
) -> Result<(), (String, String)> {
    part.check_texels(pigments, |_| true)?;
    let place = |number: f32| (0.0..f32::from(u16::MAX)).contains(&number) && number.fract() == 0.0;
    for channel in SOURCE {
        part.check(channel, "is no whole number below 65535", |_, number| place(number))?;
    }
    Ok(())
}

/// Checks that the tone of a tile is that of its colours.
///
/// # Errors
/// The reason, with what was found.
pub(super) fn check_tone(tile: &Tile, tone: f64) -> Result<(), String> {
    let wanted = tile.tone();
    if (tone - wanted).abs() <= TONE {
        return Ok(());
    }
    Err(format!("has a mean L* of {wanted:.3}, its tone is `{tone}`"))
}

/// The tile of a part that passed the check.
pub(super) fn key_map(
    header: &KeyHeader,
    part: &PartPlanes,
    pigments: Option<&[PigmentChannel]>,
) -> KeyMap {
    let [columns, rows] = SOURCE.map(|name| part.of(name));
    let places = columns.iter().zip(rows).map(|(x, y)| [*x as u16, *y as u16]);
    let sources: Field<[u16; 2]> = part.field(places.collect());
    let tile = Tile {
        color: part.color(),
        paint: pigments.map(|pigments| part.paint(pigments)),
        height_mm: part.height_mm(),
    };
    KeyMap { name: header.name.clone(), tile, sources, tone: header.tone }
}

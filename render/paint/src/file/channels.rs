//! Channels of a part of a file. Use this to name parts and channels, to find the channel of a
//! pigment, and to convert amounts to mm.

use pigment::{PigmentId, library::PigmentLibrary};
use serde::{Deserialize, Serialize};

use crate::amount::QUANTA_PER_CELL;
use crate::layer::{Layer, SLOTS, Slots};

/// Suffix of channels that hold rounding residues.
const RESIDUE_SUFFIX: &str = ".rest";

/// Content of a channel, in mm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Content {
    Height,
    /// Height of all paint together.
    Thickness,
    /// Height of a slot's paint. [`SLOTS`] stands for the vehicle.
    Amount(usize),
    HeightResidue,
    AmountResidue(usize),
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Channel {
    pub(super) name: String,
    pub(super) content: Content,
}

impl Channel {
    fn new(name: &str, content: Content) -> Self {
        Self { name: name.to_owned(), content }
    }

    fn residue(name: &str, content: Content) -> Self {
        Self { name: format!("{name}{RESIDUE_SUFFIX}"), content }
    }
}

/// Channels of the ground. With a residue channel if `inexact`.
pub(super) fn of_ground(inexact: bool) -> Vec<Channel> {
    let mut channels = vec![Channel::new(HEIGHT, Content::Height)];
    channels.extend(inexact.then(|| Channel::residue(HEIGHT, Content::HeightResidue)));
    channels
}

/// Channels of a layer. We sort them by name, since OpenEXR requires this. `inexact` says which
/// slots need a residue channel.
pub(super) fn of_layer(pigments: &[PigmentChannel], inexact: [bool; SLOTS + 1]) -> Vec<Channel> {
    let mut channels = vec![Channel::new(THICKNESS, Content::Thickness)];
    let named = pigments.iter().map(|pigment| (pigment.channel.as_str(), pigment.slot));
    for (name, slot) in named.chain([(VEHICLE, SLOTS)]) {
        channels.push(Channel::new(name, Content::Amount(slot)));
        if inexact[slot] {
            channels.push(Channel::residue(name, Content::AmountResidue(slot)));
        }
    }
    channels.sort_by(|a, b| a.name.cmp(&b.name));
    channels
}

/// Slots (and the vehicle, last) with amounts beyond those that 32-bit floats represent exactly.
pub(super) fn inexact_slots(layer: &Layer) -> [bool; SLOTS + 1] {
    let mut inexact = [false; SLOTS + 1];
    for pigments in layer.pigments.values() {
        for (inexact, &amount) in inexact.iter_mut().zip(pigments) {
            *inexact |= amount >= INEXACT_FROM;
        }
    }
    inexact[SLOTS] = layer.vehicle.values().iter().any(|&amount| amount >= INEXACT_FROM);
    inexact
}

/// Part that holds the ground.
pub(super) const BASE: &str = "base";
/// Part that holds the wet layer.
pub(super) const WET: &str = "wet";
/// Channel with the height of the ground, in part `base`.
pub(super) const HEIGHT: &str = "height";
/// Channel with the height of all paint together.
pub(super) const THICKNESS: &str = "thickness";
pub(super) const VEHICLE: &str = "vehicle";

/// Other channels of a layer. The channel of a pigment may not get one of these names.
pub(super) const LAYER_CHANNELS: [&str; 3] = [HEIGHT, THICKNESS, VEHICLE];

/// Longest channel name for a pigment, in bytes. This leaves room for a number and `.rest` within
/// the 255 bytes that OpenEXR allows.
const LONGEST: usize = 200;

/// Part that holds dry layer `index`, counted from the lowest.
pub(super) fn dry_part(index: usize) -> String {
    format!("dry.{index:03}")
}

/// Part that holds the skin of the layer in `part`.
pub(super) fn skin_part(part: &str) -> String {
    format!("{part}.skin")
}

/// Part that holds the paint of brush `index` of a table.
pub(super) fn brush_part(index: usize) -> String {
    format!("brush.{index:03}")
}

/// Gives names to the channels of the pigments in one part of an OpenEXR file. You never get a name
/// twice.
#[derive(Debug, Clone)]
pub struct ChannelNames {
    taken: Vec<String>,
}

impl ChannelNames {
    /// Gives names that differ from `reserved`, the names of the other channels of the part.
    #[must_use]
    pub fn beside(reserved: &[&str]) -> Self {
        Self { taken: reserved.iter().map(|&name| name.to_owned()).collect() }
    }

    /// Channel name for `pigment`. We replace characters that OpenEXR does not allow, and add a
    /// number if the name is taken.
    pub fn channel(&mut self, pigment: &str) -> String {
        let plain: String = pigment
            .chars()
            .map(|l| if l == ' ' || l.is_ascii_graphic() && l != '.' { l } else { '_' })
            .take(LONGEST)
            .collect();
        let plain = if plain.trim().is_empty() { "pigment".to_owned() } else { plain };
        let numbered = (2..).map(|number| format!("{plain} {number}"));
        let name = std::iter::once(plain.clone())
            .chain(numbered)
            .find(|name: &String| !self.taken.contains(name))
            .unwrap_or(plain);
        self.taken.push(name.clone());
        name
    }
}

/// Least amount, in quanta, at which a float in mm no longer distinguishes neighbouring quanta: its
/// rounding, 2^-24 of the value, reaches half a quantum.
pub(super) const INEXACT_FROM: u32 = 1 << 23;

#[derive(Debug, Clone, Copy)]
pub(super) struct Millimetres {
    quantum_mm: f64,
}

impl Millimetres {
    pub(super) fn new(cell_mm: f64) -> Self {
        Self { quantum_mm: cell_mm / f64::from(QUANTA_PER_CELL) }
    }

    /// Height in mm, rounded to a float.
    pub(super) fn mm(self, quanta: f64) -> f32 {
        (quanta * self.quantum_mm) as f32
    }

    /// Rounding residue of [`Self::mm`], in mm.
    pub(super) fn residue(self, quanta: f64) -> f32 {
        let exact = quanta * self.quantum_mm;
        (exact - f64::from(exact as f32)) as f32
    }

    /// Nearest whole number of quanta, as f64.
    pub(super) fn quanta(self, mm: f32, residue: f32) -> f64 {
        ((f64::from(mm) + f64::from(residue)) / self.quantum_mm).round()
    }
}

/// A slot that holds a pigment, with the names of the pigment and of its channel.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PigmentChannel {
    /// Slot of the pigment, 0 to 7.
    pub slot: usize,
    /// Name of the pigment in the library.
    pub name: String,
    /// Name of the channel with the height of its paint.
    pub channel: String,
}

/// The slots in use with a channel for each. The names avoid the channels `reserved` of this part.
/// If the library lacks a pigment, you get `None`.
#[must_use]
pub fn channels_of_slots(
    library: &PigmentLibrary,
    slots: &Slots,
    reserved: &[&str],
) -> Option<Vec<PigmentChannel>> {
    let mut names = ChannelNames::beside(reserved);
    let used = slots.iter().enumerate().filter_map(|(slot, pigment)| Some((slot, (*pigment)?)));
    used.map(|(slot, pigment)| {
        let name = &library.pigments.get(pigment.index())?.name;
        Some(PigmentChannel { slot, name: name.clone(), channel: names.channel(name) })
    })
    .collect()
}

/// Reads the slots from the channels of a part, beside its channels `reserved`.
///
/// # Errors
/// The reason in words: a pigment that the library lacks, a slot beyond the last, a slot or a
/// channel named twice.
pub fn slots_of_channels(
    channels: &[PigmentChannel],
    library: &PigmentLibrary,
    reserved: &[&str],
) -> Result<Slots, String> {
    let mut slots = Slots::default();
    for (at, PigmentChannel { slot, name, channel }) in channels.iter().enumerate() {
        let index = library.pigments.iter().position(|pigment| pigment.name == *name);
        let index = index.ok_or_else(|| {
            format!("channel `{channel}` names no pigment of the library: `{name}`")
        })?;
        match slots.get_mut(*slot) {
            Some(place @ None) => *place = Some(PigmentId(index)),
            Some(_) => return Err(format!("slot named twice: `{slot}`")),
            None => return Err(format!("slots are 0 to 7, found `{slot}`")),
        }
        let before = channels[..at].iter().any(|other| other.channel == *channel);
        if before || reserved.contains(&channel.as_str()) {
            return Err(format!("channel named twice: `{channel}`"));
        }
    }
    Ok(slots)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::MAX_COLUMN;

    #[test]
    fn channels_are_legal_and_differ() {
        let mut names = ChannelNames::beside(&LAYER_CHANNELS);
        let made = ["Zinc White", "Zinc White", "PB29 (r.s.)", "R\u{f6}tel", "thickness", " "]
            .map(|name| names.channel(name));
        let wanted =
            ["Zinc White", "Zinc White 2", "PB29 (r_s_)", "R_tel", "thickness 2", "pigment"];
        assert_eq!(made, wanted);
        assert_eq!(names.channel(&"x".repeat(500)).len(), LONGEST);
    }

    #[test]
    fn quanta_come_back_without_residue_below_the_limit_and_with_it_above() {
        for cell_mm in [0.1, 0.25, 0.0317, 1.0] {
            let scale = Millimetres::new(cell_mm);
            let near = (0..1000)
                .flat_map(|i| [i, INEXACT_FROM - 1 - i, i.wrapping_mul(8_388_593) % INEXACT_FROM]);
            for quanta in near.map(f64::from) {
                assert_eq!(scale.quanta(scale.mm(quanta), 0.0), quanta, "{cell_mm}");
                assert_eq!(scale.quanta(scale.mm(-quanta), 0.0), -quanta, "{cell_mm}");
            }
            let high = (0..100_000_u32).map(|i| MAX_COLUMN - i * 10_737);
            for quanta in high.filter(|q| *q >= INEXACT_FROM).map(f64::from) {
                let residue = scale.residue(quanta);
                assert_eq!(scale.quanta(scale.mm(quanta), residue), quanta, "{cell_mm}");
            }
        }
    }

    #[test]
    fn a_float_alone_would_lose_quanta_of_thick_paint() {
        let scale = Millimetres::new(0.1);
        // With cells of 0.1 mm, floats become coarser than a quantum at 0.5 mm. With other
        // cells this may already happen at `INEXACT_FROM`.
        let thick = 3 * INEXACT_FROM / 2;
        let lost =
            (thick..thick + 1000).map(f64::from).filter(|&q| scale.quanta(scale.mm(q), 0.0) != q);
        assert!(lost.count() > 0, "no residue channel would be needed");
    }

    #[test]
    fn slots_come_back_from_their_channels() {
        let library = PigmentLibrary::van_gogh_oils();
        let mut slots = Slots::default();
        (slots[1], slots[7]) = (Some(PigmentId(3)), Some(PigmentId(0)));
        let reserved = [library.pigments[0].name.as_str()];
        let channels = channels_of_slots(&library, &slots, &reserved).unwrap();
        assert_eq!(channels[1].channel, format!("{} 2", reserved[0]));
        assert_eq!(slots_of_channels(&channels, &library, &reserved).unwrap(), slots);
        slots[0] = Some(PigmentId(library.pigments.len()));
        assert_eq!(channels_of_slots(&library, &slots, &reserved), None);
    }

    #[test]
    fn channels_that_contradict_each_other_are_refused() {
        let library = PigmentLibrary::van_gogh_oils();
        let channel = |slot: usize, pigment: usize, channel: &str| PigmentChannel {
            slot,
            name: library.pigments[pigment].name.clone(),
            channel: channel.to_owned(),
        };
        let refused = |channels: [PigmentChannel; 2]| {
            slots_of_channels(&channels, &library, &["vehicle"]).unwrap_err()
        };
        let first = channel(0, 0, "a");
        assert_eq!(refused([first.clone(), channel(0, 1, "b")]), "slot named twice: `0`");
        assert_eq!(refused([first.clone(), channel(8, 1, "b")]), "slots are 0 to 7, found `8`");
        assert_eq!(refused([first.clone(), channel(1, 1, "a")]), "channel named twice: `a`");
        let reserved = refused([first.clone(), channel(1, 1, "vehicle")]);
        assert_eq!(reserved, "channel named twice: `vehicle`");
        let unknown = PigmentChannel { name: "Octarine".to_owned(), ..channel(1, 1, "b") };
        assert!(refused([first, unknown]).contains("no pigment of the library: `Octarine`"));
    }
}

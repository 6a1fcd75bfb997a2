//! Channels of a part: their names and their content.

use super::millimetres::INEXACT_FROM;
use super::names::{HEIGHT, THICKNESS, VEHICLE};
use super::pigments::PigmentChannel;
use crate::layer::{Layer, SLOTS};

/// Suffix of channels that hold rounding residues.
const RESIDUE_SUFFIX: &str = ".rest";

/// Content of a channel, in mm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Content {
    /// Height of the ground.
    Height,
    /// Height of all paint together.
    Thickness,
    /// Height of a slot's paint; [`SLOTS`] stands for the vehicle.
    Amount(usize),
    /// Rounding residue of the ground's height.
    HeightResidue,
    /// Rounding residue of a slot's paint.
    AmountResidue(usize),
}

/// A channel's name and content.
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

/// Channels of the ground; with a residue channel if `inexact`.
pub(super) fn of_ground(inexact: bool) -> Vec<Channel> {
    let mut channels = vec![Channel::new(HEIGHT, Content::Height)];
    channels.extend(inexact.then(|| Channel::residue(HEIGHT, Content::HeightResidue)));
    channels
}

/// Channels of a layer, sorted by name as OpenEXR requires. `inexact` says which slots need
/// a residue channel.
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

/// Slots (and the vehicle, last) whose amounts exceed what 32-bit floats represent
/// exactly.
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

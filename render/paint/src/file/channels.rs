//! The channels of a part: what they are called and what they hold.

use super::header::PigmentHeader;
use super::millimetres::ROUGH;
use crate::layer::{Layer, SLOTS};

/// Of part `base`.
pub(super) const HEIGHT: &str = "height";
/// The sum of all paint.
pub(super) const THICKNESS: &str = "thickness";
/// Of clear vehicle.
pub(super) const VEHICLE: &str = "vehicle";
/// Ends the channel of what a float left out.
const REST: &str = ".rest";

/// The longest name that leaves room for a number and `.rest` within the 255
/// bytes of OpenEXR.
const LONGEST: usize = 200;

/// What a channel holds, in mm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Content {
    /// Height of the ground.
    Height,
    /// All paint.
    Thickness,
    /// The paint of a slot; [`SLOTS`] is the vehicle.
    Amount(usize),
    /// What floats left out of the height.
    HeightRest,
    /// What floats left out of a slot.
    AmountRest(usize),
}

/// A channel by name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Channel {
    pub(super) name: String,
    pub(super) content: Content,
}

impl Channel {
    fn new(name: &str, content: Content) -> Self {
        Self { name: name.to_owned(), content }
    }

    fn rest(name: &str, content: Content) -> Self {
        Self { name: format!("{name}{REST}"), content }
    }
}

/// The channels of a ground; with a rest where it is rough.
pub(super) fn of_ground(rough: bool) -> Vec<Channel> {
    let mut channels = vec![Channel::new(HEIGHT, Content::Height)];
    channels.extend(rough.then(|| Channel::rest(HEIGHT, Content::HeightRest)));
    channels
}

/// The channels of a layer of `pigments`, sorted by name as OpenEXR has them;
/// `rough` tells which slots need a rest.
pub(super) fn of_layer(pigments: &[PigmentHeader], rough: [bool; SLOTS + 1]) -> Vec<Channel> {
    let mut channels = vec![Channel::new(THICKNESS, Content::Thickness)];
    let named = pigments.iter().map(|pigment| (pigment.channel.as_str(), pigment.slot));
    for (name, slot) in named.chain([(VEHICLE, SLOTS)]) {
        channels.push(Channel::new(name, Content::Amount(slot)));
        if rough[slot] {
            channels.push(Channel::rest(name, Content::AmountRest(slot)));
        }
    }
    channels.sort_by(|a, b| a.name.cmp(&b.name));
    channels
}

/// Which slots of `layer`, and whether its vehicle, go beyond what floats hold.
pub(super) fn rough_slots(layer: &Layer) -> [bool; SLOTS + 1] {
    let mut rough = [false; SLOTS + 1];
    for pigments in layer.pigments.values() {
        for (rough, &amount) in rough.iter_mut().zip(pigments) {
            *rough |= amount >= ROUGH;
        }
    }
    rough[SLOTS] = layer.vehicle.values().iter().any(|&amount| amount >= ROUGH);
    rough
}

/// Gives the pigments of a layer channels of their own.
#[derive(Debug, Default)]
pub(super) struct ChannelNames {
    taken: Vec<String>,
}

impl ChannelNames {
    /// A channel for `pigment`: its name, in what OpenEXR can hold.
    pub(super) fn channel(&mut self, pigment: &str) -> String {
        let legal = |letter: char| letter == ' ' || (letter.is_ascii_graphic() && letter != '.');
        let plain: String =
            pigment.chars().map(|l| if legal(l) { l } else { '_' }).take(LONGEST).collect();
        let plain = if plain.trim().is_empty() { "pigment".to_owned() } else { plain };
        let numbered = (2..).map(|number| format!("{plain} {number}"));
        let free = |name: &String| {
            let reserved = [HEIGHT, THICKNESS, VEHICLE].contains(&name.as_str());
            !reserved && !self.taken.contains(name)
        };
        let name = std::iter::once(plain.clone()).chain(numbered).find(free).unwrap_or(plain);
        self.taken.push(name.clone());
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_legal_and_differ() {
        let mut names = ChannelNames::default();
        let made = ["Zinc White", "Zinc White", "PB29 (r.s.)", "R\u{f6}tel", "thickness", " "]
            .map(|name| names.channel(name));
        let wanted =
            ["Zinc White", "Zinc White 2", "PB29 (r_s_)", "R_tel", "thickness 2", "pigment"];
        assert_eq!(made, wanted);
        assert_eq!(names.channel(&"x".repeat(500)).len(), LONGEST);
    }
}

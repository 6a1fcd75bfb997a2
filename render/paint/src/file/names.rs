//! Names of parts and channels.

/// Part that holds the ground.
pub(super) const BASE: &str = "base";
/// Part that holds the wet layer.
pub(super) const WET: &str = "wet";
/// Channel with the height of the ground, in part `base`.
pub(super) const HEIGHT: &str = "height";
/// Channel with the height of all paint together.
pub(super) const THICKNESS: &str = "thickness";
/// Channel with the height of clear vehicle.
pub(super) const VEHICLE: &str = "vehicle";

/// Channels of a layer that no pigment's channel can be called.
pub(super) const LAYER_CHANNELS: [&str; 3] = [HEIGHT, THICKNESS, VEHICLE];

/// Longest channel name for a pigment, in bytes: it leaves room for a number and `.rest`
/// within the 255 bytes that OpenEXR allows.
const LONGEST: usize = 200;

/// Part that holds dry layer `index`, counted from the lowest.
pub(super) fn dry_part(index: usize) -> String {
    format!("dry.{index:03}")
}

/// Part that holds the paint of brush `index` of a table.
pub(super) fn brush_part(index: usize) -> String {
    format!("brush.{index:03}")
}

/// Names for the channels of the pigments of one part of an OpenEXR file. No name is given twice.
#[derive(Debug, Clone)]
pub struct ChannelNames {
    taken: Vec<String>,
}

impl ChannelNames {
    /// Names for pigments beside the other channels of the part, `reserved`.
    #[must_use]
    pub fn beside(reserved: &[&str]) -> Self {
        Self { taken: reserved.iter().map(|&name| name.to_owned()).collect() }
    }

    /// Channel name for `pigment`: its name with characters replaced that OpenEXR does not
    /// allow, numbered if taken.
    pub fn channel(&mut self, pigment: &str) -> String {
        let legal = |letter: char| letter == ' ' || (letter.is_ascii_graphic() && letter != '.');
        let plain: String =
            pigment.chars().map(|l| if legal(l) { l } else { '_' }).take(LONGEST).collect();
        let plain = if plain.trim().is_empty() { "pigment".to_owned() } else { plain };
        let numbered = (2..).map(|number| format!("{plain} {number}"));
        let free = |name: &String| !self.taken.contains(name);
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
        let mut names = ChannelNames::beside(&LAYER_CHANNELS);
        let made = ["Zinc White", "Zinc White", "PB29 (r.s.)", "R\u{f6}tel", "thickness", " "]
            .map(|name| names.channel(name));
        let wanted =
            ["Zinc White", "Zinc White 2", "PB29 (r_s_)", "R_tel", "thickness 2", "pigment"];
        assert_eq!(made, wanted);
        assert_eq!(names.channel(&"x".repeat(500)).len(), LONGEST);
    }
}

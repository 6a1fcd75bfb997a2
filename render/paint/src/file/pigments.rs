//! Pigments of a part of the file: their slots, names and channels.

use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use serde::{Deserialize, Serialize};

use super::names::ChannelNames;
use crate::layer::Slots;

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

/// The slots in use with a channel for each, beside the channels `reserved` of the same part;
/// `None` if the library lacks a pigment.
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

/// The slots that the channels of a part tell of, beside its channels `reserved`.
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

//! Pictures of the canvas after each action of the history, in a limited memory.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::miniature::difference;
use super::state::{HistoryShot, HistoryShots, Thumbnail};

/// Memory of all pictures, in bytes.
const MOST_BYTES: usize = 24 << 20;

/// Pictures by the number of the state that they show.
#[derive(Debug, Clone)]
pub(super) struct Shots {
    /// Numbers of the states that can be reached.
    order: Vec<u64>,
    taken: BTreeMap<u64, HistoryShot>,
    most_bytes: usize,
}

impl Default for Shots {
    fn default() -> Self {
        Self { order: vec![0], taken: BTreeMap::new(), most_bytes: MOST_BYTES }
    }
}

impl Shots {
    /// Adopts the numbers of the states that can be reached now, the beginning first. Pictures of
    /// others are dropped. The numbers rise.
    pub(super) fn follow(&mut self, numbers: &[u64]) {
        self.order.clear();
        self.order.extend_from_slice(numbers);
        self.taken.retain(|number, _| numbers.binary_search(number).is_ok());
    }

    /// Whether there is a picture after the first `done` actions.
    pub(super) fn has(&self, done: usize) -> bool {
        self.order.get(done).is_some_and(|number| self.taken.contains_key(number))
    }

    /// Keeps the picture after the first `done` actions. If the memory is full, the pictures of the
    /// oldest actions are dropped.
    pub(super) fn keep(&mut self, done: usize, picture: &Thumbnail) {
        let Some(&number) = self.order.get(done) else { return };
        let previous = done.checked_sub(1).and_then(|before| self.taken.get(&self.order[before]));
        let changed = previous.and_then(|previous| difference(&previous.picture, picture));
        let same = previous.filter(|previous| *previous.picture == *picture);
        // Actions on the palette leave the canvas as it was.
        let picture =
            same.map_or_else(|| Arc::new(picture.clone()), |same| Arc::clone(&same.picture));
        self.taken.insert(number, HistoryShot { picture, changed });
        let mut bytes = self.bytes();
        for oldest in self.order.clone() {
            if bytes <= self.most_bytes || oldest == number {
                break;
            }
            if self.taken.remove(&oldest).is_some() {
                bytes = self.bytes();
            }
        }
    }

    /// Memory that the pictures take, in bytes; a picture that several actions share counts once.
    fn bytes(&self) -> usize {
        let in_order = self.order.iter().filter_map(|number| self.taken.get(number));
        let mut last: Option<&Arc<Thumbnail>> = None;
        let mut bytes = 0;
        for HistoryShot { picture, .. } in in_order {
            if !last.is_some_and(|last| Arc::ptr_eq(last, picture)) {
                bytes += picture.pixels.len() * size_of::<[u8; 4]>();
            }
            last = Some(picture);
        }
        bytes
    }

    /// Pictures in the order of the history.
    pub(super) fn report(&self) -> HistoryShots {
        let shots = self.order.iter().map(|number| self.taken.get(number).cloned()).collect();
        HistoryShots { shots, bytes: self.bytes(), most_bytes: self.most_bytes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of 10 x 10 pixels, 400 bytes.
    fn picture(shade: u8) -> Thumbnail {
        let mut pixels = vec![[7, 7, 7, 255]; 100];
        pixels[34] = [shade, 0, 0, 255];
        Thumbnail { width: 10, height: 10, pixels }
    }

    fn shades(shots: &Shots) -> Vec<Option<u8>> {
        shots
            .report()
            .shots
            .iter()
            .map(|shot: &Option<HistoryShot>| shot.as_ref().map(|shot| shot.picture.pixels[34][0]))
            .collect()
    }

    #[test]
    fn pictures_follow_their_actions_through_undo_and_forgetting() {
        let mut shots = Shots::default();
        shots.keep(0, &picture(10));
        for number in 1..=3 {
            shots.follow(&(0..=number).collect::<Vec<_>>());
            assert!(!shots.has(number as usize));
            shots.keep(number as usize, &picture(10 + number as u8));
            assert!(shots.has(number as usize));
        }
        assert_eq!(shades(&shots), [Some(10), Some(11), Some(12), Some(13)]);
        // Two actions undone, another done in their place.
        shots.follow(&[0, 1, 4]);
        assert_eq!(shades(&shots), [Some(10), Some(11), None]);
        assert_eq!(shots.taken.len(), 2, "pictures of what was undone for good are dropped");
        shots.keep(2, &picture(14));
        // The first action can no longer be undone.
        shots.follow(&[1, 4]);
        assert_eq!(shades(&shots), [Some(11), Some(14)]);
    }

    #[test]
    fn what_an_action_changed_is_outlined_and_equal_pictures_are_shared() {
        let mut shots = Shots::default();
        shots.keep(0, &picture(10));
        shots.follow(&[0, 1, 2]);
        shots.keep(1, &picture(20));
        shots.keep(2, &picture(20));
        let HistoryShots { shots, bytes, .. } = shots.report();
        let changed: Vec<_> = shots.iter().flatten().map(|shot| shot.changed).collect();
        assert_eq!(changed, [None, Some([4, 3, 1, 1]), None]);
        assert_eq!(bytes, 800, "the third is the second");
    }

    #[test]
    fn a_full_memory_drops_the_oldest_pictures_but_never_the_new_one() {
        let mut shots = Shots { most_bytes: 900, ..Shots::default() };
        shots.follow(&[0, 1, 2, 3]);
        for done in 0..=3 {
            shots.keep(done, &picture(done as u8));
            assert!(shots.bytes() <= 900, "{done}");
        }
        assert_eq!(shades(&shots), [None, None, Some(2), Some(3)]);
        let mut tight = Shots { most_bytes: 10, ..Shots::default() };
        tight.keep(0, &picture(1));
        assert_eq!(shades(&tight), [Some(1)]);
    }
}

//! How the groups of a column share its height.

/// Height below its tabs that a group needs, in points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightRequest {
    /// Whether the painter folded it.
    pub folded: bool,
    /// Height at which all of it is seen, or the height that the painter chose.
    pub wanted: f32,
    /// Whether all of it should be seen, rather than a part that scrolls.
    pub whole: bool,
    /// Counter of the last use: the group used last stays open longest.
    pub last_used: u64,
}

/// Height to which a longer panel that scrolls may be reduced, in points.
const LEAST: f32 = 192.0;

/// Shares `room` points among groups from the top down. A panel that should be seen whole is
/// not reduced below the room; others may scroll. Where they do not fit, those that were not
/// used for longest are folded. Returns the height of each, `None` for a
/// folded one. The last open group takes what is left.
#[must_use]
pub fn heights(requests: &[HeightRequest], room: f32) -> Vec<Option<f32>> {
    let least =
        |request: &HeightRequest| request.wanted.min(if request.whole { room } else { LEAST });
    let mut open: Vec<bool> = requests.iter().map(|request| !request.folded).collect();
    loop {
        let opened = || (0..requests.len()).filter(|&index| open[index]);
        let needed: f32 = opened().map(|index| least(&requests[index])).sum();
        // Of those that were never used, the lowest.
        let oldest = opened().rev().min_by_key(|&index| requests[index].last_used);
        match oldest {
            Some(oldest) if needed > room && opened().count() > 1 => open[oldest] = false,
            _ => break,
        }
    }
    let opened: Vec<usize> = (0..requests.len()).filter(|&index| open[index]).collect();
    let mut shared: Vec<Option<f32>> = vec![None; requests.len()];
    let mut left = room - opened.iter().map(|&index| least(&requests[index])).sum::<f32>();
    for &index in &opened {
        let least = least(&requests[index]);
        let more = (requests[index].wanted - least).min(left).max(0.0);
        left -= more;
        shared[index] = Some(least + more);
    }
    if let Some(&last) = opened.last() {
        shared[last] = shared[last].map(|height| (height + left).max(0.0));
    }
    shared
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(wanted: f32, whole: bool, last_used: u64) -> HeightRequest {
        HeightRequest { folded: false, wanted, whole, last_used }
    }

    #[test]
    fn a_panel_that_should_be_whole_is_and_another_takes_the_rest() {
        let brush = request(510.0, true, 0);
        let light = request(560.0, false, 1);
        assert_eq!(heights(&[brush, light], 880.0), [Some(510.0), Some(370.0)]);
        assert_eq!(heights(&[light, brush], 880.0), [Some(370.0), Some(510.0)]);
        // In a column that is too low for it, it has all of the room while it is in use.
        let brush = request(510.0, true, 2);
        assert_eq!(heights(&[brush, light], 480.0), [Some(480.0), None]);
    }

    #[test]
    fn without_room_the_group_used_last_stays_open() {
        let share = |uses: [u64; 2]| {
            let brush = request(510.0, true, uses[0]);
            let light = request(800.0, false, uses[1]);
            heights(&[brush, light], 680.0)
        };
        assert_eq!(share([2, 1]), [Some(680.0), None]);
        assert_eq!(share([1, 2]), [None, Some(680.0)]);
        assert_eq!(share([0, 0]), [Some(680.0), None], "the upper one is open at first");
        // One group stays open, however low the column is.
        assert_eq!(heights(&[request(510.0, true, 1)], 90.0), [Some(90.0)]);
    }

    #[test]
    fn folded_groups_take_nothing_and_the_last_open_one_fills_the_column() {
        let folded = HeightRequest { folded: true, ..request(300.0, true, 9) };
        let open = [request(100.0, true, 0), request(200.0, true, 1), folded];
        assert_eq!(heights(&open, 1000.0), [Some(100.0), Some(900.0), None]);
        assert_eq!(heights(&[folded, folded], 1000.0), [None, None]);
        assert!(heights(&[], 1000.0).is_empty());
    }

    #[test]
    fn heights_fill_the_room_and_none_is_negative() {
        for room in [0.0, 150.0, 500.0, 900.0, 2000.0] {
            for wanted in [[50.0, 400.0, 900.0], [900.0, 900.0, 900.0], [10.0, 10.0, 10.0]] {
                let [a, b, c] = wanted;
                let requests = [request(a, true, 3), request(b, false, 1), request(c, true, 2)];
                let shared = heights(&requests, room);
                let sum: f32 = shared.iter().flatten().sum();
                assert!((sum - room).abs() < 1e-3, "{wanted:?} in {room}: {shared:?}");
                assert!(shared.iter().flatten().all(|&height| height >= 0.0), "{shared:?}");
            }
        }
    }
}

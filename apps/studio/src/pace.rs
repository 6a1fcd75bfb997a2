//! The pace of frames that other threads ask for: at most one for each refresh of the display.
//!
//! If the last frame is older than one refresh, we draw the next at once, so a pen that begins to
//! paint waits for nothing. Frames for input of the window system are not paced here. They wait for
//! the display.

use web_time::{Duration, Instant};

use eframe::egui::{Context, Id};

/// Refresh rate that we assume if the display reports none, in hertz.
const USUAL_HZ: f64 = 60.0;

/// Refresh rates that we believe, in hertz. For any other rate we assume [`USUAL_HZ`].
const RATES_HZ: std::ops::RangeInclusive<f64> = 24.0..=500.0;

#[cfg(not(target_arch = "wasm32"))]
/// Time from one frame to the next while drawing gives way to the paint. This gives 20 frames a
/// second.
const SLOT_BEHIND: Duration = Duration::from_millis(48);

/// Delay of an immediate frame. Without any delay egui would draw two frames.
const AT_ONCE: Duration = Duration::from_nanos(1);

#[derive(Debug, Clone, Copy)]
struct Pace {
    /// Time from one refresh of the display to the next.
    slot: Duration,
    /// Shortest time from one frame to the next while something else shows the changes of a stroke.
    rare: Option<Duration>,
    /// Start of the last frame.
    last: Option<Instant>,
    /// Whether another thread has asked for a frame since the last one.
    woken: bool,
}

impl Pace {
    /// Time from one frame to the next.
    fn between(&self) -> Duration {
        self.rare.unwrap_or(self.slot)
    }
}

#[cfg(not(target_arch = "wasm32"))]
/// Sets the refresh rate of the display, in thousandths of a hertz, if it is known.
pub(crate) fn set_display(context: &Context, millihertz: Option<u32>) {
    change(context, |pace| pace.slot = slot_of(millihertz));
}

/// Sets the shortest time between two frames for other threads, while something else shows the
/// changes of a stroke. `None` allows one frame for each refresh of the display. Returns whether a
/// time was set before.
pub(crate) fn set_rare(context: &Context, rare: Option<Duration>) -> bool {
    change(context, |pace| std::mem::replace(&mut pace.rare, rare)).is_some()
}

/// Notes that a frame begins. If another thread asked for it, this asks for one more frame, because
/// some layouts need two.
pub(crate) fn begin_frame(context: &Context, now: Instant) {
    let (woken, slot) = change(context, |pace| {
        pace.last = Some(now);
        (std::mem::take(&mut pace.woken), pace.between())
    });
    if woken {
        context.request_repaint_after(slot);
    }
}

/// Asks for a frame because there is news. You can call this from any thread.
pub(crate) fn wake(context: &Context) {
    wake_at(context, Instant::now());
}

#[cfg(not(target_arch = "wasm32"))]
/// Time to wait before a frame that would begin `now`, if the processor both draws and paints. This
/// leaves 20 frames a second to draw. Call it also if input of the window system asks for frames.
pub(crate) fn give_way(context: &Context, now: Instant) -> Duration {
    change(context, |pace| delay(pace.last, now, SLOT_BEHIND))
}

fn wake_at(context: &Context, now: Instant) {
    let delay = change(context, |pace| {
        pace.woken = true;
        delay(pace.last, now, pace.between())
    });
    context.request_repaint_after(delay.max(AT_ONCE));
}

/// Asks for a frame after the time `soon`, but not within one refresh after the last frame.
pub(crate) fn frame_after(context: &Context, soon: Duration, now: Instant) {
    let delay = change(context, |pace| delay(pace.last, now, pace.between()));
    context.request_repaint_after(soon.max(delay).max(AT_ONCE));
}

/// Time from `now` until a frame may begin, if the last one began at `last` and frames are at least
/// `slot` apart.
fn delay(last: Option<Instant>, now: Instant, slot: Duration) -> Duration {
    last.map_or(Duration::ZERO, |last| (last + slot).saturating_duration_since(now).min(slot))
}

/// Time of one refresh of a display.
fn slot_of(millihertz: Option<u32>) -> Duration {
    let reported = millihertz.map(|rate| f64::from(rate) / 1000.0);
    Duration::from_secs_f64(
        1.0 / reported.filter(|rate| RATES_HZ.contains(rate)).unwrap_or(USUAL_HZ),
    )
}

fn change<T>(context: &Context, change: impl FnOnce(&mut Pace) -> T) -> T {
    context.data_mut(|data| {
        change(data.get_temp_mut_or_insert_with(Id::unique("pace of frames"), || Pace {
            slot: slot_of(None),
            rare: None,
            last: None,
            woken: false,
        }))
    })
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use eframe::egui::RawInput;

    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn a_frame_waits_for_its_slot_and_not_longer() {
        let start = Instant::now();
        let slot = 16 * MS;
        for (ms, wait) in [(0_u32, 16_u32), (5, 11), (16, 0), (900, 0)] {
            assert_eq!(delay(Some(start), start + ms * MS, slot), wait * MS, "after {ms} ms");
        }
        assert_eq!(delay(None, start, slot), Duration::ZERO, "the first frame");
        assert_eq!(delay(Some(start + 40 * MS), start, slot), slot, "never more than a slot");
    }

    #[test]
    fn the_slot_is_that_of_the_display_or_a_sixtieth_of_a_second() {
        assert_eq!(slot_of(Some(50_000)), 20 * MS);
        assert_eq!(slot_of(Some(125_000)), 8 * MS);
        for unknown in [None, Some(0), Some(1000), Some(u32::MAX)] {
            assert_eq!(slot_of(unknown), Duration::from_secs_f64(1.0 / 60.0), "{unknown:?}");
        }
    }

    /// A context with a display of 50 Hz after its first frames, which egui asks for itself. The
    /// function returns the delays of the frames requested since.
    fn paced(start: Instant) -> (Context, impl Fn() -> Vec<Duration>) {
        let context = Context::default();
        let asked = Arc::new(Mutex::new(Vec::new()));
        let noted = Arc::clone(&asked);
        context.set_request_repaint_callback(move |info| noted.lock().unwrap().push(info.delay));
        set_display(&context, Some(50_000));
        let asked = move || std::mem::take(&mut *asked.lock().unwrap());
        for _ in 0..3 {
            frame(&context, start);
        }
        asked();
        (context, asked)
    }

    fn frame(context: &Context, now: Instant) {
        context.begin_pass(RawInput::default());
        begin_frame(context, now);
        context.end_pass().textures_delta.clear();
    }

    #[test]
    fn news_is_drawn_in_the_next_slot_and_settles_in_one_more() {
        let start = Instant::now();
        let (context, asked) = paced(start);
        wake_at(&context, start + 5 * MS);
        assert_eq!(asked(), [15 * MS]);
        frame(&context, start + 20 * MS);
        assert_eq!(asked(), [20 * MS], "one more frame for what the news changed");
        frame(&context, start + 40 * MS);
        assert!(asked().is_empty(), "and no third one");
        wake_at(&context, start + 200 * MS);
        assert_eq!(asked(), [AT_ONCE], "the last frame is old");
        wake_at(&context, start + 201 * MS);
        assert!(asked().is_empty(), "it comes already");
    }

    #[test]
    fn frames_that_give_way_to_the_paint_are_twenty_a_second() {
        let start = Instant::now();
        let (context, _) = paced(start);
        let waits = [0, 30, 48, 900].map(|ms| give_way(&context, start + ms * MS));
        assert_eq!(waits, [48 * MS, 18 * MS, Duration::ZERO, Duration::ZERO]);
    }

    #[test]
    fn frames_are_rare_while_something_else_shows_what_changes() {
        let start = Instant::now();
        let (context, asked) = paced(start);
        set_rare(&context, Some(250 * MS));
        wake_at(&context, start + 5 * MS);
        assert_eq!(asked(), [245 * MS]);
        frame(&context, start + 250 * MS);
        assert_eq!(asked(), [250 * MS]);
        set_rare(&context, None);
        wake_at(&context, start + 255 * MS);
        assert_eq!(asked(), [15 * MS], "and at the display's pace again");
    }

    #[test]
    fn a_frame_that_is_due_soon_waits_for_the_slot_and_a_later_one_for_its_time() {
        let start = Instant::now();
        let (context, asked) = paced(start);
        for (soon, wanted) in [(70, 70), (10, 18), (0, 18)] {
            frame(&context, start);
            frame_after(&context, soon * MS, start + 2 * MS);
            assert_eq!(asked(), [wanted * MS], "in {soon} ms");
        }
    }
}

//! The colour wheel of your tubes, computed on a background thread.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use pigment::PigmentId;
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::palette::{Cards, ColorWheel, Palette, PaletteError, color_wheel};
use session::thread;

/// Tubes and light of a wheel.
#[derive(Debug, Clone)]
pub struct WheelRequest {
    /// Library of the tubes.
    pub library: Arc<PigmentLibrary>,
    /// Pigments of the tubes, in rising order.
    pub tubes: Vec<PigmentId>,
    /// Light and observer.
    pub viewing: Viewing,
}

impl PartialEq for WheelRequest {
    fn eq(&self, other: &Self) -> bool {
        (Arc::ptr_eq(&self.library, &other.library) || self.library == other.library)
            && self.tubes == other.tubes
            && self.viewing == other.viewing
    }
}

impl WheelRequest {
    /// Computes the wheel.
    ///
    /// # Errors
    /// [`PaletteError`] if none of the tubes can be mixed.
    pub fn make(&self) -> Result<ColorWheel, PaletteError> {
        let cards = Cards::standard(self.library.grid);
        let palette = Palette::new(&self.library, &self.viewing, cards)?.among(&self.tubes)?;
        Ok(color_wheel(&palette))
    }
}

/// A computed wheel, or why there is none.
pub type MadeWheel = Arc<Result<ColorWheel, PaletteError>>;

/// Keeps the wheel of the last request. If tubes or light change, this computes a new one.
#[derive(Debug, Default)]
pub struct WheelMaker {
    made: Option<(WheelRequest, MadeWheel)>,
    running: Option<(WheelRequest, Receiver<Result<ColorWheel, PaletteError>>)>,
}

impl WheelMaker {
    /// The wheel of `request`. While it is being computed, this is the wheel of the request before.
    /// `None` before the first is ready. The thread calls `wake` when it ends.
    pub fn get(
        &mut self,
        request: &WheelRequest,
        wake: impl FnOnce() + Send + 'static,
    ) -> Option<MadeWheel> {
        self.collect();
        let known = self.made.as_ref().is_some_and(|(of, _)| of == request);
        if !known && self.running.is_none() {
            let (sender, receiver) = channel();
            let wanted = request.clone();
            self.running = Some((request.clone(), receiver));
            thread::start(move || {
                let _ = sender.send(wanted.make());
                drop(sender);
                wake();
            });
        }
        self.made.as_ref().map(|(_, made)| Arc::clone(made))
    }

    /// Whether a wheel is being computed.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.running.is_some()
    }

    fn collect(&mut self) {
        let Some((request, receiver)) = &self.running else { return };
        match receiver.try_recv() {
            Ok(wheel) => self.made = Some((request.clone(), Arc::new(wheel))),
            Err(TryRecvError::Empty) => return,
            // The thread has ended without a result. The next call starts it again.
            Err(TryRecvError::Disconnected) => {}
        }
        self.running = None;
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::RecvTimeoutError;
    use std::time::Duration;

    use super::*;

    fn request(names: &[&str]) -> WheelRequest {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let tubes = names.iter().map(|name| library.find(name).unwrap()).collect();
        WheelRequest { library, tubes, viewing: Viewing::default() }
    }

    /// Asks until this returns the wheel of `request`. Returns how often a thread ended.
    fn wait(maker: &mut WheelMaker, request: &WheelRequest) -> (usize, MadeWheel) {
        let (woken, wakes) = channel();
        let mut ended = 0;
        loop {
            let woken = woken.clone();
            let found = maker.get(request, move || woken.send(()).unwrap_or_default());
            if let (Some(made), false) = (found, maker.is_busy()) {
                return (ended, made);
            }
            match wakes.recv_timeout(Duration::from_secs(60)) {
                Ok(()) => ended += 1,
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
                    panic!("no wheel in a minute")
                }
            }
        }
    }

    #[test]
    fn a_wheel_is_computed_once_for_the_same_tubes_and_light() {
        let mut maker = WheelMaker::default();
        let first = request(&["Zinc White", "Vermilion"]);
        let (ended, made) = wait(&mut maker, &first);
        assert_eq!((ended, made.as_ref()), (1, &first.make()));
        assert_eq!(wait(&mut maker, &request(&["Zinc White", "Vermilion"])).0, 0, "it is kept");
        let other = request(&["Zinc White", "Ultramarine"]);
        assert_eq!(wait(&mut maker, &other).0, 1, "other tubes");
        let tungsten = Viewing {
            illuminant: spectra::Illuminant::named("A").unwrap(),
            observer: spectra::Observer::default(),
        };
        let (ended, made) = wait(&mut maker, &WheelRequest { viewing: tungsten, ..other.clone() });
        assert!(ended == 1 && *made != other.make(), "another light");
    }

    #[test]
    fn tubes_that_cannot_be_mixed_give_the_reason() {
        let mut maker = WheelMaker::default();
        let (_, made) = wait(&mut maker, &request(&[]));
        assert_eq!(*made, Err(PaletteError::NothingToMix(0)));
    }
}

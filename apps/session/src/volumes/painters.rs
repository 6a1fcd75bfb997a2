//! Draws pictures of a scene: a drawing, and paintings in pigments. Another thread makes the
//! painters when they are first needed, so that the window does not wait.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use graphics::camera::Camera;
use graphics::field::Field;
use graphics::mesh::Mesh;
use paint::document::Document;
use volumes::painter::{PaintingError, Show, VolumePainter, VolumePigments};
use volumes::script::{RegionStyle, Script};
use volumes::settings::Settings;
use volumes::world::World;

use super::look::{Inside, Look};
use crate::failure::FileFailure;
use crate::thread;

/// Size and camera of a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    pub(super) camera: Camera,
    /// In pixels.
    pub(super) size: [usize; 2],
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Quality {
    /// Whether to draw all samples of each pixel, or only one.
    pub(super) fine: bool,
    /// Width of this picture divided by its final width. Strokes keep their final size.
    pub(super) share: f32,
    /// Whether to wait for the painter. If not, you get the drawing until it is made.
    pub(super) waits: bool,
}

impl Quality {
    pub(super) const BEST: Self = Self { fine: true, share: 1.0, waits: true };
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A drawing. Its volumes show the subject's own colours.
    Drawing,
    /// A painting in pigments. Its volumes show this inside.
    Painting(Inside),
}

#[derive(Debug)]
struct Made {
    kind: Kind,
    /// Version of the pigments that it was made with.
    version: u64,
    painter: VolumePainter,
}

/// A painter that is being made, with its kind and the version of its pigments.
type InMaking = (Kind, u64, Making<Result<VolumePainter, PaintingError>>);

#[derive(Debug)]
pub(super) struct Painters {
    scene: Arc<Mesh>,
    settings: Settings,
    styles: Vec<RegionStyle>,
    pigments: Option<VolumePigments>,
    /// Counts changes of the pigments.
    version: u64,
    made: Vec<Made>,
    /// Kind, and version of the pigments, of the painter that failed last.
    failed: Option<(Kind, u64)>,
    making: Option<InMaking>,
}

impl Painters {
    /// Painters for the settings and regions of a script, with these pigments if there are any.
    pub(super) fn new(
        scene: &Arc<Mesh>,
        script: &Script,
        settings: &Settings,
        pigments: Option<VolumePigments>,
    ) -> Self {
        Self {
            scene: Arc::clone(scene),
            settings: settings.clone(),
            styles: script.region_styles(settings),
            pigments,
            version: 1,
            made: Vec::new(),
            failed: None,
            making: None,
        }
    }

    /// Paints with other pigments, or under another light, from now on. Until the new painters are
    /// made, pictures use the old ones.
    pub(super) fn set_pigments(&mut self, pigments: Option<VolumePigments>) {
        self.pigments = pigments;
        self.version += 1;
    }

    /// Whether this look shows a painting.
    pub(super) fn paints(&self, look: &Look) -> bool {
        let shows_films = look.show == Show::Final && look.inside != Inside::OwnColours;
        shows_films && self.pigments.is_some()
    }

    pub(super) fn is_making(&self) -> bool {
        self.making.is_some()
    }

    /// Takes the painter that was being made if it is ready, and returns whether it was. Fails for
    /// settings or pigments that cannot be used.
    pub(super) fn take_made(&mut self) -> Result<bool, FileFailure> {
        if self.making.as_mut().is_some_and(|(.., making)| making.is_ready()) {
            return self.await_made().map(|()| true);
        }
        Ok(false)
    }

    /// Waits for the painter that is being made.
    fn await_made(&mut self) -> Result<(), FileFailure> {
        let Some((kind, version, making)) = self.making.take() else { return Ok(()) };
        self.failed = Some((kind, version));
        let what = "the paint could not be mixed by a fault of the program".to_owned();
        let made = making.result().ok_or(FileFailure { what, hint: None })?;
        let painter = made.map_err(|error| FileFailure::explained(&error))?;
        self.failed = None;
        self.made.retain(|made| made.kind != kind);
        self.made.push(Made { kind, version, painter });
        Ok(())
    }

    /// Version of the pigments that a painter of this kind must have now.
    fn wanted(&self, kind: Kind) -> u64 {
        if kind == Kind::Drawing { 0 } else { self.version }
    }

    fn index(&self, kind: Kind) -> Option<usize> {
        self.made.iter().position(|made| made.kind == kind)
    }

    fn is_made(&self, kind: Kind) -> bool {
        let wanted = self.wanted(kind);
        self.index(kind).is_some_and(|index| self.made[index].version == wanted)
    }

    /// Begins to make a painter, unless it exists or another is being made.
    fn begin(&mut self, kind: Kind) {
        if self.is_made(kind) || self.making.is_some() {
            return;
        }
        let inside = match kind {
            Kind::Drawing => Inside::OwnColours,
            Kind::Painting(inside) => inside,
        };
        let styles = self.styles.iter().map(|style| RegionStyle {
            inside: inside.as_setting().unwrap_or(style.inside),
            ..style.clone()
        });
        let styles: Vec<RegionStyle> = styles.collect();
        let pigments = self.pigments.clone().filter(|_| kind != Kind::Drawing);
        let scene = Arc::clone(&self.scene);
        let settings = self.settings.clone();
        let making = Making::begin(move || {
            let painter = VolumePainter::new(&scene, &settings, &styles)?;
            match pigments {
                Some(pigments) => painter.with_pigments(pigments),
                None => Ok(painter),
            }
        });
        self.making = Some((kind, self.wanted(kind), making));
    }

    /// The painter of a kind, set to draw with these settings. This waits until it is made. If you
    /// do not want it to wait, you may get one with earlier pigments, or the painter of the
    /// drawing.
    fn painter(
        &mut self,
        kind: Kind,
        waits: bool,
        settings: &Settings,
    ) -> Result<&mut VolumePainter, FileFailure> {
        let mut kind = kind;
        if !waits && kind != Kind::Drawing {
            if self.failed != Some((kind, self.version)) {
                self.begin(kind);
            }
            if self.index(kind).is_none() {
                kind = Kind::Drawing;
            }
        }
        while !self.is_made(kind) && (waits || self.index(kind).is_none()) {
            // A painter of another kind may be in the making.
            let others = self.making.as_ref().is_some_and(|(own, ..)| *own != kind);
            if others && kind == Kind::Drawing {
                let waiting = self.making.take();
                self.begin(kind);
                self.await_made()?;
                self.making = waiting;
                continue;
            }
            self.begin(kind);
            self.await_made()?;
        }
        let index = self.index(kind).unwrap_or_default();
        let painter = &mut self.made[index].painter;
        painter.set_drawing(settings).map_err(|error| FileFailure::explained(&error))?;
        Ok(painter)
    }

    /// The picture of a world as encoded sRGB.
    pub(super) fn picture(
        &mut self,
        world: &World,
        sight: &Sight,
        look: &Look,
        quality: Quality,
    ) -> Result<Field<[f32; 4]>, FileFailure> {
        let mut settings = look.applied_to(&self.settings);
        if !quality.fine {
            settings.picture.samples = 1;
        }
        let hatching = &mut settings.hatching;
        hatching.width_px = (hatching.width_px * quality.share).max(1.0);
        let kind = if self.paints(look) { Kind::Painting(look.inside) } else { Kind::Drawing };
        let painter = self.painter(kind, quality.waits, &settings)?;
        let picture = painter.shown(world, &sight.camera, sight.size.into(), look.show);
        picture.map_err(|error| FileFailure::explained(&error))
    }

    /// The painting of a world.
    pub(super) fn painting(
        &mut self,
        world: &World,
        sight: &Sight,
        look: &Look,
        title: &str,
    ) -> Result<Document, FileFailure> {
        let settings = look.applied_to(&self.settings);
        let painter = self.painter(Kind::Painting(look.inside), true, &settings)?;
        let painting = painter.painting(world, &sight.camera, sight.size.into(), title);
        painting.map_err(|error| FileFailure::explained(&error))
    }
}

/// A value that another thread makes while the window goes on.
#[derive(Debug)]
pub(super) struct Making<T> {
    receiver: Receiver<T>,
    /// The value once it was received. The inner `None` means that the thread has panicked.
    made: Option<Option<T>>,
}

impl<T: Send + 'static> Making<T> {
    pub(super) fn begin(make: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, receiver) = channel();
        thread::start(move || {
            let _ = sender.send(make());
        });
        Self { receiver, made: None }
    }

    pub(super) fn is_ready(&mut self) -> bool {
        if self.made.is_none() {
            self.made = match self.receiver.try_recv() {
                Ok(made) => Some(Some(made)),
                Err(TryRecvError::Empty) => None,
                Err(TryRecvError::Disconnected) => Some(None),
            };
        }
        self.made.is_some()
    }

    /// Waits for the value. Returns `None` if its thread has panicked.
    pub(super) fn result(mut self) -> Option<T> {
        while !self.is_ready() && thread::next() {}
        self.made.unwrap_or_else(|| self.receiver.recv().ok())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    #[test]
    fn it_is_ready_when_its_thread_has_ended() {
        let (send, receive) = channel::<u32>();
        let mut making = Making::begin(move || receive.recv().unwrap() + 1);
        assert!(!making.is_ready(), "it waits");
        send.send(4).unwrap();
        assert_eq!(making.result(), Some(5));
        let failed = Making::<u32>::begin(|| std::panic::resume_unwind(Box::new("a fault")));
        assert_eq!(failed.result(), None);
    }
}

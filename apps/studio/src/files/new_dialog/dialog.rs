//! State of the dialog.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::Context;
use paint::document::Lighting;
use paint::ground::{GroundRelief, PictureRelief};
use paint::light::Light;
use paint::strokes::PaletteSpec;
use pigment::library::PigmentLibrary;
use session::PaintingState;

use super::answer::CanvasPicture;
use super::memory::free_bytes;
use super::preview::{Preview, PreviewLight};
use crate::files::job::Job;
use crate::files::new_canvas::{NewCanvas, TONES};

/// sRGB of each tone; `None` of one whose pigments a library lacks.
type ToneColors = Vec<Option<[u8; 3]>>;

/// A dialog that describes a new painting.
#[derive(Debug)]
pub(in crate::files) struct NewDialog {
    /// The canvas as it is described so far.
    pub(in crate::files) new: NewCanvas,
    /// Pigments of the current painting.
    pub(in crate::files) palette: PaletteSpec,
    /// Library of the current painting.
    pub(in crate::files) library: Arc<PigmentLibrary>,
    /// The library that comes with the program.
    pub(in crate::files) oils: Arc<PigmentLibrary>,
    lighting: Lighting,
    light: Arc<Light>,
    pub(super) preview: Preview,
    /// Name of the preset that is chosen or typed.
    pub(super) preset: String,
    /// Free memory in bytes, if the system tells.
    pub(super) free_bytes: Option<u64>,
    finding_memory: Option<Job<Option<u64>>>,
    /// Colours of the tones in each library: of the current painting, and of the program.
    tones: [ToneColors; 2],
    mixing_tones: Option<Job<[ToneColors; 2]>>,
}

impl NewDialog {
    /// A dialog that starts with `last`, for a painting begun after that of `state`.
    #[must_use]
    pub(in crate::files) fn new(
        state: &PaintingState,
        mut last: NewCanvas,
        context: &Context,
    ) -> Self {
        last.bound();
        let pigments = state.slots.iter().flatten();
        let pigments = pigments.map(|&pigment| state.library[pigment].name.as_str());
        let wake = context.clone();
        let finding_memory =
            Job::start("memory", move || wake.request_repaint(), move |_| Ok(free_bytes()));
        let library = Arc::clone(&state.library);
        let oils = Arc::new(PigmentLibrary::van_gogh_oils());
        let libraries = [Arc::clone(&library), Arc::clone(&oils)];
        let wake = context.clone();
        let viewing = state.light.viewing.clone();
        let mixing_tones = Job::start(
            "tones",
            move || wake.request_repaint(),
            move |_| {
                Ok(libraries.each_ref().map(|library: &Arc<PigmentLibrary>| {
                    TONES.iter().map(|tone| tone.color(library, &viewing)).collect()
                }))
            },
        );
        Self {
            new: last,
            palette: PaletteSpec::from_names(pigments),
            library,
            oils,
            lighting: state.lighting.clone(),
            light: Arc::clone(&state.light),
            preview: Preview::default(),
            preset: String::new(),
            free_bytes: None,
            finding_memory: Some(finding_memory),
            tones: Default::default(),
            mixing_tones: Some(mixing_tones),
        }
    }

    /// The library that the new painting will have.
    #[must_use]
    pub(in crate::files) fn own_library(&self) -> &Arc<PigmentLibrary> {
        if self.new.same_pigments { &self.library } else { &self.oils }
    }

    /// Colour of the tone with this index, once it is known.
    pub(super) fn tone_color(&self, index: usize) -> Option<[u8; 3]> {
        let tones = &self.tones[usize::from(!self.new.same_pigments)];
        tones.get(index).copied().flatten()
    }

    /// Uses a picture that the painter chose.
    pub(in crate::files) fn set_picture(&mut self, purpose: CanvasPicture, path: PathBuf) {
        match purpose {
            CanvasPicture::FirstLayer => self.new.first_layer = Some(path),
            CanvasPicture::Relief => {
                let depth_mm = match &self.new.canvas.ground.relief {
                    GroundRelief::Image(picture) => picture.depth_mm,
                    _ => 0.2,
                };
                let path = path.display().to_string();
                self.new.canvas.ground.relief =
                    GroundRelief::Image(PictureRelief { path, depth_mm });
            }
        }
    }

    /// Takes what was found out beside the window's thread.
    pub(super) fn update(&mut self, context: &Context) {
        if let Some(found) = self.finding_memory.as_mut().and_then(Job::poll) {
            self.finding_memory = None;
            self.free_bytes = found.ok().flatten();
        }
        if let Some(found) = self.mixing_tones.as_mut().and_then(Job::poll) {
            self.mixing_tones = None;
            self.tones = found.unwrap_or_default();
        }
        let same = self.new.same_pigments;
        let library = Arc::clone(self.own_library());
        // A light is made for a library.
        let light = (same || *library == *self.library).then(|| Arc::clone(&self.light));
        let lighting = self.lighting.clone();
        self.preview.update(context, &self.new.canvas, same, move || PreviewLight {
            library,
            lighting,
            light,
        });
    }
}

//! All techniques of painting have one shape: settings and their presets, a subject, its painter,
//! the pictures that it paints and the stages on the way to them.
//!
//! If you know [`Technique`], you can read settings, prepare a painter and ask it for pictures in
//! one way for every technique:
//!
//! ```
//! use documents::Task;
//! use documents::settings::Preset;
//! use paint::technique::Technique;
//!
//! /// The first picture of a subject in the first preset of its technique.
//! fn first_picture<T: Technique>(
//!     subject: T::Subject<'_>,
//!     view: T::View<'_>,
//! ) -> Result<T::Picture, T::Error> {
//!     let settings = T::Preset::ALL.first().map(|preset| preset.settings()).unwrap_or_default();
//!     let task = Task::observed(|progress| eprintln!("{}: {progress}", T::NAME));
//!     T::prepare(subject, &settings, &task)?.paint(view, &task)
//! }
//! ```

use std::path::Path;

use documents::hint::Explain;
use documents::settings::{self, Preset, SettingsError, Table};
use documents::{Cancelled, Task};
use graphics::field::Field;

/// A step on the way to a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Its name in lower case with hyphens, for example `dry-brush`.
    pub name: String,
    /// Its picture, encoded sRGB with coverage.
    pub picture: Field<[f32; 4]>,
}

/// A technique of painting. The type that implements it is the painter of one subject.
pub trait Technique: Sized {
    /// The name of the technique, for example `watercolor`.
    const NAME: &'static str;

    /// Changes of single settings as users write them, e.g. `edges.strength=2`. Help texts show
    /// these examples, the most usual one first.
    const EXAMPLES: &'static [&'static str];

    /// The settings, one row each.
    type Settings: Table;

    /// Settings that ship under a name.
    type Preset: Preset<Settings = Self::Settings>;

    /// The photograph or model that you paint, with all that you need for it: for example pigments
    /// or a device.
    type Subject<'a>;

    /// How you see the subject, for example by a camera, or where you paint it.
    type View<'a>;

    /// The result: a picture, or for example a painting with its strokes.
    type Picture;

    /// Tells you why a technique cannot paint a subject.
    type Error: Explain + From<Cancelled> + 'static;

    /// Returns a copy of `settings`, changed by the text of a file. If the settings name files, we
    /// look for them in the folder of `file`.
    ///
    /// # Errors
    /// [`SettingsError`] if the text is no TOML, a key is unknown, or a value is out of its range.
    fn changed_by_file(
        settings: &Self::Settings,
        file: &Path,
        text: &str,
    ) -> Result<Self::Settings, SettingsError> {
        settings::changed(settings, &file.display().to_string(), text)
    }

    /// Does all work that does not depend on the view. This takes from a moment to some seconds.
    ///
    /// # Errors
    /// [`Self::Error`] for a subject that cannot be painted in these settings, and if `task` is cancelled.
    fn prepare(
        subject: Self::Subject<'_>,
        settings: &Self::Settings,
        task: &Task,
    ) -> Result<Self, Self::Error>;

    /// Paints the subject as you see it in this view.
    ///
    /// # Errors
    /// [`Self::Error`] for a view that shows nothing, for a device that fails, and if `task` is cancelled.
    fn paint(&mut self, view: Self::View<'_>, task: &Task) -> Result<Self::Picture, Self::Error>;

    /// The pictures of the steps in which [`Self::paint`] paints this view, in their order. If the
    /// steps of a technique are not pictures, you get none.
    ///
    /// # Errors
    /// The errors of [`Self::paint`].
    fn stages(&mut self, _view: Self::View<'_>, task: &Task) -> Result<Vec<Stage>, Self::Error> {
        task.check()?;
        Ok(Vec::new())
    }
}

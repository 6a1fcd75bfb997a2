//! The shape that all techniques of painting have: settings and their presets, a subject, its painter, the
//! pictures that it paints and the stages on the way to them.
//!
//! A program that knows [`Technique`] reads settings, prepares a painter and asks it for pictures in the same
//! way for every technique:
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
    /// Its name in lower case with hyphens, such as `dry-brush`.
    pub name: String,
    /// Its picture, encoded sRGB with coverage.
    pub picture: Field<[f32; 4]>,
}

/// A technique of painting. The type that implements it is the painter of one subject.
pub trait Technique: Sized {
    /// The name of the technique, such as `watercolor`.
    const NAME: &'static str;

    /// Changes of single settings as users write them, such as `edges.strength=2`: examples for help texts, the
    /// most usual one first.
    const EXAMPLES: &'static [&'static str];

    /// The settings, one row each.
    type Settings: Table;

    /// Settings that ship under a name.
    type Preset: Preset<Settings = Self::Settings>;

    /// The photograph or model that is painted, with all that it is painted with: pigments, a device.
    type Subject<'a>;

    /// How the subject is seen, such as by a camera, or where it is painted.
    type View<'a>;

    /// The result: a picture, or for example a painting with its strokes.
    type Picture;

    /// Why a subject cannot be painted.
    type Error: Explain + From<Cancelled> + 'static;

    /// A copy of `settings` changed by the text of a file. A technique with files in its settings takes their
    /// paths from the folder of `file`.
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

    /// Does all work that does not depend on the view. It takes from a moment to some seconds.
    ///
    /// # Errors
    /// [`Self::Error`] for a subject that cannot be painted in these settings, and if `task` is cancelled.
    fn prepare(
        subject: Self::Subject<'_>,
        settings: &Self::Settings,
        task: &Task,
    ) -> Result<Self, Self::Error>;

    /// Paints the subject as it is seen.
    ///
    /// # Errors
    /// [`Self::Error`] for a view that shows nothing, for a device that fails, and if `task` is cancelled.
    fn paint(&mut self, view: Self::View<'_>, task: &Task) -> Result<Self::Picture, Self::Error>;

    /// The pictures of the steps to [`Self::paint`] of this view, in their order. A technique whose steps are
    /// not pictures has none.
    ///
    /// # Errors
    /// The errors of [`Self::paint`].
    fn stages(&mut self, _view: Self::View<'_>, task: &Task) -> Result<Vec<Stage>, Self::Error> {
        task.check()?;
        Ok(Vec::new())
    }
}

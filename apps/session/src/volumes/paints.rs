//! Changes of the pigments of a scene, and of the light on them.

use std::path::Path;
use std::sync::Arc;

use documents::file::disk;
use documents::hint::Hint;
use pigment::library::PigmentLibrary;
use volumes::script::Script;

use super::materials::{Materials, fill_tubes, light_for_script};
use super::scene::Scene;
use crate::failure::FileFailure;

impl Scene {
    /// Sees pigments under another light.
    ///
    /// # Errors
    /// [`FileFailure`] for a light that a script cannot name.
    pub(super) fn set_illuminant(&mut self, illuminant: &str) -> Result<(), FileFailure> {
        let mut script = self.recorded.base().clone();
        script.illuminant = light_for_script(illuminant)?;
        let materials = self.materials.again(&script)?;
        self.take_up(script, materials);
        Ok(())
    }

    /// Fills the tubes from a library of the painter's own. Paint that was poured from a tube is
    /// that of its new pigment.
    ///
    /// # Errors
    /// [`FileFailure`] for a file that is no library, or has too few pigments.
    pub(super) fn set_library(&mut self, path: &Path) -> Result<(), FileFailure> {
        let library = PigmentLibrary::open(path);
        let library = library.map_err(|error| FileFailure::explained(&error))?;
        let mut script = self.recorded.base().clone();
        let is_bare = script.palette.is_empty();
        if is_bare && !self.recorded.events().is_empty() {
            let what = "paint was poured in this scene that has no pigments".to_owned();
            let hint = Some(Hint::new("begin a new scene for the library"));
            return Err(FileFailure { what, hint });
        }
        fill_tubes(&mut script, &library)?;
        let path = disk::absolute(path).unwrap_or_else(|_| path.to_owned());
        // Below the folder of the subject by its name there.
        let named = path.strip_prefix(&self.folder).unwrap_or(&path);
        script.library = Some(named.to_string_lossy().into_owned());
        let materials = self.materials.with_library(&script, Arc::new(library), Some(path))?;
        self.take_up(script, materials);
        // Paint keeps its slots, as the letters stay.
        if is_bare { self.replay_from(0) } else { Ok(()) }
    }

    /// Puts another pigment of the library into a tube, by its number from 0. Paint that was poured
    /// from it is that of the new pigment.
    ///
    /// # Errors
    /// [`FileFailure`] for a pigment that the library does not have, or another tube has.
    pub(super) fn set_tube(&mut self, number: usize, pigment: &str) -> Result<(), FileFailure> {
        let mut script = self.recorded.base().clone();
        if let Some(name) = script.palette.values_mut().nth(number) {
            pigment.clone_into(name);
        }
        let materials = self.materials.again(&script)?;
        self.take_up(script, materials);
        Ok(())
    }

    /// Goes on with another palette or light.
    fn take_up(&mut self, script: Script, materials: Materials) {
        self.painters.set_pigments(materials.painted(&script));
        self.materials = materials;
        self.recorded.change_base(|base| *base = script);
    }
}

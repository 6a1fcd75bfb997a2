//! The pigments of a scene, and the light on them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::counted;
use documents::hint::Hint;
use paint::document::{Lighting, Slots};
use paint::ground::GroundSpec;
use paint::light::Light;
use pigment::library::PigmentLibrary;
use volumes::painter::VolumePigments;
use volumes::script::{Script, ScriptError, is_light};

use super::event::SceneTube;
use crate::failure::FileFailure;
use crate::prepare::tubes_of;
use crate::report::Colors;

/// Letters of the tubes in a new scene.
const LETTERS: &str = "ABCDEFGH";

/// The pigments of a scene's tubes, and the light on them.
#[derive(Debug, Clone)]
pub(super) struct Materials {
    pub(super) library: Arc<PigmentLibrary>,
    /// File of the painter's own library. There is none for the library that comes with the
    /// program.
    pub(super) file: Option<PathBuf>,
    pub(super) illuminant: String,
    pub(super) light: Arc<Light>,
    /// Tubes in the order of the palette.
    pub(super) tubes: Arc<Vec<SceneTube>>,
    pub(super) slots: Slots,
    ground: GroundSpec,
}

impl Materials {
    /// Reads the library and finds the pigments that a script names. Its path is relative to
    /// `folder`, and errors show the `name` and `text` of the script. If the script names no
    /// library, the palette uses the one that comes with the program. Fails for a library that
    /// cannot be read, for a pigment that it lacks, and for the file of a lamp, because the studio
    /// cannot use one here.
    pub(super) fn of(
        script: &Script,
        (name, text): (&str, &str),
        folder: &Path,
    ) -> Result<Self, FileFailure> {
        if let Some(lamp) = &script.lamp {
            let what = format!("{name}: the studio lights no pigments by the lamp `{lamp}`");
            let hint = Hint::new("leave lamp out, or give illuminant = \"A\" or a temperature");
            return Err(FileFailure { what, hint: Some(hint) });
        }
        let named = script.open_library(folder);
        let named = named.map_err(|error| FileFailure::explained(&error))?;
        let shipped = PigmentLibrary::van_gogh_oils();
        let own = script.library.as_ref().filter(|library| **library != shipped.title);
        let file = own.map(|library| folder.join(library));
        let library = Arc::new(named.unwrap_or(shipped));
        Self::new(script, library, file).map_err(|fault| match fault {
            MaterialsFault::Script(fault) => {
                FileFailure::explained(&ScriptError::located(name, text, fault))
            }
            MaterialsFault::Other(failure) => failure,
        })
    }

    fn new(
        script: &Script,
        library: Arc<PigmentLibrary>,
        file: Option<PathBuf>,
    ) -> Result<Self, MaterialsFault> {
        let slots = script.slots(&library).map_err(MaterialsFault::Script)?;
        let ground = script.ground_under(&library).map_err(MaterialsFault::Script)?;
        let Lighting { illuminant, observer, .. } = lighting(script);
        let light = Light::named(&library, &illuminant, &observer);
        let light = light.map_err(|error| FileFailure::explained(&error))?;
        let light = Arc::new(light);
        let tubes = Arc::new(tubes(script, &slots, &library, &light));
        Ok(Self { library, file, illuminant, light, tubes, slots, ground })
    }

    /// The materials after the script changed.
    pub(super) fn again(&self, script: &Script) -> Result<Self, FileFailure> {
        self.with_library(script, Arc::clone(&self.library), self.file.clone())
    }

    /// The materials with another library. `script` has a palette of it already.
    pub(super) fn with_library(
        &self,
        script: &Script,
        library: Arc<PigmentLibrary>,
        file: Option<PathBuf>,
    ) -> Result<Self, FileFailure> {
        Self::new(script, library, file).map_err(|fault| match fault {
            MaterialsFault::Script(fault) => FileFailure::explained(&ScriptError::from(fault)),
            MaterialsFault::Other(failure) => failure,
        })
    }

    /// Pigments, ground and light for paintings of the scene. A scene without tubes has none.
    pub(super) fn painted(&self, script: &Script) -> Option<VolumePigments> {
        (!self.tubes.is_empty()).then(|| VolumePigments {
            library: Arc::clone(&self.library),
            slots: self.slots,
            own_colors: None,
            ground: self.ground.clone(),
            lighting: lighting(script),
        })
    }
}

enum MaterialsFault {
    Script(Box<volumes::toml_text::Fault>),
    Other(FileFailure),
}

impl From<FileFailure> for MaterialsFault {
    fn from(failure: FileFailure) -> Self {
        Self::Other(failure)
    }
}

/// The light of a script on its pigments.
fn lighting(script: &Script) -> Lighting {
    let usual = Lighting::default();
    let illuminant = script.illuminant.clone().unwrap_or_else(|| usual.illuminant.clone());
    // Films are thinner than the relief of a ground, which would only hide the drawing.
    Lighting { illuminant, relief: 0.0, ..usual }
}

fn tubes(
    script: &Script,
    slots: &Slots,
    library: &Arc<PigmentLibrary>,
    light: &Arc<Light>,
) -> Vec<SceneTube> {
    let colors = Colors::new(Arc::clone(library), Arc::clone(light));
    let masstones = colors.masstones(slots);
    let tints = colors.tints(slots);
    let names = script.palette.values().zip(masstones).zip(tints);
    names
        .map(|((name, masstone), tint): ((&String, _), _)| SceneTube {
            name: name.clone(),
            masstone,
            tint,
        })
        .collect()
}

/// Gives a script the default tubes of a library. If the script has tubes, it keeps as many, with
/// their letters, since these identify the paint that was poured. Fails if the library has fewer
/// pigments than there are tubes.
pub(super) fn fill_tubes(script: &mut Script, library: &PigmentLibrary) -> Result<(), FileFailure> {
    let names = tubes_of(library);
    let letters: Vec<String> = match script.palette.is_empty() {
        true => LETTERS.chars().map(String::from).take(names.len()).collect(),
        false => script.palette.keys().cloned().collect(),
    };
    if names.len() < letters.len() {
        let what = format!(
            "{}: it has {} that can be mixed, and the scene {}",
            library.title,
            counted(names.len(), "pigment"),
            counted(letters.len(), "tube")
        );
        let hint = Some(Hint::new("take a library with more pigments, or begin a new scene"));
        return Err(FileFailure { what, hint });
    }
    script.palette = letters.into_iter().zip(names).collect();
    Ok(())
}

/// The name of a light for a script, or `None` for the default one. Fails for a light that a script
/// cannot name.
pub(super) fn light_for_script(illuminant: &str) -> Result<Option<String>, FileFailure> {
    if !is_light(illuminant) {
        let what = format!("a scene cannot be lit by `{illuminant}`");
        let hint = Hint::new("choose an illuminant by its name, or a temperature such as 5600K");
        return Err(FileFailure { what, hint: Some(hint) });
    }
    Ok((illuminant != Lighting::default().illuminant).then(|| illuminant.to_owned()))
}

//! How a subject is painted: the settings of a technique by preset, file and single changes, the pigments of a
//! library by their names, and the ground.

use std::path::{Path, PathBuf};

use calibrate::library::PigmentLibrary;
use documents::{
    settings::{Preset, changed},
    text::read_text,
};
use paint::{
    document::{Slots, palette_slots},
    ground::GroundKind,
    technique::Technique,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::instrument::split_file_and_name;

use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note};

/// The settings of a technique.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StyleRequest {
    /// Preset of settings that ships with impasto
    pub preset: Option<String>,
    /// Settings from a file (TOML). Others keep the values of the preset
    pub settings: Option<PathBuf>,
    /// Changes of single settings as KEY=VALUE, such as `edges.strength=2`
    pub set: Vec<String>,
}

impl StyleRequest {
    /// The preset, if one is named.
    ///
    /// # Errors
    /// [`PictureError::Settings`] if the technique has no preset of this name.
    pub fn preset<T: Technique>(&self) -> Result<Option<T::Preset>, PictureError> {
        Ok(self.preset.as_deref().map(str::parse).transpose()?)
    }

    /// The settings of preset, file and single changes.
    ///
    /// # Errors
    /// [`PictureError`] for a preset or setting that does not exist, and a value out of its range.
    pub fn settings<T: Technique>(&self) -> Result<T::Settings, PictureError> {
        let preset = self.preset::<T>()?;
        let mut settings = preset.map_or_else(T::Settings::default, Preset::settings);
        if let Some(path) = &self.settings {
            settings = T::changed_by_file(&settings, path, &read_text(path)?)?;
        }
        for change in &self.set {
            let toml = toml_of_change::<T>(change)?;
            settings = changed(&settings, change, &toml)
                .map_err(|error| SettingError::as_of("set", &error))?;
        }
        Ok(settings)
    }
}

/// The file of a text that names one, `FILE` or `FILE#NAME`. `None` if there is no such file.
pub(crate) fn file_in(text: &str) -> Option<PathBuf> {
    let file = Path::new(split_file_and_name(text).0);
    file.is_file().then(|| file.to_owned())
}

/// A change `KEY=VALUE` as a line of TOML. Words need no quotes, and `.5` is a number.
///
/// # Errors
/// [`SettingError`] if there is no `=`. The hint shows an example of the technique.
pub fn toml_of_change<T: Technique>(change: &str) -> Result<String, SettingError> {
    let Some((key, value)) = change.split_once('=') else {
        let example = T::EXAMPLES.first().copied().unwrap_or_default();
        let reason = format!("takes KEY=VALUE, found `{change}`");
        return Err(SettingError::of("set", reason, format!("try [set={example}]")));
    };
    Ok(format!("{} = {}", key.trim(), as_toml(value.trim())))
}

fn as_toml(value: &str) -> String {
    if let Ok(whole) = value.parse::<i64>() {
        return whole.to_string();
    }
    if let Ok(number) = value.parse::<f64>() {
        return format!("{number:?}").to_lowercase();
    }
    // Lists are written as in a file.
    let bare = ["true", "false"].contains(&value) || value.starts_with(['"', '\'', '[']);
    if bare { value.to_owned() } else { format!("{value:?}") }
}

/// The library at `path`, or the oils that ship.
pub(crate) fn library_of(
    path: Option<&Path>,
    listener: &mut Listener<'_>,
) -> Result<PigmentLibrary, PictureError> {
    let Some(path) = path else { return Ok(PigmentLibrary::van_gogh_oils()) };
    let library = PigmentLibrary::open(path)?;
    listener(Note::Library { path: path.to_owned(), pigments: library.pigments.len() });
    Ok(library)
}

/// The ground that the key `ground` names.
pub(crate) fn canvas_of(name: &str) -> Result<GroundKind, SettingError> {
    let kind = GroundKind::CANVASES.into_iter().find(|kind| kind.name() == name);
    kind.ok_or_else(|| {
        let names = GroundKind::CANVASES.map(GroundKind::name).join(", ");
        let reason = format!("takes {names}, found `{name}`");
        SettingError::of("ground", reason, "try [ground=panel]")
    })
}

/// Finds the pigments in lists of names and puts them into the slots of a layer.
///
/// # Errors
/// [`PictureError::Palette`] for a name that the library lacks, a name given twice, and too many names.
pub fn palette(lists: &[String], library: &PigmentLibrary) -> Result<Slots, PictureError> {
    Ok(palette_slots(&pigment_names(lists, library), library)?)
}

/// The names in lists. Commas separate names, except commas that belong to the name of a pigment:
/// see [`listed`].
#[must_use]
pub fn pigment_names(lists: &[String], library: &PigmentLibrary) -> Vec<String> {
    let names = lists.iter().flat_map(|list| listed(list, library, |part| part));
    names.map(str::to_owned).collect()
}

/// The parts of a list. Commas separate parts, except commas that belong to the name of a pigment.
/// For example, `Madder (old, dry)` is one part. We take the longest part in which `name_of` finds
/// a pigment of the library. Text in brackets stays together too.
#[must_use]
pub fn listed<'t>(
    list: &'t str,
    library: &PigmentLibrary,
    name_of: fn(&str) -> &str,
) -> Vec<&'t str> {
    let commas = list.match_indices(',').map(|(at, _)| at);
    let ends: Vec<usize> = commas.chain([list.len()]).collect();
    let mut parts = Vec::new();
    let mut from = 0;
    while from <= list.len() {
        let ahead = || ends.iter().copied().filter(|end| *end >= from);
        let longest = ahead().rev().find(|end| {
            let name = name_of(&list[from..*end]).trim().to_lowercase();
            library.pigments.iter().any(|pigment| pigment.name.to_lowercase() == name)
        });
        let closed = ahead().find(|end| {
            let part = &list[from..*end];
            part.matches('(').count() <= part.matches(')').count()
        });
        let end = longest.or(closed).or_else(|| ahead().next()).unwrap_or(list.len());
        parts.push(list[from..end].trim());
        from = end + 1;
    }
    parts
}

/// The name in a part of a recipe, `NAME=SHARE` or a name alone.
#[must_use]
pub fn name_in_recipe(part: &str) -> &str {
    match part.rsplit_once('=') {
        Some((name, share)) if !share.contains(',') => name,
        _ => part,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;
    use watercolor::WatercolorPainter;

    #[test]
    fn names_with_commas_are_whole() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments[0].name = "Red, dark".to_owned();
        library.pigments[1].name = "Red".to_owned();
        library.pigments[2].name = "Eosin Lake (lead, wax)".to_owned();
        let names = |list: &str| pigment_names(&[list.to_owned()], &library).join("|");
        assert_eq!(names("Red, dark,Red , Viridian"), "Red, dark|Red|Viridian");
        assert_eq!(names("red,DARK,Red"), "red|DARK|Red");
        assert_eq!(names("Viridian,RED, DARK"), "Viridian|RED, DARK");
        assert_eq!(names("Eosin Lake (lead, wax),Red"), "Eosin Lake (lead, wax)|Red");
        // An unknown name is whole too, so that a message can tell it.
        assert_eq!(names("Red,Madder (old, dry),Mauve (a,b"), "Red|Madder (old, dry)|Mauve (a|b");
        assert_eq!([names(""), names("Red,")], ["", "Red|"]);
        let lists = ["Red".to_owned(), "Viridian,Red, dark".to_owned()];
        assert_eq!(pigment_names(&lists, &library), ["Red", "Viridian", "Red, dark"]);
        let parts = listed("Red, dark=2, Viridian=1,Red", &library, name_in_recipe);
        assert_eq!(parts, ["Red, dark=2", "Viridian=1", "Red"]);
    }

    #[test]
    fn changes_follow_the_preset_and_errors_name_them() {
        let set = |change: &str| StyleRequest {
            preset: Some("portrait".to_owned()),
            set: vec!["edges.strength=.5".to_owned(), change.to_owned()],
            ..StyleRequest::default()
        };
        let settings = set("paper.kind=rough").settings::<WatercolorPainter>().unwrap();
        assert_eq!(settings.edges.strength, 0.5);
        for (change, message, hint) in [
            ("edges", "set takes KEY=VALUE, found `edges`", "try `set = edges.strength=2`"),
            (
                "edges.strength=11",
                "set edges.strength=11, line 1: edges.strength takes 0 to 10, found `11`",
                "3 is usual",
            ),
        ] {
            let error = set(change).settings::<WatercolorPainter>().unwrap_err();
            let hinted = error.hint().unwrap().to_string();
            assert_eq!((error.to_string().as_str(), hinted.as_str()), (message, hint));
        }
        let unknown = StyleRequest { preset: Some("landscap".to_owned()), ..Default::default() };
        let error = unknown.settings::<WatercolorPainter>().unwrap_err();
        assert_eq!(error.hint().unwrap().to_string(), "did you mean landscape?");
    }
}

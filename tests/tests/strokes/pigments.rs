//! Pigments of a script by name: resolving, unknown names, and pigments off the palette.

use documents::hint::Explain;
use paint::strokes::{ActionPigments, StrokeScript};
use suite::oils::library;

use crate::SOUND;

fn resolved(from: &str, to: &str) -> Result<paint::strokes::Resolved, (String, String)> {
    let script = StrokeScript::from_json("a.json", SOUND.replace(from, to).as_bytes()).unwrap();
    let told = script.resolve(&library());
    told.map_err(|error| {
        (error.to_string(), error.hint().map(|hint| hint.to_string()).unwrap_or_default())
    })
}

#[test]
fn names_and_short_names_become_pigments() {
    let library = library();
    let id = |name: &str| library.find(name).unwrap();
    let white = id("Zinc White");
    let blue = id("Prussian Blue");
    let green = id("Viridian");
    let found = resolved("\"W\": 3", "\"zinc white\": 3").unwrap();
    assert_eq!(found.slots[..3], [Some(white), Some(blue), None]);
    let mut wanted = vec![(white, 3.0), (blue, 1.0)];
    wanted.sort_by_key(|(pigment, _)| *pigment);
    assert_eq!(found.actions.len(), 14);
    assert_eq!(found.actions[0], ActionPigments::Recipe(wanted));
    assert_eq!(found.actions[1], ActionPigments::None);
    let slots = [Some(white), Some(green), None, None, None, None, None, None];
    assert_eq!(found.actions[6], ActionPigments::Palette(slots));
    assert_eq!(found.actions[11], ActionPigments::Swap { from: green, to: blue });
}

#[test]
fn unknown_pigments_are_told_with_the_nearest() {
    let (error, hint) = resolved("\"W\": \"Zinc White\"", "\"W\": \"Zink Wite\"").unwrap_err();
    assert_eq!(error, "palette: a pigment of the library, found `Zink Wite`");
    assert_eq!(hint, "did you mean Zinc White?");
    let (error, hint) = resolved("\"B\": 1", "\"Octarine\": 1").unwrap_err();
    assert_eq!(error, "action 0 (load), recipe: a pigment of the library, found `Octarine`");
    assert!(hint.starts_with("pigments: "), "{hint}");
    let (error, _) = resolved("\"from\": \"Viridian\"", "\"from\": \"Viridium\"").unwrap_err();
    assert!(error.starts_with("action 11 (swap), from: "), "{error}");
}

#[test]
fn recipes_keep_to_the_palette_and_name_a_pigment_once() {
    let (error, hint) = resolved("\"B\": 1", "\"Viridian\": 1").unwrap_err();
    assert_eq!(error, "action 0 (load), recipe: pigments of the palette, found `Viridian`");
    assert_eq!(hint, "the palette has Zinc White, Prussian Blue");
    let (error, _) = resolved("\"B\": 1", "\"Zinc White\": 1").unwrap_err();
    assert!(error.contains("recipe: each pigment once"), "{error}");
    let (error, _) =
        resolved("[\"Zinc White\", \"Viridian\"]", "[\"Viridian\", \"Viridian\"]").unwrap_err();
    assert!(error.starts_with("action 6 (palette), palette: each pigment once"), "{error}");
}

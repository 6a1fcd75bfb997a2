//! Default canvas, palette and brushes.

use std::collections::BTreeMap;

use paint::brush::HeadShape;
use paint::ground::{GroundKind, GroundSpec};
use paint::strokes::{Action, BrushSpec, Canvas, Load, PaletteSpec, StrokeScript};
use pigment::library::PigmentLibrary;

use super::command::{Command, Origin};

/// Pigments of the default palette: white, a cool and a warm one of each primary, black.
const TUBES: [&str; 8] = [
    "Zinc White",
    "Chrome Yellow (Otero)",
    "Chrome Yellow",
    "Vermilion",
    "Cochineal Lake",
    "Ultramarine",
    "Prussian Blue",
    "Bone Black",
];

/// Default brushes: name, shape and size in mm.
const BRUSHES: [(&str, HeadShape, f64); 6] = [
    ("round", HeadShape::Round, 6.0),
    ("flat", HeadShape::Flat, 10.0),
    ("filbert", HeadShape::Filbert, 8.0),
    ("rigger", HeadShape::Rigger, 1.5),
    ("fan", HeadShape::Fan, 12.0),
    ("knife", HeadShape::Knife, 14.0),
];

/// Default brushes by name.
#[must_use]
pub fn default_brushes() -> BTreeMap<String, BrushSpec> {
    BRUSHES
        .into_iter()
        .map(|(name, shape, size_mm): (&str, _, _)| (name.to_owned(), BrushSpec { shape, size_mm }))
        .collect()
}

/// A wooden palette of 640 x 420 cells of `cell_mm` mm: 64 x 42 mm for cells of 0.1 mm.
#[must_use]
pub fn default_mixing_canvas(cell_mm: f64) -> Canvas {
    let ground = GroundKind::Wood.spec(1);
    let width_mm = 640.0 * cell_mm;
    let height_mm = 420.0 * cell_mm;
    Canvas { width_mm, height_mm, cell_mm, ground }
}

/// A canvas of `width_mm` x `height_mm` mm of primed linen with cells of `cell_mm` mm, pigments
/// of `library` and the default brushes. The Van Gogh oils give a painter's choice of eight
/// pigments, any other library its white and the first pigments whose scattering is known.
#[must_use]
pub fn blank_canvas(
    library: PigmentLibrary,
    width_mm: f64,
    height_mm: f64,
    cell_mm: f64,
) -> Origin {
    let tubes = tubes_of(&library);
    let tubes = PaletteSpec::from_names(tubes.iter().map(String::as_str));
    let canvas = Canvas { width_mm, height_mm, cell_mm, ground: GroundSpec::default() };
    let mut script = StrokeScript::new("untitled", "", canvas, tubes);
    script.library = Some(library.title.clone());
    script.mixing = Some(default_mixing_canvas(cell_mm));
    script.brushes = default_brushes();
    Origin::Blank { script: Box::new(script), library: Box::new(library) }
}

/// The usual tubes of a library: see [`blank_canvas`].
pub(super) fn tubes_of(library: &PigmentLibrary) -> Vec<String> {
    let mixed = library.pigments.iter().filter(|pigment| pigment.identified);
    let mut names: Vec<&str> = mixed.map(|pigment| pigment.name.as_str()).collect();
    names.sort_by_key(|name| Some(*name) != library.reference.as_deref());
    let own = TUBES.iter().all(|tube| names.contains(tube));
    let tubes = if own { TUBES.to_vec() } else { names };
    tubes.into_iter().take(TUBES.len()).map(str::to_owned).collect()
}

/// First commands of a front end: a linen canvas of 1920 x 1080 cells (192 x 108 mm), and blue
/// on the round brush.
#[must_use]
pub fn initial_commands() -> Vec<Command> {
    let paint = Load {
        brush: "round".to_owned(),
        recipe: [("Ultramarine".to_owned(), 1.0)].into(),
        vehicle: 0.15,
        amount_mm: 0.3,
    };
    vec![
        Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 192.0, 108.0, 0.1)),
        Command::Apply(Action::Load(paint)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_initial_commands_are_valid() {
        let mut commands = initial_commands().into_iter();
        let Some(Command::Open(Origin::Blank { mut script, library })) = commands.next() else {
            panic!("a canvas is opened first");
        };
        for command in commands {
            let Command::Apply(action) = command else { panic!("then there are actions only") };
            script.actions.push(action);
        }
        assert_eq!(script.canvas.cells(), (1920, 1080));
        let resolved = script.resolve(&library).unwrap();
        for pigment in resolved.slots {
            let pigment = &library[pigment.expect("eight tubes")];
            assert!(pigment.identified, "{} can be mixed", pigment.name);
        }
    }

    #[test]
    fn another_library_opens_with_its_white_and_identified_pigments() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments.retain(|pigment| pigment.name != "Vermilion");
        library.pigments[3].identified = false;
        let Origin::Blank { script, .. } = blank_canvas(library, 20.0, 10.0, 0.1) else {
            panic!("a bare canvas");
        };
        let names: Vec<String> =
            script.palette.pigments.into_iter().map(|(_, name)| name).collect();
        let wanted = [
            "Zinc White",
            "Eosin Lake (wax)",
            "Eosin Lake",
            "Bone Black",
            "Cochineal Lake",
            "Minium",
            "Lead White",
            "Viridian",
        ];
        assert_eq!(names, wanted);
    }
}

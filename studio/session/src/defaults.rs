//! The painting that is there at once.

use std::collections::BTreeMap;

use pigment::library::PigmentLibrary;
use render::paint::brush::HeadShape;
use render::paint::ground::{GroundKind, GroundSpec};
use render::paint::strokes::{Action, BrushSpec, Canvas, Load, PaletteSpec, StrokeScript};

use super::command::{Command, Origin};

/// Squeezed out at first: white, a cool and a warm one of each primary, black.
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

/// The stand: name, shape and size in mm.
const STAND: [(&str, HeadShape, f64); 6] = [
    ("round", HeadShape::Round, 6.0),
    ("flat", HeadShape::Flat, 10.0),
    ("filbert", HeadShape::Filbert, 8.0),
    ("rigger", HeadShape::Rigger, 1.5),
    ("fan", HeadShape::Fan, 12.0),
    ("knife", HeadShape::Knife, 14.0),
];

/// The brushes that stand there at first.
#[must_use]
pub fn default_brushes() -> BTreeMap<String, BrushSpec> {
    let spec =
        |(name, shape, size_mm): (&str, _, _)| (name.to_owned(), BrushSpec { shape, size_mm });
    STAND.into_iter().map(spec).collect()
}

/// A wooden palette beside a canvas of cells of this width, 640 x 420 of them;
/// 64 x 42 mm beside the usual canvas.
#[must_use]
pub fn default_mixing_canvas(cell_mm: f64) -> Canvas {
    let ground = GroundKind::Wood.spec(1);
    let (width_mm, height_mm) = (640.0 * cell_mm, 420.0 * cell_mm);
    Canvas { width_mm, height_mm, cell_mm, ground }
}

/// A bare canvas, `width_mm` x `height_mm` of primed linen in cells of
/// `cell_mm`, with pigments of `library` and the usual brushes. The oils give
/// the tubes a painter would choose, any other library its white and the first
/// that can be mixed.
#[must_use]
pub fn blank_canvas(
    library: PigmentLibrary,
    width_mm: f64,
    height_mm: f64,
    cell_mm: f64,
) -> Origin {
    let mixed = library.pigments.iter().filter(|pigment| pigment.identified);
    let mut names: Vec<&str> = mixed.map(|pigment| pigment.name.as_str()).collect();
    names.sort_by_key(|name| Some(*name) != library.reference.as_deref());
    let tubes = if TUBES.iter().all(|tube| names.contains(tube)) {
        PaletteSpec::from_names(TUBES)
    } else {
        PaletteSpec::from_names(names.into_iter().take(TUBES.len()))
    };
    let canvas = Canvas { width_mm, height_mm, cell_mm, ground: GroundSpec::default() };
    let mut script = StrokeScript::new("untitled", "", canvas, tubes);
    script.library = Some(library.title.clone());
    script.mixing = Some(default_mixing_canvas(cell_mm));
    script.brushes = default_brushes();
    Origin::Blank { script: Box::new(script), library: Box::new(library) }
}

/// What a window asks for first: 1920 x 1080 cells of linen, 192 x 108 mm, and
/// the round brush loaded with blue.
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
    fn what_is_there_at_first_can_be_painted_with() {
        let mut commands = initial_commands().into_iter();
        let Some(Command::Open(Origin::Blank { mut script, library })) = commands.next() else {
            panic!("a canvas is taken up first");
        };
        for command in commands {
            let Command::Apply(action) = command else { panic!("then there are actions only") };
            script.actions.push(action);
        }
        assert_eq!(script.canvas.cells(), (1920, 1080));
        let resolved = script.resolve(&library).unwrap();
        for pigment in resolved.slots {
            let pigment = &library.pigments[pigment.expect("eight tubes")];
            assert!(pigment.identified, "{} can be mixed", pigment.name);
        }
    }

    #[test]
    fn another_library_opens_with_its_white_and_what_can_be_mixed() {
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

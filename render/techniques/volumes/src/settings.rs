//! The settings of paint volumes, their TOML files and presets.

use documents::counted;
use documents::text::{Checked, KeyPath, ValueFault};
use serde::{Deserialize, Serialize};
use toml::Table;

pub use documents::settings::SettingsError;
// The words of some settings are those of the modules that do the work.
pub use crate::drawing::{GreyWeights, MOST_SHELLS};
pub use crate::pigments::{FilmKind as Film, InsidePaint as Inside, UnderPainting as Under};

documents::settings! {
    /// The settings of paint volumes. Keys that a file leaves out have the defaults.
    pub struct Settings: File(shells_and_tints_fit) {
        unit_mm: f32 = 0.0, Number(0.0, 1e6), "mm" => "Length of a unit of the scene; 0 makes the scene's longest side 200 mm long";
        seed: u32 = 1, Whole(0, 4_294_967_295) => "Seed of everything random";
        [motion]: MotionTable => "forces on particles, and how fast volumes grow";
        [grid]: GridTable => "cells that paint spills over";
        [drawing]: DrawingTable => "colour inside of volumes";
        [hatching]: HatchingTable => "pencil strokes of light and shade";
        [light]: LightTable => "on the scene";
        [grey]: GreyTable => "outside of volumes";
        [picture]: PictureTable => "its samples and paper";
    }
}

documents::presets! {
    /// A shipped style with a name.
    pub enum Preset of Settings {
        Sketch = "sketch", "presets/sketch.toml" => "Sketch: a pencil drawing whose own colours return with a hard edge.";
        Washed = "washed", "presets/washed.toml" => "Washed: colour in four steps, which washes out towards the rim.";
        Tinted = "tinted", "presets/tinted.toml" => "Tinted: a drawing with a breath of colour, which glows at the core.";
        Grisaille = "grisaille", "presets/grisaille.toml" => "Grisaille: glazes of pigments over an underpainting in greys.";
        Bleed = "bleed", "presets/bleed.toml" => "Bleed: paint that frays along the grain of the surface.";
    }
}

impl Settings {
    /// A copy of these settings in which the keys of `changes` are replaced. Faults name keys
    /// below `base`.
    pub(crate) fn changed_by(
        &self,
        changes: &Table,
        base: &KeyPath,
    ) -> Result<Self, Box<ValueFault>> {
        documents::settings::changed_by(self, changes, base)
    }
}

documents::settings! {
    /// Forces on particles, per unit of mass, and how fast volumes grow.
    pub struct MotionTable {
        pressure: f32 = 400.0, Number(0.0, 1e6), "1/s^2" => "Force that keeps the radius of a volume around the desired one";
        elastic: f32 = 100.0, Number(0.0, 1e6), "1/s^2" => "Force that keeps particles close to their original places";
        cohesion: f32 = 200.0, Number(0.0, 1e6), "1/s^2" => "Force that makes particles follow their neighbours: little lets rims fray";
        friction: f32 = 40.0, Number(0.0, 1e4), "1/s" => "How soon oscillations end";
        kick: f32 = 0.3, Number(0.0, 100.0), "radii a second" => "Random push of the particles at birth and where paint is poured";
        microstructure: f32 = 0.18, Number(0.0, 0.9) => "How far the surface's microstructure dents the rim, by the radius";
        grain: f32 = 0.35, Number(0.01, 100.0), "cells" => "Width of the microstructure";
        fastest: f32 = 1.0, Number(0.001, 1000.0), "cells a second" => "Greatest speed at which a volume grows or shrinks";
        surface_pull: f32 = 50.0, Number(0.0, 1e6), "1/s^2" => "Force towards the surface on particles within a cell of it";
        gravity: f32 = 0.0, Number(0.0, 1e6), "cells/s^2" => "Pull downwards along the surface";
        keep: f32 = 2000.0, Number(0.0, 1e6), "1/s^2" => "Force of the walls of the regions that volumes are kept in";
    }
}

documents::settings! {
    /// Cells over the scene's surface, and how paint spills from one to the other.
    pub struct GridTable {
        cell: f32 = 0.083_333_3, Number(0.0, 1.0), "longest sides of the scene" => "Width of a cell; 0 is single volumes only";
        film_mm: f32 = 0.02, Number(1e-4, 100.0), "mm" => "Thickness of the film that a surface takes before paint spills further";
        rate: f32 = 0.04, Number(0.0, 0.067) => "Share of the difference between neighbouring cells that flows in a step of 1/120 s";
        slope: f32 = 0.0, Number(0.0, 1000.0) => "How much paint prefers to run down; 0 spreads alike to all sides";
        samples: u32 = 64, Whole(8, 1024) => "Samples of the surface in a cell, on average";
    }
}

documents::settings! {
    /// How volumes show what they hold.
    pub struct DrawingTable {
        shells: Vec<f32> = vec![1.0, 0.93, 0.86, 0.79], Numbers(0.01, 1.0) => "Sizes of a volume's concentric shells, falling; one shell has a hard edge";
        tint: Vec<f32> = Vec::new(), Numbers(0.0, 1.0) => "Share of colour in 0, 1, 2, ... shells, rising; [] takes even steps from 0 to 1";
        stain: String = "#ffffff".to_owned(), Color => "The drawing is multiplied by this colour inside of volumes, below its own colours; not in pigments";
        gate: f32 = -0.2, Number(-1.0, 1.0), "cosine" => "Surfaces that face away from those of their cell by more than this stay unpainted";
        inside: Inside = Inside::OwnColors, Words(&["own-colours", "glaze", "both"]) => "Volumes show the scene's own colours, a glaze of the poured pigments, or both";
        under: Under = Under::Grisaille, Words(&["grisaille", "own-colours", "none"]) => "Painting that lies under the glaze";
        neutral: bool = true, Switch => "Whether greys of the grisaille take a third paint against the cast of white and black";
        film: Film = Film::Surface, Words(&["surface", "through"]) => "The glaze lies on the surface, or is looked through along the eye ray";
        rim: f32 = 0.15, Number(0.0, 1.0), "radii" => "Width over which a film thins out";
        edge: f32 = 0.5, Number(0.0, 4.0) => "How much thicker a film dries near its rim";
    }
}

documents::settings! {
    /// Pencil hatching, which conveys the light.
    pub struct HatchingTable {
        inside: f32 = 1.0, Number(0.0, 1.0) => "Strength of pencil strokes inside of volumes";
        outside: f32 = 1.0, Number(0.0, 1.0) => "Strength of pencil strokes outside of volumes";
        along: StrokesAlong = StrokesAlong::Axes, Words(&["axes", "texture"]) => "Strokes are projected along the three axes, or follow the scene's texture coordinates";
        pencil: f32 = 0.15, Number(0.0, 1.0) => "Grey of the pencil: 0 is black, 1 is white";
        width_px: f32 = 2.8, Number(1.0, 16.0), "px" => "Width of a stroke, which varies by a third either way";
        softness: f32 = 0.12, Number(0.01, 0.15) => "Change of tone over which a stroke fades in: little draws a hard pencil";
        darkest: f32 = 0.15, Number(0.0, 1.0) => "Tone of the darkest shade; 0 leaves no paper between strokes";
        angle_deg: f32 = 32.0, Number(-360.0, 360.0), "degrees" => "Slant of the strokes, from the horizontal";
    }
}

/// Where strokes lie on surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StrokesAlong {
    /// Projected along the three axes, each where the surface faces it.
    #[default]
    Axes,
    /// Along the scene's own texture coordinates where these are useful.
    Texture,
}

documents::settings! {
    /// The light on the scene.
    pub struct LightTable {
        lit: bool = true, Switch => "Whether light falls on the scene";
        with: LightWith = LightWith::Camera, Words(&["camera", "model"]) => "The light moves with the camera or with the model";
        azimuth_deg: f32 = 315.0, Number(-360.0, 360.0), "degrees" => "Where the light stands, clockwise from the top";
        elevation_deg: f32 = 45.0, Number(-90.0, 90.0), "degrees" => "How high the light stands, towards the viewer";
        levels: u32 = 6, Whole(1, 16) => "Number of steps from shade to light";
        softness: f32 = 0.5, Number(0.0, 1.0) => "Share of a step over which it blends into the next";
        shade: f32 = 0.3, Number(0.0, 1.0) => "Share of its colour that a surface loses in full shade, beside the hatching";
    }
}

/// Whether the light moves with the camera or the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightWith {
    /// With the camera.
    #[default]
    Camera,
    /// With the model.
    Model,
}

documents::settings! {
    /// Grey outside of volumes.
    pub struct GreyTable {
        weights: GreyWeights = GreyWeights::Luminance, Words(&["luminance", "rec601"]) => "Grey is the luminance of a colour, or the weighted sum of Rec. 601";
        pale: f32 = 0.0, Number(0.0, 1.0) => "Share by which greys are lifted towards white paper; 0 is as light as the colour";
    }
}

documents::settings! {
    /// Samples and paper of the picture.
    pub struct PictureTable {
        samples: u32 = 2, Whole(1, 8) => "Samples along each side of a pixel: more smooth the rims of colour";
        paper: String = "#ffffff".to_owned(), Color => "Colour of the paper, where nothing is seen";
    }
}

/// Checks settings that belong together. Faults name keys below `base`.
fn shells_and_tints_fit(settings: &Settings, base: &KeyPath) -> Checked {
    let DrawingTable { shells, tint, .. } = &settings.drawing;
    check_shells(&base.key("drawing"), &as_written(shells), &as_written(tint))
}

/// Numbers with the digits that they have in a file.
fn as_written(list: &[f32]) -> Vec<f64> {
    list.iter()
        .map(|number: &f32| number.to_string().parse().unwrap_or_else(|_| f64::from(*number)))
        .collect()
}

/// Even steps from 0 to 1 for `shells` shells: the tint in no shell, in one, and so on.
#[must_use]
pub fn even_tints(shells: usize) -> Vec<f64> {
    (0..=shells).map(|count| count as f64 / shells.max(1) as f64).collect()
}

/// Checks shells and their tints. If there are no tints, they go in even steps. `table` is the path
/// of the table that holds both.
pub(crate) fn check_shells(table: &KeyPath, shells: &[f64], tints: &[f64]) -> Checked {
    fn list(numbers: &[f64]) -> String {
        let numbers: Vec<String> = numbers.iter().map(f64::to_string).collect();
        format!("[{}]", numbers.join(", "))
    }
    let key = table.key("shells");
    if !(1..=MOST_SHELLS).contains(&shells.len()) {
        let wanted = format!("1 to {MOST_SHELLS} sizes");
        return Err(ValueFault::new(&key, wanted, list(shells), "[1.0] is a single shell"));
    }
    let falling = shells.windows(2).all(|pair| pair[0] > pair[1]);
    if !(falling && shells.iter().all(|size| (0.01..=1.0).contains(size))) {
        let hint = "[1.0, 0.93, 0.86, 0.79] is usual";
        return Err(ValueFault::new(&key, "sizes that fall from 1 to 0.01", list(shells), hint));
    }
    let key = table.key("tint");
    let even = format!("{} is even, and so is []", list(&even_tints(shells.len())));
    if !tints.is_empty() && tints.len() != shells.len() + 1 {
        let wanted = format!("{} shares for {}", shells.len() + 1, counted(shells.len(), "shell"));
        return Err(ValueFault::new(&key, wanted, list(tints), even));
    }
    let rising = tints.windows(2).all(|pair| pair[0] <= pair[1]);
    if !(rising && tints.iter().all(|tint| (0.0..=1.0).contains(tint))) {
        return Err(ValueFault::new(&key, "shares that rise from 0 to 1", list(tints), even));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use documents::hint::Explain;
    use documents::settings::{Takes, differences, digest, rows};

    use super::*;

    #[test]
    fn presets_have_their_values_to_the_bit() {
        let digests = Preset::ALL.map(|preset| digest(&preset.settings()));
        let wanted = [
            0x1507_8e71_b524_fd4f,
            0x4908_2043_dfd2_4bf5,
            0x31a7_1209_3406_2b61,
            0x8b8d_970b_d122_aa46,
            0xff1a_3602_aefa_e8e0,
        ];
        assert_eq!(digests, wanted);
        for preset in Preset::ALL {
            let settings = preset.settings();
            assert_eq!(Settings::from_toml("again", &preset.text()).unwrap(), settings);
            let changes = differences(&settings, &Settings::default());
            assert_eq!(preset.changes().split_once('\n').map(|(_, rest)| rest), Some(&changes[..]));
            assert_eq!(preset.name().parse::<Preset>().unwrap(), preset);
        }
        let [sketch, washed, tinted, grisaille, bleed] = Preset::ALL.map(Preset::settings);
        assert_eq!((sketch.drawing.shells.len(), washed.drawing.shells.len()), (1, 4));
        assert_eq!(tinted.drawing.tint.last(), Some(&1.0));
        assert_eq!(grisaille.drawing.inside, Inside::Glaze);
        assert!(bleed.motion.microstructure > 2.0 * sketch.motion.microstructure);
        assert!(bleed.motion.cohesion < sketch.motion.cohesion / 2.0);
    }

    #[test]
    fn defaults_are_those_of_the_literature() {
        let Settings { motion, grid, drawing, hatching, light, .. } = Settings::default();
        let forces = [motion.pressure, motion.elastic, motion.cohesion, motion.friction];
        assert_eq!(forces, [400.0, 100.0, 200.0, 40.0]);
        assert_eq!([motion.kick, motion.microstructure, motion.grain], [0.3, 0.18, 0.35]);
        assert_eq!([motion.surface_pull, motion.gravity, motion.keep], [50.0, 0.0, 2000.0]);
        assert!((grid.cell - 1.0 / 12.0).abs() < 1e-6);
        assert_eq!([grid.film_mm, grid.rate, grid.slope], [0.02, 0.04, 0.0]);
        assert_eq!(drawing.shells, [1.0, 0.93, 0.86, 0.79]);
        assert_eq!([drawing.rim, drawing.edge, drawing.gate], [0.15, 0.5, -0.2]);
        assert_eq!((hatching.pencil, light.levels, grid.samples), (0.15, 6, 64));
        Settings::default().valid().unwrap();
    }

    #[test]
    fn values_beyond_both_ends_of_a_range_are_refused_with_line_and_key() {
        for (key, row) in rows::<Settings>() {
            let values = match row.takes {
                Takes::Number(least, most) => {
                    vec![format!("{}", least - 1.0), format!("{}", most * 1.01)]
                }
                Takes::Numbers(least, most) => {
                    vec![
                        format!("[{}]", least - 1.0),
                        format!("[{}]", most + 0.1),
                        "[nan]".to_owned(),
                    ]
                }
                Takes::Whole(_, most) => vec!["-1".to_owned(), format!("{}", most + 1)],
                Takes::Words(_) => vec!["\"other\"".to_owned()],
                Takes::Switch => vec!["1".to_owned()],
                Takes::Color => vec!["\"white\"".to_owned()],
                _ => unreachable!("{key} has no such values"),
            };
            for value in values.iter().map(String::as_str).chain(["{}", "nan"]) {
                let text = format!("\n{} = {value}", key);
                let error = Settings::from_toml("s.toml", &text).unwrap_err();
                let start = format!("s.toml, line 2: {}", key);
                assert!(error.to_string().starts_with(&start), "{text}: {error}");
                assert!(error.hint().is_some(), "{text}");
            }
        }
    }

    #[test]
    fn the_ends_of_ranges_are_taken() {
        for (key, row) in rows::<Settings>() {
            let values = match row.takes {
                Takes::Number(least, most) => vec![format!("{least}"), format!("{most}")],
                Takes::Whole(least, most) => vec![least.to_string(), most.to_string()],
                Takes::Words(words) => words.iter().map(|word| format!("\"{word}\"")).collect(),
                Takes::Switch => vec!["true".to_owned(), "false".to_owned()],
                Takes::Color => vec!["\"#fbf9f4\"".to_owned()],
                _ => vec![],
            };
            for value in values {
                let text = format!("{} = {value}", key);
                let settings = Settings::from_toml("s.toml", &text);
                assert!(settings.is_ok(), "{text}: {settings:?}");
            }
        }
    }

    #[test]
    fn faults_of_a_file_name_line_key_and_way_out() {
        let sketch = Preset::Sketch.settings();
        for (text, wanted, hint) in [
            (
                "motion.frction = 3",
                "mine, line 1: motion.frction: unknown key `frction`",
                "did you mean friction?",
            ),
            (
                "[motions]\nkick = 3",
                "mine, line 1: motions: unknown key `motions`",
                "did you mean motion?",
            ),
            (
                "\n[grey]\nweights = \"rec602\"",
                "mine, line 3: grey.weights: unknown word `rec602`",
                "did you mean rec601?",
            ),
            ("[grid]\ncell = \"wide\"", "mine, line 2: grid.cell: invalid type", "0.0833333 is"),
            ("[grid\ncell = 1", "mine, line 1: ", "a line of TOML"),
            ("seed = 1\nseed = 2", "mine, line 2: duplicate key", "a line of TOML"),
            (
                "drawing.tint = [1.0, 0.0]",
                "mine, line 1: drawing.tint takes shares that rise",
                "[0, 1] is even",
            ),
            (
                "drawing.tint = [0.0]",
                "mine, line 1: drawing.tint takes 2 shares for 1 shell",
                "[0, 1] is even",
            ),
            (
                "drawing.shells = [0.8, 0.9]",
                "mine, line 1: drawing.shells takes sizes that fall",
                "[1.0, 0.93",
            ),
        ] {
            let error = sketch.changed("mine", text).unwrap_err();
            assert!(error.to_string().starts_with(wanted), "{error}");
            let found = error.hint().unwrap().to_string();
            assert!(found.starts_with(hint), "{text}: {found}");
        }
        let error = "washd".parse::<Preset>().unwrap_err();
        assert_eq!(error.to_string(), "there is no preset `washd`");
        assert_eq!(error.hint().unwrap().to_string(), "did you mean washed?");
    }

    #[test]
    fn changes_keep_what_they_do_not_name() {
        let bleed = Preset::Bleed.settings();
        assert_eq!(bleed.changed("none", "").unwrap(), bleed);
        let text = "motion.kick = 2\ndrawing.shells = [1.0, 0.5]\ndrawing.tint = []\nunit_mm = 50";
        let changed = bleed.changed("some", text).unwrap();
        assert_eq!((changed.motion.kick, changed.unit_mm), (2.0, 50.0));
        assert_eq!(changed.motion.cohesion, bleed.motion.cohesion);
        let mut back = changed;
        back.motion.kick = bleed.motion.kick;
        back.drawing = bleed.drawing.clone();
        back.unit_mm = bleed.unit_mm;
        assert_eq!(back, bleed);
    }

    #[test]
    fn tints_rise_and_shells_fall() {
        fn check(shells: &[f64], tints: &[f64]) -> Result<(), String> {
            check_shells(&KeyPath::of("drawing"), shells, tints).map_err(|fault| fault.to_string())
        }
        assert_eq!(even_tints(4), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(check(&[1.0, 0.9], &[]), Ok(()));
        assert_eq!(check(&[1.0, 0.9], &[0.0, 1.0, 1.0]), Ok(()));
        for (shells, tints, wanted) in [
            (&[][..], &[][..], "drawing.shells takes 1 to 63 sizes, found `[]`"),
            (&[0.9, 1.0], &[], "drawing.shells takes sizes that fall"),
            (&[1.0, f64::NAN], &[], "drawing.shells takes sizes that fall"),
            (&[1.0, 0.001], &[], "drawing.shells takes sizes that fall"),
            (&[1.0], &[0.0, 0.5, 1.0], "drawing.tint takes 2 shares for 1 shell"),
            (&[1.0], &[1.0, 0.0], "drawing.tint takes shares that rise"),
            (&[1.0], &[0.0, f64::NAN], "drawing.tint takes shares that rise"),
        ] {
            let fault = check(shells, tints).unwrap_err();
            assert!(fault.starts_with(wanted), "{fault}");
        }
    }
}

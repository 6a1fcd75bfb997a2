//! The settings of watercolor, their TOML files and presets.

use documents::settings::Table;
use paint::ground::PaperFinish;
use serde::{Deserialize, Serialize};

pub use documents::settings::SettingsError;

documents::settings! {
    /// The style of a watercolor. Keys that a file leaves out have the defaults.
    pub struct Settings: File {
        reference_px: f32 = 1000.0, Number(16.0, 65536.0), "px" => "Lengths in px are those of a picture whose longer side has this many px; in larger and smaller pictures they change in proportion";
        [abstraction]: AbstractionSettings => "flat regions of photographs";
        [tones]: ToneSettings => "darks and reserved whites of photographs";
        [wet]: WetSettings => "photographs: washes that run into their neighbours";
        [margin]: MarginSettings => "photographs: bare paper around the painting";
        [back_runs]: BackRunSettings => "photographs: blooms of water in a drying wash";
        [toon]: ToonSettings => "light and shade of meshes";
        [wash]: WashSettings => "water in the paint";
        [wobble]: WobbleSettings => "edges that follow the grain";
        [edges]: EdgeSettings => "pigment carried to the rim of a wash";
        [flow]: FlowSettings => "clouds of a wet wash";
        [dispersion]: DispersionSettings => "grains of pigment";
        [paper]: PaperSettings => "the paper and its grain";
        [dry_brush]: DryBrushSettings => "a brush that touches the heights of the paper only";
        [coherence]: CoherenceSettings => "noise while a mesh moves";
    }
}

documents::presets! {
    /// A shipped style with a name.
    pub enum Preset of Settings {
        Portrait = "portrait", "presets/portrait.toml" => "Portrait: soft light and fine grain; edges stay where they are.";
        Landscape = "landscape", "presets/landscape.toml" => "Landscape: wet clouds on rough paper, a dry brush over it.";
        Sketch = "sketch", "presets/sketch.toml" => "Sketch: few colours, strong edges, much bare paper.";
    }
}

impl Settings {
    /// The settings for a picture of `width` x `height` pixels: all lengths are scaled from
    /// the reference to its pixels. Applying this twice changes nothing. Scaled lengths may be
    /// outside of the documented ranges, which hold for the reference.
    #[must_use]
    pub fn for_size(&self, width: usize, height: usize) -> Self {
        let longer = width.max(height).max(1) as f32;
        let mut scaled = self.clone();
        scaled.scale(longer / self.reference_px);
        scaled.reference_px = longer;
        scaled
    }
}

documents::settings! {
    /// Abstraction of photographs: mean-shift segmentation, then morphological opening and closing.
    pub struct AbstractionSettings {
        spatial_px: f32 = 8.0, Number(1.0, 128.0), "px", Length => "Details up to this radius merge";
        range_luv: f32 = 8.0, Number(1.0, 100.0), "CIELUV" => "Colours up to this difference merge";
        tone_luv: f32 = 25.0, Number(0.0, 200.0), "CIELUV" => "Gradients are laid in steps of about this; 0 lays each in one";
        least_region_px: f32 = 40.0, Number(0.0, 1e6), "px", Area => "Regions of less area than this join a neighbour";
        brush_px: f32 = 5.0, Number(0.0, 128.0), "px", Length => "Width of the brush that smooths outlines by opening and closing; 0 smooths none";
    }
}

documents::settings! {
    /// Tones of a photograph in paint: how dark black is, and what stays bare paper.
    pub struct ToneSettings {
        dark: String = "#2b2a33".to_owned(), Color => "Colour that black is painted in; lighter colours follow in proportion, white stays";
        reserve: f32 = 0.93, Number(0.0, 1.0) => "From where on light colours (the least of red, green and blue) stay bare paper; halfway to 1 all is bare, 1 reserves nothing";
    }
}

documents::settings! {
    /// Wet-in-wet: washes that run into their neighbours.
    pub struct WetSettings {
        tone_px: f32 = 40.0, Number(0.0, 256.0), "px", Length => "Over how much the steps of a gradient run together, where the photograph has no outline; 0 keeps them apart";
        amount: f32 = 0.25, Number(0.0, 1.0) => "Share of weak outlines that are painted wet";
        reach_px: f32 = 14.0, Number(0.0, 256.0), "px", Length => "How far colours run there";
        seed: u64 = 1, Any => "The same seed, the same wet places";
    }
}

documents::settings! {
    /// A ragged margin of bare paper.
    pub struct MarginSettings {
        width_px: f32 = 22.0, Number(0.0, 1000.0), "px", Length => "Its mean width; 0 paints to the borders";
        ragged_px: f32 = 12.0, Number(0.0, 500.0), "px", Length => "How far strokes end before or after that";
        seed: u64 = 1, Any => "The same seed, the same margin";
    }
}

documents::settings! {
    /// Back-runs: water that flows back into a drying wash, pale blooms with a dark crinkled rim.
    pub struct BackRunSettings {
        strength: f32 = 0.5, Number(0.0, 5.0) => "How much density changes; 0 has no blooms";
        size_px: f32 = 220.0, Number(2.0, 4096.0), "px", Length => "Width of the largest blooms";
        share: f32 = 0.3, Number(0.0, 1.0) => "Share of the places for a bloom that have one";
        seed: u64 = 1, Any => "The same seed, the same blooms";
    }
}

documents::settings! {
    /// Toon shading of meshes: light in a few steps.
    pub struct ToonSettings {
        levels: u32 = 4, Whole(1, 16) => "Steps from shade to light; 1 is flat colour";
        greys: Option<String> = None, Text => "Greys from shade to light from a picture's middle row, instead of steps", like "greys.png";
        strength: f32 = 1.6, Number(0.0, 5.0) => "How much thicker paint is in the shade";
        shadow: f32 = 0.9, Number(0.0, 1.0) => "How dark cast shadows are; 1 as the shade, 0 casts none";
        shadow_color as "shadow_colour": String = "#b3aecb".to_owned(), Color => "Colour of cast shadows, a glaze over the paint, so that white surfaces have shadows too";
        softness: f32 = 0.15, Number(0.0, 1.0) => "Share of a step over which it runs into the next";
        smoothing_rounds: u32 = 4, Whole(0, 1000) => "How often normals are averaged over their neighbours";
        light_azimuth_deg: f32 = 315.0, Number(-360.0, 360.0), "degrees" => "Where the light stands, clockwise from the top";
        light_elevation_deg: f32 = 40.0, Number(0.0, 90.0), "degrees" => "How high the light stands, towards the viewer";
    }
}

documents::settings! {
    /// Amount of pigment in the water.
    pub struct WashSettings {
        density: f32 = 0.8, Number(0.0, 4.0) => "Density of all paint: 1 as the colours are, less is paler, 2 is two glazes";
    }
}

documents::settings! {
    /// Displacement of the picture by the grain of the paper, which makes edges uneven.
    pub struct WobbleSettings {
        amount_px: f32 = 1.0, Number(0.0, 50.0), "px", Length => "How far the picture is displaced, root mean square";
    }
}

documents::settings! {
    /// Edge darkening: pigment carried to the rim of a wash.
    pub struct EdgeSettings {
        strength: f32 = 3.0, Number(0.0, 10.0) => "What density gains where black meets white; 0 darkens nothing";
        width_px: f32 = 1.0, Number(0.0, 20.0), "px", Length => "Blur (standard deviation) before edges are looked for: wider edges are paler";
    }
}

documents::settings! {
    /// Turbulent flow: large clouds of pigment in a wet wash.
    pub struct FlowSettings {
        strength: f32 = 1.0, Number(0.0, 5.0) => "How much density changes";
        size_px: f32 = 240.0, Number(2.0, 4096.0), "px", Length => "Width of the largest clouds";
        octaves: u32 = 5, Whole(1, 8) => "Sizes of clouds, each half as wide as the one before";
        seed: u64 = 1, Any => "The same seed, the same clouds";
    }
}

documents::settings! {
    /// Pigment dispersion: fine grains of pigment that flocculates.
    pub struct DispersionSettings {
        strength: f32 = 0.35, Number(0.0, 5.0) => "How much density changes";
        finest_px: f32 = 0.5, Number(0.1, 64.0), "px", Length => "Width of the finest grains";
        scales: u32 = 3, Whole(1, 6) => "Sizes of grains, each twice as wide as the one before";
        seed: u64 = 1, Any => "The same seed, the same grains";
    }
}

documents::settings! {
    /// The paper under the picture.
    pub struct PaperSettings {
        kind: PaperFinish = PaperFinish::ColdPressed, Words(&["cold-pressed", "rough", "hot-pressed"]) => "How it was made";
        scan: Option<String> = None, Text => "Heights from a picture instead, white the highest", like "paper.png";
        scan_scale: f32 = 1.0, Number(0.05, 20.0), "px", Length => "How wide a pixel of that picture is";
        seed: u64 = 1, Any => "The same seed, the same paper";
        strength: f32 = 0.5, Number(0.0, 5.0) => "How much more pigment settles in hollows";
        grain_px: f32 = 4.5, Number(1.0, 512.0), "px", Length => "Width of the usual bump of cold-pressed paper; rough has wider ones";
        color as "colour": String = "#fbf9f4".to_owned(), Color => "Its colour";
        relief: f32 = 0.02, Number(0.0, 1.0) => "How much light from the upper left shows the grain";
    }
}

documents::settings! {
    /// A dry brush, which touches only the high parts of the paper.
    pub struct DryBrushSettings {
        amount: f32 = 0.0, Number(0.0, 1.0) => "Share of the paper that stays bare";
        softness: f32 = 0.1, Number(0.001, 0.5) => "Over how much of the paper's height paint fades out";
        patches: f32 = 1.0, Number(0.0, 1.0) => "How much of it is kept to patches: at 0 everywhere alike, at 1 where the wash is thin";
        streaks: f32 = 0.7, Number(0.0, 1.0) => "How much streaks along the strokes decide, and how little the grain";
        direction_deg: f32 = 15.0, Number(-360.0, 360.0), "degrees" => "Direction of the strokes, counterclockwise from the right";
        length_px: f32 = 90.0, Number(1.0, 4096.0), "px", Length => "Length of the streaks";
        outline_px: f32 = 6.0, Number(0.0, 50.0), "px", Length => "How far the brush keeps from outlines; 0 passes over them";
        darkest: f32 = 0.2, Number(0.0, 1.0) => "Washes up to this value (mean of red, green and blue) are laid wet, lighter ones less and less; 0 is not a limit";
        color as "colour": Option<String> = None, Color => "Only where the wash is of about this colour", like "#506a8c";
        tolerance: f32 = 25.0, Number(1.0, 200.0), "CIELAB" => "How far from that colour";
    }
}

documents::settings! {
    /// Temporal coherence: noise of flow and dispersion while a mesh moves.
    pub struct CoherenceSettings {
        method: CoherenceMethod = CoherenceMethod::Features, Words(&["static", "particles", "features"]) => "What noise holds on to";
        particles: u32 = 6, Whole(1, 256) => "How many particles an object has";
        octaves: u32 = 4, Whole(1, 8) => "Octaves of the infinite zoom, and of features";
        feature_px: f32 = 6.0, Number(1.0, 256.0), "px", Length => "Width of the finest feature";
        features_per_place: f32 = 4.0, Number(0.1, 64.0) => "Features over each place of the object";
    }
}

/// Anchoring of the noise of flow and dispersion while a mesh moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CoherenceMethod {
    /// Fixed to the screen (the shower-door effect).
    Static,
    /// Textures attached to a few particles of the mesh.
    Particles,
    /// Each feature of the noise is a quad attached to a point of the mesh.
    #[default]
    Features,
}

#[cfg(test)]
mod tests {
    use documents::settings::{differences, digest};

    use super::{Preset, Settings};

    #[test]
    fn presets_have_their_values_to_the_bit() {
        let digests = Preset::ALL.map(|preset| digest(&preset.settings()));
        assert_eq!(digests, [0xa272_d298_0507_b2d2, 0x77f3_293e_6150_d2dc, 0xf780_4127_de2e_0d0d]);
        for preset in Preset::ALL {
            let text = preset.text();
            assert_eq!(Settings::from_toml("again", &text).unwrap(), preset.settings());
            let changes = differences(&preset.settings(), &Settings::default());
            assert_eq!(preset.changes().split_once('\n').map(|(_, rest)| rest), Some(&changes[..]));
        }
    }

    #[test]
    fn settings_that_are_not_named_stay() {
        let sketch = Preset::Sketch.settings();
        assert_eq!(sketch.changed("none", "").unwrap(), sketch);
        let text = "[paper]\nseed = 7\n[dry_brush]\ncolour = \"#102030\"";
        let changed = sketch.changed("some", text).unwrap();
        assert_eq!((changed.paper.seed, changed.dry_brush.color.as_deref()), (7, Some("#102030")));
        let mut back = changed;
        back.paper.seed = sketch.paper.seed;
        back.dry_brush.color.clone_from(&sketch.dry_brush.color);
        assert_eq!(back, sketch);
    }

    #[test]
    fn errors_name_the_line_of_the_text() {
        let sketch = Preset::Sketch.settings();
        for (text, wanted) in [
            ("\nedges.strength = 99", "mine, line 2: edges.strength takes 0 to 10, found `99`"),
            ("edges.stronger = 1", "mine, line 1: edges.stronger: unknown key `stronger`"),
            ("edges = ", "mine, line 1"),
        ] {
            let error = sketch.changed("mine", text).unwrap_err().to_string();
            assert!(error.starts_with(wanted), "{error}");
        }
    }
}

//! The settings of painterly rendering, their TOML files and presets.

use artmap::map::Between;
use documents::settings::Table;
use graphics::mesh::Along;
use graphics::smoothstep;
use serde::{Deserialize, Serialize};

pub use documents::settings::SettingsError;

documents::settings! {
    /// The style in which a map is painted on a model. Keys that a file leaves out have the defaults.
    pub struct Settings: File {
        reference_px: f32 = 1000.0, Number(16.0, 65536.0), "px" => "Lengths in px are those of a picture whose longer side has this many px; in larger and smaller pictures they change in proportion";
        [strokes]: StrokeSettings => "their size, direction and place on the model";
        [overlap]: OverlapSettings => "how strokes that cover a place share it";
        [layers]: LayerSettings => "strokes of several sizes";
        [light]: LightSettings => "chooses the tone of each stroke";
        [color as "colour"]: ColorSettings => "of strokes";
        [silhouette]: SilhouetteSettings => "strokes along outlines";
        [flow]: FlowSettings => "strokes that move along the surface";
        [picture]: PictureSettings => "with a depth";
    }
}

documents::presets! {
    /// A shipped style with a name.
    pub enum Preset of Settings {
        Impressionist = "impressionist", "presets/impressionist.toml" => "Impressionist: short strokes along the form, each seen.";
        Pointillist = "pointillist", "presets/pointillist.toml" => "Pointillist: separate round touches, close together.";
        Knife = "knife", "presets/knife.toml" => "Knife: broad slabs with hard edges, smaller ones where they are needed.";
        Hatching = "hatching", "presets/hatching.toml" => "Hatching: fine lines around the form.";
        Fur = "fur", "presets/fur.toml" => "Fur: thin long strokes that lie along the form.";
        Night = "night", "presets/night.toml" => "Night: long strokes that swirl, flow and twinkle in a loop.";
        Paper = "paper", "presets/paper.toml" => "Paper: as Yan, Chi, Lee and Lin published it in 2008.";
    }
}

impl Preset {
    /// Name of the style of samples that suits the preset
    /// ([`Style::named`](artmap::painted::Style::named)).
    #[must_use]
    pub fn style(self) -> &'static str {
        match self {
            Self::Paper | Self::Impressionist => "oil-flat",
            Self::Hatching => "hatching",
            Self::Pointillist => "dabs",
            Self::Knife => "knife",
            Self::Fur | Self::Night => "oil-long",
        }
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

    /// The settings of one layer, counted from the lowest: smaller strokes on each. Only the
    /// uppermost has outlines.
    pub(crate) fn of_layer(&self, layer: u32) -> Self {
        let mut layered = self.clone();
        layered.strokes.scale(self.layers.ratio.powi(layer as i32));
        layered.strokes.seed = self.strokes.seed.wrapping_add(u64::from(layer) << 32);
        if layer + 1 < self.layers.count {
            layered.silhouette.width_px = 0.0;
        }
        layered
    }
}

documents::settings! {
    /// Strokes: their size, direction and place on the model.
    pub struct StrokeSettings {
        width_px: f32 = 10.0, Number(1.0, 200.0), "px", Length => "Distance of neighbouring brush strokes";
        radius: f32 = 1.5, Number(0.5, 8.0) => "Half the width of a splat, in distances of brush strokes";
        stretch: f32 = 1.6, Number(1.0, 4.0) => "Length of a splat by its width";
        along: StrokeDirection = StrokeDirection::Least, Words(&["least", "greatest"]) => "The curvature that strokes run along";
        smoothing: f32 = 0.05, Number(0.0, 1.0) => "Length over which directions are smoothed, by the model's radius";
        tilt: f32 = 0.6, Number(0.0, 1.0) => "0 keeps strokes flat on the canvas, 1 lays them down on the surface";
        zoom: Zoom = Zoom::Screen, Words(&["screen", "surface"]) => "What stays as the model comes nearer: strokes on the screen, or on the surface";
        seed: u64 = 1, Any => "Other places for the strokes";
    }
}

impl StrokeSettings {
    /// Half the width and half the length of a splat, in px.
    pub(crate) fn radii_px(&self) -> [f32; 2] {
        let across = self.width_px * self.radius;
        [across, across * self.stretch]
    }
}

/// The principal curvature that strokes run along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StrokeDirection {
    /// The least: along a branch.
    #[default]
    Least,
    /// The greatest: around a branch.
    Greatest,
}

impl From<StrokeDirection> for Along {
    fn from(direction: StrokeDirection) -> Self {
        match direction {
            StrokeDirection::Least => Self::Least,
            StrokeDirection::Greatest => Self::Greatest,
        }
    }
}

/// The property of strokes that stays the same as the model comes nearer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Zoom {
    /// Size and density of strokes in the picture.
    #[default]
    Screen,
    /// Size and density of strokes on the model, so that strokes grow (Yan and others 2008).
    Surface,
}

documents::settings! {
    /// Overlap: how strokes that cover a place share it.
    pub struct OverlapSettings {
        splats: f32 = 8.0, Number(2.0, 32.0) => "How many splats reach a place, on average";
        sharpness: u32 = 4, OneOf(&[1, 2, 4, 8, 16]) => "1 blurs strokes into each other (Yan and others 2008), 16 ends each at an edge";
        ridges: f32 = 0.75, Number(0.0, 0.95) => "How far ridges of strokes lie above furrows where strokes overlap, so that strokes end in bristles; maps without relief have no ridges";
        fade: f32 = 1.0, Number(0.05, 1.0) => "Share of the splats that fade in or out as the model moves";
        offsets: Offsets = Offsets::Matched, Words(&["matched", "random"]) => "Strokes continue in their neighbours (matched), or begin anywhere (random)";
        overhang: f32 = 0.5, Number(0.0, 1.0) => "How far strokes reach beyond outlines";
    }
}

/// Where in the map a splat begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Offsets {
    /// Where the strokes of the splat continue the strokes of its neighbours.
    #[default]
    Matched,
    /// Anywhere (Yan and others 2008).
    Random,
}

documents::settings! {
    /// Layers of strokes, each of smaller strokes than the one below.
    pub struct LayerSettings {
        count: u32 = 1, Whole(1, 4) => "Number of layers";
        ratio: f32 = 0.5, Number(0.2, 0.9) => "Size of the strokes of a layer by that of the layer below";
        detail: f32 = 0.5, Number(0.0, 1.0) => "How readily smaller strokes show where a model bends or a picture has detail; 0 nowhere, 1 everywhere";
    }
}

impl LayerSettings {
    /// How much of a layer above the lowest shows, 0 to 1, where the detail is `amount` times what
    /// default settings let pass. It changes without a step.
    pub(crate) fn shown(&self, amount: f32) -> f32 {
        // Half of the way lets pass what is usual, the end nothing.
        let passed = (1.0 - self.detail) / self.detail.max(1e-6);
        if passed <= 0.0 {
            return 1.0;
        }
        smoothstep([0.5, 1.5], amount / passed)
    }
}

documents::settings! {
    /// Light, which chooses the tone of each stroke.
    pub struct LightSettings {
        tone: ToneSource = ToneSource::Auto, Words(&["auto", "light", "colour"]) => "The tone follows the light, or the lightness of the subject's own colour; auto: light on a model, the lightness of a picture";
        with: LightWith = LightWith::Camera, Words(&["camera", "model"]) => "The light moves with the camera or with the model";
        azimuth_deg: f32 = 315.0, Number(-360.0, 360.0), "degrees" => "Where the light stands, clockwise from the top";
        elevation_deg: f32 = 35.0, Number(-90.0, 90.0), "degrees" => "How high the light stands, towards the viewer (with the model: towards its +z axis)";
        wrap: f32 = 0.5, Number(0.0, 1.0) => "How far light reaches around the surface: 0 ends where it turns away, 1 at the far side";
        darkest: f32 = 0.0, Number(0.0, 1.0) => "Tone of the deepest shade, from the darkest tile of the map to the lightest";
        lightest: f32 = 1.0, Number(0.0, 1.0) => "Tone of the full light, from the darkest tile of the map to the lightest";
        smoothing_rounds: u32 = 2, Whole(0, 1000) => "How often normals are averaged over their neighbours";
        between: Between = Between::Dissolve, Words(&["dissolve", "blend"]) => "Tones between the tiles of the map dissolve stroke by stroke, or blend";
    }
}

/// The object that the light moves with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightWith {
    /// With the camera.
    #[default]
    Camera,
    /// With the model.
    Model,
}

/// Source of the tone of a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneSource {
    /// Light on a model, the lightness of a picture.
    #[default]
    Auto,
    /// Light.
    Light,
    /// The lightness of the subject's own colour.
    #[serde(rename = "colour")]
    Color,
}

documents::settings! {
    /// Colour of strokes.
    pub struct ColorSettings {
        from: ColorSource = ColorSource::Auto, Words(&["auto", "map", "model"]) => "Colours of the map, or of the model (or picture); auto: of the map on a model, the picture's own";
        space: ColorSpace = ColorSpace::Cielab, Words(&["cielab", "yuv"]) => "Where brushwork is added to the model's colours";
        lightness: f32 = 1.0, Number(0.0, 4.0) => "How much of the map's detail of lightness shows on the model's colours";
        chroma: f32 = 0.5, Number(0.0, 4.0) => "How much of the map's detail of chroma shows on the model's colours";
        statistics: f32 = 0.0, Number(0.0, 1.0) => "How far the spread of the map's colours becomes that of the model's (Reinhard and others 2001)";
    }
}

/// Where colours come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorSource {
    /// On a model, the colours of the map. On a picture, its own.
    #[default]
    Auto,
    /// The map's own colours.
    Map,
    /// Colours of the model or picture, with the brushwork of the map.
    Model,
}

/// The coordinates in which the brushwork of the map is added to the model's colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorSpace {
    /// CIELAB.
    #[default]
    Cielab,
    /// YUV (Rec. 601) of encoded sRGB (Yan and others 2008).
    Yuv,
}

documents::settings! {
    /// Strokes along outlines.
    pub struct SilhouetteSettings {
        width_px: f32 = 0.0, Number(0.0, 100.0), "px", Length => "Width of the lines; 0 draws none";
        darkness: f32 = 0.5, Number(0.0, 1.0) => "How much darker than the model they are, where colours are the model's";
    }
}

documents::settings! {
    /// Strokes that flow along the surface (equation 11 of Yan and others 2008).
    pub struct FlowSettings {
        periods: u32 = 0, Whole(0, 16) => "Lengths of the map by which strokes move in a loop; 0 stands still";
        loop_seconds: f32 = 4.0, Number(0.1, 3600.0), "seconds" => "Duration of a loop";
        noise: f32 = 0.0, Number(0.0, 4.0) => "Random offset of each splat, in distances of brush strokes: breaks strokes that continue in their neighbours";
        twinkle: f32 = 0.0, Number(0.0, 1.0) => "How much lighter and darker strokes become by turns, by the range of tones";
        twinkle_seconds: f32 = 2.0, Number(0.1, 3600.0), "seconds" => "Duration of one change to lighter and darker; a loop has a whole number of them";
    }
}

documents::settings! {
    /// How a picture of depth becomes a relief.
    pub struct PictureSettings {
        relief: f32 = 0.2, Number(0.0, 1.0) => "How far white stands before black, by the picture's longer side";
    }
}

#[cfg(test)]
mod tests {
    use documents::hint::Explain;
    use documents::settings::{differences, digest};

    use super::*;

    #[test]
    fn presets_have_their_values_to_the_bit() {
        let digests = Preset::ALL.map(|preset| digest(&preset.settings()));
        let wanted = [
            0x29f8_f0d9_89dc_b300,
            0x9e8a_574a_6de9_f43d,
            0x153a_c642_0fb1_e811,
            0x7a20_e118_96e0_48e0,
            0x25d7_8eeb_e096_6469,
            0x9c9f_6509_b071_86ac,
            0xf5a0_3c0b_e9fc_0133,
        ];
        assert_eq!(digests, wanted);
        for preset in Preset::ALL {
            let settings = preset.settings();
            assert_eq!(Settings::from_toml("again", &preset.text()).unwrap(), settings);
            let changes = differences(&settings, &Settings::default());
            assert_eq!(preset.changes().split_once('\n').map(|(_, rest)| rest), Some(&changes[..]));
            assert_eq!(preset.name().parse::<Preset>().unwrap(), preset);
            assert!(artmap::painted::Style::named(preset.style()).is_ok(), "{}", preset.style());
        }
    }

    #[test]
    fn settings_that_are_not_named_stay() {
        let paper = Preset::Paper.settings();
        assert_eq!(paper.changed("none", "").unwrap(), paper);
        let changed =
            paper.changed("some", "[strokes]\nseed = 7\n[overlap]\nsharpness = 8").unwrap();
        assert_eq!((changed.strokes.seed, changed.overlap.sharpness), (7, 8));
        let mut back = changed;
        back.strokes.seed = paper.strokes.seed;
        back.overlap.sharpness = paper.overlap.sharpness;
        assert_eq!(back, paper);
    }

    #[test]
    fn errors_name_the_line_of_the_text_or_the_preset_that_is_meant() {
        let paper = Preset::Paper.settings();
        for (text, wanted) in [
            ("\nlight.wrap = 2", "mine, line 2: light.wrap takes 0 to 1, found `2`"),
            ("[overlap]\nsharpness = 3", "mine, line 2: overlap.sharpness takes 1, 2, 4, 8 or 16"),
            ("strokes.wide = 1", "mine, line 1: strokes.wide: unknown key `wide`"),
            ("strokes = ", "mine, line 1"),
            ("[flow]\nperiods = 1\nperiods = 2", "mine, line 3: duplicate key"),
        ] {
            let error = paper.changed("mine", text).unwrap_err().to_string();
            assert!(error.starts_with(wanted), "{error}");
        }
        let unknown = "hatchng".parse::<Preset>().unwrap_err();
        assert_eq!(unknown.hint().unwrap().to_string(), "did you mean hatching?");
    }

    #[test]
    fn detail_shows_smaller_strokes_nowhere_to_everywhere() {
        let layers = |detail| LayerSettings { detail, ..LayerSettings::default() };
        assert_eq!(layers(0.0).shown(50.0), 0.0);
        assert_eq!(layers(1.0).shown(0.0), 1.0);
        assert_eq!((layers(0.5).shown(0.4), layers(0.5).shown(1.0)), (0.0, 0.5));
        assert!(layers(0.7).shown(0.7) > layers(0.5).shown(0.7));
    }
}

//! A palette in the plane of a* and b*: tubes, their tints, mixing lines and reach.

use spectra::color::{Lab, delta_e_ciede2000};

use super::gamut::{Boundary, Gamut, GamutSample, sampled_gamut, shares};
use super::mixing_chart::{TintLadder, tint_ladders};
use super::paints::Palette;
use crate::appearance::Appearance;
use crate::recipe::{PigmentId, Recipe};

/// Number of sectors of an outline.
const SECTORS: usize = 72;

/// Half of the range of L* whose mixtures count as of one lightness: mixtures are sampled, so a
/// narrower range would leave gaps.
const BAND: f64 = 5.0;

/// Colours of two paints mixed in all ratios.
#[derive(Debug, Clone, PartialEq)]
pub struct MixingLine {
    /// The two paints, in the library's order.
    pub pair: [PigmentId; 2],
    /// Share of the first paint and the colour, from the second paint alone to the first alone.
    pub colors: Vec<(f64, Appearance)>,
}

/// Everything that a chart of a palette in a* and b* shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorWheel {
    /// Colour of every paint alone, in the library's order.
    pub masstones: Vec<(PigmentId, Appearance)>,
    /// Tints of every paint but the white.
    pub tints: Vec<TintLadder>,
    /// Lines between every pair of paints.
    pub lines: Vec<MixingLine>,
    /// Mixtures of all kinds, with their colours.
    pub gamut: Gamut,
}

/// The mixture of a palette that comes nearest to a colour.
#[derive(Debug, Clone, PartialEq)]
pub struct NearestMixture<'a> {
    /// The sampled mixture.
    pub sample: &'a GamutSample,
    /// CIEDE2000 between the two. Mixtures between the sampled ones may come nearer.
    pub delta_e: f64,
}

/// Computes masstones, tints, mixing lines and gamut of a palette by Kubelka-Munk.
#[must_use]
pub fn color_wheel(palette: &Palette<'_>) -> ColorWheel {
    let masstone = |&paint: &PigmentId| (paint, palette.color(&Recipe::single(paint)));
    let line = |(first, second): (PigmentId, PigmentId)| {
        let color = |share: f64| {
            let parts = [(first, share), (second, 1.0 - share)];
            let mixed: Recipe = parts.into_iter().filter(|(_, part)| *part > 0.0).collect();
            (share, palette.color(&mixed))
        };
        let inner = shares().map(color);
        let colors = [color(0.0)].into_iter().chain(inner).chain([color(1.0)]).collect();
        MixingLine { pair: [first, second], colors }
    };
    ColorWheel {
        masstones: palette.paints().iter().map(masstone).collect(),
        tints: tint_ladders(palette),
        lines: palette.pairs().map(line).collect(),
        gamut: sampled_gamut(palette),
    }
}

impl ColorWheel {
    /// Outline of the mixtures whose L* is within 5 of `lightness`, or of all mixtures.
    #[must_use]
    pub fn region(&self, lightness: Option<f64>) -> Boundary {
        let range =
            lightness.map_or([f64::NEG_INFINITY, f64::INFINITY], |at| [at - BAND, at + BAND]);
        self.gamut.in_lab(range, SECTORS)
    }

    /// The sampled mixture nearest to `color`; `None` if there are no samples.
    #[must_use]
    pub fn nearest(&self, color: Lab) -> Option<NearestMixture<'_>> {
        let measured = self.gamut.samples.iter().map(|sample| NearestMixture {
            sample,
            delta_e: delta_e_ciede2000(color, sample.color.lab),
        });
        measured.min_by(|a, b| a.delta_e.total_cmp(&b.delta_e))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Cards;
    use super::*;
    use crate::evaluate::Viewing;
    use crate::library::PigmentLibrary;

    fn with_palette<T>(names: &[&str], use_palette: impl FnOnce(&Palette<'_>) -> T) -> T {
        let library = PigmentLibrary::van_gogh_oils();
        let viewing = Viewing::default();
        let ids: Vec<PigmentId> = names.iter().map(|name| library.find(name).unwrap()).collect();
        let palette = Palette::new(&library, &viewing, Cards::standard(library.grid)).unwrap();
        use_palette(&palette.among(&ids).unwrap())
    }

    fn distance(a: Lab, b: Lab) -> f64 {
        let squares = a.to_array().into_iter().zip(b.to_array()).map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>().sqrt()
    }

    #[test]
    fn masstones_lie_where_the_library_measures_them_and_lines_end_at_them() {
        with_palette(&["Zinc White", "Vermilion", "Ultramarine"], |palette| {
            let wheel = color_wheel(palette);
            let library = palette.library();
            assert_eq!((wheel.masstones.len(), wheel.lines.len(), wheel.tints.len()), (3, 3, 2));
            for (paint, found) in &wheel.masstones {
                let name = library[*paint].name.as_str();
                let wanted = library.color([(name, 1.0)], palette.viewing()).unwrap();
                assert!(distance(found.lab, wanted.lab) < 1e-6, "{name}: {found:?}");
            }
            let masstone =
                |paint| wheel.masstones.iter().find(|(of, _)| *of == paint).expect("a tube").1.lab;
            for MixingLine { pair: [first, second], colors } in &wheel.lines {
                let start = colors[0].1.lab;
                let end = colors[colors.len() - 1].1.lab;
                assert!(distance(start, masstone(*second)) < 1e-9, "{first:?} {second:?}");
                assert!(distance(end, masstone(*first)) < 1e-9, "{first:?} {second:?}");
                assert!(colors.windows(2).all(|two| two[0].0 < two[1].0), "shares rise");
            }
        });
    }

    #[test]
    fn a_line_is_curved_and_passes_the_mixtures_of_the_library() {
        with_palette(&["Zinc White", "Prussian Blue"], |palette| {
            let wheel = color_wheel(palette);
            let [line] = wheel.lines.as_slice() else { panic!("one pair") };
            let library = palette.library();
            let [first, second] = line.pair.map(|paint| library[paint].name.clone());
            for (share, found) in &line.colors[1..line.colors.len() - 1] {
                let parts = [(&first, *share), (&second, 1.0 - share)];
                let wanted = library.color(parts, palette.viewing()).unwrap();
                assert!(distance(found.lab, wanted.lab) < 1e-6, "{share}");
            }
            let chroma = |at: usize| line.colors[at].1.lab.to_lch().chroma;
            let most = (0..line.colors.len()).map(chroma).fold(0.0, f64::max);
            let ends = chroma(0).max(chroma(line.colors.len() - 1));
            assert!(most > ends + 10.0, "white brings the blue out: {most} over {ends}");
        });
    }

    #[test]
    fn greys_reach_a_thin_region_and_primaries_a_wide_one() {
        let area = |names: &[&str]| {
            with_palette(names, |palette| color_wheel(palette).region(None).area())
        };
        let greys = area(&["Zinc White", "Bone Black"]);
        let primaries = area(&["Zinc White", "Chrome Yellow", "Vermilion", "Ultramarine"]);
        assert!(greys < 60.0 && primaries > 2000.0, "{greys} and {primaries}");
    }

    #[test]
    fn a_region_of_one_lightness_holds_its_mixtures_only() {
        with_palette(&["Zinc White", "Vermilion", "Ultramarine"], |palette| {
            let wheel = color_wheel(palette);
            let kept = wheel.region(Some(60.0));
            let held: Vec<usize> = kept.sectors.iter().flatten().map(|(_, index)| *index).collect();
            assert!(!held.is_empty());
            for index in held {
                let lightness = wheel.gamut.samples[index].color.lab.lightness;
                assert!((55.0..=65.0).contains(&lightness), "{lightness}");
            }
            assert!(wheel.region(Some(60.0)).area() < wheel.region(None).area());
        });
    }

    #[test]
    fn a_mixture_is_found_again_and_a_colour_out_of_reach_is_far() {
        with_palette(&["Zinc White", "Vermilion", "Ultramarine"], |palette| {
            let wheel = color_wheel(palette);
            let mixed = &wheel.gamut.samples[100];
            let found = wheel.nearest(mixed.color.lab).unwrap();
            assert!(found.delta_e < 1e-9, "{found:?}");
            let green = Lab { lightness: 60.0, a: -60.0, b: 40.0 };
            assert!(wheel.nearest(green).unwrap().delta_e > 20.0, "no green without a yellow");
        });
    }
}

//! Numbers as a script holds them: what is painted by hand is rounded before it
//! is painted, so that its recording paints the same to the bit.

use pigment::digits;

use super::action::{Action, Load, Recipe, Squeeze, Stroke};
use super::rows::short;
use crate::document::Lighting;
use crate::optics::Gloss;
use crate::pose::Sample;

impl Action {
    /// The action with its numbers rounded as a file has them: samples to four
    /// decimals, all else to six digits. Written and read it stays as it is.
    #[must_use]
    pub fn rounded(&self) -> Self {
        match self {
            Self::Load(load) => Self::Load(Load {
                brush: load.brush.clone(),
                recipe: recipe(&load.recipe),
                vehicle: six(load.vehicle),
                amount_mm: six(load.amount_mm),
            }),
            Self::Stroke(stroke) => Self::Stroke(Stroke {
                brush: stroke.brush.clone(),
                on: stroke.on,
                samples: stroke.samples.iter().map(sample).collect(),
            }),
            Self::Wipe { brush, keep } => Self::Wipe { brush: brush.clone(), keep: six(*keep) },
            Self::Dry { fraction } => Self::Dry { fraction: six(*fraction) },
            Self::Light(lighting) => Self::Light(Lighting {
                azimuth_deg: six(lighting.azimuth_deg),
                elevation_deg: six(lighting.elevation_deg),
                ambient: six(lighting.ambient),
                relief: six(lighting.relief),
                ..lighting.clone()
            }),
            Self::Opacity { layer, value } => Self::Opacity { layer: *layer, value: six(*value) },
            Self::Squeeze(squeeze) => Self::Squeeze(Squeeze {
                on: squeeze.on,
                recipe: recipe(&squeeze.recipe),
                vehicle: six(squeeze.vehicle),
                x_mm: six(squeeze.x_mm),
                y_mm: six(squeeze.y_mm),
                volume_mm3: six(squeeze.volume_mm3),
            }),
            Self::Gloss { wet, dry } => Self::Gloss { wet: gloss(*wet), dry: gloss(*dry) },
            Self::Wash { .. }
            | Self::Palette(_)
            | Self::Undo {}
            | Self::Redo {}
            | Self::Swap { .. }
            | Self::Merge { .. }
            | Self::Scrape { .. }
            | Self::Save { .. } => self.clone(),
        }
    }
}

/// A sample as a file has it.
pub(crate) fn sample(sample: &Sample) -> Sample {
    Sample {
        seconds: short(sample.seconds),
        x_mm: short(sample.x_mm),
        y_mm: short(sample.y_mm),
        pressure: short(sample.pressure),
        tilt_x_deg: short(sample.tilt_x_deg),
        tilt_y_deg: short(sample.tilt_y_deg),
        twist_deg: short(sample.twist_deg),
    }
}

fn recipe(parts: &Recipe) -> Recipe {
    parts.iter().map(|(name, part)| (name.clone(), six(*part))).collect()
}

fn gloss(gloss: Gloss) -> Gloss {
    let six = |value: f32| six(f64::from(value)) as f32;
    Gloss { strength: six(gloss.strength), exponent: six(gloss.exponent) }
}

/// Six digits. The file knows no zero below zero.
pub(crate) fn six(value: f64) -> f64 {
    digits::rounded(value) + 0.0
}

#[cfg(test)]
mod tests {
    use super::super::{Canvas, LayerRef, PaletteSpec, StrokeScript, SurfaceId};
    use super::*;

    const ODD: f64 = 0.123_456_789_012;

    fn odd() -> Vec<Action> {
        let recipe = || Recipe::from([("Zinc White".to_owned(), 1.0 / 3.0), ("B".to_owned(), ODD)]);
        let sample = Sample {
            seconds: ODD,
            x_mm: -1e-5,
            y_mm: 100.0 / 3.0,
            pressure: 1.0 / 3.0,
            tilt_x_deg: -1e-9,
            tilt_y_deg: 1e-9,
            twist_deg: 359.999_99,
        };
        let brush = || "big".to_owned();
        let gloss = Gloss { strength: 0.06, exponent: 20.123_457 };
        vec![
            Action::Load(Load { brush: brush(), recipe: recipe(), vehicle: ODD, amount_mm: ODD }),
            Action::Stroke(Stroke {
                brush: brush(),
                on: SurfaceId::Palette,
                samples: vec![sample],
            }),
            Action::Wipe { brush: brush(), keep: 2.0 / 3.0 },
            Action::Dry { fraction: ODD },
            Action::Light(Lighting {
                azimuth_deg: -1e-12,
                elevation_deg: ODD,
                ambient: ODD,
                relief: 1.0 / 7.0,
                ..Lighting::default()
            }),
            Action::Opacity { layer: LayerRef::Dry(3), value: 1000.0 / 7.0 },
            Action::Squeeze(Squeeze {
                on: SurfaceId::Palette,
                recipe: recipe(),
                vehicle: ODD,
                x_mm: -1.0 / 7.0,
                y_mm: 123.456_789,
                volume_mm3: ODD,
            }),
            Action::Scrape { on: SurfaceId::Palette },
            Action::Gloss { wet: gloss, dry: gloss },
        ]
    }

    /// Equal to the bit: a zero below zero is another number.
    fn bits(action: &Action) -> String {
        format!("{action:?}")
    }

    #[test]
    fn what_was_rounded_is_read_as_it_was_written() {
        let canvas = || Canvas {
            width_mm: 100.0,
            height_mm: 80.0,
            cell_mm: 0.1,
            ground: crate::ground::GroundSpec::default(),
        };
        let mut script =
            StrokeScript::new("", "", canvas(), PaletteSpec::from_names(["Zinc White"]));
        script.mixing = Some(canvas());
        let big = super::super::BrushSpec { shape: crate::brush::HeadShape::Flat, size_mm: 3.0 };
        script.brushes.insert("big".to_owned(), big);
        script.actions = odd().iter().map(Action::rounded).collect();
        let text = script.to_json().expect("it is sound");
        let read = StrokeScript::from_json("a.json", text.as_bytes()).expect("it is sound");
        assert_eq!(read.actions.len(), script.actions.len());
        for (read, written) in read.actions.iter().zip(&script.actions) {
            assert_eq!(bits(read), bits(written));
            assert_eq!(bits(&read.rounded()), bits(read), "rounding again changes nothing");
        }
        for (odd, written) in odd().iter().zip(&script.actions) {
            let scrape = matches!(odd, Action::Scrape { .. });
            assert_eq!(bits(odd) == bits(written), scrape, "{odd:?} is rounded");
        }
    }
}

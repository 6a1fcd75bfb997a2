//! The paint that a tool took off a surface, in words for the painter.

use documents::hint::Hint;
use paint::painting::{Painting, TakenPaint};
use paint::strokes::StrokeTool;

/// Message after a stroke of `tool` that took `taken`, and advice or the parts of the paint in mm3.
/// Canvas and palette have the pigments of `canvas` in their slots.
pub(super) fn tally(
    tool: StrokeTool,
    taken: &TakenPaint,
    canvas: &Painting,
) -> (String, Option<Hint>) {
    let volumes = taken.volumes_mm3(canvas.cell_mm());
    let whole = volumes.iter().sum();
    if whole == 0.0 {
        let text = format!("there was no wet paint to {}", tool.name());
        return (text, Some(Hint::new("dry layers stay as they are")));
    }
    let what = match tool {
        StrokeTool::Blend { .. } => "wiped off the head",
        _ => "taken off",
    };
    let names = canvas
        .state()
        .slots
        .iter()
        .map(|slot| slot.map_or("", |pigment| canvas.library()[pigment].name.as_str()));
    let mut parts: Vec<(&str, f64)> = names.chain(["medium"]).zip(volumes).collect();
    parts.retain(|(_, mm3)| *mm3 >= 0.005 * whole);
    parts.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let parts: Vec<String> =
        parts.iter().map(|(name, mm3)| format!("{name} {}", three_digits(*mm3))).collect();
    let text = format!("{} mm3 of paint {what}", three_digits(whole));
    (text, Some(Hint::new(parts.join(", "))))
}

/// A volume with three significant digits, or with none after the point from 100 on.
fn three_digits(volume: f64) -> String {
    let digits = (2.0 - volume.log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{volume:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_have_three_digits() {
        for (volume, text) in [
            (1234.4, "1234"),
            (12.34, "12.3"),
            (12.0, "12"),
            (0.5, "0.5"),
            (0.012_34, "0.0123"),
            (1e-9, "0"),
        ] {
            assert_eq!(three_digits(volume), text);
        }
    }
}

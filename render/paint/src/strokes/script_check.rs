//! Checks of a whole script before it is played.

use documents::hint::Hint;

use super::action_limits::{
    ActionLimits, check_brush, check_gloss, check_light, check_palette, check_size,
};
use super::check_context::{CheckContext, Checked};
use super::error::ScriptError;
use super::limits::{MAX_ACTIONS, MAX_CELLS, MAX_SAMPLES};
use super::script::StrokeScript;
use crate::canvas::Canvas;
use crate::document::Medium;

impl StrokeScript {
    /// Checks that every number is in range and every brush is declared. Pigments are
    /// looked up by [`StrokeScript::resolve`].
    ///
    /// # Errors
    /// [`ScriptError::Invalid`] with action, sample and field.
    pub fn check(&self) -> Result<(), ScriptError> {
        Ok(self.check_values()?)
    }

    pub(super) fn check_values(&self) -> Checked {
        self.check_header()?;
        let mut samples = 0;
        if self.actions.len() > MAX_ACTIONS {
            let wanted = format!("at most {MAX_ACTIONS}");
            return Err(CheckContext::default().invalid(
                "actions",
                &wanted,
                &self.actions.len(),
                None,
            ));
        }
        let limits = self.limits();
        for (index, action) in self.actions.iter().enumerate() {
            let at = CheckContext::action(index, action.kind());
            if let Some(brush) = action.brush() {
                check_brush(&at, brush, self.brushes.keys().map(String::as_str))?;
            }
            limits.check(&at, action)?;
            if let Some(stroke) = action.stroke() {
                samples += stroke.samples.len();
            }
            if samples > MAX_SAMPLES {
                let wanted = format!("at most {MAX_SAMPLES} of all strokes so far");
                let hint = Hint::new("record fewer samples a second, or several scripts");
                return Err(at.invalid("samples", &wanted, &samples, Some(hint)));
            }
        }
        Ok(())
    }

    fn check_header(&self) -> Checked {
        let top = CheckContext::default();
        check_canvas("canvas", &self.canvas)?;
        if let Some(mixing) = &self.mixing {
            check_canvas("mixing", mixing)?;
            let cell_mm = self.canvas.cell_mm;
            if mixing.cell_mm != cell_mm {
                let hint = Some(Hint::new(format!("\"cell_mm\": {cell_mm}")));
                let wanted = format!("that of the canvas, {cell_mm}");
                return Err(top.invalid("mixing.cell_mm", &wanted, &mixing.cell_mm, hint));
            }
        }
        if let Some(start) = &self.start {
            check_start(start)?;
            let own = [("medium", self.medium.is_some()), ("lighting", self.lighting.is_some())];
            if let Some((field, _)) = own.iter().find(|(_, given)| *given) {
                let wanted = "left out with `start`: that painting has its own";
                return Err(top.invalid(
                    field,
                    wanted,
                    &"both",
                    Some(Hint::new(format!("leave `{field}` out"))),
                ));
            }
        }
        if self.table && (self.start.is_none() || self.mixing.is_none()) {
            let hint = Some(Hint::new("name the painting as `start`, and describe `mixing`"));
            return Err(top.invalid("table", "only with `start` and `mixing`", &true, hint));
        }
        if let Some(medium) = &self.medium {
            check_medium(medium)?;
        }
        if let Some(lighting) = &self.lighting {
            check_light(&top, "lighting.", lighting)?;
        }
        check_palette(&top, &self.palette)?;
        for (name, brush) in &self.brushes {
            check_size(&top, &format!("brushes.{name}.size_mm"), brush.size_mm)?;
        }
        Ok(())
    }

    /// Limits of the script's actions.
    pub(crate) fn limits(&self) -> ActionLimits {
        ActionLimits {
            canvas_mm: self.canvas.longer_side_mm(),
            palette_mm: self.mixing.as_ref().map(Canvas::longer_side_mm),
        }
    }
}

fn check_canvas(key: &str, canvas: &Canvas) -> Checked {
    let at = CheckContext::default();
    at.range(&format!("{key}.cell_mm"), canvas.cell_mm, 0.001, 10.0)?;
    for (field, side) in [("width_mm", canvas.width_mm), ("height_mm", canvas.height_mm)] {
        at.range(&format!("{key}.{field}"), side, 0.001, 1e6)?;
    }
    let (width, height) = canvas.cells();
    if (width as u64).saturating_mul(height as u64) > MAX_CELLS {
        let wanted = format!("at most {MAX_CELLS} cells, which take 6 GB");
        let least = (canvas.width_mm * canvas.height_mm / MAX_CELLS as f64).sqrt();
        let cell_mm = (least * 1000.0).ceil() / 1000.0 + 0.001;
        let hint = Hint::new(format!("\"cell_mm\": {cell_mm:.3}"));
        return Err(at.invalid(key, &wanted, &format!("{width} x {height}"), Some(hint)));
    }
    Ok(())
}

/// Checks the path of the painting that a script continues. Like the path of a library, it
/// may lead to any folder.
fn check_start(path: &str) -> Checked {
    let fits = (1..=1024).contains(&path.len())
        && !path.contains(char::is_control)
        && path.to_ascii_lowercase().ends_with(".exr");
    if fits {
        return Ok(());
    }
    let wanted = "the path of a painting, which ends in .exr";
    let hint = Hint::new("save the painting as an .exr file");
    Err(CheckContext::default().invalid("start", wanted, &path, Some(hint)))
}

fn check_medium(medium: &Medium) -> Checked {
    let at = CheckContext::default();
    at.range("medium.scattering_per_mm", medium.scattering_per_mm, 1e-3, 1e6)?;
    at.range("medium.stiffness", medium.stiffness, 0.0, 1.0)?;
    check_gloss(&at, "medium.", medium.wet, medium.dry)
}

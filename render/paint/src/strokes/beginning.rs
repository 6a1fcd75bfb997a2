//! What a script begins on: bare surfaces, or a painting to go on with.

use pigment::digits::rounded;
use pigment::library::PigmentLibrary;

use super::at::{At, Checked};
use super::error::ScriptError;
use super::palette::PaletteSpec;
use super::resolve::Resolved;
use super::script::{Canvas, StrokeScript, cells_within};
use crate::document::{Document, Ground, Slots};
use crate::ground::{GroundError, GroundSpec};
use graphics::tile::Rect;

/// Why a script cannot begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScriptStartError {
    /// The script cannot be played, or not on that painting.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// There is no such ground.
    #[error(transparent)]
    Ground(#[from] GroundError),
}

impl ScriptStartError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Script(error) => error.hint(),
            Self::Ground(error) => error.hint(),
        }
    }
}

impl StrokeScript {
    /// The bare canvas of this script: its ground, no paint yet.
    #[must_use]
    pub fn bare(&self, library: &PigmentLibrary, resolved: &Resolved, ground: Ground) -> Document {
        Document::bare(
            &self.title,
            self.canvas.cell_mm,
            ground,
            library.clone(),
            self.medium.clone().unwrap_or_default(),
            resolved.slots,
            self.lighting.clone().unwrap_or_default(),
        )
    }

    /// The canvas before the first action, and the palette beside it if the
    /// script has one, as its file describes them: numbers count as written. `start` is the painting that the script names as such, if
    /// it names one; the pigments are then those of its own library.
    ///
    /// # Errors
    /// [`ScriptStartError`] where the script cannot be played (see
    /// [`StrokeScript::resolve`]), where `start` is missing, not asked for, or of
    /// another size or other pigments, and for grounds that cannot be.
    pub fn surfaces(
        &self,
        library: &PigmentLibrary,
        start: Option<Document>,
    ) -> Result<(Document, Option<Document>), ScriptStartError> {
        let header = self.rounded_header()?;
        let resolved = header.resolve(start.as_ref().map_or(library, |start| &start.library))?;
        let canvas = match (&self.start, start) {
            (None, None) => {
                let ground = ground(&header.canvas, library)?;
                header.bare(library, &resolved, ground)
            }
            (Some(_), Some(start)) => {
                let bounds = start.ground.height.bounds();
                let pigments = (&start.slots, &start.library);
                header
                    .check_agreement(bounds, start.cell_mm, pigments, &resolved.slots)
                    .map_err(ScriptError::from)?;
                start
            }
            (named, given) => {
                let named = named.as_deref().unwrap_or("none");
                let found = given.map_or("none".to_owned(), |document| document.title);
                let wanted = format!("the painting that the script begins on, {named}");
                let hint = Some("read that painting, or leave `start` out".to_owned());
                let fault = At::default().fault("start", &wanted, &found, hint);
                return Err(ScriptError::from(fault).into());
            }
        };
        let palette = header.mixing.as_ref().map(|mixing| {
            Ok::<_, GroundError>(Document::bare(
                &canvas.title,
                canvas.cell_mm,
                ground(mixing, &canvas.library)?,
                canvas.library.clone(),
                canvas.medium.clone(),
                canvas.slots,
                canvas.lighting.clone(),
            ))
        });
        Ok((canvas, palette.transpose()?))
    }

    /// Whether the canvas of cells `bounds`, each `cell_mm` wide, is that of the
    /// script, and has the pigments `slots` that the script begins with.
    pub(crate) fn check_agreement(
        &self,
        bounds: Rect,
        cell_mm: f64,
        (own, library): (&Slots, &PigmentLibrary),
        slots: &Slots,
    ) -> Checked {
        let at = At::default();
        let (width, height) = self.canvas.cells();
        let Rect { width: columns, height: rows, .. } = bounds;
        if (columns, rows) != (width, height) {
            let wanted = format!("as many cells as the painting has, {columns} x {rows}");
            return Err(at.fault("canvas", &wanted, &format!("{width} x {height}"), None));
        }
        let cell_mm = rounded(cell_mm);
        if rounded(self.canvas.cell_mm) != cell_mm {
            let wanted = format!("that of the painting, {cell_mm}");
            let hint = Some(format!("\"cell_mm\": {cell_mm}"));
            return Err(at.fault("canvas.cell_mm", &wanted, &self.canvas.cell_mm, hint));
        }
        let sorted = |slots: &Slots| {
            let mut pigments: Vec<usize> = slots.iter().flatten().copied().collect();
            pigments.sort_unstable();
            pigments
        };
        if sorted(slots) != sorted(own) {
            let wanted = format!("that of the painting, {}", names(own, library).join(", "));
            let named: Vec<&str> = self.palette.pigments.iter().map(|(_, name)| &**name).collect();
            return Err(at.fault("palette", &wanted, &named.join(", "), None));
        }
        Ok(())
    }

    /// A script without actions that goes on with a painting, which whoever
    /// replays it finds at `start`; without a palette to mix on.
    #[must_use]
    pub fn continue_from(start: &str, painting: &Document) -> Self {
        let cell_mm = rounded(painting.cell_mm);
        let side_mm = |cells: usize| {
            // Rounded up, it could be a cell more.
            let exact = rounded(cells as f64 * cell_mm);
            let within = rounded((cells as f64 - 0.5) * cell_mm);
            if cells_within(exact, cell_mm) == cells { exact } else { within }
        };
        let height = &painting.ground.height;
        let canvas = Canvas {
            width_mm: side_mm(height.width()),
            height_mm: side_mm(height.height()),
            cell_mm,
            ground: GroundSpec::default(),
        };
        let palette = PaletteSpec::from_names(names(&painting.slots, &painting.library));
        let mut script = Self::new(&painting.title, "", canvas, palette);
        script.start = Some(start.to_owned());
        script.library = Some(painting.library.title.clone());
        script
    }
}

fn ground(canvas: &Canvas, library: &PigmentLibrary) -> Result<Ground, GroundError> {
    let (width, height) = canvas.cells();
    canvas.ground.ground(width, height, canvas.cell_mm, library)
}

/// The names of the pigments of `slots`, in their order.
pub(crate) fn names<'a>(slots: &Slots, library: &'a PigmentLibrary) -> Vec<&'a str> {
    slots.iter().flatten().map(|&pigment| library.pigments[pigment].name.as_str()).collect()
}

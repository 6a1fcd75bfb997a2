//! The surfaces that a script starts on: bare ones, or a painting to continue.

use pigment::PigmentId;
use pigment::digits::rounded;
use pigment::library::PigmentLibrary;

use super::check_context::{CheckContext, Checked};
use super::error::ScriptError;
use super::palette::PaletteSpec;
use super::resolve::Resolved;
use super::script::StrokeScript;
use super::side_table::{KeptBrush, SideTable};
use crate::canvas::{Canvas, covering_cells};
use crate::document::{Document, Medium, Slots};
use crate::ground::{Ground, GroundError, GroundSpec};
use documents::hint::{Explain, Hint};
use graphics::tile::Rect;

/// Why the surfaces of a script cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScriptStartError {
    /// The script is invalid, or does not describe the painting that it continues.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
}

impl Explain for ScriptStartError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Script(error) => error.hint(),
            Self::Ground(error) => error.hint(),
        }
    }
}

impl StrokeScript {
    /// The canvas of this script without paint, on `ground`.
    #[must_use]
    pub fn bare(&self, library: &PigmentLibrary, resolved: &Resolved, ground: Ground) -> Document {
        Document::bare(
            &self.title,
            self.canvas.cell_mm,
            ground,
            library.clone(),
            self.medium.clone().unwrap_or_else(|| Medium::of(library)),
            resolved.slots,
            self.lighting.clone().unwrap_or_default(),
        )
    }

    /// The canvas before the first action, and the palette if the script has one. Numbers
    /// are rounded to the digits of a file.
    ///
    /// `start` is the painting that the script continues, if it names one; pigments are
    /// then those of its library, and `library` is not used.
    ///
    /// # Errors
    /// [`ScriptStartError`] for a script that cannot be played (see
    /// [`StrokeScript::resolve`]), for a `start` that is missing, not asked for, or of
    /// another size or other pigments, and for a ground that cannot be made.
    pub fn surfaces(
        &self,
        library: &PigmentLibrary,
        start: Option<Document>,
    ) -> Result<(Document, Option<Document>), ScriptStartError> {
        let header = self.rounded_header()?;
        let resolved = header.resolve(start.as_ref().map_or(library, |start| &start.library))?;
        let canvas = match (&self.start, start) {
            (None, None) => {
                let ground = header.canvas.ground(library)?;
                header.bare(library, &resolved, ground)
            }
            (Some(_), Some(start)) => {
                let bounds = start.ground.height.bounds();
                let pigments = (&start.slots, &start.library);
                header
                    .check_painting(bounds, start.cell_mm, pigments, &resolved.slots)
                    .map_err(ScriptError::from)?;
                start
            }
            (named, start) => {
                let named = named.as_deref().unwrap_or("none");
                let found = start.map_or("none".to_owned(), |document| document.title);
                let wanted = format!("the painting that the script begins on, {named}");
                let hint = Some(Hint::new("read that painting, or leave `start` out"));
                let invalid = CheckContext::default().invalid("start", &wanted, &found, hint);
                return Err(ScriptError::from(invalid).into());
            }
        };
        let palette = header.mixing.as_ref().map(|mixing| {
            Ok::<_, GroundError>(Document::bare(
                &canvas.title,
                canvas.cell_mm,
                mixing.ground(&canvas.library)?,
                canvas.library.clone(),
                canvas.medium.clone(),
                canvas.slots,
                canvas.lighting.clone(),
            ))
        });
        Ok((canvas, palette.transpose()?))
    }

    /// The canvas and the palette before the first action, and the brushes with their loads, of a
    /// script that may continue a painting with the table beside it (key `table`). Without that
    /// key it is [`StrokeScript::surfaces`], and no brushes.
    ///
    /// # Errors
    /// [`ScriptStartError`] in the cases of [`StrokeScript::surfaces`], if the script asks for a
    /// `table` that is missing, and if that belongs to another painting.
    pub fn surfaces_with_table(
        &self,
        library: &PigmentLibrary,
        start: Option<Document>,
        table: Option<SideTable>,
    ) -> Result<(Document, Option<Document>, Vec<KeptBrush>), ScriptStartError> {
        let (canvas, bare) = self.surfaces(library, start)?;
        if !self.table {
            return Ok((canvas, bare, Vec::new()));
        }
        let at = CheckContext::default();
        let wrong = |wanted: &str, found: &str, hint: &'static str| {
            ScriptStartError::from(ScriptError::from(at.invalid(
                "table",
                wanted,
                &found,
                Some(Hint::new(hint)),
            )))
        };
        let Some(SideTable { palette, brushes }) = table else {
            let hint = "save the painting in the studio, or leave `table` out";
            return Err(wrong("a painting saved with its palette and brushes", "none", hint));
        };
        let wanted = self.mixing.as_ref().map(Canvas::cells);
        let found = palette.wet.vehicle.bounds();
        if wanted != Some((found.width, found.height)) {
            let found = format!("{} x {}", found.width, found.height);
            return Err(wrong("a palette of the size of `mixing`", &found, "describe its size"));
        }
        if !palette.belongs_to(&canvas) {
            let hint = "save the painting again";
            return Err(wrong("the palette of this painting", "another painting's", hint));
        }
        Ok((canvas, Some(palette), brushes))
    }

    /// Checks that the script describes a painting with cells `bounds` of width `cell_mm`
    /// and the pigments `own` of `library`; `slots` are the pigments that the script starts
    /// with.
    pub(crate) fn check_painting(
        &self,
        bounds: Rect,
        cell_mm: f64,
        (own, library): (&Slots, &PigmentLibrary),
        slots: &Slots,
    ) -> Checked {
        let at = CheckContext::default();
        let (width, height) = self.canvas.cells();
        let Rect { width: columns, height: rows, .. } = bounds;
        if (columns, rows) != (width, height) {
            let wanted = format!("as many cells as the painting has, {columns} x {rows}");
            return Err(at.invalid("canvas", &wanted, &format!("{width} x {height}"), None));
        }
        let cell_mm = rounded(cell_mm);
        if rounded(self.canvas.cell_mm) != cell_mm {
            let wanted = format!("that of the painting, {cell_mm}");
            let hint = Some(Hint::new(format!("\"cell_mm\": {cell_mm}")));
            return Err(at.invalid("canvas.cell_mm", &wanted, &self.canvas.cell_mm, hint));
        }
        let sorted = |slots: &Slots| {
            let mut pigments: Vec<PigmentId> = slots.iter().flatten().copied().collect();
            pigments.sort_unstable();
            pigments
        };
        if sorted(slots) != sorted(own) {
            let wanted =
                format!("that of the painting, {}", pigment_names(own, library).join(", "));
            let named: Vec<&str> = self.palette.pigments.iter().map(|(_, name)| &**name).collect();
            return Err(at.invalid("palette", &wanted, &named.join(", "), None));
        }
        Ok(())
    }

    /// A script without actions that continues `painting` with the palette and the brushes beside
    /// it, which are saved at the path `start`.
    #[must_use]
    pub fn continue_with_table(start: &str, painting: &Document, table: &SideTable) -> Self {
        let mut script = Self::continue_from(start, painting);
        script.mixing = Some(Self::continue_from(start, &table.palette).canvas);
        script.table = true;
        script
    }

    /// A script without actions and palette that continues `painting`, which is saved at
    /// the path `start`.
    #[must_use]
    pub fn continue_from(start: &str, painting: &Document) -> Self {
        let cell_mm = rounded(painting.cell_mm);
        let side_mm = |cells: usize| {
            // A side length that was rounded up could cover one cell more.
            let exact = rounded(cells as f64 * cell_mm);
            let shorter = rounded((cells as f64 - 0.5) * cell_mm);
            if covering_cells(exact, cell_mm) == cells { exact } else { shorter }
        };
        let height = &painting.ground.height;
        let canvas = Canvas {
            width_mm: side_mm(height.width()),
            height_mm: side_mm(height.height()),
            cell_mm,
            ground: GroundSpec::default(),
        };
        let palette = PaletteSpec::from_names(pigment_names(&painting.slots, &painting.library));
        let mut script = Self::new(&painting.title, "", canvas, palette);
        script.start = Some(start.to_owned());
        script.library = Some(painting.library.title.clone());
        script
    }
}

/// The names of the pigments of `slots`, in the order of the slots.
pub(crate) fn pigment_names<'a>(slots: &Slots, library: &'a PigmentLibrary) -> Vec<&'a str> {
    slots.iter().flatten().map(|&pigment| library[pigment].name.as_str()).collect()
}

//! The start of a script: bare surfaces or a painting to continue, its pigment library, and the
//! pictures of its grounds.

use std::path::Path;

use documents::file::{NamedFileError, NamedFiles};
use documents::hint::{Explain, Hint};
use graphics::tile::Rect;
use pigment::PigmentId;
use pigment::digits::rounded;
use pigment::library::{LibraryError, PigmentLibrary, RecipeError};

use super::action::{Action, ActionPigments, Load, PaletteSpec, Recipe, Squeeze};
use super::script::{KeptBrush, SideTable, StrokeScript};
use super::table::{CheckContext, Checked, did_you_mean};
use super::{InvalidValue, ScriptError};
use crate::document::{Canvas, Document, Medium, Slots, covering_cells};
use crate::ground::{Ground, GroundError, GroundRelief, GroundSpec};
use crate::layer::SLOTS;

/// Why the surfaces of a script cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ScriptStartError {
    /// The script is invalid, or does not describe the painting that it continues.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
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

    /// The canvas before the first action, and the palette if the script has one. We round numbers
    /// to the digits of a file.
    ///
    /// If the script continues a painting, pass it as `start`. We then take pigments from its
    /// library and do not use `library`.
    ///
    /// # Errors
    /// [`ScriptStartError`] for a script that you cannot play (see [`StrokeScript::resolve`]), for
    /// a `start` that is missing, not asked for, or of another size or other pigments, and for a
    /// ground that cannot be made.
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

    /// The canvas, the palette and the brushes with their paint before the first action. With the
    /// key `table`, the script continues a painting together with the palette and the brushes that
    /// are saved beside it. Without this key, you get [`StrokeScript::surfaces`] and no brushes.
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
    /// and the pigments `own` of `library`. `slots` are the pigments that the script starts
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
        if sorted_pigments(slots) != sorted_pigments(own) {
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

fn sorted_pigments(slots: &Slots) -> Vec<PigmentId> {
    let mut pigments: Vec<PigmentId> = slots.iter().flatten().copied().collect();
    pigments.sort_unstable();
    pigments
}

/// The names of the pigments of `slots`, in the order of the slots.
pub(crate) fn pigment_names<'a>(slots: &Slots, library: &'a PigmentLibrary) -> Vec<&'a str> {
    slots.iter().flatten().map(|&pigment| library[pigment].name.as_str()).collect()
}

/// The pigments of a script.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// Pigments of the wet layer before the first action.
    pub slots: Slots,
    /// Pigments that each action names, in the order of the actions.
    pub actions: Vec<ActionPigments>,
}

impl StrokeScript {
    /// Checks the script and looks its pigments up in `library`. If several palettes have a short
    /// name, we take the latest.
    ///
    /// A recipe may only name pigments of the first palette or of a palette that an earlier action
    /// sets. Whether this palette is still set depends on undone actions, so we check it when we
    /// apply the action.
    ///
    /// # Errors
    /// [`ScriptError::Invalid`] for values out of range (see [`StrokeScript::check`]),
    /// names that match no pigment or several, a pigment named twice in a palette or a
    /// recipe, and recipes with pigments of no palette.
    pub fn resolve(&self, library: &PigmentLibrary) -> Result<Resolved, ScriptError> {
        self.check()?;
        let (mut names, slots) = PigmentNames::new(&self.palette, library)?;
        let mut actions = Vec::with_capacity(self.actions.len());
        for (index, action) in self.actions.iter().enumerate() {
            let at = CheckContext::action(index, action.kind());
            let pigments = names.pigments_of(&at, action, library)?;
            names.add_palette_of(action, &pigments);
            actions.push(pigments);
        }
        Ok(Resolved { slots, actions })
    }
}

/// Meaning of pigment names at one action of a script.
#[derive(Debug)]
pub(crate) struct PigmentNames {
    palettes: Vec<(PaletteSpec, Slots)>,
}

impl PigmentNames {
    /// The names before the first action, and the slots of `palette`.
    pub(crate) fn new(
        palette: &PaletteSpec,
        library: &PigmentLibrary,
    ) -> Result<(Self, Slots), Box<InvalidValue>> {
        let slots = slots(&CheckContext::default(), palette, library)?;
        Ok((Self { palettes: vec![(palette.clone(), slots)] }, slots))
    }

    pub(crate) fn add_palette_of(&mut self, action: &Action, pigments: &ActionPigments) {
        if let (Action::Palette(palette), ActionPigments::Palette(slots)) = (action, pigments) {
            self.palettes.push((palette.clone(), *slots));
        }
    }

    pub(crate) fn pigments_of(
        &self,
        at: &CheckContext,
        action: &Action,
        library: &PigmentLibrary,
    ) -> Result<ActionPigments, Box<InvalidValue>> {
        Ok(match action {
            Action::Load(Load { recipe, .. }) | Action::Squeeze(Squeeze { recipe, .. }) => {
                ActionPigments::Recipe(self.recipe(at, recipe, library)?)
            }
            Action::Palette(palette) => ActionPigments::Palette(slots(at, palette, library)?),
            Action::Swap { from, to, .. } => ActionPigments::Swap {
                from: self.pigment(at, "from", from, library)?,
                to: self.pigment(at, "to", to, library)?,
            },
            _ => ActionPigments::None,
        })
    }

    fn recipe(
        &self,
        at: &CheckContext,
        recipe: &Recipe,
        library: &PigmentLibrary,
    ) -> Result<Vec<(PigmentId, f64)>, Box<InvalidValue>> {
        let mut parts: Vec<(PigmentId, f64)> = Vec::new();
        for (name, &part) in recipe {
            let index = self.pigment(at, "recipe", name, library)?;
            if !self.palettes.iter().any(|(_, slots)| slots.contains(&Some(index))) {
                let known = self.palettes.iter().flat_map(|(palette, _)| &palette.pigments);
                let known: Vec<_> = known.map(|(_, name)| name.as_str()).collect();
                let hint = Hint::new(format!("the palette has {}", known.join(", ")));
                return Err(at.invalid("recipe", "pigments of the palette", name, Some(hint)));
            }
            if parts.iter().any(|(other, _)| *other == index) {
                return Err(at.invalid("recipe", "each pigment once", name, None));
            }
            if part > 0.0 {
                parts.push((index, part));
            }
        }
        parts.sort_by_key(|(index, _)| *index);
        Ok(parts)
    }

    /// Pigment with a short name or a name of the library.
    fn pigment(
        &self,
        at: &CheckContext,
        field: &str,
        name: &str,
        library: &PigmentLibrary,
    ) -> Result<PigmentId, Box<InvalidValue>> {
        let short = self.palettes.iter().rev().find_map(|(palette, _)| palette.library_name(name));
        find_pigment(at, field, short.unwrap_or(name), library)
    }
}

fn slots(
    at: &CheckContext,
    palette: &PaletteSpec,
    library: &PigmentLibrary,
) -> Result<Slots, Box<InvalidValue>> {
    let mut slots = [None; SLOTS];
    for (slot, (_, name)) in palette.pigments.iter().enumerate() {
        let index = find_pigment(at, "palette", name, library)?;
        if slots.contains(&Some(index)) {
            return Err(at.invalid("palette", "each pigment once", name, None));
        }
        slots[slot] = Some(index);
    }
    Ok(slots)
}

fn find_pigment(
    at: &CheckContext,
    field: &str,
    name: &str,
    library: &PigmentLibrary,
) -> Result<PigmentId, Box<InvalidValue>> {
    library.find(name).map_err(|error| {
        let known = library.pigments.iter().map(|pigment| pigment.name.as_str());
        let hint = match &error {
            RecipeError::UnknownPigment { .. } => {
                did_you_mean(name, known).or_else(|| error.hint())
            }
            _ => error.hint(),
        };
        at.invalid(field, "a pigment of the library", &name, hint)
    })
}

/// The pigment library of a script.
#[derive(Debug, Clone)]
pub struct ScriptLibrary {
    /// The library that the script names, or the shipped oils.
    pub library: PigmentLibrary,
    /// Name in the script of a library that does not exist. `library` then holds the shipped
    /// oils.
    pub missing: Option<String>,
}

impl StrokeScript {
    /// Opens the library of the script: the shipped oils if it names no library or gives
    /// their title, else a file relative to `folder`, the folder of the script.
    ///
    /// # Errors
    /// [`LibraryError`] if the file exists and is not a valid library.
    pub fn open_library(&self, folder: &Path) -> Result<ScriptLibrary, LibraryError> {
        let shipped = PigmentLibrary::van_gogh_oils();
        let Some(name) = self.library.as_ref().filter(|name| **name != shipped.title) else {
            return Ok(ScriptLibrary { library: shipped, missing: None });
        };
        let path = folder.join(name);
        if documents::file::disk::is_file(&path) {
            return Ok(ScriptLibrary { library: PigmentLibrary::open(path)?, missing: None });
        }
        Ok(ScriptLibrary { library: shipped, missing: Some(name.clone()) })
    }

    /// Finds the pictures of grounds, and replaces their paths by complete ones.
    ///
    /// # Errors
    /// [`NamedFileError`] for a picture that is not there, or that the script must not name.
    pub fn complete_picture_paths(&mut self, files: &mut NamedFiles) -> Result<(), NamedFileError> {
        for surface in std::iter::once(&mut self.canvas).chain(&mut self.mixing) {
            if let GroundRelief::Image(picture) = &mut surface.ground.relief {
                let path = files.find("the picture of a ground", &picture.path)?;
                picture.path = path.display().to_string();
            }
        }
        Ok(())
    }
}

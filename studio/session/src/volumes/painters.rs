//! Pictures of a scene: a drawing, and paintings in pigments, whose painters are made when they are
//! first needed.

use std::sync::Arc;

use pigment::library::PigmentLibrary;
use render::camera::Camera;
use render::field::Field;
use render::mesh::Mesh;
use render::paint::document::{Document, Lighting, Slots};
use render::paint::ground::GroundKind;
use render::volumes::painter::{Show, VolumePainter, VolumePigments};
use render::volumes::script::{RegionStyle, Script};
use render::volumes::settings::Settings;
use render::volumes::world::World;

use super::look::{Inside, Look};
use crate::failure::FileFailure;

/// Size of a picture in pixels, and what sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    /// The camera that sees it.
    pub(super) camera: Camera,
    /// Width and height in pixels.
    pub(super) size: [usize; 2],
}

/// How carefully a picture is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quality {
    /// Whether it has all samples, or one a pixel.
    pub(super) fine: bool,
    /// Its width by that of the picture that it stands for, whose strokes it has.
    pub(super) share: f32,
}

impl Quality {
    /// A picture as it is exported.
    pub(super) const BEST: Self = Self { fine: true, share: 1.0 };
}

/// The purpose of a painter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A drawing whose volumes show the subject's own colours.
    Drawing,
    /// A painting in pigments, whose volumes show this inside.
    Painting(Inside),
}

/// The painters of a scene.
#[derive(Debug)]
pub(super) struct Painters {
    settings: Settings,
    styles: Vec<RegionStyle>,
    pigments: Option<VolumePigments>,
    made: Vec<(Kind, VolumePainter)>,
}

impl Painters {
    /// Painters with the settings and regions of a script, and the pigments of its palette if it
    /// has one, on the ground that the command line takes.
    pub(super) fn new(
        script: &Script,
        settings: &Settings,
        (library, slots): (&Arc<PigmentLibrary>, Slots),
    ) -> Self {
        let pigments = (!script.palette.is_empty()).then(|| VolumePigments {
            library: Arc::clone(library),
            slots,
            own_colors: None,
            ground: GroundKind::Panel.spec(1),
            // Films are thinner than the relief of a ground, which would only hide the drawing.
            lighting: Lighting { relief: 0.0, ..Lighting::default() },
        });
        let styles = script.region_styles(settings);
        Self { settings: settings.clone(), styles, pigments, made: Vec::new() }
    }

    /// The painter of a kind, which draws with these settings.
    fn painter(
        &mut self,
        scene: &Mesh,
        kind: Kind,
        settings: &Settings,
    ) -> Result<&mut VolumePainter, FileFailure> {
        let known = self.made.iter().position(|(own, _)| *own == kind);
        let index = match known {
            Some(index) => index,
            None => {
                let painter = self.make(scene, kind, settings)?;
                self.made.push((kind, painter));
                self.made.len() - 1
            }
        };
        let painter = &mut self.made[index].1;
        painter.set_drawing(settings).map_err(|error| FileFailure::explained(&error))?;
        Ok(painter)
    }

    fn make(
        &self,
        scene: &Mesh,
        kind: Kind,
        settings: &Settings,
    ) -> Result<VolumePainter, FileFailure> {
        let inside = match kind {
            Kind::Drawing => Inside::OwnColours,
            Kind::Painting(inside) => inside,
        };
        let style =
            |style: &RegionStyle| RegionStyle { inside: inside.as_setting(), ..style.clone() };
        let styles: Vec<RegionStyle> = self.styles.iter().map(style).collect();
        let painter = VolumePainter::new(scene, settings, &styles);
        let painter = painter.map_err(|error| FileFailure::explained(&error))?;
        match self.pigments.clone().filter(|_| kind != Kind::Drawing) {
            Some(pigments) => {
                painter.with_pigments(pigments).map_err(|error| FileFailure::explained(&error))
            }
            None => Ok(painter),
        }
    }

    /// The picture of a world: encoded sRGB.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn picture(
        &mut self,
        (scene, world): (&Mesh, &World),
        sight: &Sight,
        look: &Look,
        quality: Quality,
    ) -> Result<Field<[f32; 4]>, FileFailure> {
        let mut settings = look.applied_to(&self.settings);
        if !quality.fine {
            settings.picture.samples = 1;
        }
        let hatching = &mut settings.hatching;
        hatching.width_px = (hatching.width_px * quality.share).max(1.0);
        let drawn = look.show != Show::Final || look.inside == Inside::OwnColours;
        let kind = if drawn { Kind::Drawing } else { Kind::Painting(look.inside) };
        let painter = self.painter(scene, kind, &settings)?;
        let picture = painter.shown(world, &sight.camera, sight.size.into(), look.show);
        picture.map_err(|error| FileFailure::explained(&error))
    }

    /// The painting of a world.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn painting(
        &mut self,
        (scene, world): (&Mesh, &World),
        sight: &Sight,
        look: &Look,
        title: &str,
    ) -> Result<Document, FileFailure> {
        let settings = look.applied_to(&self.settings);
        let painter = self.painter(scene, Kind::Painting(look.inside), &settings)?;
        let painting = painter.painting(world, &sight.camera, sight.size.into(), title);
        painting.map_err(|error| FileFailure::explained(&error))
    }
}

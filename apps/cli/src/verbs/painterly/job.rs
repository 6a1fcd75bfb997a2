//! A subject, and the files that it is painted into.

use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::encoding::{linear_from_encoded, over_white};
use graphics::export::frame_of;
use graphics::mesh::{Guide, Mesh};
use graphics::picture::Photograph;
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;
use painterly::{Painter, PictureForm, Settings};
use serde_json::json;
use spectra::Viewing;

use super::brushwork::Maps;
use super::exr_frames::ExrFrames;
use super::pigments::Materials;
use crate::animation::{Animation, FramesDigest};
use crate::console::Console;
use crate::failure::Result;
use crate::pictures::OpenExports;
use crate::plain_picture::PX_MM;
use crate::progress::waited;
use crate::stages::StageFolder;

/// A subject, and the pictures of it.
pub(super) struct Scene {
    pub(super) subject: SceneSubject,
    /// The cameras of all frames, at least one.
    pub(super) cameras: Vec<Camera>,
    /// Width and height of a picture in pixels.
    pub(super) size: (usize, usize),
}

/// A subject.
#[derive(Debug)]
pub(super) enum SceneSubject {
    /// A mesh with its guides.
    Model(Box<Mesh>, Vec<Guide>),
    /// A picture with its form.
    Picture(Photograph, PictureForm),
}

/// A subject, and its outputs.
pub(super) struct Job {
    pub(super) settings: Settings,
    pub(super) scene: Scene,
    /// Where pictures are made.
    pub(super) compute: Compute,
    /// Title, ground and pigments, if it is a painting.
    pub(super) painting: Option<Materials>,
    pub(super) exports: OpenExports,
    pub(super) stages: Option<StageFolder>,
    pub(super) exr_frames: Option<ExrFrames>,
    pub(super) animation: Option<Animation>,
}

impl Job {
    pub(super) fn paint(self, maps: &Maps, console: &mut Console<'_>) -> Result<Summary> {
        let Self { compute, settings, scene, painting, exports, stages, exr_frames, animation } =
            self;
        let Scene { subject, cameras, size } = scene;
        let brushwork = maps.brushwork();
        let painter = waited("laying out strokes", console, || match &subject {
            SceneSubject::Model(mesh, guides) => {
                Painter::of_model_with(mesh, &brushwork, guides, &settings)
            }
            SceneSubject::Picture(photograph, form) => {
                Painter::of_picture_with(photograph, &brushwork, form, &settings)
            }
        })?;
        let backend = compute.name().to_owned();
        let mut painter = painter.on(compute)?;
        let recording = match animation {
            None => None,
            Some(animation) => {
                let digest = FramesDigest::default()
                    .add(&env!("CARGO_PKG_VERSION"))
                    .add(&settings)
                    .add(&cameras)
                    .add(&subject)
                    .add(&brushwork)
                    .add(&backend);
                Some(animation.begin(digest, cameras.len(), size)?)
            }
        };
        let layers = painter.splats(&cameras[0], size, 0.0)?.1.iter().map(Vec::len).collect();
        if let Some(folder) = stages {
            let stages = painter.stages(&cameras[0], size, 0.0)?.into_iter();
            let stages: Vec<_> = stages.map(|stage| (stage.name, stage.picture)).collect();
            folder.write(&stages, console)?;
        }
        match painting {
            _ if !exports.any() => {}
            Some(Materials { title, ground, pigments }) => {
                if let Some((library, palette)) = pigments {
                    painter.set_pigments(library, palette);
                }
                let document = waited("painting", console, || {
                    painter.painting(&cameras[0], size, 0.0, (&title, &ground))
                })?;
                let engine = PaintEngine::on_cpu(document.ground.height.clone());
                let light = Light::new(&document.library, &Viewing::default())?;
                exports.write(&mut Painting::open_under(document, light, engine, 0)?, console)?;
            }
            None => {
                let painted =
                    waited("painting", console, || painter.paint(&cameras[0], size, 0.0))?;
                let linear = linear_from_encoded(&over_white(&painted.color));
                exports.write_picture(&linear, PX_MM, console)?;
            }
        }
        // One loop of the flow over all frames.
        let count = cameras.len();
        let time =
            |index: usize| f64::from(settings.flow.loop_seconds) * index as f64 / count as f64;
        if let Some(folder) = exr_frames {
            folder.write(console, |index| {
                Ok(painter.exr_frame(&cameras[index], size, time(index))?)
            })?;
        }
        let mut frames = None;
        if let Some(recording) = recording {
            let found = recording.paint(console, |index| {
                let painted = painter.paint(&cameras[index], size, time(index))?;
                Ok(frame_of(&over_white(&painted.color)))
            })?;
            frames = Some((count, found));
        }
        let maps = brushwork.maps.len();
        let regions = brushwork.regions.list.len();
        Ok(Summary { size, backend, layers, matched: painter.matched(), maps, regions, frames })
    }
}

/// Summary of a finished run.
pub(super) struct Summary {
    /// Width and height in pixels.
    size: (usize, usize),
    /// Device of the pictures.
    backend: String,
    /// Number of strokes of each layer of the first picture.
    layers: Vec<usize>,
    /// Share of strokes that continue a neighbour.
    matched: f64,
    /// Numbers of maps and regions.
    maps: usize,
    regions: usize,
    /// Number of frames of an animation, and the number of these that existed already.
    frames: Option<(usize, usize)>,
}

impl Summary {
    pub(super) fn print(&self, as_json: bool, console: &mut Console<'_>) -> Result<()> {
        let Self { size: (width, height), backend, layers, matched, maps, regions, frames } = self;
        let strokes: usize = layers.iter().sum();
        if as_json {
            return console.json(&json!({
                "size": [width, height],
                "backend": backend,
                "strokes": strokes,
                "layers": layers,
                "matched": matched,
                "maps": maps,
                "regions": regions,
                "frames": frames.map(|(frames, _)| frames),
                "frames_found": frames.map(|(_, found)| found),
            }));
        }
        let strokes = documents::counted(strokes, "stroke");
        let mut line = format!(
            "{width} x {height} pixels, {strokes}, {:.0} % continue a neighbour",
            100.0 * matched
        );
        if let Some((frames, found)) = frames {
            line += &format!(", {}", documents::counted(*frames, "frame"));
            if *found > 0 {
                line += &format!(" ({found} of them existed already)");
            }
        }
        console.line(line)
    }
}

//! One job for pictures: a photograph or a model, painted in a technique, with all its files.
//!
//! ```text
//! PictureRequest  -> open ->  PictureJob  -> paint ->  files, PictureOutcome
//! (JSON, options)             (checked)
//! ```
//!
//! A [`PictureRequest`] holds subject, technique, settings, pigments, light, outputs and frames as owned values,
//! so that a program fills it in its own way, for example from JSON, and calls [`PictureRequest::run`]:
//!
//! ```
//! use documents::Task;
//! use documents::request::request_from_json;
//! use pictures::PictureRequest;
//!
//! let folder = tempfile::tempdir()?;
//! let json = format!(
//!     r#"{{
//!         "subject": "shape:sphere",
//!         "technique": {{"watercolor": {{}}}},
//!         "view": {{"width": 32}},
//!         "style": {{"preset": "landscape"}},
//!         "stages": {:?},
//!         "device": "cpu"
//!     }}"#,
//!     folder.path().join("steps")
//! );
//! let request: PictureRequest = request_from_json(&json)?;
//! let task = Task::observed(|progress| eprintln!("{progress}"));
//! let outcome = request.run(&task)?;
//! assert_eq!(outcome.size, (32, 24));
//! assert_eq!(outcome.files, [folder.path().join("steps")]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | task | call |
//! |---|---|
//! | paint a picture, and write its files | [`PictureRequest::run`] |
//! | hear of each file when it is written | [`PictureRequest::open`], [`PictureJob::paint`] |
//! | show a stored painting under another light | [`RelightRequest::run`] |
//! | paint a script of strokes, and a timelapse of it | [`ScriptRequest::run`] |
//! | write the files of a painting | [`ExportRequest::open`] |
//! | frames that an interrupted run continues | [`AnimationRequest::open`] |
//! | a subject with its cameras | [`ViewRequest::subject`] |
//! | paint a photograph in strokes, or separate it into pigments | [`StrokesRequest`] |
//! | propose marks for samples of brushwork, take samples from a picture, or paint them | [`MarksRequest`], [`SampleRequest`], [`SwatchRequest`] |
//! | make, check or draw a map of samples | [`ArtMapRequest`], [`ArtMapCheckRequest`], [`SheetRequest`] |
//! | pour paint over a model or photograph | [`VolumesRequest`] |
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

mod error;
mod exports;
mod animation;
mod subject;
mod style;
mod request;
mod brushwork;
mod artmap_outcomes;
mod artmap_request;
mod artmap_job;
mod watercolor_job;
mod painterly_job;
mod strokes_job;
mod volumes_job;
mod job;
mod relight;
mod timelapse;
mod script;

pub use animation::{Animation, AnimationRequest, FramesDigest, Recording, animation_format};
pub use artmap_outcomes::{
    ArtMapOutcome, BrushworkOutcome, DirectionFigures, HeightFigures, MarkFigures, MarksOutcome,
    PassageFigures, SampleFigures, SamplesOutcome, TileFigures,
};
pub use artmap_request::{
    ArtMapCheckRequest, ArtMapRequest, MarksRequest, SampleRequest, SheetRequest, SwatchRequest,
};
pub use brushwork::style_of;
pub use error::{PictureError, SettingError};
pub use exports::{
    Bands, ExportRequest, Listener, Note, OpenExports, PX_MM, StageFolder, Written, gamut_remark,
};
pub use job::PictureJob;
pub use relight::{DryLayerOutcome, LayerOutcome, RelightJob, RelightOutcome, RelightRequest};
pub use request::{
    Device, PaintAmounts, PainterlyRequest, PictureOutcome, PictureRequest, PigmentRequest,
    StrokesRequest, TechniqueOutcome, TechniqueRequest, VolumesRequest, WatercolorRequest,
};
pub use script::{PlayedSession, ScriptJob, ScriptOutcome, ScriptRequest};
pub use style::{StyleRequest, listed, name_in_recipe, palette, pigment_names, toml_of_change};
pub use subject::{
    FARTHEST_DEG, LEAST_PX, MOST_FRAMES, MOST_PX, OpenSubject, PictureViews, Subject, ViewRequest,
    picture_turns,
};
pub use timelapse::{TimelapseOutcome, TimelapseRequest};

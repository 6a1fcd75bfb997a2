//! The panels of a scene of paint volumes. Each shows the state that the scene's worker last
//! reported and queues requests.

mod illuminant;
mod chooser;
mod context;
mod tubes;
mod tool;
mod view;
mod light;
mod time_bar;
mod events;
mod export;
mod here;
mod side;

pub use crate::files::SceneExport;
pub use chooser::TubeChooser;
pub use context::{SceneContext, SceneFileRequest, SceneRequest, SceneTab, SceneTools};
pub use here::show as show_here;
pub use illuminant::SceneIlluminant;
pub use side::show as show_side;
pub use time_bar::{HEIGHT as TIME_BAR_HEIGHT, seconds_text, show as show_time_bar};

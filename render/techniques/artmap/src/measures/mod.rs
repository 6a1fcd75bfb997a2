//! Figures of how well a map has the brushwork of its sample, and how well maps agree.

mod texture;
mod brushwork;
mod agreement;

pub use agreement::{coherence, most_used, usual_wrap_ratio, wrap_ratio};
pub use brushwork::{co_occurrence_error, contrast, stroke_length};
pub use texture::Texture;

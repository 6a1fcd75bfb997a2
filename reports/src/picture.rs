//! Figures as PNG, with two pixels per px of the figure. This is the only file that uses the crate
//! resvg.
//!
//! We build the fonts in instead of taking them from the machine, so that a figure gives the same
//! bytes everywhere.

use std::sync::{Arc, OnceLock};

use documents::hint::Explain;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

/// Pixels per px of the figure.
const SCALE: f32 = 2.0;

/// Renders `svg` and returns the bytes of a PNG file.
///
/// # Errors
/// [`PictureError`] if `svg` is not an SVG document, or is empty or too large to render.
pub fn png(svg: &str) -> Result<Vec<u8>, PictureError> {
    let options = Options { fontdb: fonts(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|cause| error(cause.to_string()))?;
    let size = tree.size().to_int_size().scale_by(SCALE);
    let size = size.ok_or_else(|| error("an empty drawing".to_owned()))?;
    let mut pixmap = Pixmap::new(size.width(), size.height())
        .ok_or_else(|| error(format!("{} x {} px", size.width(), size.height())))?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|cause| error(cause.to_string()))
}

fn error(reason: String) -> PictureError {
    PictureError { reason }
}

fn fonts() -> Arc<Database> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    Arc::clone(FONTS.get_or_init(load))
}

fn load() -> Arc<Database> {
    let mut database = Database::new();
    for font in [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR] {
        database.load_font_data(font.to_vec());
    }
    let first = database.faces().next().and_then(|face| face.families.first().cloned());
    if let Some((family, _)) = first {
        database.set_sans_serif_family(family);
    }
    Arc::new(database)
}

/// A drawing that cannot be rendered.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[fault(Environment)]
#[error("a figure cannot be rendered: {reason}")]
pub struct PictureError {
    /// Reason, as text.
    pub reason: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_rendered_with_the_built_in_fonts() {
        assert_eq!(ink(""), 0);
        // A Latin letter, and a Greek letter of the figures.
        assert!(ink("M") > 40 && ink("\u{39b}") > 20, "{} {}", ink("M"), ink("\u{39b}"));
    }

    fn ink(text: &str) -> usize {
        let picture = Pixmap::decode_png(&png(&svg(text)).unwrap()).unwrap();
        assert_eq!((picture.width(), picture.height()), (80, 40));
        picture.pixels().iter().filter(|pixel| pixel.alpha() > 0).count()
    }

    fn svg(text: &str) -> String {
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20" font-family="Nowhere,sans-serif"><text x="2" y="15" font-size="14" fill="#000000">{text}</text></svg>"##
        )
    }

    #[test]
    fn a_document_that_is_not_svg_is_an_error() {
        assert!(png("<b>no</b>").is_err(), "it is not SVG");
    }
}

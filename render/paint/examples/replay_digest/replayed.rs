//! Strokes played on the processor.

use std::convert::Infallible;
use std::error::Error;
use std::ops::ControlFlow;

use paint::engine::PaintEngine;
use paint::painting::{Painting, UNDO_BYTES};
use paint::session::PaintingSession;
use paint::strokes::StrokeScript;
use pigment::PigmentLibrary;

/// Digest of the paint on the canvas after the first `actions` of a script, which paints with the
/// shipped oils.
pub(crate) fn digest(script: &[u8], actions: usize) -> Result<String, Box<dyn Error>> {
    let mut script = StrokeScript::from_json("script", script)?;
    script.actions.truncate(actions);
    let (document, palette) = script.surfaces(&PigmentLibrary::van_gogh_oils(), None)?;
    let opened = |document: paint::document::Document| {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, UNDO_BYTES)
    };
    let mut session = PaintingSession::new(opened(document)?, palette.map(opened).transpose()?)?;
    script.replay(
        &mut session,
        |_: &str, _: &mut Painting| Ok::<_, Infallible>(()),
        || ControlFlow::Continue(()),
    )?;
    Ok(session.documents()?.0.digest_of_paint())
}

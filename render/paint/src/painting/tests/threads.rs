//! Strokes on any number of threads.

use super::bench::{along, loaded, on_cpu};
use crate::brush::HeadShape;
use crate::layer::Layer;

/// Paint of the canvas and the brush after a stroke of a flat that covers most of the canvas.
fn painted(threads: usize) -> (Layer, Layer) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut painting = on_cpu(r#"{"kind": "linen"}"#, 0.1);
        let brush = loaded(&mut painting, HeadShape::Flat, 28.0);
        let report = painting.stroke(brush, &along(8.0, (15.0, 25.0), 0.9)).unwrap();
        assert!(report.cells / report.substeps > 6_000, "{report:?}");
        (painting.wet().unwrap().clone(), painting.brush_paint(brush).unwrap())
    })
}

#[test]
fn a_wide_stroke_is_the_same_on_one_thread_and_on_eight() {
    let alone = painted(1);
    for threads in [2, 5, 8] {
        assert!(painted(threads) == alone, "on {threads} threads");
    }
}

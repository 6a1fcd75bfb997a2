//! Errors of the graphics device: sizes beyond its limits, and a lost device.

use documents::hint::Explain;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use paint::engine::PaintEngine;
use paint::layer::Layer;

#[test]
fn a_canvas_beyond_the_device_is_told_with_both_sizes() {
    let Some(device) = crate::device() else { return };
    let limit = device.adapter().limits.binding_bytes;
    // A strip of cells whose pigments, 32 bytes a cell, exceed the limit; the floor has 4 bytes.
    let cells = (limit / 32 + 1) as usize;
    if cells > 1 << 26 {
        return;
    }
    let error = PaintEngine::on_device(device, &Field::filled(cells, 1, 0)).unwrap_err();
    let bytes = 32 * cells as u64;
    assert_eq!(error, DeviceError::TooLarge { what: "the canvas", bytes, limit });
    assert_eq!(error.hint().unwrap().to_string(), "paint on the processor: `backend = cpu`");
}

#[test]
fn a_lost_device_is_an_error_of_every_call() {
    let Some(device) = crate::device() else { return };
    let mut engine = PaintEngine::on_device(device, &Field::filled(70, 70, 0)).unwrap();
    let brush = engine.add_brush(4, 4).unwrap();
    engine.device().unwrap().close();
    let lost = |found: Result<(), DeviceError>| {
        assert!(matches!(found, Err(DeviceError::Lost { .. })), "{found:?}");
    };
    lost(engine.set_wet(&Layer::empty(70, 70)));
    lost(engine.set_brush_paint(brush, &Layer::empty(4, 4)));
    lost(engine.wet().map(drop));
    lost(engine.brush_paint(brush).map(drop));
    lost(engine.dry(100));
    lost(engine.floor().map(drop));
    lost(engine.picture().map(drop));
    lost(engine.add_brush(4, 4).map(drop));
    lost(engine.finish());
}

#[test]
fn a_buffer_beyond_the_limit_is_refused() {
    let Some(device) = crate::device() else { return };
    let limit = device.adapter().limits.binding_bytes;
    let error = device.buffer("a test", limit + 1).unwrap_err();
    assert_eq!(error, DeviceError::TooLarge { what: "a test", bytes: limit + 1, limit });
}

//! Pixels and brush head that a stroke changes between two frames, as an object of JavaScript.

use js_sys::{Array, Float32Array, Object, Reflect, Uint8ClampedArray};
use studio::app::Between;
use studio::view::HeadLines;
use wasm_bindgen::JsValue;

/// The object that the page draws, in physical pixels: `pixels` row by row, and for the brush head the
/// `lines`, each a list of x and y and whether it is closed, their `strokes` as widths and colours,
/// and the `dot`.
pub(crate) fn shown(between: &Between, density: f32) -> Object {
    let Between { patch, head } = between;
    let all = Object::new();
    let set = |name: &str, value: &JsValue| {
        // A new object accepts every name.
        let _ = Reflect::set(&all, &name.into(), value);
    };
    let numbers = [patch.left, patch.top, patch.width, patch.height];
    for (name, number) in ["left", "top", "width", "height"].into_iter().zip(numbers) {
        set(name, &(number as f64).into());
    }
    set("pixels", &Uint8ClampedArray::from(&patch.rgba[..]));
    let lines = head.lines.iter().map(|(line, closed)| {
        let flat: Vec<f32> = line.iter().flat_map(|at| [at.x * density, at.y * density]).collect();
        Array::of2(&Float32Array::from(&flat[..]), &(*closed).into())
    });
    set("lines", &lines.collect::<Array>());
    let strokes = HeadLines::STROKES.into_iter().map(|(width, color)| {
        let [red, green, blue, alpha] = color.to_srgba_unmultiplied();
        let color = format!("rgb({red} {green} {blue} / {})", f32::from(alpha) / 255.0);
        Array::of2(&(width * density).into(), &color.into())
    });
    set("strokes", &strokes.collect::<Array>());
    if let Some((at, [red, green, blue])) = head.dot {
        let [dark, radius] = HeadLines::DOT.map(|radius| radius * density);
        let numbers = [at.x * density, at.y * density, dark, radius];
        let color = format!("rgb({red} {green} {blue})");
        set("dot", &Array::of2(&Float32Array::from(&numbers[..]), &color.into()));
    }
    all
}

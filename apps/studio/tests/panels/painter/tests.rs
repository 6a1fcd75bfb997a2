//! Typical working steps with the panels (squeezing, loading, mixing, drying, exchanging pigments)
//! and the paint and layers that result.

use super::*;

/// Whether two amounts are equal up to the rounding to quanta.
fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.01
}

#[test]
fn paint_is_squeezed_mixed_and_picked_up() {
    let mut painter = Painter::new();
    painter.click("tube of Chrome Yellow");
    painter.squeeze(SurfaceId::Palette, 20.0, 20.0);
    painter.click("tube of Ultramarine");
    painter.squeeze(SurfaceId::Palette, 34.0, 20.0);
    painter.wait_until("two heaps", |painting| painting.history.len() == 2);
    painter.click("knife");
    assert_eq!(painter.brush("knife").amount_mm, 0.0);
    for y_mm in [18.0, 20.0, 22.0] {
        painter.stroke(SurfaceId::Palette, (14.0, y_mm), (40.0, y_mm));
        painter.stroke(SurfaceId::Palette, (40.0, y_mm), (14.0, y_mm));
    }
    painter.wait_until("six strokes more", |painting| {
        painting.history.len() == 8 && !painting.stroke_open
    });
    let knife = painter.wait_until_brush("knife", |knife| knife.amount_mm > 0.0);
    let both = [painter.part("knife", "Chrome Yellow"), painter.part("knife", "Ultramarine")];
    assert!(both[0] > 0.02 && both[1] > 0.02, "both are on the knife: {both:?}, {knife:?}");
    assert!((both[0] + both[1] - 1.0).abs() < 1e-9, "no other pigment: {both:?}");
    painter.click("Wash");
    painter.wait_until_brush("knife", |knife| knife.amount_mm == 0.0);
    assert_eq!(painter.harness.state().messages, []);
}

#[test]
fn a_brush_is_loaded_thinned_wiped_duplicated_and_resized() {
    let mut painter = Painter::new();
    painter.harness.state_mut().tools.tube = 3;
    painter.harness.run();
    painter.slide("Medium", 20.0);
    painter.click("Load from tube");
    let is = |mm, share| {
        move |brush: &BrushState| near(brush.amount_mm, mm) && near(brush.vehicle, share)
    };
    painter.wait_until_brush("round", is(0.3, 0.2));
    assert_eq!(painter.part("round", "Vermilion"), 1.0);
    painter.click("Medium only");
    painter.wait_until_brush("round", is(0.6, 0.6));

    // The larger head keeps the paint.
    painter.slide("Size", 9.0);
    let larger =
        painter.wait_until_brush("round", |brush| brush.spec.size_mm == 9.0 && is(0.6, 0.6)(brush));
    painter.slide("Wipe to", 50.0);
    painter.click("Wipe");
    let wiped = painter.wait_until_brush("round", is(0.3, 0.6));

    painter.click("Keep");
    assert_eq!(painter.harness.state().tools.brush, "round 2");
    let twin = painter.wait_until_brush("round 2", |twin| twin.amount_mm == 0.0);
    assert_eq!(twin.spec, larger.spec);
    assert_eq!(painter.brush("round"), wiped, "the original brush keeps its paint");
    assert_eq!(painter.harness.state().messages, []);
}

#[test]
fn dried_layers_are_dimmed_merged_and_undone() {
    let mut painter = Painter::new();
    painter.click("tube of Vermilion");
    painter.click("Load brush");
    let loaded = painter.wait_until_brush("round", |brush| near(brush.amount_mm, 0.3));
    painter.stroke(SurfaceId::Canvas, (6.0, 6.0), (26.0, 12.0));
    painter.wait_until_brush("round", |brush| brush.amount_mm < loaded.amount_mm);
    painter.slide("Share", 50.0);
    painter.click("Dry share");
    painter.click("Dry all");
    let painting = painter.wait_until("two layers, measured", |painting| {
        painting.layers.len() == 2 && painting.layers.iter().all(|layer| layer.mean_mm > 0.0)
    });
    for layer in &painting.layers {
        assert!(layer.mean_mm <= layer.max_mm, "{layer:?}");
        assert!((0.01..0.6).contains(&layer.coverage), "{}", layer.coverage);
    }
    painter.save("painter");

    // A drag is one action with the value at its end.
    let before = painting.history.len();
    let rail = painter.harness.get_by_role_and_label(Role::Slider, "opacity of Layer 1");
    let start = rail.rect().left_center() + vec2(30.0, 0.0);
    painter.harness.hover_at(start);
    painter.harness.drag_at(start);
    painter.harness.run();
    for step in 1..6_u8 {
        painter.harness.hover_at(start + vec2(6.0 * f32::from(step), 0.0));
        painter.harness.run();
        std::thread::sleep(Duration::from_millis(20));
    }
    painter.harness.drop_at(start + vec2(30.0, 0.0));
    painter.settle();
    let dimmed = painter.wait_until("one action", |painting| painting.history.len() == before + 1);
    let opacity = dimmed.layers[0].opacity;
    assert!(opacity != 1.0 && opacity > 0.0, "{opacity}");

    painter.click("visibility of Layer 1");
    let hidden = painter.wait_until("hidden", |painting| !painting.layers[0].visible);
    assert_eq!(hidden.layers[0].opacity, opacity, "hiding leaves the opacity");
    painter.click("visibility of Layer 1");
    painter.wait_until("shown", |painting| painting.layers[0].visible);

    for _ in 0..3 {
        painter.click("Undo");
    }
    painter.wait_until("as before the drag", |painting| {
        painting.history_done == before && painting.layers[0].opacity == 1.0
    });
    painter.click("menu of Layer 2");
    painter.click("Merge down");
    let both = painting.layers[0].mean_mm + painting.layers[1].mean_mm;
    let is_merged = |painting: &PaintingState| {
        painting.layers.len() == 1 && (painting.layers[0].mean_mm / both - 1.0).abs() < 0.05
    };
    let merged = painter.wait_until("one layer as high as both", is_merged);

    let history = merged.history.clone();
    painter.click("0 beginning");
    painter.wait_until("bare", |painting| painting.history_done == 0 && painting.layers.is_empty());
    assert_eq!(painter.brush("round"), loaded, "as before the stroke");
    painter.click(&format!("{} {}", history.len(), history[history.len() - 1]));
    let again = painter.wait_until("all done again", |painting| {
        painting.history_done == history.len() && is_merged(painting)
    });
    assert_eq!(again.history, history);
    assert_eq!(again.layers[0].mean_mm, merged.layers[0].mean_mm);
    assert_eq!(again.brushes, merged.brushes);
    assert_eq!(painter.harness.state().messages, []);
}

#[test]
fn tubes_change_without_wet_paint_and_exchange_in_the_painting() {
    let mut painter = Painter::new();
    painter.click("tube of Vermilion");
    painter.click("Load brush");
    painter.stroke(SurfaceId::Canvas, (6.0, 6.0), (26.0, 12.0));
    painter.wait_until("a stroke", |painting| painting.history.len() == 1);

    // A slot whose paint is still wet cannot be changed.
    let slots = painter.painting().slots;
    painter.click("Tubes...");
    painter.click("slot 4");
    painter.choose("Cobalt Blue");
    let start = Instant::now();
    while painter.harness.state().messages.is_empty() {
        assert!(start.elapsed() < PATIENCE, "no message");
        painter.settle();
    }
    let (text, hint) = painter.harness.state_mut().messages.pop().unwrap();
    assert!(text.contains("Vermilion") && hint.is_some(), "{text}, {hint:?}");
    assert_eq!(painter.painting().slots, slots, "the slot is unchanged");

    // Another slot can be changed.
    painter.click("slot 5");
    painter.choose("Cobalt Blue");
    let mut wanted = slots;
    wanted[4] = Some(painter.painting().library.find("Cobalt Blue").unwrap());
    painter.wait_until("Cobalt Blue in slot 5", |painting| painting.slots == wanted);
    painter.click("Close window");

    // Exchange in the painting, wet and dry.
    painter.slide("Share", 50.0);
    painter.click("Dry share");
    painter.wait_until("a dry layer", |painting| painting.layers.len() == 1);
    painter.harness.get_by_label("tube of Vermilion").click_secondary();
    painter.harness.run();
    painter.click("Exchange in the painting...");
    painter.choose("Minium");
    let minium = Some(painter.painting().library.find("Minium").unwrap());
    painter.wait_until("Minium, wet and dry", |painting| {
        painting.slots[3] == minium && painting.layers[0].slots[3] == minium
    });
    assert_eq!(painter.harness.state().messages, []);
}

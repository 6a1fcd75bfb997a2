//! Stations at pen, brush, palette and layers.

use eframe::egui::{Key, Modifiers, vec2};
use paint::strokes::SurfaceId::{Canvas, Palette};

use super::hand::Hand;

const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;

impl Hand<'_> {
    /// Pressure curve and stabiliser, with strokes on the field to try them.
    pub(super) fn pen(&mut self) {
        self.key(SHIFT, Key::P);
        self.click("Firm");
        let field = self.place("Pressure curve") + vec2(0.0, 20.0);
        self.hover(field);
        self.station("pen-window");
        if self.find("Test field").is_some() {
            let middle = self.place("Test field");
            let corners =
                [vec2(-90.0, -20.0), vec2(-30.0, 20.0), vec2(30.0, -20.0), vec2(90.0, 20.0)];
            self.drag(&corners.map(|corner| middle + corner));
            self.station("pen-field");
        }
        self.key(SHIFT, Key::P);
    }

    /// An own brush is kept with its paint.
    pub(super) fn own_brush(&mut self) {
        self.key(SHIFT, Key::B);
        self.click("with its paint");
        self.click("Keep brush");
        self.station("own-brushes");
        self.key(SHIFT, Key::B);
    }

    /// The tools that work wet paint, and a mask.
    pub(super) fn tools(&mut self) {
        self.key(NONE, Key::W);
        self.double_click("tube of Chrome Yellow");
        self.paint(Canvas, &[(30.0, 80.0), (160.0, 84.0)]);
        self.key(NONE, Key::N);
        self.paint(Canvas, &[(50.0, 74.0), (55.0, 92.0), (62.0, 74.0)]);
        self.station("blended");
        self.key(NONE, Key::S);
        self.paint(Canvas, &[(90.0, 76.0), (92.0, 92.0)]);
        self.station("scraped");
        self.key(NONE, Key::E);
        self.paint(Canvas, &[(120.0, 76.0), (128.0, 92.0), (136.0, 76.0)]);
        self.station("erased");
        self.key(NONE, Key::K);
        let mask =
            [(60.0, 10.0), (140.0, 12.0), (150.0, 60.0), (90.0, 70.0), (50.0, 40.0), (60.0, 10.0)];
        self.paint(Canvas, &mask);
        self.station("mask");
        self.key(NONE, Key::B);
        self.paint(Canvas, &[(40.0, 30.0), (165.0, 36.0)]);
        self.station("painted-through-the-mask");
    }

    /// The round menu at the pointer.
    pub(super) fn quick_palette(&mut self) {
        let middle = self.twin.point(Canvas, 100.0, 50.0);
        self.click_aside(middle);
        self.picture("quick-palette");
        let tube = self.place("quick Prussian Blue");
        self.hover(tube);
        self.picture("quick-palette-tube");
        self.click_at(tube);
    }

    /// Kept mixtures, the wheel of the tubes, and the eyedropper with recipes.
    pub(super) fn colors(&mut self) {
        self.click("Keep this mixture");
        self.click("Swatches");
        self.station("swatches");
        self.click("Wheel");
        self.wait_for("Colour wheel");
        self.station("wheel");
        let at = self.place("Colour wheel") + vec2(20.0, -24.0);
        self.click_at(at);
        self.wait_for("Load recipe 1");
        self.station("wheel-recipes");
        self.key(NONE, Key::I);
        self.paint(Palette, &[(26.0, 20.0), (26.0, 20.1)]);
        self.station("eyedropper");
        self.key(NONE, Key::B);
        self.click("Light");
        self.station("light");
    }

    /// Layers: dried, named, ordered, merged.
    pub(super) fn layers(&mut self) {
        self.key(NONE, Key::D);
        self.double_click("tube of Zinc White");
        self.paint(Canvas, &[(100.0, 30.0), (120.0, 90.0)]);
        self.key(NONE, Key::D);
        self.click("Layers");
        self.station("layers");
        self.click("menu of Layer 1");
        self.picture("layer-menu");
        self.click("Rename (F2)");
        self.text("sky");
        self.key(NONE, Key::Enter);
        self.click("menu of sky");
        self.click("Move up");
        self.station("layer-moved");
        self.click("menu of sky");
        if self.find("Merge down").is_some() {
            self.click("Merge down");
        }
        self.station("layers-merged");
        self.click("History");
        self.station("history");
        self.click("Brush");
    }

    /// Draws frames in both windows until a control is there.
    pub(super) fn wait_for(&mut self, label: &str) {
        for _ in 0..60 {
            if self.find(label).is_some() {
                std::thread::sleep(std::time::Duration::from_millis(500));
                return;
            }
            self.wait();
        }
        panic!("there is no {label}");
    }
}

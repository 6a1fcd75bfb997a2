//! Stations at dialogs and windows.

use std::time::Duration;

use eframe::egui::{Key, Modifiers};
use paint::strokes::SurfaceId;

use super::hand::Hand;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

impl Hand<'_> {
    /// The frame of a crop, left again.
    pub(super) fn crop(&mut self) {
        self.choose("Edit", "Crop...");
        self.station("crop-all");
        for (handle, x_mm, y_mm) in
            [("Crop upper left", 30.0, 20.0), ("Crop lower right", 150.0, 90.0)]
        {
            let from = self.place(handle);
            let to = self.twin.point(SurfaceId::Canvas, x_mm, y_mm);
            self.drag(&[from, to]);
        }
        self.station("crop");
        self.escape();
    }

    /// A picture pinned beside the canvas, and laid over it.
    pub(super) fn reference(&mut self) {
        self.choose("File", "Pin a picture...");
        self.wait_for("reference.png");
        std::thread::sleep(Duration::from_secs(1));
        self.station("browser");
        self.click("reference.png");
        self.click("Open");
        self.wait_for("Reference picture");
        self.station("reference");
        self.key(NONE, Key::O);
        self.station("reference-over");
        self.key(NONE, Key::O);
        self.click("Close picture");
    }

    /// All dialogs of files.
    pub(super) fn dialogs(&mut self) {
        self.key(CTRL, Key::N);
        self.station("new");
        self.escape();
        self.key(CTRL, Key::S);
        self.station("save");
        self.escape();
        self.key(CTRL, Key::E);
        self.station("export");
        self.escape();
        self.choose("File", "Export timelapse...");
        self.station("timelapse");
        self.escape();
        self.key(CTRL, Key::Comma);
        self.station("preferences");
        self.escape();
    }

    /// Menus, keys, figures and touch mode.
    pub(super) fn window(&mut self) {
        for menu in ["File", "Edit", "View", "Tools", "Help"] {
            self.click(menu);
            self.picture(&format!("menu-{}", menu.to_lowercase()));
            self.escape();
        }
        self.key(NONE, Key::F1);
        self.station("keys");
        self.click("Find an action");
        self.text("mirror");
        self.click("change M of Mirror");
        self.station("keys-change");
        self.escape();
        self.escape();
        self.key(NONE, Key::F12);
        self.station("figures");
        self.key(NONE, Key::F12);
        self.choose("View", "Large targets for touch");
        self.station("touch");
        self.click("View");
        self.picture("touch-menu-view");
        self.escape();
        self.key(CTRL, Key::Comma);
        self.station("touch-preferences");
        self.click("Large targets");
        self.click("Close");
        self.choose("View", "Palette");
        self.station("without-palette");
        self.choose("View", "Palette");
        self.paint(SurfaceId::Canvas, &[(20.0, 96.0), (60.0, 100.0)]);
        self.key(CTRL, Key::Q);
        self.station("unsaved");
        self.escape();
    }

    /// The workspace of scenes, and the sample painting.
    pub(super) fn others(&mut self) {
        self.choose("File", "New scene");
        std::thread::sleep(Duration::from_secs(4));
        self.station("scene");
        self.key(CTRL, Key::E);
        self.choose("File", "Sample painting");
        self.station("sample-asks");
        if self.find("Discard").is_some() {
            self.click("Discard");
        }
        for _ in 0..60 {
            self.wait();
            if !self.twin.studio().files.is_playing() {
                break;
            }
        }
        std::thread::sleep(Duration::from_secs(5));
        self.station("sample");
    }
}

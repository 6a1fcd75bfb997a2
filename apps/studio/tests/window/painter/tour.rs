//! The first minute: what is shown at the start, and the guided tour.

use eframe::egui::{Key, Modifiers};
use paint::strokes::SurfaceId::{Canvas, Palette};
use studio::app::TourStep;

use super::hand::Hand;

impl Hand<'_> {
    /// Goes through the tour, doing what each card asks for.
    pub(super) fn tour(&mut self) {
        self.station("first-start");
        self.choose("Help", "Guided tour");
        for step in TourStep::ALL {
            assert_eq!(self.twin.studio().tour().step(), Some(step), "the tour goes on");
            self.station(&format!("tour-{step:?}").to_lowercase());
            self.take(step);
        }
        self.station("tour-end");
        self.click("Close the tour");
    }

    fn take(&mut self, step: TourStep) {
        match step {
            TourStep::Load => self.double_click("tube of Vermilion"),
            TourStep::Paint => {
                self.paint(Canvas, &[(20.0, 30.0), (70.0, 20.0), (110.0, 45.0)]);
            }
            TourStep::Mix => {
                for (tube, x_mm) in [("Ultramarine", 22.0), ("Zinc White", 30.0)] {
                    self.click(&format!("tube of {tube}"));
                    self.key(Modifiers::NONE, Key::Q);
                    self.paint(Palette, &[(x_mm, 20.0), (x_mm, 20.1)]);
                }
                self.key(Modifiers::NONE, Key::B);
                self.paint(Palette, &[(18.0, 18.0), (34.0, 22.0), (18.0, 22.0), (34.0, 18.0)]);
                self.paint(Canvas, &[(30.0, 60.0), (80.0, 70.0), (150.0, 55.0)]);
            }
            TourStep::Dry => self.key(Modifiers::NONE, Key::D),
            TourStep::Glaze => {
                self.key(Modifiers::NONE, Key::W);
                // The medium of the loads, which is seen once the other panels are folded.
                self.click("Fold Light");
                self.set_medium("99");
                self.double_click("tube of Cochineal Lake");
                self.paint(Canvas, &[(40.0, 20.0), (90.0, 60.0), (140.0, 40.0)]);
                self.set_medium("15");
                self.station("tour-brush-unfolded");
                self.click("Unfold Light");
            }
            TourStep::Relight => self.key(Modifiers::NONE, Key::L),
        }
    }

    fn set_medium(&mut self, percent: &str) {
        let at = self.place_of(eframe::egui::accesskit::Role::SpinButton, "Medium");
        self.click_at(at);
        self.key(Modifiers::COMMAND, Key::A);
        self.text(percent);
        self.key(Modifiers::NONE, Key::Enter);
    }
}

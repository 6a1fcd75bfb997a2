//! Lines of text that a window shows, and everything in it that is clicked.

use eframe::egui::accesskit::Action;
use eframe::egui::{Color32, FullOutput, Rect, Role, Shape, Vec2};
use egui_kittest::Node;
use egui_kittest::kittest::NodeT;

/// Text on the screen.
#[derive(Debug, Clone)]
pub(crate) struct SeenText {
    pub(crate) words: String,
    pub(crate) rect: Rect,
    /// The part of the window in which it is drawn.
    pub(crate) clip: Rect,
    /// Its colour; translucent if it is disabled.
    pub(crate) color: Color32,
    elided: bool,
}

impl SeenText {
    /// Whether a part of it is missing at the right or at the left.
    pub(crate) fn is_cut(&self) -> bool {
        let beyond = self.rect.left() < self.clip.left() - 1.5
            || self.rect.right() > self.clip.right() + 1.5;
        self.is_seen() && (self.elided || beyond)
    }

    fn is_seen(&self) -> bool {
        !self.words.trim().is_empty()
            && self.clip.is_positive()
            && self.clip.y_range().intersects(self.rect.y_range())
            && self.clip.x_range().intersects(self.rect.x_range())
    }

    /// Whether all of it is on the screen.
    pub(crate) fn is_whole(&self) -> bool {
        self.is_seen() && !self.is_cut() && self.clip.expand(1.0).contains_rect(self.rect)
    }
}

/// All text of a frame.
pub(crate) fn texts(output: &FullOutput) -> Vec<SeenText> {
    let mut found = Vec::new();
    for clipped in &output.shapes {
        collect(&clipped.shape, clipped.clip_rect, &mut found);
    }
    found
}

fn collect(shape: &Shape, clip: Rect, found: &mut Vec<SeenText>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, clip, found)),
        Shape::Text(text) => {
            let galley = &text.galley;
            let own = galley.job.sections.first().map_or(Color32::PLACEHOLDER, |s| s.format.color);
            let own = if own == Color32::PLACEHOLDER { text.fallback_color } else { own };
            let color = text.override_text_color.unwrap_or(own);
            found.push(SeenText {
                words: galley.text().to_owned(),
                rect: galley.rect.translate(text.pos.to_vec2()),
                clip,
                color: color.gamma_multiply(text.opacity_factor),
                elided: galley.elided,
            });
        }
        _ => {}
    }
}

/// Something that is clicked or dragged with a finger.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    pub(crate) name: String,
    pub(crate) size: Vec2,
    pub(crate) right: f32,
}

/// Everything below `root` that is clicked, and all sliders.
pub(crate) fn targets(root: &Node<'_>) -> Vec<Target> {
    let touched = |node: &Node<'_>| {
        let inner = node.accesskit_node();
        // Instead of scroll bars, fingers drag the content.
        let is_bar = inner.role() == Role::ScrollBar;
        let is_clicked = inner.data().supports_action(Action::Click);
        (is_clicked && !is_bar) || inner.role() == Role::Slider
    };
    root.children_recursive()
        .filter(touched)
        .map(|node: Node<'_>| {
            let inner = node.accesskit_node();
            let name = inner.label().or(inner.value());
            let name = name.unwrap_or_else(|| format!("{:?} without a name", inner.role()));
            Target { name, size: node.rect().size(), right: node.rect().right() }
        })
        .collect()
}

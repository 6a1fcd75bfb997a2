//! Brushes by name, and the surface that holds their paint.

use std::collections::{BTreeMap, BTreeSet};

use crate::engine::BrushId;
use crate::strokes::{BrushSpec, PerSurface, SurfaceId};

/// A head that was added under a name.
#[derive(Debug)]
pub(super) struct Tool {
    /// Name under which it was added.
    pub(super) name: String,
    /// Its name in the recording, unique among all heads.
    pub(super) recorded: String,
    pub(super) spec: BrushSpec,
    /// Its id in the painting of each surface, once it was used there.
    pub(super) ids: PerSurface<Option<BrushId>>,
    /// Surface whose painting holds its paint; in the other one it is clean.
    pub(super) at: SurfaceId,
}

impl Tool {
    pub(super) fn used(&self) -> bool {
        self.ids.iter().any(Option::is_some)
    }
}

/// State of a head after it was added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Added {
    /// The head is new, or had the name already.
    Ready,
    /// The head had the name before and was used; it may have paint on it.
    Used,
}

/// All brushes of a session.
#[derive(Debug, Default)]
pub(super) struct Brushes {
    /// All heads, including those whose name now belongs to another: undo needs them.
    pub(super) tools: Vec<Tool>,
    names: BTreeMap<String, usize>,
}

impl Brushes {
    /// Adds a brush under a name, in place of the one with that name.
    pub(super) fn add(&mut self, name: &str, spec: &BrushSpec) -> Added {
        if let Some(&now) = self.names.get(name) {
            if self.tools[now].spec == *spec {
                return Added::Ready;
            }
            let again = self.tools.iter().position(|t| t.name == name && t.spec == *spec);
            if let Some(again) = again {
                self.names.insert(name.to_owned(), again);
                return if self.tools[again].used() { Added::Used } else { Added::Ready };
            }
            if !self.tools[now].used() {
                self.tools[now].spec = spec.clone();
                return Added::Ready;
            }
        }
        self.tools.push(Tool {
            name: name.to_owned(),
            recorded: self.free_name(name),
            spec: spec.clone(),
            ids: PerSurface::default(),
            at: SurfaceId::Canvas,
        });
        self.names.insert(name.to_owned(), self.tools.len() - 1);
        Added::Ready
    }

    /// Adds a head that an earlier session had, after all those that it was added after. The last
    /// one of a name that is `named` has the name now.
    pub(super) fn restore(&mut self, tool: Tool, named: bool) {
        if named {
            self.names.insert(tool.name.clone(), self.tools.len());
        }
        self.tools.push(tool);
    }

    /// Index of the head that has a name now.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.names.get(name).copied()
    }

    /// Names with the heads that have them now.
    pub(super) fn names(&self) -> impl Iterator<Item = (&str, &Tool)> + Clone {
        self.names.iter().map(|(name, &tool)| (name.as_str(), &self.tools[tool]))
    }

    /// Heads whose name now belongs to another.
    pub(super) fn replaced(&self) -> Vec<usize> {
        let named: BTreeSet<usize> = self.names.values().copied().collect();
        (0..self.tools.len()).filter(|tool| !named.contains(tool)).collect()
    }

    /// `name`, with a number appended if another head was recorded under it.
    fn free_name(&self, name: &str) -> String {
        let used: BTreeSet<&str> = self.tools.iter().map(|tool| &*tool.recorded).collect();
        let numbered = (2_usize..).map(|number| format!("{name} {number}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        names.find(|name| !used.contains(name.as_str())).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brush::HeadShape;

    fn spec(size_mm: f64) -> BrushSpec {
        BrushSpec { shape: HeadShape::Round, size_mm }
    }

    fn now(brushes: &Brushes, name: &str) -> (usize, String) {
        let tool = brushes.find(name).expect("it was added");
        (tool, brushes.tools[tool].recorded.clone())
    }

    #[test]
    fn a_used_head_keeps_its_recorded_name_and_others_get_their_own() {
        let mut brushes = Brushes::default();
        assert_eq!(brushes.add("round", &spec(6.0)), Added::Ready);
        // The brush is not used yet, so its entry is replaced.
        brushes.add("round", &spec(7.0));
        assert_eq!((now(&brushes, "round"), brushes.tools.len()), ((0, "round".to_owned()), 1));
        brushes.tools[0].ids[SurfaceId::Canvas] = Some(BrushId(0));
        brushes.add("round", &spec(8.0));
        assert_eq!(now(&brushes, "round"), (1, "round 2".to_owned()));
        brushes.add("round 2", &spec(8.0));
        assert_eq!(now(&brushes, "round 2"), (2, "round 2 2".to_owned()));
        assert_eq!(brushes.add("round", &spec(7.0)), Added::Used, "the first again");
        assert_eq!(brushes.add("round", &spec(7.0)), Added::Ready, "it is in hand");
        assert_eq!(now(&brushes, "round"), (0, "round".to_owned()));
        assert_eq!(brushes.add("round", &spec(8.0)), Added::Ready, "it was never used");
        assert_eq!(brushes.replaced(), [0], "`round` is the second again");
        let names: Vec<&str> = brushes.names().map(|(name, _)| name).collect();
        assert_eq!(names, ["round", "round 2"]);
    }
}

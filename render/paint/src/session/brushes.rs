//! Brushes by name, and where the paint on them is.

use std::collections::{BTreeMap, BTreeSet};

use crate::strokes::{BrushSpec, SurfaceId};

/// A head, as it was taken under a name.
#[derive(Debug)]
pub(super) struct Tool {
    /// The name under which it was taken.
    pub(super) name: String,
    /// Its name in the recording, which no other has.
    pub(super) recorded: String,
    pub(super) spec: BrushSpec,
    /// Its number in the painting of each surface, once it was used there.
    pub(super) numbers: [Option<usize>; 2],
    /// Where the paint on it is; on the other surface it is clean.
    pub(super) at: SurfaceId,
}

impl Tool {
    pub(super) fn used(&self) -> bool {
        self.numbers.iter().any(Option::is_some)
    }
}

/// What taking a brush came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Taken {
    /// It is there and clean, or was there already.
    Ready,
    /// A head that was used before, perhaps with paint on it.
    Used,
}

/// All brushes.
#[derive(Debug, Default)]
pub(super) struct Brushes {
    /// All heads, those too that gave their name to another: undo needs them.
    pub(super) tools: Vec<Tool>,
    names: BTreeMap<String, usize>,
}

impl Brushes {
    /// Takes a brush under a name, in place of the one of that name.
    pub(super) fn take(&mut self, name: &str, spec: &BrushSpec) -> Taken {
        if let Some(&now) = self.names.get(name) {
            if self.tools[now].spec == *spec {
                return Taken::Ready;
            }
            let again = self.tools.iter().position(|t| t.name == name && t.spec == *spec);
            if let Some(again) = again {
                self.names.insert(name.to_owned(), again);
                return if self.tools[again].used() { Taken::Used } else { Taken::Ready };
            }
            if !self.tools[now].used() {
                self.tools[now].spec = spec.clone();
                return Taken::Ready;
            }
        }
        self.tools.push(Tool {
            name: name.to_owned(),
            recorded: self.free_name(name),
            spec: spec.clone(),
            numbers: [None; 2],
            at: SurfaceId::Canvas,
        });
        self.names.insert(name.to_owned(), self.tools.len() - 1);
        Taken::Ready
    }

    /// The head that has a name now.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.names.get(name).copied()
    }

    /// Names and what they stand for now.
    pub(super) fn names(&self) -> impl Iterator<Item = (&str, &Tool)> + Clone {
        self.names.iter().map(|(name, &tool)| (name.as_str(), &self.tools[tool]))
    }

    /// Heads that have no name any more.
    pub(super) fn put_away(&self) -> Vec<usize> {
        let named: BTreeSet<usize> = self.names.values().copied().collect();
        (0..self.tools.len()).filter(|tool| !named.contains(tool)).collect()
    }

    /// `name`, or with a number after it, so that no head was recorded so.
    fn free_name(&self, name: &str) -> String {
        let taken: BTreeSet<&str> = self.tools.iter().map(|tool| &*tool.recorded).collect();
        let numbered = (2_usize..).map(|number| format!("{name} {number}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        names.find(|name| !taken.contains(name.as_str())).unwrap_or_default()
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
        let tool = brushes.find(name).expect("it was taken");
        (tool, brushes.tools[tool].recorded.clone())
    }

    #[test]
    fn a_used_head_keeps_its_recorded_name_and_others_get_their_own() {
        let mut brushes = Brushes::default();
        assert_eq!(brushes.take("round", &spec(6.0)), Taken::Ready);
        // Nobody painted with it: it is exchanged in its place.
        brushes.take("round", &spec(7.0));
        assert_eq!((now(&brushes, "round"), brushes.tools.len()), ((0, "round".to_owned()), 1));
        brushes.tools[0].numbers[0] = Some(0);
        brushes.take("round", &spec(8.0));
        assert_eq!(now(&brushes, "round"), (1, "round 2".to_owned()));
        brushes.take("round 2", &spec(8.0));
        assert_eq!(now(&brushes, "round 2"), (2, "round 2 2".to_owned()));
        assert_eq!(brushes.take("round", &spec(7.0)), Taken::Used, "the first again");
        assert_eq!(brushes.take("round", &spec(7.0)), Taken::Ready, "it is in hand");
        assert_eq!(now(&brushes, "round"), (0, "round".to_owned()));
        assert_eq!(brushes.take("round", &spec(8.0)), Taken::Ready, "it was never used");
        assert_eq!(brushes.put_away(), [0], "`round` is the second again");
        let names: Vec<&str> = brushes.names().map(|(name, _)| name).collect();
        assert_eq!(names, ["round", "round 2"]);
    }
}

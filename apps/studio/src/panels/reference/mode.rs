//! The use of the pointer on the picture.

use crate::language::tr;

/// The use of the primary button on the reference picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum ReferenceMode {
    /// Picks colours.
    #[default]
    Pick,
    /// Marks samples of brushwork.
    Mark,
    /// Combs guides of strokes.
    Comb,
}

impl ReferenceMode {
    /// All modes in the order of their buttons.
    pub(super) const ALL: [Self; 3] = [Self::Pick, Self::Mark, Self::Comb];

    /// Text of the button.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Pick => tr("Pick colour"),
            Self::Mark => tr("Mark samples"),
            Self::Comb => tr("Comb"),
        }
    }

    /// Tooltip of the button.
    pub(super) fn description(self) -> &'static str {
        match self {
            Self::Pick => tr("A click picks a colour to match"),
            Self::Mark => tr("Lines over passages of brushwork, from which samples are taken"),
            Self::Comb => tr("Lines along which strokes run on a model or a picture"),
        }
    }
}

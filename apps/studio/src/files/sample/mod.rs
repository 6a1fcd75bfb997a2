//! The sample painting: a still life with dry layers, glazes and wet lights, as a script that the
//! worker plays.

use paint::strokes::StrokeScript;
use pigment::library::PigmentLibrary;

use super::pending::{FileOrigin, PendingAction, Replacement};
use super::problem::Problem;
use super::state::Files;
use crate::language::tr;
use session::{Command, Pace};

/// Two oranges and a lemon, in the Van Gogh oils.
const ORANGES: &[u8] = include_bytes!("oranges.json");

/// The script of the sample painting.
fn script() -> Result<StrokeScript, Problem> {
    let read = StrokeScript::from_json(tr("the sample painting"), ORANGES);
    read.map_err(|error| Problem::from_error(&error))
}

impl Files {
    /// Opens the sample painting in place of the open one, after asking about unsaved changes.
    pub(super) fn open_sample(&mut self) {
        match script() {
            Ok(script) => {
                let script = Box::new(script);
                let library = Box::new(PigmentLibrary::van_gogh_oils());
                let commands = vec![Command::Replay { script, library, pace: Pace::Fast }];
                let origin = FileOrigin { sample: true, ..FileOrigin::default() };
                self.carry_out_safely(PendingAction::Replace(Replacement { commands, origin }));
            }
            Err(problem) => self.report(problem),
        }
    }

    /// The replay has ended: the sample painting has no changes of the painter's own.
    pub(super) fn sample_played(&mut self) {
        self.sample_settles = std::mem::take(&mut self.sample);
    }

    /// The first state after the sample painting was played.
    pub(super) fn settle_sample(&mut self) {
        if std::mem::take(&mut self.sample_settles)
            && let Some(state) = self.painting.as_ref().filter(|state| !state.stroke_open)
        {
            self.saved_revision = Some(state.revision);
        }
    }
}

#[cfg(test)]
mod tests {
    use paint::strokes::Action;

    use super::*;

    #[test]
    fn the_sample_painting_has_dry_layers_glazes_and_wet_paint() {
        let script = script().unwrap();
        script.resolve(&PigmentLibrary::van_gogh_oils()).unwrap();
        let dries = |action: &Action| matches!(action, Action::Dry { .. });
        let layers: Vec<&[Action]> = script.actions.split(dries).collect();
        assert!(layers.len() >= 4, "{} layers", layers.len());
        let strokes = |actions: &[Action]| {
            actions.iter().filter(|action| matches!(action, Action::Stroke(_))).count()
        };
        assert!(layers.iter().all(|layer| strokes(layer) > 2), "a layer has no strokes");
        assert!(
            script
                .actions
                .iter()
                .any(|action: &Action| matches!(action, Action::Load(load) if load.vehicle > 0.9)),
            "there is no glaze"
        );
        assert!(ORANGES.len() < 60_000, "{} bytes", ORANGES.len());
    }
}

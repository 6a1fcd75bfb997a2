//! Recording of what a session does as a script.

use super::action::{Action, Dry, Lift, NewVolume, PathPoint, Place, Pour, Push, Quantity, Split};
use super::events::seconds_of;
use super::file::Script;
use super::rounded::{ball, point, recipe, six, time};
use super::rows::Row;
use super::tables::{
    DryTable, LiftTable, PourTable, PushTable, RegionTable, SplitTable, VolumeTable,
};

/// A script that grows as a session goes on.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorder {
    script: Script,
}

impl Action {
    /// The action with the digits of a file. A session rounds an action before it does it: so its
    /// recording plays the same bits.
    #[must_use]
    pub fn rounded(&self) -> Self {
        let row = |row: [f64; 3]| row.map(six);
        match self {
            Self::Volume(own) => Self::Volume(NewVolume {
                center: row(own.center),
                radius: six(own.radius),
                recipe: recipe(&own.recipe),
                ..own.clone()
            }),
            Self::Pour(own) => Self::Pour(Pour {
                place: own.place.rounded(),
                quantity: own.quantity.rounded(),
                recipe: recipe(&own.recipe),
                ..own.clone()
            }),
            Self::Push(own) => Self::Push(Push {
                at: row(own.at),
                towards: row(own.towards),
                radius: six(own.radius),
                strength: six(own.strength),
            }),
            Self::Lift(own) => Self::Lift(Lift {
                place: own.place.rounded(),
                radius: six(own.radius),
                rate: six(own.rate),
            }),
            Self::Split(own) => Self::Split(own.clone()),
            Self::Dry(own) => Self::Dry(Dry { ball: own.ball.map(ball) }),
        }
    }
}

impl Place {
    fn rounded(&self) -> Self {
        match self {
            Self::At(at) => Self::At(at.map(six)),
            Self::Picked(at) => Self::Picked(at.map(six)),
            Self::Path(points) => {
                let mut points = points.clone();
                for own in &mut points {
                    let [x, y, z] = own.at;
                    let Row([seconds, x, y, z]) = point(Row([own.seconds, x, y, z]));
                    (own.seconds, own.at) = (seconds, [x, y, z]);
                }
                // A pen may report twice within one ten-thousandth of a second.
                points.dedup_by(|later, earlier| later.seconds <= earlier.seconds);
                Self::Path(points)
            }
        }
    }
}

impl Quantity {
    fn rounded(self) -> Self {
        match self {
            Self::Amount(amount) => Self::Amount(six(amount)),
            Self::Rate(rate) => Self::Rate(six(rate)),
        }
    }
}

impl Recorder {
    /// A recorder that begins with `script`: its subject, palette, settings, regions and walls,
    /// and what is done in it already.
    #[must_use]
    pub fn new(script: &Script) -> Self {
        Self { script: script.rounded() }
    }

    /// Adds an action that lasts from step `start` to before step `end`. It is recorded as
    /// [`Action::rounded`] gives it. A region that the script does not list is its first one.
    pub fn record(&mut self, start: u32, end: u32, action: &Action) {
        let from_s = time(seconds_of(start));
        let at_s = from_s;
        let for_s = time(seconds_of(end.saturating_sub(start).max(1)));
        let script = &mut self.script;
        let named = |regions: &[RegionTable], index: usize| {
            let region = regions.get(index).filter(|_| index > 0);
            region.map(|region| region.name.clone())
        };
        match action.rounded() {
            Action::Volume(own) => script.volumes.push(VolumeTable {
                center: Row(own.center),
                radius: own.radius,
                detail: own.detail,
                from_s,
                region: named(&script.regions, own.region),
                recipe: own.recipe,
            }),
            Action::Pour(own) => {
                let (at, picked, path) = rows(own.place);
                let (amount_mm3, rate_mm3_s) = keys(own.quantity);
                let region = named(&script.regions, own.region);
                let recipe = own.recipe;
                script.pours.push(PourTable {
                    at,
                    picked,
                    path,
                    from_s,
                    for_s,
                    amount_mm3,
                    rate_mm3_s,
                    region,
                    recipe,
                });
            }
            Action::Push(own) => {
                let at = Row(own.at);
                let towards = Row(own.towards);
                let radius = own.radius;
                let strength = own.strength;
                script.pushes.push(PushTable { at, towards, radius, strength, from_s, for_s });
            }
            Action::Lift(own) => {
                let (at, picked, path) = rows(own.place);
                let radius = own.radius;
                let rate = own.rate;
                script.lifts.push(LiftTable { at, picked, path, radius, from_s, for_s, rate });
            }
            Action::Split(Split { volume }) => {
                let volume = volume.and_then(|index| u32::try_from(index + 1).ok());
                script.splits.push(SplitTable { at_s, volume });
            }
            Action::Dry(Dry { ball }) => {
                let at = ball.map(|own| Row(own.center));
                let radius = ball.map(|own| own.radius);
                script.dries.push(DryTable { at_s, at, radius });
            }
        }
    }

    /// The script so far, which lasts `steps` steps.
    #[must_use]
    pub fn script(&self, steps: u32) -> Script {
        Script { seconds: seconds_of(steps), ..self.script.clone() }.rounded()
    }
}

type Rows = (Option<Row<3>>, Option<Row<2>>, Vec<Row<4>>);

fn rows(place: Place) -> Rows {
    match place {
        Place::At(at) => (Some(Row(at)), None, Vec::new()),
        Place::Picked(at) => (None, Some(Row(at)), Vec::new()),
        Place::Path(points) => (
            None,
            None,
            points
                .iter()
                .map(|point: &PathPoint| {
                    let [x, y, z] = point.at;
                    Row([point.seconds, x, y, z])
                })
                .collect(),
        ),
    }
}

fn keys(quantity: Quantity) -> (Option<f64>, Option<f64>) {
    match quantity {
        Quantity::Amount(amount) => (Some(amount), None),
        Quantity::Rate(rate) => (None, Some(rate)),
    }
}

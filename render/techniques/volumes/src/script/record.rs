//! A script as actions in time, and the way back: what you do in a session as a script.
//!
//! A session rounds what it does before it does it. The recording holds the rounded numbers, so it
//! plays the same.

use std::collections::BTreeMap;

use paint::ground::{GroundSpec, MeasuredPrimer, Primer};
use pigment::digits;
use toml::{Table, Value};

use super::action::{Action, Dry, Lift, NewVolume, PathPoint, Place, Pour, Push, Quantity, Split};
use super::camera::{CameraTable, KeyframeTable};
use super::file::Script;
use super::rows::{Ball, Pair, Row};
use super::tables::{
    DryTable, KeepTable, LiftTable, PourTable, PushTable, RegionTable, SplitTable, VolumeTable,
};
use crate::toml_text::KeyPath;
use crate::world::STEPS_PER_SECOND;

/// An action, and when it happens.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// The action begins before this step. Steps count from 0.
    pub start: u32,
    /// The action ends before this step. It is above `start`, so actions of a moment last one
    /// step.
    pub end: u32,
    /// The action.
    pub action: Action,
    /// Path of its table in the script. Faults show this.
    pub table: KeyPath,
}

/// Number of steps nearest to a time of at least 0 s.
#[must_use]
pub fn steps_of(seconds: f64) -> u32 {
    (seconds * f64::from(STEPS_PER_SECOND)).round() as u32
}

/// Time of a step in seconds.
#[must_use]
pub fn seconds_of(steps: u32) -> f64 {
    f64::from(steps) / f64::from(STEPS_PER_SECOND)
}

impl Script {
    /// All actions. We sort them by the step in which they begin, then in the order of [`Action`],
    /// then as in the script. First [`Script::check`] the script.
    #[must_use]
    pub fn events(&self) -> Vec<Event> {
        let mut events = Vec::new();
        let mut add = |name: &str, index: usize, [from, duration]: [f64; 2], action: Action| {
            let start = steps_of(from);
            let end = start + steps_of(duration).max(1);
            events.push(Event { start, end, action, table: KeyPath::of(name).index(index) });
        };
        for (index, table) in self.volumes.iter().enumerate() {
            let volume = NewVolume {
                center: table.center.0,
                radius: table.radius,
                detail: table.detail,
                recipe: table.recipe.clone(),
                region: self.region_index(table.region.as_deref()).unwrap_or(0),
            };
            add("volume", index, [table.from_s, 0.0], Action::Volume(volume));
        }
        for (index, table) in self.pours.iter().enumerate() {
            let pour = Pour {
                place: place(table.at, table.picked, &table.path),
                quantity: quantity(table.amount_mm3, table.rate_mm3_s),
                recipe: table.recipe.clone(),
                region: self.region_index(table.region.as_deref()).unwrap_or(0),
            };
            add("pour", index, [table.from_s, table.for_s], Action::Pour(pour));
        }
        for (index, table) in self.pushes.iter().enumerate() {
            let at = table.at.0;
            let towards = table.towards.0;
            let push = Push { at, towards, radius: table.radius, strength: table.strength };
            add("push", index, [table.from_s, table.for_s], Action::Push(push));
        }
        for (index, table) in self.lifts.iter().enumerate() {
            let lift = Lift {
                place: place(table.at, table.picked, &table.path),
                radius: table.radius,
                rate: table.rate,
            };
            add("lift", index, [table.from_s, table.for_s], Action::Lift(lift));
        }
        for (index, table) in self.splits.iter().enumerate() {
            let volume = table.volume.map(|number| number.saturating_sub(1) as usize);
            add("split", index, [table.at_s, 0.0], Action::Split(Split { volume }));
        }
        for (index, table) in self.dries.iter().enumerate() {
            let ball = table.at.zip(table.radius);
            let ball = ball.map(|(Row(center), radius)| Ball { center, radius });
            add("dry", index, [table.at_s, 0.0], Action::Dry(Dry { ball }));
        }
        events.sort_by_key(|event| (event.start, event.action.rank()));
        events
    }
}

fn place(at: Option<Row<3>>, picked: Option<Row<2>>, path: &[Row<4>]) -> Place {
    if !path.is_empty() {
        return Place::Path(
            path.iter()
                .map(|&Row([seconds, x, y, z]): &Row<4>| PathPoint { seconds, at: [x, y, z] })
                .collect(),
        );
    }
    match picked {
        Some(Row(picked)) => Place::Picked(picked),
        None => Place::At(at.map(|Row(at)| at).unwrap_or_default()),
    }
}

fn quantity(amount: Option<f64>, rate: Option<f64>) -> Quantity {
    match rate {
        Some(rate) => Quantity::Rate(rate),
        None => Quantity::Amount(amount.unwrap_or(0.0)),
    }
}

/// A script that grows while a session goes on.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorder {
    script: Script,
}

impl Action {
    /// The action with its numbers rounded as a file holds them. A session must round an action
    /// before it does it. Then its recording plays the same bits.
    #[must_use]
    pub fn rounded(&self) -> Self {
        fn row(row: [f64; 3]) -> [f64; 3] {
            row.map(six)
        }
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
    /// A recorder that begins with `script`. It takes over its subject, palette, settings, regions
    /// and walls, and what the script does already.
    #[must_use]
    pub fn new(script: &Script) -> Self {
        Self { script: script.rounded() }
    }

    /// Adds an action that lasts from step `start` to before step `end`. This records it as
    /// [`Action::rounded`] gives it. If the script does not list its region, the first one counts.
    pub fn record(&mut self, start: u32, end: u32, action: &Action) {
        let from_s = time(seconds_of(start));
        let at_s = from_s;
        let for_s = time(seconds_of(end.saturating_sub(start).max(1)));
        let script = &mut self.script;
        fn named(regions: &[RegionTable], index: usize) -> Option<String> {
            let region = regions.get(index).filter(|_| index > 0);
            region.map(|region| region.name.clone())
        }
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

/// Six significant digits, and never -0, because we read this as 0.
pub(super) fn six(value: f64) -> f64 {
    digits::rounded(value) + 0.0
}

/// A time in seconds with four decimals. These are finer than half a step of 1/120 s.
pub(super) fn time(seconds: f64) -> f64 {
    (seconds * 1e4).round() / 1e4 + 0.0
}

pub(super) fn row<const N: usize>(row: Row<N>) -> Row<N> {
    Row(row.0.map(six))
}

pub(super) fn point(Row([seconds, x, y, z]): Row<4>) -> Row<4> {
    Row([time(seconds), six(x), six(y), six(z)])
}

pub(super) fn ball(Ball { center, radius }: Ball) -> Ball {
    Ball { center: center.map(six), radius: six(radius) }
}

pub(super) fn recipe(parts: &BTreeMap<String, f64>) -> BTreeMap<String, f64> {
    parts.iter().map(|(letter, part)| (letter.clone(), six(*part))).collect()
}

impl Script {
    /// The script with its figures as in a file: times with four decimals, everything else with
    /// six significant digits. If you write and read such a script, it stays as it is.
    #[must_use]
    pub fn rounded(&self) -> Self {
        Self {
            unit_mm: self.unit_mm.map(six),
            seconds: time(self.seconds),
            grid: table(&self.grid),
            settings: table(&self.settings),
            ground: self.ground.as_ref().map(ground),
            camera: self.camera.as_ref().map(camera),
            regions: self.regions.iter().map(region).collect(),
            keeps: self.keeps.iter().map(keep).collect(),
            volumes: self.volumes.iter().map(volume).collect(),
            pours: self.pours.iter().map(pour).collect(),
            pushes: self.pushes.iter().map(push).collect(),
            lifts: self.lifts.iter().map(lift).collect(),
            splits: self
                .splits
                .iter()
                .map(|split| SplitTable { at_s: time(split.at_s), volume: split.volume })
                .collect(),
            dries: self.dries.iter().map(dry).collect(),
            ..self.clone()
        }
    }
}

fn table(table: &Table) -> Table {
    table.iter().map(|(key, own)| (key.clone(), value(own))).collect()
}

fn value(own: &Value) -> Value {
    match own {
        Value::Float(number) => Value::Float(six(*number)),
        Value::Array(list) => Value::Array(list.iter().map(value).collect()),
        Value::Table(inner) => Value::Table(table(inner)),
        other => other.clone(),
    }
}

fn ground(own: &GroundSpec) -> GroundSpec {
    let mut own = own.clone();
    match &mut own.reflectance {
        Some(Primer::Grey(grey)) => *grey = six(*grey),
        Some(Primer::Measured(MeasuredPrimer { spectrum })) => {
            spectrum.values.iter_mut().for_each(|value| *value = six(*value));
        }
        Some(Primer::Color(_) | Primer::Toned(_)) | None => {}
    }
    own
}

fn camera(camera: &CameraTable) -> CameraTable {
    CameraTable {
        azimuth_deg: camera.azimuth_deg.map(six),
        elevation_deg: camera.elevation_deg.map(six),
        field_of_view_deg: camera.field_of_view_deg.map(six),
        turntable: camera.turntable,
        frames: camera.frames,
        closed: camera.closed,
        keyframes: camera
            .keyframes
            .iter()
            .map(|own: &KeyframeTable| KeyframeTable {
                eye: row(own.eye),
                target: row(own.target),
                up: own.up.map(row),
                field_of_view_deg: own.field_of_view_deg.map(six),
            })
            .collect(),
    }
}

fn region(region: &RegionTable) -> RegionTable {
    let [shells, tint] = [&region.shells, &region.tint]
        .map(|list| Some(list.as_ref()?.iter().map(|&value| six(value)).collect()));
    RegionTable { shells, tint, ..region.clone() }
}

fn keep(keep: &KeepTable) -> KeepTable {
    fn pair(Pair(rows): Pair) -> Pair {
        Pair(rows.map(|row| row.map(six)))
    }
    KeepTable {
        cuboid: keep.cuboid.map(pair),
        sphere: keep.sphere.map(ball),
        above: keep.above.map(pair),
    }
}

fn volume(volume: &VolumeTable) -> VolumeTable {
    VolumeTable {
        center: row(volume.center),
        radius: six(volume.radius),
        from_s: time(volume.from_s),
        recipe: recipe(&volume.recipe),
        ..volume.clone()
    }
}

fn pour(pour: &PourTable) -> PourTable {
    PourTable {
        at: pour.at.map(row),
        picked: pour.picked.map(row),
        path: pour.path.iter().copied().map(point).collect(),
        from_s: time(pour.from_s),
        for_s: time(pour.for_s),
        amount_mm3: pour.amount_mm3.map(six),
        rate_mm3_s: pour.rate_mm3_s.map(six),
        recipe: recipe(&pour.recipe),
        ..pour.clone()
    }
}

fn push(push: &PushTable) -> PushTable {
    PushTable {
        at: row(push.at),
        towards: row(push.towards),
        radius: six(push.radius),
        strength: six(push.strength),
        from_s: time(push.from_s),
        for_s: time(push.for_s),
    }
}

fn lift(lift: &LiftTable) -> LiftTable {
    LiftTable {
        at: lift.at.map(row),
        picked: lift.picked.map(row),
        path: lift.path.iter().copied().map(point).collect(),
        radius: six(lift.radius),
        from_s: time(lift.from_s),
        for_s: time(lift.for_s),
        rate: six(lift.rate),
    }
}

fn dry(dry: &DryTable) -> DryTable {
    DryTable { at_s: time(dry.at_s), at: dry.at.map(row), radius: dry.radius.map(six) }
}

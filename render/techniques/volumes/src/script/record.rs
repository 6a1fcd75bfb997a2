//! Records what you do in a session as a script, and changes the settings of a script.
//!
//! A session rounds what it does before it does it. The recording holds the rounded numbers, so it
//! plays the same.

use std::collections::BTreeMap;

use paint::ground::{GroundSpec, MeasuredPrimer, Primer};
use pigment::digits;
use toml::{Table, Value};

use super::action::{Action, Dry, Lift, NewVolume, PathPoint, Place, Pour, Push, Quantity, Split};
use super::camera::{CameraTable, KeyframeTable};
use super::events::seconds_of;
use super::file::Script;
use super::rows::{Ball, Pair, Row};
use super::tables::{
    DryTable, KeepTable, LiftTable, PourTable, PushTable, RegionTable, SplitTable, VolumeTable,
};
use crate::settings::SettingsError;
use crate::toml_text::Source;

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

impl Script {
    /// Replaces settings of the script by the ones in `text` (TOML). Errors call this text `name`.
    ///
    /// # Errors
    /// [`SettingsError`] if the text is no TOML, a key is unknown, or a value is out of its range.
    pub fn change_settings(&mut self, name: &str, text: &str) -> Result<(), SettingsError> {
        let settings = self.settings().map_err(crate::toml_text::TextError::from)?;
        settings.changed(name, text)?;
        let mut changes: Table = Source::toml(name, text)?.typed()?;
        if let Some(Value::Table(grid)) = changes.remove("grid") {
            let own = match self.grid.is_empty() {
                true => group(&mut self.settings, "grid"),
                false => &mut self.grid,
            };
            own.extend(grid);
        }
        if changes.contains_key("unit_mm") {
            self.unit_mm = None;
        }
        for (key, change) in changes {
            match change {
                Value::Table(values) => group(&mut self.settings, &key).extend(values),
                value => {
                    self.settings.insert(key, value);
                }
            }
        }
        Ok(())
    }

    /// Leaves the light out unless the script asks for it. Use this for a photograph, which has
    /// its own light.
    pub fn light_of_its_own(&mut self) {
        let light = group(&mut self.settings, "light");
        light.entry("lit").or_insert(Value::Boolean(false));
    }
}

/// The group of settings with this name. Makes it if there is none.
fn group<'t>(settings: &'t mut Table, name: &str) -> &'t mut Table {
    let group = settings.entry(name).or_insert_with(|| Value::Table(Table::new()));
    if !group.is_table() {
        *group = Value::Table(Table::new());
    }
    match group {
        Value::Table(group) => group,
        _ => unreachable!("made a table above"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_join_the_settings_of_a_script() {
        let mut script = Script::new("shape:sphere", 1.0);
        script.unit_mm = Some(2.0);
        script.change_settings("a", "motion.kick = 0.5\ngrid.rate = 0.01").unwrap();
        script.change_settings("b", "unit_mm = 3.0\n[motion]\ngrain = 0.5").unwrap();
        let settings = script.settings().unwrap();
        assert_eq!((settings.motion.kick, settings.motion.grain), (0.5, 0.5));
        assert_eq!((settings.grid.rate, settings.unit_mm), (0.01, 3.0));
        let error = script.change_settings("c", "motion.kick = -1.0").unwrap_err();
        assert!(error.to_string().contains("kick"), "{error}");
        assert_eq!(script.settings().unwrap(), settings);
        script.light_of_its_own();
        assert!(!script.settings().unwrap().light.lit);
        script.change_settings("d", "light.lit = true").unwrap();
        script.light_of_its_own();
        assert!(script.settings().unwrap().light.lit);
        let written = Script::from_text("s", &script.to_text().unwrap()).unwrap();
        assert_eq!(written.settings().unwrap(), script.settings().unwrap());
    }
}

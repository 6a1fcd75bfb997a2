//! Rounding of a script to the digits of a file.
//!
//! A session rounds what it does before it does it, so that its recording, which holds the rounded
//! numbers, plays the same.

use std::collections::BTreeMap;

use paint::ground::{GroundSpec, MeasuredPrimer, Primer};
use pigment::digits;
use toml::{Table, Value};

use super::camera::{CameraTable, KeyframeTable};
use super::file::Script;
use super::rows::{Ball, Pair, Row};
use super::tables::{
    DryTable, KeepTable, LiftTable, PourTable, PushTable, RegionTable, SplitTable, VolumeTable,
};

/// Six significant digits, and never -0, which reads like 0.
pub(super) fn six(value: f64) -> f64 {
    digits::rounded(value) + 0.0
}

/// A time in seconds with four decimals, less than half a step of 1/120 s.
pub(super) fn time(seconds: f64) -> f64 {
    (seconds * 1e4).round() / 1e4 + 0.0
}

/// All numbers of a row with six digits.
pub(super) fn row<const N: usize>(row: Row<N>) -> Row<N> {
    Row(row.0.map(six))
}

/// A point of a path: its time with four decimals, its place with six digits.
pub(super) fn point(Row([seconds, x, y, z]): Row<4>) -> Row<4> {
    Row([time(seconds), six(x), six(y), six(z)])
}

/// A ball with six digits.
pub(super) fn ball(Ball { center, radius }: Ball) -> Ball {
    Ball { center: center.map(six), radius: six(radius) }
}

/// The parts of a recipe with six digits.
pub(super) fn recipe(parts: &BTreeMap<String, f64>) -> BTreeMap<String, f64> {
    parts.iter().map(|(letter, part)| (letter.clone(), six(*part))).collect()
}

impl Script {
    /// The script with its figures as a file has them: times with four decimals, everything else
    /// with six significant digits. Writing and reading leaves such a script as it is.
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

/// A ground whose reflectance has six digits.
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
    let list = |list: &Vec<f64>| list.iter().map(|&value| six(value)).collect();
    RegionTable {
        shells: region.shells.as_ref().map(list),
        tint: region.tint.as_ref().map(list),
        ..region.clone()
    }
}

fn keep(keep: &KeepTable) -> KeepTable {
    let pair = |Pair(rows): Pair| Pair(rows.map(|row| row.map(six)));
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

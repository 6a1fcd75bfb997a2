//! Samples as rows of numbers: `[seconds, x, y, pressure, tilt x, tilt y, twist]`, where
//! zeros at the end may be left out.

use std::fmt;

use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde::ser::{SerializeSeq, Serializer};
use serde::{Deserialize, Serialize};

use crate::pose::Sample;
use crate::stroke::SampleDecimals;

/// Fewest numbers of a row: seconds, x, y, pressure.
const SHORTEST: usize = 4;
/// Most numbers of a row: also tilt x, tilt y and twist.
const LONGEST: usize = 7;

/// The numbers of a sample in the order of a row.
pub(super) fn numbers(sample: &Sample) -> [f64; LONGEST] {
    let Sample { seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg } = *sample;
    [seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg]
}

struct Row(Sample);

impl Serialize for Row {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let numbers = numbers(&SampleDecimals::RECORDING.round(&self.0));
        let used = numbers.iter().rposition(|number| *number != 0.0).map_or(0, |last| last + 1);
        numbers[..used.max(SHORTEST)].serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;

        impl<'de> Visitor<'de> for Numbers {
            type Value = Row;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter
                    .write_str("4 to 7 numbers: seconds, x, y, pressure, tilt x, tilt y, twist")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Row, A::Error> {
                let mut numbers = [0.0; LONGEST];
                let mut count = 0;
                while let Some(number) = list.next_element::<f64>()? {
                    match numbers.get_mut(count) {
                        Some(place) => *place = number,
                        None => return Err(de::Error::invalid_length(count + 1, &self)),
                    }
                    count += 1;
                }
                if count < SHORTEST {
                    return Err(de::Error::invalid_length(count, &self));
                }
                let [seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg] = numbers;
                Ok(Row(Sample { seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg }))
            }
        }

        deserializer.deserialize_seq(Numbers)
    }
}

pub(super) fn serialize<S: Serializer>(
    samples: &[Sample],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut list = serializer.serialize_seq(Some(samples.len()))?;
    for sample in samples {
        list.serialize_element(&Row(*sample))?;
    }
    list.end()
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<Sample>, D::Error> {
    struct Samples;

    impl<'de> Visitor<'de> for Samples {
        type Value = Vec<Sample>;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("a list of samples")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<Sample>, A::Error> {
            let mut samples = Vec::new();
            while let Some(Row(sample)) = list.next_element()? {
                samples.push(sample);
            }
            Ok(samples)
        }
    }

    deserializer.deserialize_seq(Samples)
}

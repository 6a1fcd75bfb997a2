//! Requests: the options of a job as one type of a library, which every program fills in its own way: the
//! command line from options, Python and the pages from JSON.
//!
//! ```
//! use documents::hint::Explain;
//! use documents::request::request_from_json;
//!
//! #[derive(Debug, Default, serde::Deserialize)]
//! #[serde(default, deny_unknown_fields)]
//! struct SumRequest {
//!     title: Option<String>,
//!     digits: u8,
//! }
//!
//! let request: SumRequest = request_from_json(r#"{"digits": 3, "title": null}"#)?;
//! assert_eq!((request.title, request.digits), (None, 3));
//! let error = request_from_json::<SumRequest>(r#"{"digit": 3}"#).unwrap_err();
//! assert_eq!(error.to_string(), "unknown key `digit`");
//! assert_eq!(error.hint().map(|hint| hint.to_string()).as_deref(), Some("did you mean digits?"));
//! # Ok::<(), documents::request::RequestError>(())
//! ```

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeOwned, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

use crate::hint::{Explain, Hint};
use crate::text::{Source, TextError};

/// Reads a request from JSON. A key with the value `null` counts as absent.
///
/// # Errors
/// [`RequestError`] for an unknown key, or a value that its key does not take.
pub fn request_from_json<T: DeserializeOwned>(json: &str) -> Result<T, RequestError> {
    let values = serde_json::from_str(json).map_err(|error| RequestError {
        key: None,
        reason: error.to_string(),
        hint: None,
    })?;
    request_of(values)
}

/// Makes a request of values by key, as [`request_from_json`] does.
///
/// # Errors
/// [`RequestError`] for an unknown key, or a value that its key does not take.
pub fn request_of<T: DeserializeOwned>(mut values: Map<String, Value>) -> Result<T, RequestError> {
    drop_nulls(&mut values);
    let json = Value::Object(values).to_string();
    Source::json("the request", &json).and_then(|source| source.typed_json()).map_err(Into::into)
}

fn drop_nulls(values: &mut Map<String, Value>) {
    values.retain(|_, value| !value.is_null());
    for value in values.values_mut() {
        if let Value::Object(inner) = value {
            drop_nulls(inner);
        }
    }
}

/// A key of a request that does not exist, or a value that its key does not take.
#[derive(Debug, Clone, PartialEq, Eq, Explain)]
#[hint(with = hint.as_deref().map(Hint::new))]
#[fault(Setting)]
pub struct RequestError {
    /// Path of the key, with dots between its steps. `None` where the reason is a whole sentence, or the text
    /// is not JSON.
    pub key: Option<String>,
    /// The reason, which follows the key.
    pub reason: String,
    /// The hint. Settings in it stand in square brackets.
    pub hint: Option<String>,
}

impl RequestError {
    /// A value that its key does not take. The reason is, for example, `takes A,B, found `3``.
    #[must_use]
    pub fn value(reason: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { key: None, reason: reason.into(), hint: Some(hint.into()) }
    }

    /// The message and the hint of another error, for the value of a key.
    #[must_use]
    pub fn of(error: &impl Explain) -> Self {
        let hint = error.hint().map(|hint| {
            hint.with_settings(|name, value| match value {
                Some(value) => format!("[{name}={value}]"),
                None => format!("[{name}]"),
            })
        });
        Self { key: None, reason: error.to_string(), hint }
    }

    /// The error for the value of `key`.
    #[must_use]
    pub fn at(self, key: &str) -> Self {
        Self { key: Some(key.to_owned()), ..self }
    }

    /// The message with the key as a program shows it, such as an option of a command line.
    ///
    /// ```
    /// let error = documents::request::RequestError {
    ///     key: Some("least_share".to_owned()),
    ///     reason: "takes a share from 0 to 1, found `2`".to_owned(),
    ///     hint: None,
    /// };
    /// let told = error.message(|key| format!("--{}", key.replace('_', "-")));
    /// assert_eq!(told, "--least-share takes a share from 0 to 1, found `2`");
    /// ```
    #[must_use]
    pub fn message(&self, shown: impl Fn(&str) -> String) -> String {
        let reason = &self.reason;
        match &self.key {
            None => reason.clone(),
            Some(key) if reason.starts_with(TAKES) => format!("{} {reason}", shown(key)),
            Some(key) => format!("{}: {reason}", shown(key)),
        }
    }
}

impl fmt::Display for RequestError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(str::to_owned))
    }
}

impl std::error::Error for RequestError {}

impl From<TextError> for RequestError {
    fn from(error: TextError) -> Self {
        let TextError::Syntax { key, reason, hint, .. } = &error else {
            return Self { key: None, reason: error.to_string(), hint: None };
        };
        let key = key.as_ref().map(ToString::to_string);
        let (reason, hint, is_whole) = match reason.split_once(WAY_OUT) {
            Some((reason, hint)) => (reason, hint, !reason.starts_with(TAKES)),
            None => (&**reason, &**hint, reason.starts_with("unknown key")),
        };
        let hint = (!hint.is_empty()).then(|| hint.to_owned());
        Self { key: key.filter(|_| !is_whole), reason: reason.to_owned(), hint }
    }
}

/// Begins a reason that follows its key without a colon.
const TAKES: &str = "takes ";

/// Separates the reason from the hint in messages of serde, which have no field for a hint.
const WAY_OUT: char = '\u{1f}';

/// Makes the error of serde for a value that cannot be used. [`RequestError`] takes reason and hint
/// from it.
pub fn refused<E: Error>(error: RequestError) -> E {
    let RequestError { reason, hint, .. } = error;
    E::custom(format_args!("{reason}{WAY_OUT}{}", hint.unwrap_or_default()))
}

/// Reads a value that people write as text by `parse`: JSON may hold the text, a number, or a list of numbers.
/// For the attribute `deserialize_with`.
///
/// # Errors
/// The error of `parse`, or that the value is none of these.
pub fn from_text<'de, D: Deserializer<'de>, T>(
    deserializer: D,
    parse: impl FnOnce(&str) -> Result<T, RequestError>,
) -> Result<T, D::Error> {
    deserializer.deserialize_any(TextVisitor { parse })
}

/// Reads a value that people write as text by `parse`, or by the keys of `K`. For the attribute `deserialize_with`.
///
/// # Errors
/// The error of `parse` or of a key, or that the value is neither a text nor an object.
pub fn from_text_or_keys<'de, D: Deserializer<'de>, K: Deserialize<'de>, T>(
    deserializer: D,
    parse: impl FnOnce(&str) -> Result<T, RequestError>,
    of_keys: impl FnOnce(K) -> T,
) -> Result<T, D::Error> {
    deserializer.deserialize_any(TextOrKeysVisitor { parse, of_keys, keys: PhantomData })
}

struct TextOrKeysVisitor<P, O, K> {
    parse: P,
    of_keys: O,
    keys: PhantomData<K>,
}

impl<'de, K, T, P, O> Visitor<'de> for TextOrKeysVisitor<P, O, K>
where
    K: Deserialize<'de>,
    P: FnOnce(&str) -> Result<T, RequestError>,
    O: FnOnce(K) -> T,
{
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a text or an object")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        (self.parse)(text).map_err(refused)
    }

    fn visit_map<A: MapAccess<'de>>(self, keys: A) -> Result<T, A::Error> {
        K::deserialize(MapAccessDeserializer::new(keys)).map(self.of_keys)
    }
}

/// Parses within the visit, so that an error gets the place of its value.
struct TextVisitor<P> {
    parse: P,
}

impl<T, P: FnOnce(&str) -> Result<T, RequestError>> TextVisitor<P> {
    fn parsed<E: Error>(self, text: &str) -> Result<T, E> {
        (self.parse)(text).map_err(refused)
    }
}

impl<'de, T, P: FnOnce(&str) -> Result<T, RequestError>> Visitor<'de> for TextVisitor<P> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a text, a number or a list of numbers")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        self.parsed(text)
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<T, E> {
        self.parsed(&number.to_string())
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<T, E> {
        self.parsed(&number.to_string())
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<T, E> {
        self.parsed(&number.to_string())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<T, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = list.next_element::<f64>()? {
            numbers.push(number.to_string());
        }
        self.parsed(&numbers.join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hint::Fault;
    use serde::Deserialize;

    #[derive(Debug, PartialEq, Default, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    struct Sample {
        #[serde(deserialize_with = "pair")]
        pair: [f64; 2],
        grain: Grain,
        inner: Inner,
        #[serde(deserialize_with = "either")]
        either: Inner,
    }

    fn either<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Inner, D::Error> {
        from_text_or_keys(
            deserializer,
            |text| {
                let count = text.parse().map(|count| Inner { count });
                count.map_err(|_| {
                    RequestError::value(format!("takes a count, found `{text}`"), "try [either=1]")
                })
            },
            |inner| inner,
        )
    }

    #[derive(Debug, PartialEq, Default, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    struct Inner {
        count: u32,
    }

    #[derive(Debug, PartialEq, Default, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Grain {
        #[default]
        Fine,
        Coarse,
    }

    fn pair<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
        from_text(deserializer, |text| {
            let numbers: Vec<f64> = text.split(',').filter_map(|part| part.parse().ok()).collect();
            numbers.try_into().map_err(|_| {
                RequestError::value(format!("takes A,B, found `{text}`"), "try [pair=1,2]")
            })
        })
    }

    #[test]
    fn text_numbers_and_lists_are_one_value() {
        for json in [r#"{"pair": "1,2.5"}"#, r#"{"pair": [1, 2.5]}"#] {
            let sample: Sample = request_from_json(json).unwrap();
            assert_eq!(sample.pair, [1.0, 2.5]);
        }
        let absent = r#"{"pair": null, "inner": {"count": null}, "grain": null}"#;
        assert_eq!(request_from_json::<Sample>(absent).unwrap(), Sample::default());
        let coarse: Sample = request_from_json(r#"{"grain": "coarse"}"#).unwrap();
        assert_eq!(coarse.grain, Grain::Coarse);
    }

    #[test]
    fn text_and_keys_are_one_value() {
        for json in [r#"{"either": "3"}"#, r#"{"either": {"count": 3}}"#] {
            let sample: Sample = request_from_json(json).unwrap();
            assert_eq!(sample.either, Inner { count: 3 }, "{json}");
        }
    }

    #[test]
    fn errors_name_the_key_and_the_way_out() {
        for (json, message, hint) in [
            (r#"{"either": "few"}"#, "either takes a count, found `few`", "try `either = 1`"),
            (r#"{"either": {"coumt": 1}}"#, "unknown key `coumt`", "did you mean count?"),
            (r#"{"pair": 3, "grain": "fine"}"#, "pair takes A,B, found `3`", "try `pair = 1,2`"),
            (r#"{"grain": "corse"}"#, "grain: unknown word `corse`", "did you mean coarse?"),
            (r#"{"grein": "fine"}"#, "unknown key `grein`", "did you mean grain?"),
            (r#"{"inner": {"coumt": 1}}"#, "unknown key `coumt`", "did you mean count?"),
            (
                r#"{"inner": {"count": -1}}"#,
                "inner.count: invalid value: number `-1`, expected a whole number, 0 or more",
                "write a value of the kind that the key takes",
            ),
        ] {
            let error = request_from_json::<Sample>(json).unwrap_err();
            assert_eq!(error.to_string(), message);
            assert_eq!(error.hint().unwrap().to_string(), hint);
            assert_eq!(error.fault(), Fault::Setting);
        }
        assert!(request_from_json::<Sample>("[]").unwrap_err().key.is_none());
    }
}

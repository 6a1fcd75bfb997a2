//! Options of a verb from the request of a library: each key of the request is an option, and the comment of its
//! field is the help.

use std::collections::BTreeMap;
use std::marker::PhantomData;

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};
use documents::request::{RequestError, request_of};
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::de::DeserializeOwned;
use serde_json::{Map, Number, Value, json};

use crate::failure::{Failure, Result};

/// A request that a verb takes as options.
pub(crate) trait CommandLine: DeserializeOwned + JsonSchema {
    /// Adds to the `option` of `key` everything that the request does not know, e.g. a name for its value.
    fn adapted(key: &str, option: Arg) -> Arg;

    /// Whether `key` is an option. The verb sets the other keys in its own way.
    fn is_option(_key: &str) -> bool {
        true
    }
}

/// The keys of the request `T` as options of a command. A key that holds further keys is not an option.
#[derive(Debug, Clone)]
pub(crate) struct RequestOptions<T> {
    given: Map<String, Value>,
    request: PhantomData<T>,
}

impl<T: CommandLine> RequestOptions<T> {
    /// The request, with its defaults where the command gives no option.
    pub(crate) fn request(&self) -> Result<T> {
        request_of(self.given.clone()).map_err(refusal::<T>)
    }

    /// Whether an option was given with this text.
    pub(crate) fn is(&self, key: &str, text: &str) -> bool {
        self.given.get(key).is_some_and(|given| given == text)
    }

    /// Removes an option and returns the texts that were given for it.
    pub(crate) fn take(&mut self, key: &str) -> Vec<String> {
        let texts = match self.given.remove(key) {
            Some(Value::Array(texts)) => texts,
            text => text.into_iter().collect(),
        };
        texts.into_iter().filter_map(|text| text.as_str().map(str::to_owned)).collect()
    }
}

impl<T: CommandLine> Args for RequestOptions<T> {
    fn augment_args(command: Command) -> Command {
        let keys = keys::<T>();
        let options: Vec<(Arg, &Key)> = keys.iter().map(|key| (key.option::<T>(), key)).collect();
        let names: BTreeMap<String, String> = options
            .iter()
            .map(|(option, key)| (format!("`{}`", key.name), as_typed(option)))
            .collect();
        let helped = options.into_iter().map(|(option, key)| {
            let mut text = key.help.clone();
            for (key, name) in &names {
                text = text.replace(key, name);
            }
            with_help(option, &text)
        });
        command.args(helped)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<T: CommandLine> FromArgMatches for RequestOptions<T> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, Error> {
        let mut given = Map::new();
        for key in keys::<T>() {
            if matches.value_source(&key.name) != Some(ValueSource::CommandLine) {
                continue;
            }
            let raw = matches.get_raw(&key.name).into_iter().flatten();
            let texts = raw.map(|text| text.to_string_lossy().into_owned());
            given.insert(key.name.clone(), key.value(texts.collect()));
        }
        Ok(Self { given, request: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> std::result::Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// An option that does not explain its possible values, for values that need no explanation.
pub(crate) fn without_value_help(option: Arg) -> Arg {
    let names: Vec<String> =
        option.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
    option.value_parser(PossibleValuesParser::new(names))
}

/// The option without `left_out`, one of its possible values.
pub(crate) fn without_value(option: Arg, left_out: &str) -> Arg {
    let mut values = option.get_possible_values();
    values.retain(|value| value.get_name() != left_out);
    option.value_parser(PossibleValuesParser::new(values))
}

/// The error of a request in the words of the command line.
pub(crate) fn refusal<T: CommandLine>(error: RequestError) -> Failure {
    let keys = keys::<T>();
    Failure::of_request(&error, |name| {
        // An entry of a list is one value of its option.
        let entry = name.strip_prefix("[[").and_then(|name| name.split_once("]]"));
        let list = entry.map_or(name, |(list, _)| list);
        let key = keys.iter().find(|key| key.name == list);
        key.map_or_else(|| name.to_owned(), |key| as_typed(&key.option::<T>()))
    })
}

/// The option as a user types it, e.g. `--least-share`.
fn as_typed(option: &Arg) -> String {
    format!("--{}", option.get_long().unwrap_or_default())
}

/// A key of a request.
#[derive(Debug)]
struct Key {
    name: String,
    help: String,
    kind: Kind,
    default: Option<String>,
}

/// Values that a key takes.
#[derive(Debug, PartialEq)]
enum Kind {
    /// True or false.
    Flag,
    /// One of some words, each with its help.
    Words(Vec<(String, String)>),
    /// A whole number, with its format in the schema, e.g. `uint64`.
    Whole(String),
    Number,
    /// A text. Some keys also take a number.
    Text {
        may_be_number: bool,
    },
    Texts,
}

/// The keys of a request that are options, in the order of its fields.
fn keys<T: CommandLine>() -> Vec<Key> {
    let settings = SchemaSettings::draft2020_12().with(|settings| {
        settings.inline_subschemas = true;
    });
    let schema = settings.into_generator().into_root_schema_for::<T>().to_value();
    let properties = schema.get("properties").and_then(Value::as_object);
    let options = properties.into_iter().flatten().filter(|(name, _)| T::is_option(name));
    let keys = options.filter_map(|(name, property)| {
        let kind = kind(property)?;
        let default = property.get("default").filter(|_| kind != Kind::Flag).and_then(text_of);
        let help = property.get("description").and_then(Value::as_str).unwrap_or_default();
        Some(Key { name: name.clone(), help: help.to_owned(), kind, default })
    });
    keys.collect()
}

/// The values that a schema allows. `None` for a key that holds further keys.
fn kind(schema: &Value) -> Option<Kind> {
    let mut types = Vec::new();
    let mut words = Vec::new();
    for alternative in alternatives(schema) {
        let help = alternative.get("description").and_then(Value::as_str).unwrap_or_default();
        let listed = alternative.get("enum").and_then(Value::as_array);
        let before = words.len();
        for word in alternative.get("const").into_iter().chain(listed.into_iter().flatten()) {
            words.extend(word.as_str().map(|word| (word.to_owned(), help.to_owned())));
        }
        if words.len() > before {
            continue;
        }
        if alternative.pointer("/items/type").is_some_and(|items| items == "object") {
            return None;
        }
        match alternative.get("type") {
            Some(Value::String(name)) => types.push(name.as_str()),
            Some(Value::Array(names)) => types.extend(names.iter().filter_map(Value::as_str)),
            _ => {}
        }
    }
    let has = |name: &str| types.contains(&name);
    let format = schema.get("format").and_then(Value::as_str).unwrap_or_default();
    Some(match () {
        () if has("boolean") => Kind::Flag,
        () if has("string") => Kind::Text { may_be_number: has("number") },
        () if has("object") => return None,
        () if !words.is_empty() && has("number") => Kind::Text { may_be_number: true },
        () if !words.is_empty() => Kind::Words(words),
        () if has("array") => Kind::Texts,
        () if has("integer") => Kind::Whole(format.to_owned()),
        () => Kind::Number,
    })
}

/// The alternatives of a schema, of which a value must meet one. A schema without alternatives is
/// its only one.
fn alternatives(schema: &Value) -> Vec<&Value> {
    let of = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array());
    let inner: Vec<&Value> = of.flatten().flat_map(alternatives).collect();
    if inner.is_empty() { vec![schema] } else { inner }
}

/// A default value as it is typed.
fn text_of(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Number(number) => number.as_f64().map(|number| number.to_string()),
        _ => None,
    }
}

impl Key {
    /// The option of this key, without its help.
    fn option<T: CommandLine>(&self) -> Arg {
        let option = Arg::new(self.name.clone()).long(self.name.replace('_', "-"));
        if self.kind == Kind::Flag {
            return T::adapted(&self.name, option.action(ArgAction::SetTrue));
        }
        let option = option.value_name(self.name.to_uppercase());
        let option = match &self.default {
            Some(default) => option.default_value(default.clone()),
            None => option,
        };
        let option = match &self.kind {
            Kind::Flag | Kind::Text { may_be_number: false } => option,
            Kind::Text { may_be_number: true } => option.allow_hyphen_values(true),
            Kind::Texts => option.action(ArgAction::Append),
            Kind::Number => option.value_parser(value_parser!(f64)).allow_hyphen_values(true),
            Kind::Whole(format) => match format.as_str() {
                "uint32" => option.value_parser(value_parser!(u32)),
                "uint64" => option.value_parser(value_parser!(u64)).allow_hyphen_values(true),
                _ => option.value_parser(value_parser!(usize)),
            },
            Kind::Words(words) => {
                let values = words.iter().map(|(word, help)| {
                    let value = PossibleValue::new(word.clone());
                    match first_paragraph(help) {
                        text if text.is_empty() => value,
                        text => value.help(text),
                    }
                });
                option.value_parser(PossibleValuesParser::new(values.collect::<Vec<_>>()))
            }
        };
        T::adapted(&self.name, option)
    }

    /// Converts the texts of an option into the JSON value of its key. A text that is not a number
    /// stays a text, so that the request can refuse it.
    fn value(&self, texts: Vec<String>) -> Value {
        match (&self.kind, &texts[..]) {
            (Kind::Flag, _) => Value::Bool(true),
            (Kind::Whole(_), [text]) => {
                text.parse::<u64>().map_or_else(|_| json!(text), Value::from)
            }
            (Kind::Number, [text]) => {
                // JSON has no NaN and no infinity. As text they are refused.
                let number = text.parse().ok().and_then(Number::from_f64);
                number.map_or_else(|| json!(text), Value::from)
            }
            (Kind::Words(_) | Kind::Text { .. }, [text]) => json!(text),
            _ => json!(texts),
        }
    }
}

/// Gives the option a help of several paragraphs, of which `-h` shows only the first.
fn with_help(option: Arg, text: &str) -> Arg {
    let paragraphs = paragraphs(text);
    let option = option.help(first_paragraph(text));
    if paragraphs.len() > 1 { option.long_help(paragraphs.join("\n\n")) } else { option }
}

/// The first paragraph without the full stop at its end.
fn first_paragraph(text: &str) -> String {
    let first = paragraphs(text).into_iter().next().unwrap_or_default();
    match first.strip_suffix('.') {
        Some(sentence) if !sentence.ends_with('.') => sentence.to_owned(),
        _ => first,
    }
}

fn paragraphs(text: &str) -> Vec<String> {
    let of = text.split("\n\n").map(|lines| lines.split_whitespace().collect::<Vec<_>>().join(" "));
    of.filter(|paragraph| !paragraph.is_empty()).collect()
}

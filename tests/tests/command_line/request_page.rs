//! The page of the guide on requests, made from their schema: a table for each request.

use serde_json::{Map, Value};

const HEAD: &str = "\
# Requests: jobs as JSON

A request holds the options of a job. Every program takes the same keys: the command line as options
(`below_surface` is `--below-surface`; `impasto VERB --help` names the few that differ), Python as arguments, the
pages and your own programs as JSON. In Rust you read it with `documents::request::request_from_json`.

```json
{\"method\": \"weighted\", \"surface\": [0.03, 0.6], \"viewing\": {\"illuminant\": \"A\"}}
```

A key that you leave out, or set to `null`, takes its default. An unknown key is an error.
[requests.json](../schema/requests.json) is the JSON schema, from which these tables are made.
";

/// The page for the definitions of the schema. Types that several requests share come last.
pub(super) fn page(definitions: &Map<String, Value>) -> String {
    let (requests, shared): (Vec<_>, Vec<_>) =
        definitions.iter().partition(|(name, _)| name.ends_with("Request"));
    let mut page = HEAD.to_owned();
    for (name, schema) in requests.into_iter().chain(shared) {
        section(&mut page, name, schema);
    }
    page
}

fn section(page: &mut String, name: &str, schema: &Value) {
    let about = schema["description"].as_str().unwrap_or_default();
    if let Some(properties) = schema["properties"].as_object() {
        *page += &format!("\n## {name}\n\n{}.\n\n", flowing(about).trim_end_matches('.'));
        *page += "| key | takes | default | meaning |\n| --- | --- | --- | --- |\n";
        for (key, property) in properties {
            let meaning = cell(property["description"].as_str().unwrap_or_default());
            let default = default(&property["default"]);
            *page += &format!("| `{key}` | {} | {default} | {meaning} |\n", takes(property));
        }
    } else if let Some(words) = schema["oneOf"].as_array() {
        *page += &format!("\n## {name}\n\n{}.\n\n", flowing(about).trim_end_matches('.'));
        *page += "| word | meaning |\n| --- | --- |\n";
        for word in words {
            let meaning = cell(word["description"].as_str().unwrap_or_default());
            *page += &format!("| {} | {meaning} |\n", written(word));
        }
    } else {
        let about = flowing(about);
        *page += &format!("\n## {name}\n\n{about} It is {}.\n", takes(schema));
    }
}

/// A word of an enum as it stands in JSON: a text or a number, or the first key of an object with
/// its value.
fn written(word: &Value) -> String {
    match word["properties"].as_object().and_then(|keys| keys.iter().next()) {
        Some((key, value)) => format!("`{key}`: {}", takes(value)),
        None => format!("`{}`", word["const"].to_string().trim_matches('"')),
    }
}

/// The text without line breaks inside its paragraphs.
fn flowing(text: &str) -> String {
    let paragraphs = text.split("\n\n").map(|paragraph| paragraph.replace('\n', " "));
    paragraphs.collect::<Vec<_>>().join("\n\n")
}

/// The text in one cell of a table.
fn cell(text: &str) -> String {
    let paragraphs = text.split("\n\n").map(|paragraph| paragraph.replace('\n', " "));
    let sentences = paragraphs.map(|paragraph| match paragraph.ends_with(['.', ']', ')']) {
        true => paragraph,
        false => paragraph + ".",
    });
    sentences.collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

fn default(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::Array(list) if list.is_empty() => String::new(),
        Value::Object(_) | Value::Array(_) => String::new(),
        Value::String(text) => format!("`{text}`"),
        Value::Bool(false) => "no".to_owned(),
        Value::Bool(true) => "yes".to_owned(),
        Value::Number(number) => format!("`{}`", number.as_f64().unwrap()),
    }
}

/// The values that a key takes, in words.
fn takes(schema: &Value) -> String {
    if let Some(path) = schema["$ref"].as_str() {
        let name = path.rsplit('/').next().unwrap();
        return format!("[{name}](#{})", name.to_lowercase());
    }
    if let Some(alternatives) = schema["anyOf"].as_array() {
        let words = alternatives.iter().filter(|one| one["type"] != "null").map(takes);
        return words.collect::<Vec<_>>().join(" or ");
    }
    let kind = match &schema["type"] {
        Value::String(kind) => kind,
        Value::Array(kinds) => {
            kinds.iter().filter_map(Value::as_str).find(|kind| *kind != "null").unwrap()
        }
        _ => panic!("a schema without a type: {schema}"),
    };
    match kind {
        "boolean" => "yes or no (`true`, `false`)".to_owned(),
        "string" => "a text".to_owned(),
        "integer" => "a whole number".to_owned(),
        "number" => "a number".to_owned(),
        "array" if schema["prefixItems"].is_array() => {
            let items = schema["prefixItems"].as_array().unwrap().iter().map(takes);
            format!("[{}]", items.collect::<Vec<_>>().join(", "))
        }
        "array" => match schema["minItems"].as_u64() {
            Some(count) => format!("a list of {count}: {}", takes(&schema["items"])),
            None => format!("a list: {}", takes(&schema["items"])),
        },
        "object" => {
            let keys = schema["properties"].as_object().unwrap().keys();
            let keys: Vec<String> = keys.map(|key| format!("`{key}`")).collect();
            format!("an object with {}", keys.join(" and "))
        }
        other => panic!("no words for the type {other}"),
    }
}

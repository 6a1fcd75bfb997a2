//! Descriptions in attributes of OpenEXR files, which hold ASCII only.

use serde::Serialize;

/// Attribute of files of impasto that holds their description.
pub const ATTRIBUTE: &str = "impasto";

/// Encodes a value as JSON in ASCII: other characters are escaped.
///
/// # Errors
/// If serialisation fails, as for a map whose keys are no texts.
pub fn ascii_json(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let text = serde_json::to_string(value)?;
    let mut ascii = String::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_ascii() {
            ascii.push(letter);
        } else {
            for unit in letter.encode_utf16(&mut [0; 2]) {
                ascii.push_str(&format!("\\u{unit:04x}"));
            }
        }
    }
    Ok(ascii)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_beyond_ascii_come_back() {
        let words = ["R\u{f6}tel", "\u{1f3a8} 2"];
        let json = ascii_json(&words).unwrap();
        assert_eq!(json, r#"["R\u00f6tel","\ud83c\udfa8 2"]"#);
        let back: Vec<String> = serde_json::from_str(&json).unwrap();
        assert_eq!(back, words);
    }
}

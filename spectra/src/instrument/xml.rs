//! Reading an XML file into a tree of elements with local names.
//!
//! We drop namespace prefixes, because writers choose them freely. We expand only the five
//! predefined entities and numeric character references, and we limit the depth, so that a file
//! cannot grow in memory.

use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::measured::InstrumentError;

const DEEPEST: usize = 64;

#[derive(Debug, Default)]
pub(super) struct Element {
    /// Local name, without its prefix.
    pub(super) name: String,
    attributes: Vec<(String, String)>,
    /// Text of the element itself, joined, without the text of its children.
    pub(super) text: String,
    /// Number of the line on which the element begins, from 1.
    pub(super) line: usize,
    pub(super) children: Vec<Element>,
}

impl Element {
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    pub(super) fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name == name)
    }

    pub(super) fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|child| child.name == name)
    }

    /// Name and text of every descendant that has text and no children.
    pub(super) fn leaves(&self) -> Vec<(String, String)> {
        let mut found = Vec::new();
        for child in &self.children {
            if child.children.is_empty() && !child.text.trim().is_empty() {
                found.push((child.name.clone(), child.text.trim().to_owned()));
            }
            found.extend(child.leaves());
        }
        found
    }
}

pub(super) fn parse(file: &str, text: &str) -> Result<Element, InstrumentError> {
    let fault = |at: u64, what: String| {
        let before = &text.as_bytes()[..text.len().min(at as usize)];
        InstrumentError::line(file, 1 + newlines(before), "well-formed XML", &what)
    };
    let mut reader = Reader::from_str(text);
    reader.config_mut().expand_empty_elements = true;
    let mut root = None;
    let mut open: Vec<Element> = Vec::new();
    let mut line = 1;
    let mut counted = 0;
    loop {
        let start = reader.buffer_position();
        line += newlines(&text.as_bytes()[counted..start as usize]);
        counted = start as usize;
        let event =
            reader.read_event().map_err(|error| fault(reader.error_position(), error.to_string()));
        match event? {
            Event::Start(tag) => {
                if open.len() == DEEPEST {
                    return Err(fault(start, format!("elements {DEEPEST} deep")));
                }
                if open.is_empty() && root.is_some() {
                    return Err(fault(start, format!("a second root <{}>", tag.name().as_ref())));
                }
                open.push(element(&tag, line).map_err(|what| fault(start, what))?);
            }
            Event::End(_) => {
                let Some(closed) = open.pop() else { continue };
                match open.last_mut() {
                    Some(parent) => parent.children.push(closed),
                    None => root = Some(closed),
                }
            }
            Event::Text(text) => append(&mut open, &text.xml10_content()),
            Event::CData(text) => append(&mut open, &text.xml10_content()),
            // Keeps the line numbers of the text that follows.
            Event::Comment(text) => append(&mut open, &"\n".repeat(newlines(text.as_bytes()))),
            Event::GeneralRef(name) => {
                let character = name.resolve_char_ref().map_err(|e| fault(start, e.to_string()))?;
                match (character, resolve_predefined_entity(&name)) {
                    (Some(character), _) => append(&mut open, character.encode_utf8(&mut [0; 4])),
                    (None, Some(known)) => append(&mut open, known),
                    _ => return Err(fault(start, format!("the unknown entity &{};", &*name))),
                }
            }
            Event::Eof => break,
            _ => {}
        }
    }
    match (root, open.last()) {
        (Some(root), None) => Ok(root),
        (_, Some(element)) => Err(InstrumentError::line(
            file,
            element.line,
            "well-formed XML",
            &format!("<{}>, which is never closed", element.name),
        )),
        _ => Err(fault(0, "no element".to_owned())),
    }
}

fn element(tag: &BytesStart<'_>, line: usize) -> Result<Element, String> {
    let mut attributes = Vec::new();
    for attribute in tag.attributes() {
        let attribute = attribute.map_err(|error| error.to_string())?;
        let value = attribute.normalized_value(XmlVersion::Implicit1_0);
        let value = value.map_err(|error| error.to_string())?;
        let key = attribute.key.local_name();
        attributes.push((key.as_ref().to_owned(), value.into_owned()));
    }
    let name = tag.local_name().as_ref().to_owned();
    Ok(Element { name, attributes, line, ..Element::default() })
}

fn append(open: &mut [Element], text: &str) {
    if let Some(element) = open.last_mut() {
        element.text.push_str(text);
    }
}

/// Number of line ends: LF, CR LF, or CR alone.
fn newlines(bytes: &[u8]) -> usize {
    bytes
        .iter()
        .enumerate()
        .filter(|&(i, &byte)| byte == b'\n' || (byte == b'\r' && bytes.get(i + 1) != Some(&b'\n')))
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_references_and_comments_are_read() {
        let text = "<?xml version=\"1.0\"?>\n<a:r xmlns:a='u' a:n='x &lt;&#65;'>\n\
                    <b>1<!-- not\nthis -->&amp;<![CDATA[<2>]]></b><c/></a:r>\n";
        let root = parse("f", text).unwrap();
        assert_eq!((root.name.as_str(), root.attribute("n")), ("r", Some("x <A")));
        let b = root.child("b").unwrap();
        assert_eq!((b.text.as_str(), b.line), ("1\n&<2>", 3));
        assert_eq!(root.leaves(), [("b".to_owned(), "1\n&<2>".to_owned())]);
    }

    #[test]
    fn faults_name_the_line() {
        for (text, expected) in [
            ("<a>\n<b></a>", "f, line 2: expected well-formed XML"),
            ("<a>\n<b>\n", "f, line 2: expected well-formed XML, found `<b>, which is never"),
            ("<a>\n&lol;</a>", "f, line 2: expected well-formed XML, found `the unknown entity"),
            ("<a>\n<b c='&x;'/></a>", "f, line 2:"),
            ("<a/>\n<b/>", "f, line 2:"),
            ("", "f, line 1: expected well-formed XML, found `no element`"),
        ] {
            let error = parse("f", text).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{text:?}: {error}");
        }
    }

    #[test]
    fn no_entity_of_a_file_is_expanded_and_depth_is_bounded() {
        let bomb = "<!DOCTYPE a [<!ENTITY x \"xxxx\"><!ENTITY y \"&x;&x;\">]><a>&y;</a>";
        assert!(parse("f", bomb).unwrap_err().to_string().contains("entity"));
        let deep = "<a>".repeat(65) + &"</a>".repeat(65);
        assert!(parse("f", &deep).unwrap_err().to_string().contains("64 deep"));
        let fits = "<a>".repeat(64) + &"</a>".repeat(64);
        assert!(parse("f", &fits).is_ok(), "64 levels");
    }
}

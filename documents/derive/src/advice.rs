//! The attributes `#[hint(..)]` and `#[fault(..)]`.

use proc_macro2::{Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Attribute, Error, Expr, Ident, LitStr, Member, Result, Token};

mod word {
    syn::custom_keyword!(verbatim);
    syn::custom_keyword!(with);
    syn::custom_keyword!(inner);
    syn::custom_keyword!(none);
}

/// All attributes that this macro reads from a variant, a struct or a whole enum.
pub(crate) struct Advice {
    pub(crate) hints: Vec<HintAttribute>,
    pub(crate) fault: Option<FaultAttribute>,
    /// Whether the message comes from the inner error.
    pub(crate) transparent: bool,
}

impl Advice {
    pub(crate) fn of(attributes: &[Attribute]) -> Result<Self> {
        let mut advice = Self { hints: Vec::new(), fault: None, transparent: false };
        for attribute in attributes {
            if attribute.path().is_ident("hint") {
                let last = advice.hints.last();
                if last.is_some_and(|last: &HintAttribute| last.condition.is_none()) {
                    let text = "only the last `hint` may stand without `if`";
                    return Err(Error::new_spanned(attribute, text));
                }
                advice.hints.push(attribute.parse_args()?);
            } else if attribute.path().is_ident("fault") {
                if advice.fault.is_some() {
                    return Err(Error::new_spanned(attribute, "a second `fault`"));
                }
                advice.fault = Some(attribute.parse_args()?);
            } else if attribute.path().is_ident("error") {
                let word = attribute.parse_args::<Ident>();
                advice.transparent = word.is_ok_and(|word| word == "transparent");
            }
        }
        Ok(advice)
    }
}

pub(crate) struct HintAttribute {
    pub(crate) condition: Option<Expr>,
    pub(crate) source: HintSource,
}

/// Where the macro takes a hint from.
pub(crate) enum HintSource {
    /// A text, with arguments if you give some.
    Text {
        verbatim: bool,
        text: LitStr,
        arguments: Vec<Expr>,
    },
    With(Expr),
    /// The hint of the error that this one wraps.
    Inner(Inner),
    None,
}

pub(crate) struct Inner {
    pub(crate) span: Span,
    pub(crate) field: Option<Member>,
}

impl Inner {
    fn parse_after(word: Span, input: ParseStream<'_>) -> Result<Self> {
        if input.parse::<Option<Token![=]>>()?.is_none() {
            return Ok(Self { span: word, field: None });
        }
        Ok(Self { span: word, field: Some(input.parse()?) })
    }
}

impl Parse for HintAttribute {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let mut condition = None;
        if input.parse::<Option<Token![if]>>()?.is_some() {
            condition = Some(input.parse()?);
            input.parse::<Token![,]>()?;
        }
        let source = input.parse()?;
        if !input.is_empty() {
            return Err(input.error("nothing more fits here"));
        }
        Ok(Self { condition, source })
    }
}

impl Parse for HintSource {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        if input.peek(word::with) {
            input.parse::<word::with>()?;
            input.parse::<Token![=]>()?;
            return Ok(Self::With(input.parse()?));
        }
        if input.peek(word::inner) {
            let word = input.parse::<word::inner>()?;
            return Ok(Self::Inner(Inner::parse_after(word.span(), input)?));
        }
        if input.parse::<Option<word::none>>()?.is_some() {
            return Ok(Self::None);
        }
        let verbatim = input.parse::<Option<word::verbatim>>()?.is_some();
        if verbatim {
            input.parse::<Token![,]>()?;
        } else if !input.peek(LitStr) {
            let text = "`#[hint(..)]` takes a text, `verbatim, \"text\"`, `with = expression`, `inner` or `none`";
            return Err(input.error(text));
        }
        let text = input.parse()?;
        let mut arguments = Vec::new();
        if input.parse::<Option<Token![,]>>()?.is_some() {
            let list = Punctuated::<Expr, Token![,]>::parse_terminated(input)?;
            arguments = list.into_iter().collect();
        }
        Ok(Self::Text { verbatim, text, arguments })
    }
}

pub(crate) enum FaultAttribute {
    /// A variant of `Fault`, e.g. `Setting`.
    Kind(Ident),
    With(Expr),
    /// The fault of the error that this one wraps.
    Inner(Inner),
}

impl Parse for FaultAttribute {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        if input.peek(word::with) {
            input.parse::<word::with>()?;
            input.parse::<Token![=]>()?;
            return Ok(Self::With(input.parse()?));
        }
        if input.peek(word::inner) {
            let word = input.parse::<word::inner>()?;
            return Ok(Self::Inner(Inner::parse_after(word.span(), input)?));
        }
        let kind: Ident = input.parse()?;
        if !["Input", "Setting", "Environment"].iter().any(|known| kind == known) {
            let text =
                "a fault is Input, Setting or Environment, or `with = expression`, or `inner`";
            return Err(Error::new(kind.span(), text));
        }
        Ok(Self::Kind(kind))
    }
}

/// The value of an expression. If it is a path to a function, we call this with the error.
pub(crate) fn called(expression: &Expr) -> TokenStream {
    match expression {
        Expr::Path(path) => quote_spanned!(path.span()=> #path(self)),
        other => quote!(#other),
    }
}

/// The text of a hint with its fields and arguments in place. Without arguments, you write `{0}`
/// for the first field of a tuple.
pub(crate) fn formatted(text: &LitStr, arguments: &[Expr]) -> TokenStream {
    let value = text.value();
    let text = match arguments.is_empty() {
        true => LitStr::new(&with_named_fields(&value), text.span()),
        false => text.clone(),
    };
    match value.contains(['{', '}']) || !arguments.is_empty() {
        true => quote_spanned!(text.span()=> ::std::format!(#text #(, #arguments)*)),
        false => quote!(#text),
    }
}

/// The name that we bind a field of a tuple to.
pub(crate) fn tuple_field(index: usize) -> Ident {
    format_ident!("_{}", index)
}

/// Writes `{0}` as `{_0}`, the name of a field of a tuple.
fn with_named_fields(text: &str) -> String {
    let mut named = String::new();
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        named.push(letter);
        if letter != '{' {
            continue;
        }
        match letters.peek() {
            Some('{') => named.extend(letters.next()),
            Some(digit) if digit.is_ascii_digit() => named.push('_'),
            _ => {}
        }
    }
    named
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_digits_after_an_opening_brace_are_fields() {
        for (text, wanted) in [
            ("{0} of {1:.2}", "{_0} of {_1:.2}"),
            ("{{0}} and {name}", "{{0}} and {name}"),
            ("8 {} 3}", "8 {} 3}"),
            ("{", "{"),
        ] {
            assert_eq!(with_named_fields(text), wanted);
        }
    }
}

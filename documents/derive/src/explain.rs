//! The implementation of `Explain` for one type.

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::{ToTokens, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Error, Fields, Generics, Ident, Result, Type};

use crate::advice::{
    Advice, FaultAttribute, HintAttribute, HintSource, Inner, called, formatted, tuple_field,
};

/// Path of the module that holds the trait.
fn module() -> TokenStream {
    quote!(::documents::hint)
}

pub(crate) fn explain(input: &DeriveInput) -> Result<TokenStream> {
    let whole = Advice::of(&input.attrs)?;
    let nothing = Advice { hints: Vec::new(), fault: None, transparent: false };
    let mut variants = Vec::new();
    match &input.data {
        Data::Struct(data) => {
            variants.push(Variant::of(quote!(Self), input.span(), &data.fields, whole)?);
        }
        Data::Enum(data) => {
            for variant in &data.variants {
                let name = &variant.ident;
                let advice = Advice::of(&variant.attrs)?;
                let path = quote!(Self::#name);
                variants.push(Variant::of(path, variant.span(), &variant.fields, advice)?);
            }
        }
        Data::Union(_) => return Err(Error::new_spanned(&input.ident, "a union is not an error")),
    }
    let whole = match &input.data {
        Data::Enum(_) => Advice::of(&input.attrs)?,
        _ => nothing,
    };
    let hints = variants.iter().map(|variant| variant.hint(&whole)).collect::<Result<Vec<_>>>()?;
    let faults =
        variants.iter().map(|variant| variant.fault(&whole)).collect::<Result<Vec<_>>>()?;
    let patterns: Vec<&TokenStream> = variants.iter().map(|variant| &variant.pattern).collect();

    let module = module();
    let name = &input.ident;
    let generics = with_bounds(&input.generics, &variants);
    let (parameters, arguments, bounds) = generics.split_for_impl();
    Ok(quote! {
        #[automatically_derived]
        #[allow(unused_variables, unused_imports, clippy::all, reason = "fields are bound for all texts alike")]
        impl #parameters #module::Explain for #name #arguments #bounds {
            fn hint(&self) -> ::core::option::Option<#module::Hint> {
                use #module::Explain as _;
                match self { #(#patterns => #hints,)* }
            }

            fn fault(&self) -> #module::Fault {
                use #module::Explain as _;
                match self { #(#patterns => #faults,)* }
            }
        }
    })
}

struct Variant<'a> {
    pattern: TokenStream,
    span: Span,
    fields: &'a Fields,
    advice: Advice,
}

impl<'a> Variant<'a> {
    fn of(path: TokenStream, span: Span, fields: &'a Fields, advice: Advice) -> Result<Self> {
        let names = (0..fields.len()).map(|index| bound_name(fields, index));
        let pattern = match fields {
            Fields::Named(_) => quote!(#path { #(#names,)* }),
            Fields::Unnamed(_) => quote!(#path(#(#names,)*)),
            Fields::Unit => path,
        };
        Ok(Self { pattern, span, fields, advice })
    }

    /// The expression of the hint, an `Option<Hint>`. Pass the attributes of the enum as `whole`.
    fn hint(&self, whole: &Advice) -> Result<TokenStream> {
        let own = &self.advice.hints;
        if own.is_empty() && self.advice.transparent {
            let inner = self.inner(&Inner { span: self.span, field: None })?;
            return Ok(quote!(#inner.hint()));
        }
        let hints = if own.is_empty() { &whole.hints } else { own };
        let mut all = quote!(::core::option::Option::None);
        for HintAttribute { condition, source } in hints.iter().rev() {
            let hint = self.hint_of(source)?;
            all = match condition {
                Some(condition) => quote!(if #condition { #hint } else { #all }),
                None => hint,
            };
        }
        Ok(all)
    }

    fn hint_of(&self, source: &HintSource) -> Result<TokenStream> {
        let module = module();
        Ok(match source {
            HintSource::Text { verbatim, text, arguments } => {
                let kind = if *verbatim { quote!(verbatim) } else { quote!(new) };
                let text = formatted(text, arguments);
                quote!(::core::option::Option::Some(#module::Hint::#kind(#text)))
            }
            HintSource::With(expression) => called(expression),
            HintSource::Inner(inner) => {
                let inner = self.inner(inner)?;
                quote!(#inner.hint())
            }
            HintSource::None => quote!(::core::option::Option::None),
        })
    }

    /// The expression of the fault. Pass the attributes of the enum as `whole`.
    fn fault(&self, whole: &Advice) -> Result<TokenStream> {
        let module = module();
        let inner_of = |inner: &Inner| {
            let inner = self.inner(inner)?;
            Ok(quote!(#inner.fault()))
        };
        let given = |fault: &FaultAttribute| match fault {
            FaultAttribute::Kind(kind) => Ok(quote!(#module::Fault::#kind)),
            FaultAttribute::With(expression) => Ok(called(expression)),
            FaultAttribute::Inner(inner) => inner_of(inner),
        };
        if let Some(fault) = &self.advice.fault {
            return given(fault);
        }
        if let Some(HintAttribute { source: HintSource::Inner(inner), condition: None }) =
            self.advice.hints.last()
        {
            return inner_of(inner);
        }
        if self.advice.transparent {
            return inner_of(&Inner { span: self.span, field: None });
        }
        whole.fault.as_ref().map_or(Ok(quote!(#module::Fault::Input)), given)
    }

    /// The name that we bind the wrapped error to, with the span of its type.
    fn inner(&self, inner: &Inner) -> Result<TokenStream> {
        let index = self.inner_index(inner)?;
        let name = bound_name(self.fields, index);
        let span = self.fields.iter().nth(index).map_or(inner.span, |field| field.ty.span());
        Ok(quote_spanned!(span=> (#name)))
    }

    /// The place of the wrapped error. This is the field that the attribute names, else the one
    /// with `#[from]` or `#[source]`, else `source` or `error`, else the only one.
    fn inner_index(&self, inner: &Inner) -> Result<usize> {
        let named = |wanted: &dyn Fn(&Ident) -> bool| {
            self.fields.iter().position(|field| field.ident.as_ref().is_some_and(wanted))
        };
        if let Some(field) = &inner.field {
            let found = self.fields.members().position(|member| member == *field);
            return found.ok_or_else(|| Error::new(field.span(), "there is no such field"));
        }
        let marked = self.fields.iter().position(|field| {
            let mut attributes = field.attrs.iter();
            attributes.any(|one| one.path().is_ident("from") || one.path().is_ident("source"))
        });
        let found = marked
            .or_else(|| named(&|name| name == "source").or_else(|| named(&|name| name == "error")))
            .or_else(|| (self.fields.len() == 1).then_some(0));
        found.ok_or_else(|| {
            let text =
                "which field is the inner error? mark it with #[source], or write `inner = field`";
            Error::new(inner.span, text)
        })
    }

    /// The type of the wrapped error, if hint or fault come from it.
    fn inner_type(&self) -> Option<&Type> {
        let by_hint = self.advice.hints.iter().find_map(|hint| match &hint.source {
            HintSource::Inner(inner) => Some(inner),
            _ => None,
        });
        let by_fault = match &self.advice.fault {
            Some(FaultAttribute::Inner(inner)) => Some(inner),
            _ => None,
        };
        let transparent = Inner { span: self.span, field: None };
        let transparent = self.advice.transparent.then_some(&transparent);
        let inner = by_hint.or(by_fault).or(transparent)?;
        let index = self.inner_index(inner).ok()?;
        self.fields.iter().nth(index).map(|field| &field.ty)
    }
}

/// The name that we bind a field to in a pattern.
fn bound_name(fields: &Fields, index: usize) -> Ident {
    let field = fields.iter().nth(index).and_then(|field| field.ident.clone());
    field.unwrap_or_else(|| tuple_field(index))
}

/// The generics, with `Explain` required for every parameter in the type of a wrapped error.
fn with_bounds(generics: &Generics, variants: &[Variant<'_>]) -> Generics {
    let module = module();
    let inner: Vec<&Type> = variants.iter().filter_map(Variant::inner_type).collect();
    let mut all = generics.clone();
    for parameter in generics.type_params() {
        let name = &parameter.ident;
        if inner.iter().any(|inner| names(inner.to_token_stream(), name)) {
            let bounds = &mut all.make_where_clause().predicates;
            bounds.push(syn::parse_quote!(#name: #module::Explain));
        }
    }
    all
}

fn names(inner: TokenStream, parameter: &Ident) -> bool {
    inner.into_iter().any(|token| match token {
        TokenTree::Group(group) => names(group.stream(), parameter),
        TokenTree::Ident(name) => name == *parameter,
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::explain;

    #[test]
    fn faulty_attributes_are_refused_with_a_sentence() {
        for (text, wanted) in [
            ("#[hint(\"a\")] #[hint(\"b\")] struct E;", "only the last `hint`"),
            ("enum E { #[hint(texts)] A }", "`#[hint(..)]` takes a text"),
            ("enum E { #[hint(\"a\" b)] A }", "nothing more fits here"),
            ("enum E { #[hint(inner)] A }", "which field is the inner error?"),
            ("enum E { #[hint(inner)] A { a: X, b: Y } }", "which field is the inner error?"),
            ("enum E { #[hint(inner = c)] A { a: X, b: Y } }", "there is no such field"),
            ("enum E { #[hint(inner b)] A(X) }", "nothing more fits here"),
            ("#[fault(Data)] struct E;", "a fault is Input, Setting or Environment"),
            ("#[fault(Input)] #[fault(Setting)] struct E;", "a second `fault`"),
            ("union E { a: u8 }", "a union is not an error"),
        ] {
            let error = explain(&syn::parse_str(text).unwrap()).unwrap_err().to_string();
            assert!(error.starts_with(wanted), "{text}: {error}");
        }
    }

    #[test]
    fn a_wrapped_parameter_must_explain_itself() {
        let input = "enum E<A, B> { #[error(transparent)] Inner(Box<A>), Other(B) }";
        let code = explain(&syn::parse_str(input).unwrap()).unwrap().to_string();
        assert!(code.contains("where A : :: documents :: hint :: Explain"), "{code}");
        assert!(!code.contains("B : ::"), "{code}");
    }
}

//! The macro of `documents::hint::Explain`, which is documented there.

mod advice;
mod explain;

use proc_macro::TokenStream;

/// Implements `documents::hint::Explain`. You write hints beside messages: `#[hint("..")]` after
/// `#[error("..")]`. The page of the trait lists all forms.
#[proc_macro_derive(Explain, attributes(hint, fault))]
pub fn derive_explain(input: TokenStream) -> TokenStream {
    let input = syn::parse_macro_input!(input as syn::DeriveInput);
    explain::explain(&input).unwrap_or_else(|error| error.to_compile_error()).into()
}

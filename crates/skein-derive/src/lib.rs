//! `#[derive(Settings)]` and `#[derive(Choice)]`: one field says the profile key, the default, the bounds, the unit
//! and the manual page. A setting without a doc comment or a default does not compile.

use proc_macro::TokenStream;
use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::{
    Attribute, Data, DeriveInput, Error, Expr, Fields, Ident, Lit, LitStr, Meta, parse_macro_input,
    spanned::Spanned,
};

/// Makes a struct of settings describe itself.
#[proc_macro_derive(Settings, attributes(setting))]
pub fn settings(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    expand_settings(&input).unwrap_or_else(|error| error.to_compile_error()).into()
}

/// Makes an enum of unit variants a list of words: `OddEven` is `"odd-even"`.
#[proc_macro_derive(Choice)]
pub fn choice(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    expand_choice(&input).unwrap_or_else(|error| error.to_compile_error()).into()
}

fn expand_settings(input: &DeriveInput) -> Result<Tokens, Error> {
    let name = &input.ident;
    let Data::Struct(data) = &input.data else {
        return Err(Error::new(input.span(), "settings are a struct with named fields"));
    };
    let empty = syn::punctuated::Punctuated::new();
    let fields = match &data.fields {
        Fields::Named(fields) => &fields.named,
        Fields::Unit => &empty,
        Fields::Unnamed(_) => {
            return Err(Error::new(input.span(), "settings are a struct with named fields"));
        }
    };
    let (mut describe, mut default, mut set, mut values) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for field in fields {
        let ident = field.ident.as_ref().ok_or_else(|| Error::new(field.span(), "a setting has a name"))?;
        let ty = &field.ty;
        let key = LitStr::new(&ident.to_string(), ident.span());
        let about = doc(&field.attrs)
            .ok_or_else(|| Error::new(field.span(), "a setting has a doc comment: it is the manual"))?;
        let said = Said::read(&field.attrs, field.span())?;
        let (min, max, unit) = (optional(&said.min), optional(&said.max), &said.unit);
        let value = match &said.default {
            Expr::Lit(_) | Expr::Unary(_) => {
                let literal = &said.default;
                quote!(::skein::settings::default_of::<#ty>(&::skein::Value::from(#literal), #min, #max))
            }
            Expr::Macro(_) | Expr::Call(_) | Expr::Path(_) | Expr::MethodCall(_) => {
                let expression = &said.default;
                quote!(#expression)
            }
            other => return Err(Error::new(other.span(), "a default is a literal, a path or a call")),
        };
        describe.push(quote! {
            ::skein::Field {
                name: #key,
                about: #about,
                unit: #unit,
                kind: <#ty as ::skein::Setting>::KIND,
                default: <#ty as ::skein::Setting>::show(&default.#ident),
                min: #min,
                max: #max,
            }
        });
        default.push(quote!(#ident: #value));
        set.push(quote!(#key => { self.#ident = ::skein::settings::read_within::<#ty>(value, #min, #max, #unit)?; Ok(()) }));
        values.push(quote!((#key, <#ty as ::skein::Setting>::show(&self.#ident))));
    }
    let (unused_default, unused_value) = if fields.is_empty() {
        (quote!(let _ = &default;), quote!(let _ = value;))
    } else {
        (quote!(), quote!())
    };
    Ok(quote! {
        impl ::core::default::Default for #name {
            fn default() -> Self {
                Self { #(#default,)* }
            }
        }
        impl ::skein::Settings for #name {
            fn fields() -> ::std::vec::Vec<::skein::Field> {
                let default = Self::default();
                #unused_default
                ::std::vec![#(#describe),*]
            }
            fn set(&mut self, name: &str, value: &::skein::Value) -> ::core::result::Result<(), ::skein::SettingError> {
                #unused_value
                match name {
                    #(#set)*
                    _ => Err(::skein::SettingError::Unknown),
                }
            }
            fn values(&self) -> ::std::vec::Vec<(&'static str, ::skein::Value)> {
                ::std::vec![#(#values),*]
            }
        }
    })
}

/// What `#[setting(…)]` says.
struct Said {
    default: Expr,
    min: Option<Expr>,
    max: Option<Expr>,
    unit: LitStr,
}

impl Said {
    fn read(attributes: &[Attribute], place: proc_macro2::Span) -> Result<Self, Error> {
        let attribute = attributes.iter().find(|attribute| attribute.path().is_ident("setting"));
        let attribute =
            attribute.ok_or_else(|| Error::new(place, "a setting has a default: #[setting(default = …)]"))?;
        let (mut default, mut min, mut max, mut unit) = (None, None, None, None);
        attribute.parse_nested_meta(|meta| {
            let value = meta.value()?;
            match meta.path.get_ident().map(Ident::to_string).as_deref() {
                Some("default") => default = Some(value.parse::<Expr>()?),
                Some("min") => min = Some(value.parse::<Expr>()?),
                Some("max") => max = Some(value.parse::<Expr>()?),
                Some("unit") => unit = Some(value.parse::<LitStr>()?),
                _ => return Err(meta.error("a setting knows default, min, max and unit")),
            }
            Ok(())
        })?;
        let default = default.ok_or_else(|| Error::new(place, "a setting has a default"))?;
        Ok(Self { default, min, max, unit: unit.unwrap_or_else(|| LitStr::new("", place)) })
    }
}

fn optional(bound: &Option<Expr>) -> Tokens {
    match bound {
        Some(bound) => quote!(::core::option::Option::Some(f64::from(#bound))),
        None => quote!(::core::option::Option::None),
    }
}

fn expand_choice(input: &DeriveInput) -> Result<Tokens, Error> {
    let name = &input.ident;
    let Data::Enum(data) = &input.data else {
        return Err(Error::new(input.span(), "a choice is an enum of plain words"));
    };
    let (mut words, mut variants) = (Vec::new(), Vec::new());
    for variant in &data.variants {
        if !matches!(variant.fields, Fields::Unit) {
            return Err(Error::new(variant.span(), "a choice is an enum of plain words"));
        }
        let about = doc(&variant.attrs)
            .ok_or_else(|| Error::new(variant.span(), "a choice says what it means in a doc comment"))?;
        let word = kebab(&variant.ident.to_string());
        let ident = &variant.ident;
        words.push(quote!((#word, #about)));
        variants.push(quote!(Self::#ident));
    }
    Ok(quote! {
        impl ::skein::Choice for #name {
            const WORDS: &'static [(&'static str, &'static str)] = &[#(#words),*];
            const ALL: &'static [Self] = &[#(#variants),*];
        }
    })
}

fn kebab(name: &str) -> String {
    let mut word = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !word.is_empty() {
            word.push('-');
        }
        word.extend(letter.to_lowercase());
    }
    word
}

/// The doc comment as one paragraph.
fn doc(attributes: &[Attribute]) -> Option<String> {
    let mut lines = Vec::new();
    for attribute in attributes {
        if let Meta::NameValue(pair) = &attribute.meta
            && pair.path.is_ident("doc")
            && let Expr::Lit(literal) = &pair.value
            && let Lit::Str(text) = &literal.lit
        {
            lines.push(text.value().trim().to_owned());
        }
    }
    let text = lines.join(" ").trim().to_owned();
    (!text.is_empty()).then_some(text)
}

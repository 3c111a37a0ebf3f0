//! STL, the format that every drawing program can write.

mod binary;
mod text;

pub(crate) use binary::{has_exact_length, read as binary};
pub(crate) use text::{looks_like_text, read as text};

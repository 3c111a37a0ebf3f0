//! The command `clayforge`.
fn main() {}

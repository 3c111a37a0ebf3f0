//! Every test that needs more than one crate. The tests are in `all.rs` beside this folder.

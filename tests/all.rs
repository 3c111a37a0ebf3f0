//! Every test that needs more than one crate, in one binary.
//!
//! * [`cases`]: the pages of the stages are their tests;
//! * [`law`]: reading undoes writing, and views leave nothing out;
//! * [`parts`]: whole prints, in memory and as text, on one thread and on two;
//! * [`cli`]: the command as scripts and people meet it;
//! * [`tidy`]: the layout of the workspace;
//! * [`totals`]: what lies on the test meshes behind fill.

mod cases;
mod cli;
mod law;
mod parts;
mod support;
mod tidy;
mod totals;

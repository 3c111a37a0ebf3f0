//! Every test that needs more than one crate, in one binary.
//!
//! * [`cases`]: the pages of the stages are their tests;
//! * [`law`]: reading undoes writing, and views leave nothing out;
//! * [`parts`]: whole prints, in memory and as text, on one thread and on two;
//! * [`cli`]: the command as scripts and people meet it;
//! * [`edit`]: the page of `clayforge edit` is its test;
//! * [`emulate`]: what a machine makes of finished files, through the command;
//! * [`import`]: parts of every format through the command;
//! * [`outage`]: the command when the machine fails it;
//! * [`fuzzing`]: a short run of every fuzz target;
//! * [`torture`]: parts as potters find them, each in a process of its own;
//! * [`tidy`]: the layout of the workspace;
//! * [`totals`]: what lies on the test meshes behind fill.

mod cases;
mod cli;
mod edit;
mod emulate;
mod fuzzing;
mod import;
mod law;
mod outage;
mod parts;
mod support;
mod tidy;
mod torture;
mod totals;

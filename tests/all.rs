//! Every test that needs more than one crate, in one binary.
//!
//! * [`cases`]: the pages of the stages are their tests;
//! * [`joined`]: stages that work on threads, on those that join has made;
//! * [`law`]: reading undoes writing, and views leave nothing out;
//! * [`parts`]: whole prints, in memory and as text, on one thread and on two;
//! * [`everything`]: all stages at once, on every part, in both chains;
//! * [`cli`]: the command as scripts and people meet it, and [`command`]: how it is built and run;
//! * [`edit`]: the page of `clayforge edit` is its test;
//! * [`emulate`]: what a machine makes of finished files, through the command;
//! * [`import`]: parts of every format through the command;
//! * [`outage`]: the command when the machine fails it;
//! * [`fuzzing`]: a short run of every fuzz target;
//! * [`torture`]: parts as potters find them, each in a process of its own;
//! * [`rows`]: every row of the tables in docs/ has its test;
//! * [`tidy`]: the layout of the workspace;
//! * [`totals`]: what lies on the test meshes behind fill;
//! * [`volume`]: what the stages do to the clay of each layer.

mod cases;
mod cli;
mod command;
mod edit;
mod emulate;
mod everything;
mod fuzzing;
mod import;
mod joined;
mod law;
mod outage;
mod parts;
mod rows;
mod support;
mod tidy;
mod torture;
mod totals;
mod volume;

//! The command as scripts and people meet it: exit codes, messages, files.

mod files;
mod readme;
mod refused;
mod says;
mod slice;

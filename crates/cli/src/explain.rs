//! `clayforge stages` and `clayforge explain`.

use crate::args::{Explain, Stages};
use crate::output::print;
use crate::report::Done;
use clayforge::STAGES;
use serde_json::json;

/// Lists the stages in order.
pub fn stages(stages: &Stages) -> Done {
    if stages.json {
        let list: Vec<_> = STAGES
            .iter()
            .map(|entry| json!({ "name": entry.name, "about": entry.about, "active": entry.active }))
            .collect();
        return print(&format!("{:#}\n", serde_json::Value::Array(list)));
    }
    let width = STAGES.iter().map(|entry| entry.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for entry in STAGES {
        let off = if entry.active { "" } else { " (off by default)" };
        text.push_str(&format!("{:width$}  {}{off}\n", entry.name, entry.about));
    }
    print(&text)
}

/// Shows the manual.
pub fn run(explain: &Explain) -> Done {
    print(&clayforge::explain(&explain.topic)?)
}

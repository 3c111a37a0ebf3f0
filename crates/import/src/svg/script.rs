//! What the seed of Skeinforge says of the part in the script of its drawings: assignments, one a line (stages.md §1.2).

use roxmltree::Document;

/// A script that speaks of layers. Its drawing has plain coordinates, and transforms that are for viewers.
pub(super) struct Script<'a>(&'a str);

impl<'a> Script<'a> {
    /// The script of a drawing of the seed, if it has one.
    pub(super) fn of(document: &'a Document<'_>) -> Option<Self> {
        let scripts = document.descendants().filter(|node| node.tag_name().name() == "script");
        scripts
            .filter_map(|node| node.text())
            .map(Self)
            .find(|script| script.value("layerThickness").is_some())
    }

    /// What is assigned to a name, without quotes and the end of a statement.
    pub(super) fn value(&self, name: &str) -> Option<&'a str> {
        self.0.lines().find_map(|line| {
            let (left, right) = line.split_once('=')?;
            let named = left.split_whitespace().next_back() == Some(name);
            named.then(|| right.trim().trim_end_matches(';').trim().trim_matches(['"', '\'']))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Script;

    #[test]
    fn assignments_are_read_as_they_are_written() {
        let script = Script(
            "\n\tdecimalPlacesCarried = 3\nvar layerThickness=0.4;\r\n\tprocedureDone = \"carve\"\nif (a == 1) b()\n",
        );
        let values = ["decimalPlacesCarried", "layerThickness", "procedureDone", "perimeterWidth", "a"]
            .map(|name| script.value(name));
        assert_eq!(values, [Some("3"), Some("0.4"), Some("carve"), None, None]);
    }
}

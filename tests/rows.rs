//! The tables of rows in docs/: every row has what it says it has.

use crate::support::{root, sources, text_of};
use std::path::PathBuf;

/// Whether an item has an example in its documentation, or a module in its own.
fn has_example((path, text): &(PathBuf, String), name: &str) -> bool {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let declares = |line: &str| {
        let rest = ["fn", "struct", "enum", "trait"].iter().find_map(|kind| {
            line.strip_prefix("pub ")?.strip_prefix(kind)?.strip_prefix(' ')?.strip_prefix(name)
        });
        rest.is_some_and(|rest| !rest.starts_with(|next: char| next.is_alphanumeric() || next == '_'))
    };
    let documented = |index: usize| {
        let above = lines[..index].iter().rev();
        let mut comment = above.take_while(|line| line.starts_with("///") || line.starts_with('#'));
        comment.any(|line| *line == "/// ```")
    };
    let is_module = [format!("{name}/mod.rs"), format!("{name}.rs"), format!("{name}/src/lib.rs")];
    let here = || (0..lines.len()).any(|index| declares(lines[index]) && documented(index));
    here() || is_module.iter().any(|end| path.ends_with(end)) && lines.contains(&"//! ```")
}

#[test]
fn every_row_of_the_emulator_has_an_example_and_a_test() {
    let crates = ["gcode", "emulate", "columns", "clayforge"].map(|name| root().join("crates").join(name));
    let sources: Vec<_> =
        crates.iter().chain([&root().join("tests")]).flat_map(|path| sources(path)).collect();
    let guide = text_of(&root().join("crates/emulate/src/guide.md"));
    let has_chapter = |title: &str| {
        let chapter = guide.split("\n## ").find_map(|chapter| chapter.strip_prefix(title));
        chapter.is_some_and(|chapter| chapter.starts_with('\n') && chapter.contains("\n```\n"))
    };
    let is_test = |name: &str| {
        let start = format!("fn {name}(");
        sources.iter().any(|(_, text)| text.contains(&start))
    };
    let page = text_of(&root().join("docs/emulation.md"));
    let rows = page.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, number, _, example, held, _] = cells[..] else { return None };
        Some((number.parse::<usize>().ok()?, example, held))
    });
    let mut count = 0;
    for (number, example, held) in rows {
        count += 1;
        assert_eq!(number, count, "the rows are in order");
        for part in example.split(", ") {
            let found = match part.strip_prefix("guide \"") {
                Some(title) => has_chapter(title.trim_end_matches('"')),
                None => {
                    let item = part.strip_prefix("doc-test `").unwrap_or_default().trim_end_matches('`');
                    let name = item.rsplit("::").next().unwrap_or_default();
                    !name.is_empty() && sources.iter().any(|source| has_example(source, name))
                }
            };
            assert!(found, "row {number}: there is no example {part}");
        }
        let quoted = held.split('`').skip(1).step_by(2);
        let tests: Vec<&str> = quoted.filter(|name| name.contains('_') && !name.contains('.')).collect();
        assert!(!tests.is_empty() || held == "the doc-test", "row {number} names no test");
        for name in tests {
            assert!(is_test(name), "row {number}: there is no test `{name}`");
        }
    }
    assert_eq!(count, 39);
}

/// The rows of docs/stages.md, each with what stands behind it.
fn acceptance_rows(page: &str) -> Vec<(&str, &str)> {
    let cells =
        page.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |")?.split_once(" | "));
    cells.filter(|(row, _)| !matches!(*row, "row" | "---")).collect()
}

/// The rows that the page says there are: `C1 to C14, T1`.
fn promised_rows(page: &str) -> Vec<String> {
    let start = page.find("\nRows: ").expect("the page lists its rows");
    let list = page[start + 7..].split_once(".\n").expect("the list ends").0.replace('\n', " ");
    let split = |name: &str| {
        let digits = name.find(|letter: char| letter.is_ascii_digit()).expect("a row has a number");
        (name[..digits].to_owned(), name[digits..].parse::<u32>().expect("a row has a number"))
    };
    let rows = list.split(", ").flat_map(|range| {
        let (first, last) = range.split_once(" to ").unwrap_or((range, range));
        let ((kind, first), (_, last)) = (split(first), split(last));
        (first..=last).map(move |number| format!("{kind}{number}"))
    });
    rows.collect()
}

#[test]
fn every_acceptance_row_has_its_test_or_a_reason() {
    let page = text_of(&root().join("docs/stages.md"));
    let rows = acceptance_rows(&page);
    assert!(rows.len() > 200, "only {} rows were found", rows.len());
    assert_eq!(rows.iter().map(|(row, _)| *row).collect::<Vec<_>>(), promised_rows(&page));
    for (row, behind) in rows {
        // `test_name` in path, `other_test` in path; or a sentence.
        let tests: Option<Vec<(&str, &str)>> =
            behind.split(", ").map(|test| test.strip_prefix('`')?.split_once("` in ")).collect();
        let Some(tests) = tests else {
            assert!(behind.len() > 5 && behind.ends_with('.'), "{row} has neither a test nor a reason");
            continue;
        };
        for (name, path) in tests {
            let text = text_of(&root().join(path));
            let place =
                text.find(&format!("fn {name}(")).unwrap_or_else(|| panic!("{row}: {path} has no {name}"));
            let before = text[..place].trim_end().lines().rev().map(str::trim);
            let marked = before.take_while(|line| line.starts_with('#')).any(|line| line == "#[test]");
            assert!(marked, "{row}: {name} in {path} is no test");
        }
    }
}

//! The layout of the workspace: who may depend on whom, and what every crate must have.

use crate::support::{folders, name_of, root, sources, text_of};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A section of a Cargo.toml: its name and its lines that say something.
type Section = (String, Vec<String>);

/// The sections of a Cargo.toml, as far as these tests must understand it.
fn sections(manifest: &Path) -> Vec<Section> {
    let mut sections: Vec<Section> = vec![(String::new(), Vec::new())];
    for line in
        text_of(manifest).lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'))
    {
        match line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            Some(name) => sections.push((name.to_owned(), Vec::new())),
            None => sections.last_mut().expect("there is always one").1.push(line.to_owned()),
        }
    }
    sections
}

/// What a crate depends on, for whatever it is.
fn dependencies(folder: &Path) -> BTreeSet<String> {
    let sections = sections(&folder.join("Cargo.toml"));
    let lists =
        sections.iter().filter(|(name, _)| name.ends_with("dependencies") && !name.starts_with("workspace"));
    let lines = lists.flat_map(|(_, lines)| lines);
    lines.filter_map(|line| line.split(['=', '.']).next()).map(|name| name.trim().to_owned()).collect()
}

/// The members of the workspace.
fn members() -> Vec<PathBuf> {
    let text = text_of(&root().join("Cargo.toml"));
    let start = text.find("members = [").expect("a workspace has members");
    let list = text[start..].split(']').next().unwrap_or("");
    let quoted = list.split('"').skip(1).step_by(2);
    quoted.map(|member| root().join(member)).collect()
}

fn stages() -> Vec<PathBuf> {
    folders(&root().join("crates/stages"))
}

#[test]
fn no_stage_depends_on_a_stage() {
    let names: BTreeSet<String> = stages().iter().map(|stage| name_of(stage)).collect();
    for stage in stages() {
        let others: Vec<String> = dependencies(&stage).intersection(&names).cloned().collect();
        assert!(others.is_empty(), "{} depends on {others:?}", name_of(&stage));
    }
}

#[test]
fn what_is_below_knows_nothing_of_what_is_above() {
    let names: BTreeSet<String> = stages().iter().map(|stage| name_of(stage)).collect();
    let above = |name: &str| names.contains(name) || matches!(name, "clayforge" | "cli");
    for lower in ["unit", "shape", "skein", "skein-derive", "gcode", "import", "clay-processor"] {
        for name in dependencies(&root().join("crates").join(lower)) {
            assert!(!above(&name), "{lower} depends on {name}");
        }
    }
    for stage in stages() {
        for name in dependencies(&stage) {
            assert!(!matches!(name.as_str(), "clayforge" | "cli"), "{} depends on {name}", name_of(&stage));
        }
    }
}

#[test]
fn what_talks_to_people_and_reads_profiles_has_one_place() {
    for (dependency, only) in [
        ("toml_edit", "clayforge"),
        ("clap", "cli"),
        ("indicatif", "cli"),
        ("ctrlc", "cli"),
        ("arrow-array", "columns"),
        ("parquet", "columns"),
    ] {
        for member in members() {
            let found = dependencies(&member).contains(dependency);
            assert!(!found || name_of(&member) == only, "{} depends on {dependency}", name_of(&member));
        }
    }
}

#[test]
fn every_folder_is_a_member_and_every_member_a_folder() {
    let listed: BTreeSet<PathBuf> = members().into_iter().collect();
    assert!(listed.iter().all(|member| member.join("Cargo.toml").exists()), "{listed:?}");
    let crates = folders(&root().join("crates")).into_iter().filter(|path| name_of(path) != "stages");
    for folder in crates.chain(stages()) {
        assert!(listed.contains(&folder), "{} is not in the workspace", folder.display());
    }
}

#[test]
fn every_stage_has_a_page_and_is_in_the_table() {
    for folder in stages() {
        let name = name_of(&folder);
        let page = folder.join("README.md");
        assert!(page.exists(), "{name} has no README.md");
        assert!(text_of(&page).starts_with(&format!("# {name}\n")), "the page of {name} has another title");
        let known = clayforge::stage(&name).is_some_and(|entry| !entry.about.is_empty());
        assert!(known, "{name} is not in the table of the facade");
    }
    for entry in clayforge::STAGES {
        assert!(root().join("crates/stages").join(entry.name).is_dir(), "{} has no folder", entry.name);
    }
}

#[test]
fn every_page_of_a_stage_says_what_it_is_for_and_what_not() {
    for folder in stages() {
        let page = text_of(&folder.join("README.md"));
        assert!(page.contains("\n## Not for\n"), "{} does not say what it is not for", name_of(&folder));
    }
}

#[test]
fn every_page_of_a_stage_shows_a_picture_of_a_case() {
    for folder in stages() {
        let (name, page) = (name_of(&folder), text_of(&folder.join("README.md")));
        let (_, behind) = page
            .split_once("![")
            .and_then(|(_, behind)| behind.split_once("]("))
            .unwrap_or_else(|| panic!("{name} shows no picture"));
        let picture = behind.split(')').next().unwrap_or("");
        assert!(picture.starts_with(&name) && folder.join(picture).exists(), "{name} shows `{picture}`");
        assert!(behind.contains(" before\n"), "no case stands behind the picture of {name}");
    }
}

#[test]
fn every_crate_keeps_the_lints_of_the_workspace() {
    for member in members() {
        let sections = sections(&member.join("Cargo.toml"));
        let lints = sections.iter().find(|(name, _)| name == "lints").map(|(_, lines)| lines.concat());
        assert_eq!(lints.as_deref(), Some("workspace = true"), "{}", member.display());
    }
}

#[test]
fn every_setting_says_what_it_does() {
    for entry in clayforge::STAGES {
        for field in entry.fields() {
            let sentence = field.about.len() > 10 && field.about.trim_end().ends_with(['.', '?', ':']);
            assert!(sentence, "{}.{}: `{}`", entry.name, field.name, field.about);
        }
    }
}

#[test]
fn the_architecture_names_every_crate() {
    let path = root().join("ARCHITECTURE.md");
    if !path.exists() {
        return;
    }
    let text = text_of(&path);
    for member in members() {
        let name = name_of(&member);
        assert!(text.contains(&name), "ARCHITECTURE.md does not name {name}");
    }
}

#[test]
fn the_readme_tests_what_the_gate_tests() {
    let gate = text_of(&root().join(".ci/run"));
    let test = "cargo test --workspace --locked";
    assert!(gate.contains(test), ".ci/run does not run `{test}`");
    let readme = root().join("README.md");
    if readme.exists() {
        assert!(text_of(&readme).contains(test), "README.md has another command to test than .ci/run");
    }
}

/// The crates that sections of a Cargo.toml name, as code names them.
fn named<'a>(
    sections: &'a [Section],
    which: impl Fn(&str) -> bool + 'a,
) -> impl Iterator<Item = String> + 'a {
    let lines = sections.iter().filter(move |(name, _)| which(name)).flat_map(|(_, lines)| lines);
    lines.filter_map(|line| line.split(['=', '.']).next()).map(|name| name.trim().replace('-', "_"))
}

/// Whether code names a crate: in a path, or in a `use` by itself.
fn names(text: &str, name: &str) -> bool {
    let mut code = text.lines().map(str::trim).filter(|line| !line.starts_with("//"));
    code.any(|line| {
        line.match_indices(name).any(|(at, _)| {
            let before = &line[..at];
            let behind = &line[at + name.len()..];
            let begins = !before.ends_with(|last: char| last.is_alphanumeric() || last == '_');
            let used = before.ends_with("use ") && behind.starts_with([';', ' ']);
            begins && (behind.starts_with("::") || used)
        })
    })
}

#[test]
fn every_dependency_is_named_in_the_code_that_has_it() {
    for member in members() {
        let sections = sections(&member.join("Cargo.toml"));
        // What only tests need may be in any of its files, anything else must be in what is built.
        for (for_tests, folder) in [(false, member.join("src")), (true, member.clone())] {
            let files = sources(&folder);
            let which = |name: &str| name.ends_with("dependencies") && name.contains("dev-") == for_tests;
            for name in named(&sections, which) {
                let found = files.iter().any(|(_, text)| names(text, &name));
                assert!(found, "{} depends on {name} and does not name it", member.display());
            }
        }
    }
}

#[test]
fn every_dependency_of_the_workspace_has_a_crate_that_needs_it() {
    let needed: BTreeSet<String> = members().iter().flat_map(|member| dependencies(member)).collect();
    for name in named(&sections(&root().join("Cargo.toml")), |name| name == "workspace.dependencies") {
        assert!(needed.contains(&name.replace('_', "-")) || needed.contains(&name), "nobody needs {name}");
    }
}

#[test]
fn the_oldest_compiler_is_the_same_everywhere() {
    let manifest = text_of(&root().join("Cargo.toml"));
    let (_, behind) = manifest.split_once("rust-version = \"").expect("a version");
    let oldest = behind.split('"').next().expect("a version");
    let page = text_of(&root().join("CONTRIBUTING.md"));
    for said in [format!("Rust {oldest} or newer"), format!("cargo +{oldest} check ")] {
        assert!(page.contains(&said), "CONTRIBUTING.md does not say `{said}`");
    }
    for member in members() {
        assert!(
            text_of(&member.join("Cargo.toml")).contains("rust-version.workspace = true"),
            "{}",
            member.display()
        );
    }
}

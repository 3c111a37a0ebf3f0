//! 3MF (core specification 1.3): objects in a model, components in objects, and the items of the build; with the
//! production extension, the objects may be in other files of the package.

use crate::error::{ErrorKind, ImportError, Place, quoted};
use crate::number::Decimal;
use crate::package::Package;
use crate::scene::{Object, Placed, Placement, Scene, coordinate};
use crate::xml::{self, Element, Visitor};
use crate::{FileUnit, Format, Part, Report, Unit};
use std::collections::BTreeSet;

/// Reads the models of a package.
pub(crate) fn package(package: &mut Package<'_>, unit: FileUnit) -> Result<Part, ImportError> {
    let mut start = Start::default();
    // A package without relations is broken, but what is meant is clear when it has one model.
    let _ = package.walk("_rels/.rels", &mut start);
    let is_model = |name: &&String| name.to_ascii_lowercase().ends_with(".model");
    let root = start.model.or_else(|| package.names.iter().find(is_model).cloned()).unwrap_or_default();
    let mut models = Models::new(unit);
    let mut seen = BTreeSet::new();
    let mut to_read = vec![root];
    while let Some(path) = to_read.pop() {
        let path = path.trim_start_matches('/').to_owned();
        if !seen.insert(path.clone()) {
            continue;
        }
        models.begin(&path, seen.len() == 1);
        package.walk(&path, &mut models)?;
        to_read.append(&mut models.others);
    }
    models.part()
}

/// Reads a model that was taken out of its package.
pub(crate) fn model(bytes: &[u8], unit: FileUnit) -> Result<Part, ImportError> {
    let mut models = Models::new(unit);
    models.begin("", true);
    xml::walk(bytes, u64::MAX, None, &mut models)?;
    models.part()
}

/// Finds the first model of a package in its relations.
#[derive(Default)]
struct Start {
    model: Option<String>,
}

impl Visitor for Start {
    fn open(&mut self, element: Element<'_>) -> Result<(), ImportError> {
        if element.name == "Relationship"
            && element.get("Type").is_some_and(|kind| kind.ends_with("/3dmodel"))
        {
            self.model = self.model.take().or_else(|| element.get("Target"));
        }
        Ok(())
    }
}

struct Models {
    wanted: FileUnit,
    unit: Unit,
    scene: Scene,
    /// The file that is being read.
    path: String,
    /// Whether its build counts: only that of the first file does.
    first: bool,
    /// The object that is being read, and whether it is to be printed.
    object: Option<(String, Object)>,
    /// Files that hold objects of this one.
    others: Vec<String>,
    /// Whether the model says what to build.
    has_build: bool,
    hidden: usize,
    helpers: BTreeSet<String>,
}

impl Models {
    fn new(wanted: FileUnit) -> Self {
        Self {
            wanted,
            unit: Unit::default(),
            scene: Scene::default(),
            path: String::new(),
            first: true,
            object: None,
            others: Vec::new(),
            has_build: false,
            hidden: 0,
            helpers: BTreeSet::new(),
        }
    }

    fn begin(&mut self, path: &str, first: bool) {
        path.clone_into(&mut self.path);
        self.first = first;
        self.unit = self.wanted.or(None);
    }

    /// An object's name within the package: numbers are given in each file anew.
    fn name(&self, path: Option<&str>, id: &str) -> String {
        let path = path.map_or(self.path.as_str(), |path| path.trim_start_matches('/'));
        if path.is_empty() { id.to_owned() } else { format!("{path}#{id}") }
    }

    /// What `item` and `component` have in common: an object and a transform.
    fn placed(&mut self, element: &Element<'_>) -> Result<Placed, ImportError> {
        let path = element.get("path");
        self.others.extend(path.clone());
        let id = needed(element, "objectid")?;
        let at = element.get("transform").map(|text| transform(&text, self.unit)).transpose()?;
        Ok(Placed { object: self.name(path.as_deref(), &id), at: at.unwrap_or(Placement::HERE) })
    }

    fn part(mut self) -> Result<Part, ImportError> {
        let mut remarks = Vec::new();
        if self.hidden > 0 {
            remarks
                .push(format!("{} objects are marked as not to be printed and were left out", self.hidden));
        }
        let before = self.scene.roots.len();
        self.scene.roots.retain(|root| !self.helpers.contains(&root.object));
        let helpers = before - self.scene.roots.len();
        if helpers > 0 {
            remarks.push(format!("{helpers} objects are supports or of no body and were left out"));
        }
        if !self.has_build {
            self.scene.roots = self.scene.tops();
            remarks.push("the file does not say what to build: all its objects are taken".to_owned());
        }
        let solids = self.scene.roots.len();
        let report =
            Report { format: Format::ThreeMf, unit: self.unit, solids, remarks, ..Report::default() };
        let unit = self.unit;
        Ok(Part::new(self.scene.facets()?.mesh(unit)?, report))
    }
}

impl Visitor for Models {
    fn open(&mut self, element: Element<'_>) -> Result<(), ImportError> {
        match element.name {
            "vertex" => {
                let [x, y, z] = three(&element, ["x", "y", "z"], |words| {
                    let [x, y, z] = words.map(|word| coordinate(word, self.unit));
                    Ok([x?, y?, z?])
                })?;
                if let Some((_, object)) = &mut self.object {
                    object.vertices.push([x, y, z]);
                }
            }
            "triangle" => {
                if let Some((_, object)) = &mut self.object {
                    three(&element, ["v1", "v2", "v3"], |words| object.triangle(words))?;
                }
            }
            "model" => {
                let own = element.get("unit").map(|word| {
                    Unit::of_word(&word).ok_or_else(|| {
                        let message = format!("`{}` is no unit", quoted(word.as_bytes()));
                        ImportError::syntax(Place::File, message)
                    })
                });
                self.unit = self.wanted.or(own.transpose()?);
            }
            "object" => {
                let name = self.name(None, &needed(&element, "id")?);
                if matches!(element.get("type").as_deref(), Some("support" | "other")) {
                    self.helpers.insert(name.clone());
                }
                self.object = Some((name, Object::default()));
            }
            "component" => {
                let placed = self.placed(&element)?;
                if let Some((_, object)) = &mut self.object {
                    object.parts.push(placed);
                }
            }
            "item" if self.first => {
                self.has_build = true;
                let placed = self.placed(&element)?;
                if element.get("printable").as_deref() == Some("0") {
                    self.hidden += 1;
                } else {
                    self.scene.roots.push(placed);
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn close(&mut self, name: &str) -> Result<(), ImportError> {
        if name == "object"
            && let Some((name, object)) = self.object.take()
            && let Some(_twice) = self.scene.objects.insert(name.clone(), object)
        {
            let message = format!("two objects have the name `{}`", quoted(name.as_bytes()));
            return Err(ImportError::syntax(Place::File, message));
        }
        Ok(())
    }
}

/// Three attributes at once, as vertices and triangles have them.
#[inline]
fn three<T>(
    element: &Element<'_>,
    names: [&str; 3],
    make: impl FnOnce([&str; 3]) -> Result<T, ImportError>,
) -> Result<T, ImportError> {
    element.three(names, |words| match words {
        [Some(a), Some(b), Some(c)] => make([a, b, c]),
        _ => {
            let message = format!("a {} has not all of {}", element.name, names.join(", "));
            Err(ImportError::syntax(Place::File, message))
        }
    })
}

fn needed(element: &Element<'_>, name: &str) -> Result<String, ImportError> {
    element.get(name).ok_or_else(|| {
        ImportError::syntax(
            Place::File,
            format!("an element `{}` has no `{name}`", quoted(element.name.as_bytes())),
        )
    })
}

/// Twelve numbers: three rows that turn and scale, and one that moves (core specification, 3.3).
fn transform(text: &str, unit: Unit) -> Result<Placement, ImportError> {
    let refuse = || {
        let message = format!("`{}` is no transform: it has not twelve numbers", quoted(text.as_bytes()));
        ImportError::new(ErrorKind::Syntax, Place::File, message, "export the model again")
    };
    let mut numbers = [Decimal::default(); 12];
    let mut words = text.split_ascii_whitespace();
    for number in &mut numbers {
        *number = words.next().and_then(|word| Decimal::read(word.as_bytes()).ok()).ok_or_else(refuse)?;
    }
    let (rows, _) = numbers.as_chunks::<3>();
    match (rows, words.next()) {
        ([a, b, c, shift], None) => {
            let [x, y, z] = shift.map(|number| number.picometres(unit).map_err(|_| refuse()));
            Ok(Placement { rows: [a, b, c].map(|row| row.map(Decimal::plain)), shift: [x?, y?, z?] })
        }
        _ => Err(refuse()),
    }
}

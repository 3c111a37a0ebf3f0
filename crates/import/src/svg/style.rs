//! Whether a shape is filled or a line: presentation attributes, style sheets and style attributes.

use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use svgtypes::Length;

/// What is inherited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub(super) fill: bool,
    pub(super) even_odd: bool,
    pub(super) stroke: bool,
    pub(super) stroke_width: Length,
    pub(super) visible: bool,
    /// Not inherited: what is in an element that is not displayed is never reached.
    pub(super) displayed: bool,
}

impl Style {
    /// What holds where nothing is said.
    pub(super) fn initial() -> Self {
        Self {
            fill: true,
            even_odd: false,
            stroke: false,
            stroke_width: Length::new_number(1.0),
            visible: true,
            displayed: true,
        }
    }

    /// The style of an element inside one of this style.
    pub(super) fn inherited(self, node: Node<'_, '_>, sheet: &Sheet) -> Self {
        let mut style = Self { displayed: true, ..self };
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            style.declare(attribute.name(), attribute.value());
        }
        sheet.each(node, |name, value| style.declare(name, value));
        for (name, value) in declarations(node.attribute("style").unwrap_or_default()) {
            style.declare(name, value);
        }
        style
    }

    fn declare(&mut self, name: &str, value: &str) {
        let value = value.trim().trim_end_matches("!important").trim_end();
        if value == "inherit" {
            return;
        }
        let is_paint = !matches!(value, "none" | "transparent");
        match name {
            "fill" => self.fill = is_paint,
            "fill-rule" => self.even_odd = value == "evenodd",
            "stroke" => self.stroke = is_paint,
            "stroke-width" => self.stroke_width = value.parse().unwrap_or(self.stroke_width),
            "visibility" => self.visible = !matches!(value, "hidden" | "collapse"),
            "display" => self.displayed = value != "none",
            _ => {}
        }
    }
}

fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split(';').filter_map(|one| one.split_once(':')).map(|(name, value)| (name.trim(), value.trim()))
}

/// The rules of a document's style sheets that are for a class, an id or a name of elements.
#[derive(Default)]
pub(super) struct Sheet {
    rules: BTreeMap<String, Vec<(String, String)>>,
    /// How many selectors are of other kinds.
    pub(super) ignored: usize,
}

impl Sheet {
    pub(super) fn of(document: &Document<'_>) -> Self {
        let mut sheet = Self::default();
        for style in document.descendants().filter(|node| node.has_tag_name_of("style")) {
            let text: String = style.children().filter_map(|node| node.text()).collect();
            sheet.read(&without_remarks(&text));
        }
        sheet
    }

    fn read(&mut self, text: &str) {
        for (selectors, body) in text.split('}').filter_map(|rule| rule.split_once('{')) {
            for selector in selectors.split(',').map(str::trim) {
                let name = selector.strip_prefix(['.', '#']).unwrap_or(selector);
                let is_one = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_');
                if name.is_empty() || !name.chars().all(is_one) {
                    self.ignored += 1;
                    continue;
                }
                let rules = self.rules.entry(selector.to_owned()).or_default();
                rules.extend(declarations(body).map(|(name, value)| (name.to_owned(), value.to_owned())));
            }
        }
    }

    /// The declarations for an element, the weakest first: those for its name, its classes and its id.
    fn each(&self, node: Node<'_, '_>, mut take: impl FnMut(&str, &str)) {
        if self.rules.is_empty() {
            return;
        }
        let mut rule = |selector: &str| {
            for (name, value) in self.rules.get(selector).into_iter().flatten() {
                take(name, value);
            }
        };
        rule(node.tag_name().name());
        for class in node.attribute("class").unwrap_or_default().split_ascii_whitespace() {
            rule(&format!(".{class}"));
        }
        if let Some(id) = node.attribute("id") {
            rule(&format!("#{id}"));
        }
    }
}

fn without_remarks(text: &str) -> String {
    let mut pieces = text.split("/*");
    let mut out = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        out.push_str(piece.split_once("*/").map_or("", |(_, rest)| rest));
    }
    out
}

/// Names of SVG, whether the drawing names its space or not.
pub(super) trait Named {
    /// Whether it is an element of SVG of this name.
    fn has_tag_name_of(&self, name: &str) -> bool;
    /// Its name, if it is an element of SVG.
    fn svg_name(&self) -> Option<&str>;
}

impl Named for Node<'_, '_> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.svg_name() == Some(name)
    }

    fn svg_name(&self) -> Option<&str> {
        let tag = self.tag_name();
        let is_svg = tag.namespace().is_none_or(|space| space == "http://www.w3.org/2000/svg");
        (self.is_element() && is_svg).then(|| tag.name())
    }
}

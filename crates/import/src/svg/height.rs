//! How high a layer is, by what it is called.

use roxmltree::Node;

/// The height in millimetres that an element says it has: in an attribute `z` of any prefix, or as `z:1.5` or `z 1.5`
/// in its id or a label.
pub(super) fn of(node: Node<'_, '_>) -> Option<f64> {
    let number = |text: &str| number(text.trim()).filter(|(_, rest)| is_end(rest)).map(|(value, _)| value);
    let own = node.attributes().find(|attribute| attribute.name() == "z").and_then(|z| number(z.value()));
    own.or_else(|| {
        let is_name = |name: &str| name == "id" || name == "data-name" || name.contains("label");
        node.attributes().filter(|attribute| is_name(attribute.name())).find_map(|name| named(name.value()))
    })
}

/// The number behind a `z` that stands for itself.
fn named(text: &str) -> Option<f64> {
    let text = unescaped(text);
    let mut before = None;
    for (at, letter) in text.char_indices() {
        let stands_alone = before.is_none_or(|letter: char| !letter.is_alphanumeric());
        if stands_alone && matches!(letter, 'z' | 'Z') {
            let rest = text.get(at + 1..).unwrap_or_default();
            let value = rest.trim_start_matches([' ', ':', '=', '_']);
            if value.len() < rest.len()
                && let Some((height, rest)) = number(value)
                && is_end(rest)
            {
                return Some(height);
            }
        }
        before = Some(letter);
    }
    None
}

/// Whether a number may end here: it may be followed by its unit, and by other words.
fn is_end(rest: &str) -> bool {
    let rest = rest.trim_start().strip_prefix("mm").unwrap_or(rest);
    !rest.starts_with(|letter: char| letter.is_alphanumeric() || letter == '.')
}

/// The number at the start of a text, and what follows.
fn number(text: &str) -> Option<(f64, &str)> {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let mut end = usize::from(text.starts_with(['-', '+']));
    let whole = digits(text.get(end..)?);
    end += whole;
    let mut places = 0;
    if text.get(end..).is_some_and(|rest| rest.starts_with('.')) {
        places = digits(text.get(end + 1..)?);
        end += usize::from(places > 0) + places;
    }
    if whole + places == 0 {
        return None;
    }
    if let Some(exponent) = text.get(end..).and_then(|rest| rest.strip_prefix(['e', 'E'])) {
        let sign = usize::from(exponent.starts_with(['-', '+']));
        let power = digits(exponent.get(sign..)?);
        end += if power > 0 { 1 + sign + power } else { 0 };
    }
    let (number, rest) = text.split_at_checked(end)?;
    Some((number.parse().ok()?, rest))
}

/// Names as Illustrator writes them into ids: `_x3A_` is a colon.
fn unescaped(text: &str) -> String {
    let mut pieces = text.split("_x");
    let mut out = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let coded = piece.split_once('_').and_then(|(code, rest)| {
            let letter = u32::from_str_radix(code, 16).ok().and_then(char::from_u32)?;
            Some((letter, rest))
        });
        match coded {
            Some((letter, rest)) => {
                out.push(letter);
                out.push_str(rest);
            }
            None => {
                out.push_str("_x");
                out.push_str(piece);
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn heights_in_names() {
        for (name, height) in [
            ("z:1.5", Some(1.5)),
            ("z 1.5", Some(1.5)),
            ("Layer 3, z:1.5", Some(1.5)),
            ("z = 2", Some(2.0)),
            ("Z:-.5", Some(-0.5)),
            ("z:1e-3", Some(0.001)),
            ("z_x3A_1_x2E_25", Some(1.25)),
            ("z:1.5mm", Some(1.5)),
            ("z:1.5 (lip)", Some(1.5)),
            ("pizza z:3", Some(3.0)),
            ("Layer 3", None),
            ("glaze:7", None),
            ("z1", None),
            ("z:1.5x", None),
            ("z:1.2.3", None),
            ("z:", None),
            ("", None),
            ("é z:2", Some(2.0)),
        ] {
            assert_eq!(named(name), height, "{name}");
        }
    }
}

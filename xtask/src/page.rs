//! What commands write into pages: the lines between `<!-- name -->` and `<!-- /name -->`.

use crate::process::said;
use std::fs;
use std::path::Path;

/// Puts lines between the two markers of a page.
///
/// # Errors
/// When the page cannot be read or written, or has no such markers.
pub fn put(page: &Path, name: &str, lines: &str) -> Result<(), String> {
    let text = fs::read_to_string(page).map_err(|error| said(page, &error))?;
    let text = replaced(&text, name, lines)
        .ok_or_else(|| format!("{}: there is no `<!-- {name} -->` … `<!-- /{name} -->`", page.display()))?;
    fs::write(page, text).map_err(|error| said(page, &error))
}

fn replaced(text: &str, name: &str, lines: &str) -> Option<String> {
    let begin = format!("<!-- {name} -->\n");
    let (before, rest) = text.split_once(&begin)?;
    let (_, behind) = rest.split_once(&format!("<!-- /{name} -->"))?;
    Some(format!("{before}{begin}{}\n<!-- /{name} -->{behind}", lines.trim_end()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_stands_between_the_markers_changes() {
        let page = "a\n<!-- b -->\nold\nolder\n<!-- /b -->\nc\n<!-- d -->\n<!-- /d -->\n";
        let once = replaced(page, "b", "new\n").expect("markers");
        assert_eq!(once, "a\n<!-- b -->\nnew\n<!-- /b -->\nc\n<!-- d -->\n<!-- /d -->\n");
        assert_eq!(replaced(&once, "b", "new").expect("markers"), once);
        assert_eq!(replaced(page, "e", ""), None);
    }
}

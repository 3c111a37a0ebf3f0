//! What the finished file is called.

use crate::Export;

/// What a name may say beside the part.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Naming<'a> {
    /// The name of the part, without its ending.
    pub part: &'a str,
    /// The profile.
    pub profile: &'a str,
    /// Sizes and counts, like `h1.5` and `w3.2`.
    pub description: Vec<String>,
    /// The day and the time.
    pub time: &'a str,
}

impl Export {
    /// The name of the file, without a folder: the part, the suffix, and what the settings add to it.
    pub fn file_name(&self, naming: &Naming<'_>) -> String {
        let mut name = format!("{}{}", naming.part, self.suffix);
        let mut add = |wanted: bool, text: &str| {
            if wanted && !text.is_empty() {
                name += "_";
                name += &plain(text);
            }
        };
        add(self.name_has_profile, naming.profile);
        naming.description.iter().for_each(|word| add(self.name_has_description, word));
        add(self.name_has_time, naming.time);
        match plain(self.file_extension.trim_start_matches('.')).as_str() {
            "" => name,
            extension => name + "." + extension,
        }
    }
}

/// What every file system takes in a name.
fn plain(text: &str) -> String {
    let letter = |letter: char| if letter.is_alphanumeric() || ".-".contains(letter) { letter } else { '-' };
    text.trim().chars().map(letter).collect()
}

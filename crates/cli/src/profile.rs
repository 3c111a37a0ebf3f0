//! Finding profiles, and `clayforge profile`.

use crate::args::{self, ProfileAction, Settings};
use crate::output::print;
use crate::report::{self, Done, io_error};
use clayforge::{BUILT_IN, Error, Notes, Profile, Source, built_in, is_built_in, only_built_in};
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

/// The profile that a command works with.
pub fn load(settings: &Settings) -> Result<Profile, Error> {
    let mut profile = match &settings.profile {
        Some(name) => read(name)?,
        // Nobody named a profile: a file that happens to lie here does not count.
        None => Profile::read(find("clay", None)?, &|wanted, by| find(wanted, Some(by)))?,
    };
    for (key, value) in &settings.set {
        profile.set(key, value)?;
    }
    Ok(profile)
}

/// The profile of a name or a file.
pub fn read(name: &str) -> Result<Profile, Error> {
    Profile::read(find(name, Some(""))?, &|wanted, by| find(wanted, Some(by)))
}

/// Looks for a profile: as a file beside the one that names it (or here), in the config folder, among the built-in
/// ones. A profile that names its own name means the next of these.
fn find(wanted: &str, by: Option<&str>) -> Result<Source, Error> {
    if by.is_some_and(is_built_in) {
        return only_built_in(wanted, "");
    }
    let folder = by.map(|by| Path::new(by).parent().unwrap_or(Path::new("")).to_owned());
    for folder in folder.into_iter().chain(config_folder()) {
        for name in [wanted.to_owned(), format!("{wanted}.toml")] {
            let path = folder.join(name);
            let is_itself = by.is_some_and(|by| Path::new(by) == path);
            if !is_itself && path.exists() && !path.is_dir() {
                return file(&path);
            }
        }
    }
    built_in(wanted).ok_or_else(|| {
        Error::new(format!("there is no profile `{wanted}`, as a file or by name"))
            .hint("all profiles: clayforge profile list")
            .said_by("profile")
    })
}

fn file(path: &Path) -> Result<Source, Error> {
    /// Larger than any profile; a disk named by mistake is not read to its end.
    const MOST: u64 = 4 << 20;
    let refuse = |error| io_error(path, "read", &error);
    let name = path.display().to_string();
    let mut bytes = Vec::new();
    File::open(path).map_err(refuse)?.take(MOST + 1).read_to_end(&mut bytes).map_err(refuse)?;
    if bytes.len() as u64 > MOST {
        return Err(Error::new("it is too large for a profile").said_by(&name));
    }
    let text = String::from_utf8(bytes)
        .map_err(|_| Error::new("it is no UTF-8 text").hint("a profile is a TOML file").said_by(&name))?;
    let text = text.strip_prefix('\u{feff}').map_or(text.clone(), str::to_owned);
    Ok(Source { name, text })
}

/// Where the user's own profiles are.
fn config_folder() -> Option<PathBuf> {
    let folder = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    folder("XDG_CONFIG_HOME")
        .or_else(|| folder("APPDATA"))
        .or_else(|| folder("HOME").map(|home| home.join(".config")))
        .map(|config| config.join("clayforge"))
}

/// `clayforge profile`.
pub fn run(profile: &args::Profile) -> Done {
    match &profile.action {
        ProfileAction::List => print(&list()),
        ProfileAction::Show { name } => print(&read(name)?.show()),
        ProfileAction::Check { file } => {
            let profile = read(file)?;
            let mut notes = Notes::default();
            let done = profile.check(&mut notes);
            report::notes(&notes);
            done?;
            print(&format!("{file}: sound\n"))
        }
        ProfileAction::Schema => print(&clayforge::schema()),
        ProfileAction::New => print(&clayforge::starter()),
    }
}

/// A line for each profile: its name, where it is from, and its first comment.
fn list() -> String {
    let mut found: Vec<(String, String, String)> = Vec::new();
    if let Some(folder) = config_folder() {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        for path in
            entries.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|end| end == "toml"))
        {
            if let (Some(name), Ok(text)) = (path.file_stem(), fs::read_to_string(&path)) {
                found.push((
                    name.to_string_lossy().into_owned(),
                    path.display().to_string(),
                    first_comment(&text),
                ));
            }
        }
    }
    found.sort();
    for (name, text) in BUILT_IN {
        found.push(((*name).to_owned(), "built in".to_owned(), first_comment(text)));
    }
    let width = found.iter().map(|(name, ..)| name.chars().count()).max().unwrap_or(0);
    found.iter().map(|(name, from, about)| format!("{name:width$}  {about} ({from})\n")).collect()
}

/// The first sentence of the comment that a profile begins with.
fn first_comment(text: &str) -> String {
    let comment: Vec<&str> = text
        .lines()
        .map_while(|line| line.strip_prefix('#'))
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    let comment = comment.join(" ");
    match comment.split_once(['.', ';']) {
        Some((sentence, _)) => sentence.to_owned(),
        None => comment,
    }
}

//! Where results go: a file that is complete or absent, standard output, or a device.

use crate::report::{Stop, io_error};
use clayforge::Error;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use tempfile::NamedTempFile;

/// The unfinished files, for the moment when somebody presses Ctrl-C.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
static HANDLER: Once = Once::new();

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on Ctrl-C removes what is unfinished and ends the program.
fn handle_interrupts() {
    HANDLER.call_once(|| {
        // A file beyond `ulimit -f` shall be an error of the write, like a full disk: the signal that would kill the
        // program is taken and forgotten.
        #[cfg(unix)]
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
        // Without a handler Ctrl-C still ends the program; only the temporary file would stay.
        let _ = ctrlc::set_handler(|| {
            let files = unfinished();
            for file in files.iter() {
                let _ = fs::remove_file(file);
            }
            // The lock is held to the end, so that no file is begun in between.
            std::process::exit(130);
        });
    });
}

/// An open target.
pub struct Output {
    to: To,
    name: PathBuf,
    unread: bool,
}

enum To {
    Stdout(io::Stdout),
    /// A device or a pipe: it cannot be replaced.
    Straight(File),
    /// A new file beside the target, which takes its place when it is complete.
    Beside(NamedTempFile, PathBuf),
}

impl Output {
    /// Standard output.
    pub fn stdout() -> Self {
        Self { to: To::Stdout(io::stdout()), name: PathBuf::from("standard output"), unread: false }
    }

    /// A file, or standard output for `-`.
    ///
    /// # Errors
    /// When nothing can be written there.
    pub fn open(path: &Path) -> Result<Self, Error> {
        if path.as_os_str() == "-" {
            return Ok(Self::stdout());
        }
        let refuse = |error: io::Error| io_error(path, "write", &error);
        let said = |why: &str| Error::new(why).said_by(&path.display().to_string());
        // A link is written through: its target is what the user means.
        let is_link = fs::symlink_metadata(path).is_ok_and(|meta| meta.is_symlink());
        let target = if is_link { fs::canonicalize(path).map_err(refuse)? } else { path.to_owned() };
        let old = match fs::metadata(&target) {
            Ok(meta) if meta.is_dir() => return Err(said("it is a folder").hint("name a file")),
            Ok(meta) if !meta.is_file() => {
                let file = OpenOptions::new().write(true).open(&target).map_err(refuse)?;
                return Ok(Self { to: To::Straight(file), name: path.to_owned(), unread: false });
            }
            Ok(meta) if meta.permissions().readonly() => {
                return Err(said("it is write-protected").hint("choose another name with -o"));
            }
            Ok(meta) => Some(meta),
            Err(_) => None,
        };
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let Some(name) = target.file_name() else { return Err(said("it is no name of a file")) };
        handle_interrupts();
        let mut files = unfinished();
        let prefix = format!(".{}.clayforge-", name.to_string_lossy());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(".tmp");
        // Like any file that a program makes, and like the one it replaces.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let file = builder.tempfile_in(folder).map_err(refuse)?;
        if let Some(old) = old {
            file.as_file().set_permissions(old.permissions()).map_err(refuse)?;
        }
        files.push(file.path().to_owned());
        drop(files);
        Ok(Self { to: To::Beside(file, target), name: path.to_owned(), unread: false })
    }

    /// Writes a piece.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&mut self, piece: &[u8]) -> Result<(), Error> {
        let written = match &mut self.to {
            To::Stdout(out) => out.write_all(piece),
            To::Straight(file) => file.write_all(piece),
            To::Beside(file, _) => file.write_all(piece),
        };
        written.map_err(|error| self.refuse(&error))
    }

    /// Everything is written: the file takes the place of the target.
    ///
    /// # Errors
    /// When it cannot be completed; the target is as it was.
    pub fn finish(mut self) -> Result<(), Stop> {
        let done = match self.to {
            To::Stdout(ref mut out) => out.flush(),
            To::Straight(ref mut file) => file.flush(),
            To::Beside(file, target) => {
                let path = file.path().to_owned();
                let done = file.as_file().sync_all().and_then(|()| {
                    // The handler must not fall between the renaming and the forgetting.
                    let mut files = unfinished();
                    let done = file.persist(&target).map_err(|error| error.error);
                    files.retain(|known| *known != path);
                    done.map(drop)
                });
                return done.map_err(|error| Stop::Failed(io_error(&self.name, "write", &error)));
            }
        };
        done.map_err(|error| {
            let refused = self.refuse(&error);
            self.stop(refused)
        })
    }

    fn refuse(&mut self, error: &io::Error) -> Error {
        self.unread |= error.kind() == io::ErrorKind::BrokenPipe;
        io_error(&self.name, "write", error)
    }

    /// Why the command ended: a reader that went away is no failure.
    pub fn stop(&self, error: Error) -> Stop {
        if self.unread { Stop::Unread } else { Stop::Failed(error) }
    }
}

/// Writes a whole text to a target.
///
/// # Errors
/// When it cannot be written.
pub fn put(path: &Path, text: &[u8]) -> Result<(), Stop> {
    let mut output = Output::open(path)?;
    output.write(text).map_err(|error| output.stop(error))?;
    output.finish()
}

/// Writes a whole text to standard output.
///
/// # Errors
/// When it cannot be written.
pub fn print(text: &str) -> Result<(), Stop> {
    put(Path::new("-"), text.as_bytes())
}

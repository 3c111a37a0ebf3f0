//! XML as a stream, with what a stranger's file may cost bounded.

use crate::error::{ErrorKind, ImportError, Place, quoted};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::io::{self, BufRead, Read};

/// What is done with the elements of a document. An error that knows no place gets the line.
pub(crate) trait Visitor {
    /// An element begins.
    fn open(&mut self, element: Element<'_>) -> Result<(), ImportError>;
    /// Text within an element; long text may come in pieces.
    fn text(&mut self, _text: &str) {}
    /// An element ends.
    fn close(&mut self, _name: &str) -> Result<(), ImportError> {
        Ok(())
    }
}

/// The start of an element: its name without prefix, and its attributes.
pub(crate) struct Element<'a> {
    pub(crate) name: &'a str,
    start: &'a BytesStart<'a>,
}

impl Element<'_> {
    /// Every attribute with its name, prefix included, and its raw value; what is no attribute ends the list.
    pub(crate) fn each(&self, mut take: impl FnMut(&str, &str)) {
        let mut attributes = self.start.attributes();
        // Looking for doubles takes as long as all else.
        attributes.with_checks(false);
        for attribute in attributes.map_while(Result::ok) {
            take(attribute.key.as_ref(), &attribute.value);
        }
    }

    /// Three attributes in one pass; those that are not there are `None`.
    #[inline]
    pub(crate) fn three<T>(&self, wanted: [&str; 3], make: impl FnOnce([Option<&str>; 3]) -> T) -> T {
        let mut values: [Option<std::borrow::Cow<'_, str>>; 3] = [None, None, None];
        let mut attributes = self.start.attributes();
        attributes.with_checks(false);
        for attribute in attributes.map_while(Result::ok) {
            let key = attribute.key.as_ref();
            if let Some((_, value)) = wanted.iter().zip(&mut values).find(|(name, _)| **name == key) {
                *value = Some(attribute.value);
            }
        }
        make(values.each_ref().map(Option::as_deref))
    }

    /// An attribute by its name without prefix.
    pub(crate) fn get(&self, wanted: &str) -> Option<String> {
        let mut found = None;
        self.each(|name, value| {
            if name.rsplit(':').next() == Some(wanted) {
                found.get_or_insert_with(|| value.to_owned());
            }
        });
        found
    }
}

/// Walks through a document of at most so many bytes. Only elements with the prefix of the outermost one are told; the
/// others belong to extensions.
///
/// `entry` is the name of the file inside an archive, if it is in one.
pub(crate) fn walk(
    input: impl BufRead,
    most: u64,
    entry: Option<&str>,
    visitor: &mut impl Visitor,
) -> Result<(), ImportError> {
    let mut reader = Reader::from_reader(Guard { inner: input, lines: 0, left: most, token: 0 });
    reader.config_mut().expand_empty_elements = true;
    let mut prefix: Option<String> = None;
    let mut depth = 0usize;
    let mut buffer = Vec::new();
    loop {
        buffer.clear();
        reader.get_mut().token = 0;
        let event = reader.read_event_into(&mut buffer);
        let done = match &event {
            Ok(Event::Start(start)) => {
                depth += 1;
                let name = start.name();
                let (of, name) = parted(name.as_ref());
                let prefix = prefix.get_or_insert_with(|| of.to_owned());
                if depth > DEEPEST {
                    Err(ImportError::syntax(
                        Place::File,
                        format!("elements are nested more than {DEEPEST} deep"),
                    ))
                } else if of == prefix {
                    visitor.open(Element { name, start })
                } else {
                    Ok(())
                }
            }
            Ok(Event::End(end)) => {
                depth = depth.saturating_sub(1);
                let name = end.name();
                match parted(name.as_ref()) {
                    (of, name) if Some(of) == prefix.as_deref() => visitor.close(name),
                    _ => Ok(()),
                }
            }
            Ok(Event::Text(text)) => {
                visitor.text(text);
                Ok(())
            }
            Ok(Event::CData(text)) => {
                visitor.text(text);
                Ok(())
            }
            Ok(Event::Eof) if depth == 0 && prefix.is_some() => return Ok(()),
            Ok(Event::Eof) => {
                Err(ImportError::truncated(Place::File, "the XML ends before its outermost element does"))
            }
            Ok(_) => Ok(()),
            Err(error) => Err(broken(error)),
        };
        drop(event);
        done.map_err(|mut error| {
            if error.place == Place::File {
                let line = reader.get_ref().lines + 1;
                error.place = match entry {
                    Some(name) => Place::Entry { name: quoted(name.as_bytes()), line },
                    None => Place::Line(line),
                };
            }
            error
        })?;
    }
}

/// Deeper than any format goes.
const DEEPEST: usize = 256;

/// Prefix and name.
fn parted(name: &str) -> (&str, &str) {
    name.split_once(':').unwrap_or(("", name))
}

fn broken(error: &quick_xml::Error) -> ImportError {
    match error {
        quick_xml::Error::Io(error) if error.kind() == io::ErrorKind::FileTooLarge => ImportError::new(
            ErrorKind::TooLarge,
            Place::File,
            error.to_string(),
            "no model is like that; export it again, or as STL",
        ),
        quick_xml::Error::Io(error) => ImportError::new(
            ErrorKind::Truncated,
            Place::File,
            format!("the archive is damaged: {error}"),
            "copy or download it again",
        ),
        quick_xml::Error::Syntax(error) => ImportError::truncated(Place::File, error),
        error => ImportError::syntax(Place::File, format!("this is no sound XML: {error}")),
    }
}

/// Counts lines, and stops when there is more than the document or one piece of it may have.
struct Guard<R> {
    inner: R,
    lines: usize,
    left: u64,
    /// Bytes since the last tag began.
    token: usize,
}

/// A tag or a stretch of text: metadata of many programs, no coordinates.
const LONGEST_TOKEN: usize = 16 << 20;

impl<R: BufRead> Read for Guard<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let length = self.fill_buf()?.read(out)?;
        self.consume(length);
        Ok(length)
    }
}

impl<R: BufRead> BufRead for Guard<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.left == 0 {
            let message = "the file unpacks to a hundred times its size and more";
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
        }
        if self.token > LONGEST_TOKEN {
            let message = format!("one tag or text has more than {LONGEST_TOKEN} bytes");
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
        }
        self.inner.fill_buf()
    }

    fn consume(&mut self, length: usize) {
        if let Ok(buffer) = self.inner.fill_buf() {
            let used = buffer.get(..length).unwrap_or(buffer);
            self.lines += used.iter().filter(|byte| **byte == b'\n').count();
        }
        self.left = self.left.saturating_sub(length as u64);
        self.token += length;
        self.inner.consume(length);
    }
}

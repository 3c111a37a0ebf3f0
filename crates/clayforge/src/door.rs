//! The door: bytes of any known form become the document with which the chain begins.

use crate::document::Plate;
use crate::{Document, Profile, Sliced};
use import::{Format, Import, Part};
use shape::TriangleMesh;
use skein::{Error, Machine, Micron, Notes, Slices};

/// Reads the parts that are sliced together: meshes, or the layers of one drawing.
pub(crate) fn open<P: AsRef<[u8]>>(
    parts: impl IntoIterator<Item = Result<P, Error>>,
    profile: &Profile,
    sliced: &mut Sliced,
) -> Result<Door, Error> {
    let mut doubt = None;
    let mut meshes = Vec::new();
    let mut done = Vec::new();
    let mut parts = parts.into_iter();
    while let Some(part) = parts.next() {
        let part = part?;
        let bytes = part.as_ref();
        if import::is_drawing(bytes) {
            if !meshes.is_empty() || parts.next().is_some() {
                return Err(Error::new("a drawing of layers cannot stand beside other parts")
                    .hint("slice it by itself"));
            }
            sliced.formats.push(Format::Svg);
            let document = Document::Slices(layers(bytes, profile, &mut sliced.notes)?);
            return Ok(Door { document, doubt });
        }
        done = Plate::stages_of(bytes);
        let part = read(bytes, &profile.import, &mut sliced.notes)?;
        doubt = doubt.or(part.doubt());
        sliced.formats.push(part.report.format);
        meshes.push(part.mesh);
    }
    Ok(Door { document: Document::Mesh(Plate { parts: meshes, done }), doubt })
}

/// What came in, and the question about its unit, which may explain why it cannot be sliced.
pub(crate) struct Door {
    pub(crate) document: Document,
    pub(crate) doubt: Option<String>,
}

/// The layers of a drawing: those of another program are for carve, which puts them on the bed; those that carve wrote
/// nobody moves any more.
fn layers(bytes: &[u8], profile: &Profile, notes: &mut Notes) -> Result<Slices, Error> {
    let slices = drawing(bytes, &profile.import, notes)?;
    if slices.done.iter().any(|done| done.stage == carve::Carve::NAME) {
        on_the_bed(&slices, &profile.machine)?;
    }
    Ok(slices)
}

/// Reads a drawing, by whomever it is.
pub(crate) fn drawing(bytes: &[u8], import: &Import, notes: &mut Notes) -> Result<Slices, Error> {
    if Slices::is_own(bytes) {
        return Slices::read(bytes);
    }
    let drawing = import.drawing(bytes)?;
    drawing.remarks.into_iter().for_each(|remark| notes.say(remark));
    notes.said_by(Import::NAME);
    Ok(drawing.slices)
}

fn on_the_bed(slices: &Slices, machine: &Machine) -> Result<(), Error> {
    let (left, front) = machine.least();
    let (right, back) = (left + machine.bed.x.0, front + machine.bed.y.0);
    let beside = slices.layers.iter().enumerate().find_map(|(layer, drawn)| {
        let points = drawn.loops.iter().flat_map(|ring| &ring.0);
        let is_beside = |x: i32, y: i32| x < left || x > right || y < front || y > back;
        points.into_iter().find(|point| is_beside(point.x, point.y)).map(|point| (layer, *point))
    });
    if let Some((layer, point)) = beside {
        let (x, y) = (Micron(point.x), Micron(point.y));
        return Err(Error::layer(layer, format!("the drawing reaches x {x} y {y} mm, beside the bed")).hint(
            "layers are printed where they are drawn; carve the part for this machine, or set machine.bed",
        ));
    }
    if slices.layers.iter().any(|layer| layer.z > machine.bed.z) {
        return Err(Error::new(format!(
            "the drawing is higher than the {} mm of the machine",
            machine.bed.z
        ))
        .hint("set machine.bed"));
    }
    Ok(())
}

/// Reads a part for a closer look.
///
/// # Errors
/// When the bytes are no part.
pub fn read_part(bytes: &[u8], profile: &Profile, notes: &mut Notes) -> Result<TriangleMesh, Error> {
    mesh(bytes, &profile.import, notes)
}

pub(crate) fn mesh(bytes: &[u8], import: &Import, notes: &mut Notes) -> Result<TriangleMesh, Error> {
    read(bytes, import, notes).map(|part| part.mesh)
}

fn read(bytes: &[u8], import: &Import, notes: &mut Notes) -> Result<Part, Error> {
    let part = import.read(bytes)?;
    for note in part.notes() {
        notes.say(note);
    }
    notes.said_by(Import::NAME);
    Ok(part)
}

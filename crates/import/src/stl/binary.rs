//! Binary STL: 80 bytes for anything, a count, and fifty bytes for each facet.

use crate::error::{ErrorKind, ImportError, Place};
use crate::number::nearest;
use crate::weld::{self, Facets, LEAST_WORK, Welder};
use crate::{Format, Part, Report, Unit};
use rayon::prelude::*;
use shape::{Point3, TriangleMesh};
use unit::Micron;

const HEAD: usize = 84;
const RECORD: usize = 50;
/// From here on a count is a placeholder that a writer never filled in: nobody has files of 100 GB.
const ABSURD: u32 = 1 << 31;

/// Whether the length is just what the count asks for. Nothing else is like that by chance.
pub(crate) fn has_exact_length(bytes: &[u8]) -> bool {
    promised(bytes).is_some_and(|count| (bytes.len() - HEAD) as u64 == u64::from(count) * RECORD as u64)
}

/// What the header promises, if there is a header.
fn promised(bytes: &[u8]) -> Option<u32> {
    let (head, _) = bytes.split_first_chunk::<HEAD>()?;
    head.last_chunk().map(|count| u32::from_le_bytes(*count))
}

pub(crate) fn read(bytes: &[u8], unit: Unit) -> Result<Part, ImportError> {
    let (Some(promised), Some(body)) = (promised(bytes), bytes.get(HEAD..)) else {
        let message = format!(
            "this is no mesh: it is none of the formats that are known, and {} bytes are too few for a binary STL",
            bytes.len()
        );
        return Err(ImportError::new(ErrorKind::Unknown, Place::File, message, "save or download it again"));
    };
    if body.is_empty() && (promised == 0 || promised >= ABSURD) {
        return Err(ImportError::no_facets(Place::Byte(HEAD)));
    }
    let count = count(promised, body)?;
    match parse(body, count, promised, unit) {
        // Extra data that makes no facets was not meant to be any.
        Err(_) if (1..count).contains(&(promised as usize)) => parse(body, promised as usize, promised, unit),
        result => result,
    }
}

/// How many facets to read: what the length gives, unless that hides a loss.
fn count(promised: u32, body: &[u8]) -> Result<usize, ImportError> {
    let (present, rest) = (body.len() / RECORD, body.len() % RECORD);
    let placeholder = promised == 0 || promised >= ABSURD;
    let asked = promised as usize;
    if !placeholder && asked > present {
        let message = format!("truncated: the header promises {promised} facets, {present} are present");
        let place = Place::Byte(HEAD + present * RECORD);
        return Err(ImportError::new(ErrorKind::Truncated, place, message, TRUNCATED));
    }
    if rest == 0 {
        return Ok(present);
    }
    if placeholder {
        let message = format!("truncated: the file ends {rest} bytes into facet {}", present + 1);
        let place = Place::Byte(HEAD + present * RECORD);
        return Err(ImportError::new(ErrorKind::Truncated, place, message, TRUNCATED));
    }
    let (_, extra) = body.split_at_checked(asked.saturating_mul(RECORD)).unwrap_or_default();
    if extra.len() < RECORD || extra.iter().all(|byte| *byte == 0) {
        return Ok(asked);
    }
    let message =
        format!("the header promises {promised} facets, but {} more bytes follow them", extra.len());
    Err(ImportError::new(
        ErrorKind::WrongCount,
        Place::Byte(HEAD + asked * RECORD),
        message,
        "either facets are missing or something was appended; export the model again",
    ))
}

const TRUNCATED: &str =
    "the end of the file is missing, or it is no STL at all; export, copy or download it again";

fn parse(body: &[u8], count: usize, promised: u32, unit: Unit) -> Result<Part, ImportError> {
    if count > TriangleMesh::MOST_TRIANGLES {
        return Err(ImportError::too_large(count));
    }
    let (all, _) = body.as_chunks::<RECORD>();
    let records = all.get(..count).unwrap_or(all);
    let mesh = welded(records, unit)?.mesh(unit)?;
    let report = Report {
        format: Format::BinaryStl,
        unit,
        promised: (promised as usize != count).then_some(promised),
        trailing: body.len() - records.len() * RECORD,
        solids: 1,
        ..Report::default()
    };
    Ok(Part::new(mesh, report))
}

/// Each thread welds a piece of the file by itself; then the vertices of the later pieces, far fewer than their
/// corners, are welded to those of the first. Indices are given by first occurrence, so the cuts do not show.
fn welded(records: &[[u8; RECORD]], unit: Unit) -> Result<Facets, ImportError> {
    let piece = records.len().div_ceil(rayon::current_num_threads()).max(LEAST_WORK);
    let mut triangles = vec![[0u32; 3]; records.len()];
    let pieces: Vec<Result<Welder, usize>> = records
        .par_chunks(piece)
        .zip(triangles.par_chunks_mut(piece))
        .map(|(records, triangles)| weld_piece(records, triangles, unit))
        .collect();

    let mut first: Option<Welder> = None;
    let mut renumbered = Vec::with_capacity(pieces.len());
    for (index, result) in pieces.into_iter().enumerate() {
        let welder = result.map_err(|bad| refuse(records, index * piece + bad, unit))?;
        let Some(first) = &mut first else {
            first = Some(welder);
            continue;
        };
        let mut indices = vec![0; welder.vertices.len()];
        first.indices(&welder.vertices, &mut indices);
        renumbered.push(indices);
    }
    triangles.par_chunks_mut(piece).skip(1).zip(&renumbered).for_each(|(triangles, indices)| {
        for vertex in triangles.as_flattened_mut() {
            *vertex = indices.get(*vertex as usize).copied().unwrap_or_default();
        }
    });
    let vertices = first.map(|first| first.vertices).unwrap_or_default();
    Ok(Facets { vertices, triangles })
}

/// Welds one piece, or returns the first of its facets with a coordinate that is none.
fn weld_piece(records: &[[u8; RECORD]], triangles: &mut [[u32; 3]], unit: Unit) -> Result<Welder, usize> {
    const BATCH: usize = weld::BATCH / 3;
    let scale = unit.microns() as f64;
    let mut welder = Welder::new(records.len());
    let mut corners = [[Point3::default(); 3]; BATCH];
    for (batch, (records, triangles)) in records.chunks(BATCH).zip(triangles.chunks_mut(BATCH)).enumerate() {
        let mut good = true;
        for (record, corners) in records.iter().zip(&mut corners) {
            good &= decode(record, scale, corners);
        }
        if !good {
            let bad = records.iter().position(|record| !decode(record, scale, &mut [Point3::default(); 3]));
            return Err(batch * BATCH + bad.unwrap_or_default());
        }
        let corners = corners.as_flattened();
        let corners = corners.get(..records.len() * 3).unwrap_or(corners);
        welder.indices(corners, triangles.as_flattened_mut());
    }
    Ok(welder)
}

/// The corners of a facet in whole microns; `false` when one of its numbers is not within a kilometre.
#[inline]
fn decode(record: &[u8; RECORD], scale: f64, corners: &mut [Point3; 3]) -> bool {
    let floats: &[[u8; 4]] = record.as_chunks().0;
    // Twelve floats: the normal, which is not believed, and three corners.
    let [_, _, _, floats @ ..] = floats else { return false };
    let mut good = true;
    let mut micron = |bytes: &[u8; 4]| {
        // Exact: a float of 24 bits by a number of at most twenty.
        let micron = nearest(f64::from(f32::from_le_bytes(*bytes)) * scale);
        good &= micron.is_some();
        micron.unwrap_or_default()
    };
    for (corner, [x, y, z]) in corners.iter_mut().zip(floats.as_chunks::<3>().0) {
        *corner = Point3 { x: micron(x), y: micron(y), z: micron(z) };
    }
    good
}

/// Names the coordinate for which a facet is refused.
fn refuse(records: &[[u8; RECORD]], index: usize, unit: Unit) -> ImportError {
    let place = Place::Facet { number: index + 1, byte: HEAD + index * RECORD };
    let floats = records.get(index).map(|record| record.as_chunks::<4>().0).unwrap_or_default();
    let most = f64::from(Micron::LIMIT) / unit.microns() as f64;
    let bad = floats
        .iter()
        .skip(3)
        .map(|bytes| f32::from_le_bytes(*bytes))
        .find(|value| value.is_nan() || f64::from(*value).abs() > most)
        .unwrap_or(f32::NAN);
    if bad.is_finite() {
        ImportError::too_far(place, &format!("{bad:e}"), unit)
    } else {
        ImportError::not_finite(place, &bad.to_string())
    }
}

use crate::{Unit, measure};
use shape::TriangleMesh;
use std::fmt;

/// A part as it was read, and what is worth knowing about the reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The part, where the file has it: it is not moved.
    pub mesh: TriangleMesh,
    /// What was found and what was repaired.
    pub report: Report,
}

/// The formats that are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// STL of words and decimal numbers.
    #[default]
    TextStl,
    /// STL of records of fifty bytes.
    BinaryStl,
    /// Wavefront OBJ.
    Obj,
    /// PLY, the polygon format of Stanford, as text or binary.
    Ply,
    /// 3MF: an archive with XML in it.
    ThreeMf,
    /// AMF: XML, plain or in an archive.
    Amf,
    /// Layers as a drawing of any program.
    Svg,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TextStl => "text STL",
            Self::BinaryStl => "binary STL",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::ThreeMf => "3MF",
            Self::Amf => "AMF",
            Self::Svg => "SVG",
        })
    }
}

/// What the reader found and what it repaired.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// What the file is.
    pub format: Format,
    /// The unit it was read in.
    pub unit: Unit,
    /// Facets in the file; of a polygon, the triangles it was cut into.
    pub facets: usize,
    /// Facets left out because two of their corners are the same point in whole microns.
    pub degenerate: usize,
    /// What a binary STL promises, when it is not what it holds.
    pub promised: Option<u32>,
    /// Bytes after the last facet of a binary file.
    pub trailing: usize,
    /// Numbers of a text file written with a comma.
    pub decimal_commas: usize,
    /// Lines of a text file, outside of facets, that mean nothing to a reader.
    pub ignored_lines: usize,
    /// Polygons whose outlines cross themselves: how they are cut into triangles is a guess.
    pub crossed: usize,
    /// Solids of a text STL and objects of a file that has such; otherwise one.
    pub solids: usize,
    /// What only files of one format have.
    pub remarks: Vec<String>,
}

impl Part {
    /// A part and its report; the number of facets left out is known when the mesh is made.
    pub(crate) fn new((mesh, degenerate): (TriangleMesh, usize), report: Report) -> Self {
        Self { report: Report { facets: mesh.faces.len() + degenerate, degenerate, ..report }, mesh }
    }

    /// What is worth saying: the repairs as sentences, one for each kind, and a question about a size that no pot has.
    pub fn notes(&self) -> Vec<String> {
        self.report.notes().into_iter().chain(self.doubt()).collect()
    }

    /// The question about the unit, for a part that nobody would print from clay as small or as large as it is.
    pub fn doubt(&self) -> Option<String> {
        measure::doubt(self.mesh.bounds())
    }
}

impl Report {
    /// The repairs as sentences, one for each kind; none for a file that needed none.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let mut say = |count: usize, text: String| {
            if count > 0 {
                notes.push(text);
            }
        };
        let Self { facets, degenerate, trailing, decimal_commas, ignored_lines, crossed, .. } = self;
        say(*degenerate, format!("{degenerate} of {facets} facets have no area and were left out"));
        if let Some(promised) = self.promised {
            say(1, format!("the header promises {promised} facets, the file holds {facets}: all were read"));
        }
        say(*trailing, format!("{trailing} bytes after the last facet were ignored"));
        say(*decimal_commas, format!("{decimal_commas} numbers with a decimal comma were read as decimals"));
        say(
            *ignored_lines,
            format!("{ignored_lines} lines between the facets were not understood and ignored"),
        );
        say(*crossed, format!("{crossed} polygons cross themselves; their triangles are a guess"));
        notes.extend(self.remarks.iter().cloned());
        notes
    }
}

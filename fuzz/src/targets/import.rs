//! Parts of any format.

use super::{Target, size};
use ::import::{Format, Import};

pub(super) const TARGET: Target = Target {
    name: "import",
    law: "any bytes, read as what they look like and as every format, are a part or a refusal",
    run,
    dictionary: &[
        "solid ",
        "facet normal 0 0 0\n",
        "outer loop\n",
        "vertex ",
        "endloop\n",
        "endfacet\n",
        "endsolid",
        "\u{feff}",
        "v 1 2 3\n",
        "f 1 2 3\n",
        "f -1 -2 -3\n",
        "f 1/2/3 4//5 6/7\n",
        "vn 0 0 1\n",
        "o part\n",
        "g part\n",
        "\\\n",
        "ply\n",
        "format ascii 1.0\n",
        "format binary_little_endian 1.0\n",
        "format binary_big_endian 1.0\n",
        "element vertex 3\n",
        "element face 1\n",
        "property float x\n",
        "property double y\n",
        "property list uchar int vertex_indices\n",
        "property list uint float vertex_index\n",
        "end_header\n",
        "<model unit=\"inch\">",
        "<resources>",
        "<object id=\"1\">",
        "<mesh>",
        "<vertices>",
        "<vertex x=\"1\" y=\"2\" z=\"3\"/>",
        "<triangles>",
        "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>",
        "<components>",
        "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 0\"/>",
        "<build>",
        "<item objectid=\"1\"/>",
        "<amf>",
        "<volume>",
        "<coordinates>",
        "<constellation>",
        "<instance objectid=\"0\">",
        "<deltax>",
        "<!DOCTYPE a [<!ENTITY b \"c\">]>",
        "&amp;",
        "&#0;",
        "PK\x01\x02",
        "PK\x03\x04",
        "PK\x05\x06",
        "3D/3dmodel.model",
    ],
    most: 65_536,
};

const FORMATS: [Format; 7] =
    [Format::TextStl, Format::BinaryStl, Format::Obj, Format::Ply, Format::ThreeMf, Format::Amf, Format::Svg];

fn run(bytes: &[u8]) -> String {
    let read = Import::default().read(bytes);
    let mut said = match &read {
        Ok(part) => format!("{} {}", part.report.format, size(part.report.facets)),
        Err(error) => error.to_string(),
    };
    for format in FORMATS {
        if let Ok(part) = Import::default().read_as(format, bytes) {
            let faces = part.mesh.faces.len();
            assert!(faces <= part.report.facets, "{faces} faces of {} facets", part.report.facets);
            said.push_str(&format!(", {format}"));
        }
    }
    said
}

//! A mesh, drawn as a solid that is seen from the front, the right and above.

use shape::TriangleMesh;
use std::fmt::Write;

/// The directions of the picture in the part: to the right, up, and out of the paper. Together they are a turn, a little
/// to the left and forwards.
const RIGHT: [f64; 3] = [0.894, 0.447, 0.0];
const UP: [f64; 3] = [-0.204, 0.408, 0.889];
const OUT: [f64; 3] = [0.398, -0.796, 0.457];

/// What of the plane is shown, in millimetres: left, top, right and bottom, y downwards.
pub type Window = [f64; 4];

/// The least window that shows what two show.
pub fn around(one: Window, other: Window) -> Window {
    let [left, top, right, bottom] = one;
    let [l, t, r, b] = other;
    [left.min(l), top.min(t), right.max(r), bottom.max(b)]
}

/// The faces of a part from the farthest to the nearest, each as it lies in the picture.
pub struct Solid {
    faces: Vec<Face>,
}

struct Face {
    corners: [[f64; 2]; 3],
    depth: f64,
    /// How far it is turned to the light, from 0 to 1.
    light: f64,
    /// Whether each side is an edge of the solid and not the seam of two faces that lie in a plane.
    sharp: [bool; 3],
}

fn dot(one: [f64; 3], other: [f64; 3]) -> f64 {
    (0..3).map(|axis| one[axis] * other[axis]).sum()
}

impl Solid {
    /// What can be seen of a part.
    pub fn of(part: &TriangleMesh) -> Self {
        let place = |vertex: u32| {
            let at = part.vertices[vertex as usize];
            [at.x, at.y, at.z].map(|microns| f64::from(microns) / 1000.0)
        };
        let normals: Vec<[f64; 3]> = part.faces.iter().map(|face| normal(face.vertices.map(place))).collect();
        let mut faces: Vec<Face> = part
            .faces
            .iter()
            .zip(&normals)
            .filter(|(_, normal)| dot(**normal, OUT) > 0.0)
            .map(|(face, normal)| {
                let corners = face.vertices.map(place);
                let beside = |side: usize| {
                    let [from, to] = [face.vertices[side], face.vertices[(side + 1) % 3]];
                    let shares = |other: &[u32; 3]| other.contains(&from) && other.contains(&to);
                    let near = |other: &[f64; 3]| dot(*other, *normal) > 0.999;
                    let all = part.faces.iter().zip(&normals);
                    all.filter(|(other, _)| shares(&other.vertices)).all(|(_, other)| near(other))
                };
                Face {
                    corners: corners.map(|at| [dot(at, RIGHT), -dot(at, UP)]),
                    depth: corners.iter().map(|at| dot(*at, OUT)).sum(),
                    light: dot(*normal, [-0.3, -0.5, 0.81]).max(0.0),
                    sharp: [0, 1, 2].map(|side| !beside(side)),
                }
            })
            .collect();
        faces.sort_by(|one, other| one.depth.total_cmp(&other.depth));
        Self { faces }
    }

    /// The least window that shows it all.
    pub fn window(&self) -> Window {
        let corners = self.faces.iter().flat_map(|face| face.corners);
        corners.fold([f64::MAX, f64::MAX, f64::MIN, f64::MIN], |[left, top, right, bottom], [x, y]| {
            [left.min(x), top.min(y), right.max(x), bottom.max(y)]
        })
    }

    /// Draws it.
    pub fn draw(&self, [left, top, right, bottom]: Window) -> String {
        let margin = (right - left).max(bottom - top) * 0.05;
        let (width, height) = (right - left + 2.0 * margin, bottom - top + 2.0 * margin);
        let mut svg = format!(
            "<svg viewBox=\"{:.3} {:.3} {width:.3} {height:.3}\" stroke-width=\"{:.3}\">\n",
            left - margin,
            top - margin,
            width / 300.0
        );
        for face in &self.faces {
            let [a, b, c] = face.corners.map(|[x, y]| format!("{x:.3} {y:.3}"));
            let shade = (110.0 + 100.0 * face.light).round();
            let colour = [shade, shade * 0.76, shade * 0.6].map(|part| format!("{part:.0}")).join(",");
            // Its own colour around it, so that no light shines between two faces of a plane. A style of its own, since the
            // drawing beside it has one for all paths. Writing to a string cannot fail.
            let _ = writeln!(
                svg,
                "<path d=\"M{a}L{b}L{c}z\" style=\"fill:rgb({colour});stroke:rgb({colour})\" stroke-linejoin=\"round\"/>"
            );
        }
        for face in &self.faces {
            for side in (0..3).filter(|side| face.sharp[*side]) {
                let ([x, y], [u, v]) = (face.corners[side], face.corners[(side + 1) % 3]);
                let _ = writeln!(
                    svg,
                    "<path d=\"M{x:.3} {y:.3}L{u:.3} {v:.3}\" style=\"stroke:#643\" stroke-linecap=\"round\"/>"
                );
            }
        }
        svg + "</svg>\n"
    }
}

fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let side = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (u, v) = (side(b), side(c));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = dot(cross, cross).sqrt();
    cross.map(|part| part / length)
}

//! Whether a part stands.

use crate::tree::array;
use shape::{Point, Point3, TriangleMesh};

/// Where the weight of a part rests.
#[derive(Clone, Debug, PartialEq)]
pub struct Stand {
    /// The centre of mass in microns, if the part encloses a volume.
    pub centre: Option<[f64; 3]>,
    /// The convex hull of everything that touches the bed.
    pub footprint: Vec<Point>,
    /// How far inside the footprint the centre of mass stands, in microns; negative when it is outside and the part
    /// tips over.
    pub margin: Option<f64>,
}

impl Stand {
    /// Whether it stands.
    pub fn stands(&self) -> bool {
        self.margin.is_some_and(|margin| margin > 0.0)
    }
}

/// Where a part stands, of which everything below `floor` touches the bed.
pub(crate) fn of(mesh: &TriangleMesh, floor: i32) -> Stand {
    let footprint = hull(touching(mesh, floor));
    let centre = centre_of_mass(mesh);
    let margin = centre.and_then(|[x, y, _]| margin(&footprint, x, y));
    Stand { centre, footprint, margin }
}

/// The corners of the part up to a height, and where its edges come up through it.
fn touching(mesh: &TriangleMesh, floor: i32) -> Vec<Point> {
    let below =
        mesh.vertices.iter().filter(|vertex| vertex.z <= floor).map(|vertex| Point::new(vertex.x, vertex.y));
    let through = mesh.edges.iter().filter_map(|edge| {
        let [a, b] = edge.vertices.map(|vertex| mesh.vertices[vertex as usize]);
        let (low, high) = if a.z <= b.z { (a, b) } else { (b, a) };
        (low.z <= floor && high.z > floor).then(|| {
            let share = f64::from(floor - low.z) / (f64::from(high.z) - f64::from(low.z));
            let at = |low: i32, high: i32| {
                (f64::from(low) + (f64::from(high) - f64::from(low)) * share).round() as i32
            };
            Point::new(at(low.x, high.x), at(low.y, high.y))
        })
    });
    below.chain(through).collect()
}

/// The convex hull, counter-clockwise (Andrew 1979).
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_unstable();
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0 {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.append(&mut half(&mut points.iter().rev().copied()));
    hull
}

fn turn(a: Point, b: Point, c: Point) -> i128 {
    let ((x, y), (u, v)) = (a.delta(b), a.delta(c));
    i128::from(x) * i128::from(v) - i128::from(y) * i128::from(u)
}

/// The centre of mass of what the surface encloses; `None` for nothing.
fn centre_of_mass(mesh: &TriangleMesh) -> Option<[f64; 3]> {
    let bounds = mesh.bounds();
    // About the middle of the part, so that the products keep their digits.
    let origin = [(bounds.min.x, bounds.max.x), (bounds.min.y, bounds.max.y), (bounds.min.z, bounds.max.z)]
        .map(|(low, high)| (f64::from(low) + f64::from(high)) / 2.0);
    let (mut volume, mut moment) = (0.0, [0.0; 3]);
    for face in &mesh.faces {
        let [a, b, c] = mesh.corners(face).map(|corner: Point3| {
            let corner = array(corner);
            [0, 1, 2].map(|axis| f64::from(corner[axis]) - origin[axis])
        });
        let part = a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        volume += part;
        for axis in 0..3 {
            // A quarter of the corners' sum: the fourth corner is the origin.
            moment[axis] += part * (a[axis] + b[axis] + c[axis]) / 4.0;
        }
    }
    // Six cubic microns are nothing: the sums of an open sheet do not cancel to the last digit.
    (volume.abs() > 6.0).then(|| [0, 1, 2].map(|axis| origin[axis] + moment[axis] / volume))
}

/// How far inside a convex outline a point lies; `None` when the outline is only a line.
fn margin(outline: &[Point], x: f64, y: f64) -> Option<f64> {
    if outline.len() < 3 {
        // On a tip or an edge nothing stands.
        let far = outline.iter().map(|point| (f64::from(point.x) - x).hypot(f64::from(point.y) - y));
        return far.min_by(f64::total_cmp).map(|far| -far);
    }
    let sides = outline.iter().zip(outline.iter().cycle().skip(1));
    sides
        .map(|(from, to)| {
            let (u, v) = (f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y));
            (u * (y - f64::from(from.y)) - v * (x - f64::from(from.x))) / (u * u + v * v).sqrt()
        })
        .min_by(f64::total_cmp)
}

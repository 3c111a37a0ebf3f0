//! The region that a line of some width covers, with blunt ends and mitred corners, as SVG has them by default.

use shape::{Point, Ring};

/// The pieces that together cover the line, each counter-clockwise: one for every side and every corner. They share
/// their corners to the micron, so that nothing is left open between them.
pub(super) fn pieces(points: &[Point], closed: bool, half: f64) -> Vec<Ring> {
    let closing = points.last().zip(points.first()).filter(|_| closed).map(|(last, first)| (*last, *first));
    let pairs = points.windows(2).map(|pair| (pair[0], pair[1]));
    let sides: Vec<Side> = pairs.chain(closing).filter_map(|(from, to)| Side::new(from, to, half)).collect();
    let after_last = sides.last().zip(sides.first()).filter(|_| closed && sides.len() > 1);
    let corners = sides.windows(2).map(|pair| (&pair[0], &pair[1])).chain(after_last);
    let corners: Vec<Ring> = corners.filter_map(|(before, after)| corner(before, after, half)).collect();
    sides.iter().map(Side::band).chain(corners).collect()
}

/// A side of the line.
struct Side {
    from: Point,
    to: Point,
    /// Its direction, of length one.
    along: (f64, f64),
    /// To its edge on the left, in whole microns.
    left: (i32, i32),
}

impl Side {
    fn new(from: Point, to: Point, half: f64) -> Option<Self> {
        let length = from.distance(to);
        let (x, y) = from.delta(to);
        let along = (x as f64 / length, y as f64 / length);
        let left = ((-along.1 * half).round() as i32, (along.0 * half).round() as i32);
        (length > 0.0).then_some(Self { from, to, along, left })
    }

    fn band(&self) -> Ring {
        let (x, y) = self.left;
        let beside = |point: Point, x: i32, y: i32| moved(point, x, y);
        Ring(vec![
            self.from,
            beside(self.from, -x, -y),
            beside(self.to, -x, -y),
            self.to,
            beside(self.to, x, y),
            beside(self.from, x, y),
        ])
    }
}

/// The wedge between the ends of two sides. One whose tip is farther than four times half the width is cut off (SVG
/// 1.1, 11.4).
fn corner(before: &Side, after: &Side, half: f64) -> Option<Ring> {
    let ((x, y), (u, v)) = (before.along, after.along);
    let (turn, straight) = (x * v - y * u, x * u + y * v);
    let at = after.from;
    // The wedge is on the outer side of the turn.
    let sense: i32 = if turn > 0.0 { -1 } else { 1 };
    let beside = |side: &Side| moved(at, sense * side.left.0, sense * side.left.1);
    let (start, end) = if turn > 0.0 { (before, after) } else { (after, before) };
    let mut wedge = vec![at, beside(start)];
    if 1.0 + straight >= 0.125 {
        let reach = f64::from(sense) * half / (1.0 + straight);
        let tip = ((-y - v) * reach, (x + u) * reach);
        wedge.push(moved(at, tip.0.round() as i32, tip.1.round() as i32));
    }
    wedge.push(beside(end));
    (turn != 0.0).then_some(Ring(wedge))
}

fn moved(point: Point, x: i32, y: i32) -> Point {
    Point::new(point.x.saturating_add(x), point.y.saturating_add(y))
}

//! Beads in gaps narrower than a bead, and infill too short to be laid, are taken up by the walls beside them.
//!
//! A thread that reaches such a bead would have to come back from its end, in two lanes too thin for any nozzle. The walls
//! on both sides are there anyway: each becomes wider by half of what the gap holds, and its middle moves towards the gap by
//! half of that, so that its other flank stays where it is.

use crate::grid::{Grid, Side};
use crate::strand::Strand;
use crate::tree::REACH;
use skein::{Feature, Point};

/// A bead takes a third more than its nominal clay before it bulges.
const MOST: f64 = 0.34;
/// How far from where the gap's width says that it is a wall may be, in bead spacings.
const OFF: f64 = 0.3;
/// How much longer or shorter than the bead a stretch of the wall beside it may be.
const BENT: f64 = 2.0;

/// What a wall takes up on a stretch.
#[derive(Clone, Copy, Debug)]
struct Gain {
    /// Where on the wall it begins and ends, in microns; the end may lie beyond the wall's.
    from: f64,
    to: f64,
    /// Length times flow.
    clay: f64,
    /// 1 when the gap is on the left of the wall, -1 on its right, 0 when the wall stays where it is.
    side: f64,
}

/// A stretch of a thin bead.
struct Piece {
    from: Point,
    to: Point,
    flow: f64,
    /// What the walls take up of it, with their index; nothing when it has to be laid.
    gains: Vec<(usize, Gain)>,
}

impl Piece {
    fn clay(&self) -> f64 {
        self.from.distance(self.to) * self.flow
    }
}

/// Takes up what is thin; the spacing of the beads is in microns.
pub fn absorb(strands: Vec<Strand>, spacing: f64) -> Vec<Strand> {
    let is_wall =
        |strand: &Strand| strand.closed && matches!(strand.feature, Feature::Edge(_) | Feature::Loop(_));
    let is_stub = |strand: &Strand| strand.feature == Feature::Infill && strand.length() < spacing / 2.0;
    let is_thin = |strand: &Strand| !strand.closed && (strand.feature == Feature::Middle || is_stub(strand));
    if !strands.iter().any(is_thin) || !strands.iter().any(is_wall) {
        return strands;
    }
    let walls = strands.iter().enumerate().filter(|(_, strand)| is_wall(strand));
    let sides = walls.flat_map(|(owner, strand)| {
        strand.sides().map(move |(start, from, to)| Side { owner: owner as u32, start, from, to })
    });
    let grid = Grid::new(sides, REACH * spacing);
    let mut gains: Vec<Vec<Gain>> = vec![Vec::new(); strands.len()];
    let mut rests: Vec<Option<Vec<Strand>>> = vec![None; strands.len()];
    for (index, strand) in strands.iter().enumerate().filter(|(_, strand)| is_thin(strand)) {
        let pieces = if is_stub(strand) { Vec::new() } else { pieces(strand, &strands, &grid, spacing) };
        let taken: f64 = pieces.iter().filter(|piece| !piece.gains.is_empty()).map(Piece::clay).sum();
        let (mut left, mut crumbs) = rest(strand, &pieces, spacing);
        if taken == 0.0 {
            if let (true, Some((wall, gain))) = (left.is_empty(), crumb(strand, &grid, spacing)) {
                gains[wall].push(gain);
                rests[index] = Some(left);
            }
            continue;
        }
        if crumbs > taken / 4.0 {
            (left, crumbs) = rest(strand, &pieces, 0.0);
        }
        // What is too short to be laid goes where the rest of the bead went.
        let factor = 1.0 + crumbs / taken;
        for (wall, gain) in pieces.into_iter().flat_map(|piece| piece.gains) {
            gains[wall].push(Gain { clay: gain.clay * factor, ..gain });
        }
        rests[index] = Some(left);
    }
    let mut laid = Vec::with_capacity(strands.len());
    for ((strand, gains), rest) in strands.into_iter().zip(gains).zip(rests) {
        match rest {
            Some(rest) => laid.extend(rest),
            None if gains.is_empty() => laid.push(strand),
            None => laid.push(widened(&strand, &gains, spacing)),
        }
    }
    laid
}

/// A thin bead cut into pieces of half a bead at most, with what the walls take up of each.
fn pieces(strand: &Strand, strands: &[Strand], grid: &Grid, spacing: f64) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for ((start, from, to), flow) in strand.sides().zip(strand.flows()) {
        let length = from.distance(to);
        let count = (length / (spacing / 2.0)).ceil().max(1.0);
        let normal = {
            let (x, y) = from.delta(to);
            if length > 0.0 { (-(y as f64) / length, x as f64 / length) } else { (0.0, 0.0) }
        };
        let place = |index: f64| {
            if index == count { to } else { strand.at(start + length * index / count) }
        };
        for index in 0..count as usize {
            let (from, to) = (place(index as f64), place(index as f64 + 1.0));
            let mut piece = Piece { from, to, flow, gains: Vec::new() };
            let beside = [1.0, -1.0].map(|side| beside(&piece, normal, side, strands, grid, spacing));
            if let [Some(left), Some(right)] = beside {
                piece.gains = vec![left, right];
            }
            pieces.push(piece);
        }
    }
    pieces
}

/// The wall on one side of a piece and the half of the piece that it takes up.
fn beside(
    piece: &Piece,
    normal: (f64, f64),
    side: f64,
    strands: &[Strand],
    grid: &Grid,
    spacing: f64,
) -> Option<(usize, Gain)> {
    let length = piece.from.distance(piece.to);
    if length == 0.0 || piece.flow / 2.0 > MOST {
        return None;
    }
    let away = side * spacing / 2.0 * (1.0 + piece.flow);
    let beside = |point: Point| {
        let shift = |at: i32, by: f64| (f64::from(at) + by * away).round() as i32;
        Point::new(shift(point.x, normal.0), shift(point.y, normal.1))
    };
    let near = grid.nearest(beside(piece.from), |_| true).filter(|near| near.distance <= OFF * spacing)?;
    let far = grid
        .nearest(beside(piece.to), |owner| owner == near.owner)
        .filter(|far| far.distance <= OFF * spacing)?;
    let wall = &strands[near.owner as usize];
    let ahead = wall.wrapped(far.along - near.along);
    let forward = ahead <= wall.length() / 2.0;
    let (from, way) = if forward { (near.along, ahead) } else { (far.along, wall.length() - ahead) };
    if way > length * BENT || way < length / BENT {
        return None;
    }
    // Walked the same way, what lies on the left of the piece has the piece on its right.
    let side = if forward { -side } else { side };
    let clay = length * piece.flow / 2.0;
    (clay / way <= MOST).then_some((near.owner as usize, Gain { from, to: from + way, clay, side }))
}

/// A bead too short to be laid, taken up by the nearest wall on a bead's width.
fn crumb(strand: &Strand, grid: &Grid, spacing: f64) -> Option<(usize, Gain)> {
    let clay = strand.laid(0.0, strand.length());
    let near = grid.nearest(strand.at(strand.length() / 2.0), |_| true)?;
    let from = (near.along - spacing / 2.0).max(0.0);
    let gain = Gain { from, to: from + spacing, clay, side: 0.0 };
    (clay / spacing <= MOST).then_some((near.owner as usize, gain))
}

/// What is left to be laid: stretches of at least a length in microns. The clay of shorter ones is told beside.
fn rest(strand: &Strand, pieces: &[Piece], least: f64) -> (Vec<Strand>, f64) {
    let mut rest = Vec::new();
    let mut crumbs = 0.0;
    for run in pieces.chunk_by(|one, other| one.gains.is_empty() == other.gains.is_empty()) {
        let [first, ..] = run else { continue };
        if !first.gains.is_empty() {
            continue;
        }
        let length: f64 = run.iter().map(|piece| piece.from.distance(piece.to)).sum();
        let points = std::iter::once(first.from).chain(run.iter().map(|piece| piece.to)).collect();
        let flows = run.iter().map(|piece| piece.flow).collect();
        match Strand::measured(strand.feature, points, flows, false).filter(|_| length >= least) {
            Some(strand) => rest.push(strand),
            None => crumbs += run.iter().map(Piece::clay).sum::<f64>(),
        }
    }
    (rest, crumbs)
}

/// A place on a wall from where more or less clay flows.
struct Change {
    place: f64,
    flow: f64,
    shift: f64,
    corner: bool,
}

/// A stretch of a wall: where it begins, how much clay it gets, how far its middle moves to the left, and whether it begins
/// at a corner.
#[derive(Clone, Copy)]
struct Stretch {
    from: Point,
    length: f64,
    clay: f64,
    shift: f64,
    corner: bool,
}

impl Stretch {
    fn is_like(&self, other: &Self) -> bool {
        (self.clay / self.length - other.clay / other.length).abs() < 0.01
            && (self.shift - other.shift).abs() < 10.0
    }
}

/// A wall with what it takes up.
fn widened(wall: &Strand, gains: &[Gain], spacing: f64) -> Strand {
    let whole = wall.length();
    // Where the clay of a stretch begins and ends: the place, the flow, and how far the middle moves to the left.
    let mut changes: Vec<Change> = Vec::with_capacity(gains.len() * 3);
    for gain in gains {
        let flow = gain.clay / (gain.to - gain.from);
        let shift = gain.side * flow * spacing / 2.0;
        let mut change = |place, sign: f64| {
            changes.push(Change { place, flow: sign * flow, shift: sign * shift, corner: false });
        };
        change(gain.from, 1.0);
        if gain.to <= whole {
            change(gain.to, -1.0);
        } else {
            change(whole, -1.0);
            change(0.0, 1.0);
            change(gain.to - whole, -1.0);
        }
    }
    let corners = wall.sides().map(|(place, ..)| Change { place, flow: 0.0, shift: 0.0, corner: true });
    changes.extend(corners);
    changes.sort_by(|one, other| one.place.total_cmp(&other.place));
    let mut fine: Vec<Stretch> = Vec::with_capacity(changes.len());
    let (mut flow, mut shift, mut corner) = (0.0, 0.0, false);
    for (index, change) in changes.iter().enumerate() {
        flow += change.flow;
        shift += change.shift;
        corner |= change.corner;
        let next = changes.get(index + 1).map_or(whole, |next| next.place);
        // What begins at the same micron is one place.
        if next - change.place >= 1.0 {
            let length = next - change.place;
            let clay = wall.laid(change.place, next) + flow.max(0.0) * length;
            let from = wall.at(change.place);
            fine.push(Stretch { from, length, clay, shift, corner: std::mem::take(&mut corner) });
        }
    }
    // A place in the midst of what is alike is not needed; those beside a change say from where on the wall has moved.
    let needed = |index: usize| {
        let around =
            index.checked_sub(2).filter(|_| index + 1 < fine.len()).map(|from| &fine[from..index + 2]);
        fine[index].corner
            || !around.is_some_and(|around| around.windows(2).all(|two| two[0].is_like(&two[1])))
    };
    let mut stretches: Vec<Stretch> = Vec::with_capacity(fine.len());
    for (index, stretch) in fine.iter().enumerate() {
        match stretches.last_mut().filter(|_| !needed(index)) {
            Some(last) => {
                last.length += stretch.length;
                last.clay += stretch.clay;
            }
            None => stretches.push(*stretch),
        }
    }
    let count = stretches.len();
    let points: Vec<Point> = (0..count)
        .map(|index| {
            let (before, here, after) =
                (stretches[(index + count - 1) % count], stretches[index], stretches[(index + 1) % count]);
            let shift = f64::midpoint(before.shift, here.shift);
            if shift == 0.0 { here.from } else { moved(before.from, here.from, after.from, shift) }
        })
        .collect();
    // A stretch that has become longer or shorter holds the same clay.
    let flows = stretches.iter().enumerate().map(|(index, stretch)| {
        let length = points[index].distance(points[(index + 1) % count]);
        stretch.clay / length.clamp(stretch.length / 2.0, stretch.length * 2.0)
    });
    let flows = flows.collect();
    Strand::measured(wall.feature, points, flows, true).unwrap_or_else(|| wall.clone())
}

/// A corner moved to the left of the way through it.
fn moved(before: Point, here: Point, after: Point, shift: f64) -> Point {
    let unit = |from: Point, to: Point| {
        let (x, y) = from.delta(to);
        let length = from.distance(to).max(1.0);
        (x as f64 / length, y as f64 / length)
    };
    let (one, other) = (unit(before, here), unit(here, after));
    let scale = shift / (1.0 + one.0 * other.0 + one.1 * other.1).max(0.5);
    let along = |at: i32, by: f64| (f64::from(at) + by * scale).round() as i32;
    Point::new(along(here.x, -(one.1 + other.1)), along(here.y, one.0 + other.0))
}

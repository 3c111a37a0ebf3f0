//! A layer of the base: lines there and back, all round within the outermost ring.
//!
//! ```text
//! ╭───────────╮     The lowest line and the uppermost follow the border, whatever its form; those between are straight.
//! │ ╭───────╴ │     Where they turn they follow the border, too, so that there is nothing left open beside it.
//! │ ╰───────╮ │
//! │ ╭───────╯ │
//! │ ╰───────╴ │
//! ╰───────────╯
//! ```

use crate::track::{Spot, behind, between, distance, divided, spot, square};
use shape::plane::{offset, simplified};
use skein::Ring;

/// The lines of a base layer.
#[derive(Clone, Debug)]
pub struct Zigzag {
    /// The four ways through the same lines that begin at different corners.
    ways: [Vec<(Spot, f64)>; 4],
    /// How far apart the lines lie, in microns.
    pub pitch: f64,
}

impl Zigzag {
    /// The lines inside a ring of beads of a width, about so far apart; `None` when the region is too small or one line
    /// across it would fall apart.
    pub fn inside(outermost: &Ring, width: f64, wanted: f64) -> Option<Self> {
        let along = along(outermost, width)?;
        let border = inner(outermost, (width + wanted) / 2.0)?;
        let (low, high) = Border::new(&border, along).heights()?;
        let room = high - low + wanted;
        let count = (room / wanted).round();
        if count < 3.0 {
            return None;
        }
        let pitch = room / count;
        let border = inner(outermost, (width + pitch) / 2.0)?;
        let room = inner(outermost, width / 2.0)?.area() * 1e6;
        let way = |flip: [f64; 2]| {
            let border = Border { flip, ..Border::new(&border, along) };
            Some(filling(border.zigzag(count as usize, pitch)?, room))
        };
        Some(Self {
            ways: [way([1.0, 1.0])?, way([-1.0, 1.0])?, way([1.0, -1.0])?, way([-1.0, -1.0])?],
            pitch,
        })
    }

    /// The way that begins nearest to a place. Each corner has the width of the room for the bead that ends there.
    pub fn from(&self, place: Spot) -> &[(Spot, f64)] {
        let far = |way: &&Vec<(Spot, f64)>| way.first().map_or(f64::INFINITY, |start| square(start.0, place));
        self.ways.iter().min_by(|one, other| far(one).total_cmp(&far(other))).map_or(&[], Vec::as_slice)
    }
}

/// The direction of the longest straight side: lines along it end square.
fn along(ring: &Ring, width: f64) -> Option<Spot> {
    let coarse = simplified(ring, width / 4.0)?;
    let sides = coarse.segments().map(|(from, to)| (spot(from), spot(to)));
    let (from, to) = sides.max_by(|one, other| square(one.0, one.1).total_cmp(&square(other.0, other.1)))?;
    let length = distance(from, to);
    (length > 0.0).then(|| [(to[0] - from[0]) / length, (to[1] - from[1]) / length])
}

/// The one ring that lies so far inside another.
fn inner(outer: &Ring, distance: f64) -> Option<Ring> {
    <[Ring; 1]>::try_from(offset(std::slice::from_ref(outer), -distance)).ok().map(|[ring]| ring)
}

/// A ring in a frame in which the lines are level, turned over so that the way begins at its lower left.
#[derive(Clone, Debug)]
struct Border {
    corners: Vec<Spot>,
    along: Spot,
    flip: [f64; 2],
}

impl Border {
    fn new(ring: &Ring, along: Spot) -> Self {
        let corners = ring.0.iter().map(|corner| {
            let at = spot(*corner);
            [at[0] * along[0] + at[1] * along[1], at[1] * along[0] - at[0] * along[1]]
        });
        Self { corners: corners.collect(), along, flip: [1.0, 1.0] }
    }

    fn back(&self, at: Spot) -> Spot {
        let [x, y] = [at[0] * self.flip[0], at[1] * self.flip[1]];
        [x * self.along[0] - y * self.along[1], x * self.along[1] + y * self.along[0]]
    }

    fn heights(&self) -> Option<(f64, f64)> {
        let heights = || self.corners.iter().map(|corner| corner[1]);
        Some((heights().min_by(f64::total_cmp)?, heights().max_by(f64::total_cmp)?))
    }

    /// The way along all lines. `None` where the border goes down on its way up: there a line would fall apart.
    fn zigzag(&self, count: usize, pitch: f64) -> Option<Vec<Corner>> {
        let mut corners: Vec<Spot> =
            self.corners.iter().map(|at| [at[0] * self.flip[0], at[1] * self.flip[1]]).collect();
        if self.flip[0] * self.flip[1] < 0.0 {
            corners.reverse();
        }
        // Counter-clockwise from the lowest corner the right side goes up, then the left one down.
        let lowest =
            (0..corners.len()).min_by(|one, other| corners[*one][1].total_cmp(&corners[*other][1]))?;
        corners.rotate_left(lowest);
        let highest =
            (0..corners.len()).max_by(|one, other| corners[*one][1].total_cmp(&corners[*other][1]))?;
        let right = corners[..=highest].to_vec();
        let mut left = corners[highest..].to_vec();
        left.push(corners[0]);
        left.reverse();
        let rises = |side: &[Spot]| side.windows(2).all(|pair| pair[1][1] > pair[0][1] - ROUNDING);
        if !rises(&right) || !rises(&left) {
            return None;
        }
        let (low, step) = (right[0][1], (right.last()?[1] - right[0][1]) / (count - 1) as f64);
        let height = |line: usize| low + step * line as f64;
        let lines: Vec<f64> = (1..count - 1).map(height).collect();
        let (left, right) = (bands(&left, &lines), bands(&right, &lines));
        // The lowest line follows the border, from one pitch short of the next on the left.
        let mut lowest = behind(&reversed(left[0].clone()), pitch);
        lowest.extend(&right[0]);
        let mut way = beside(&lowest, height(1), pitch);
        let (mut here, mut there) = (&right, &left);
        for line in 1..count - 1 {
            (here, there) = (there, here);
            // To the end of this line on the other side, and along the border up to the next.
            let turn =
                if line + 2 < count { &here[line][..] } else { here[line].get(..1).unwrap_or_default() };
            let ends = |(index, at): (usize, &Spot)| Corner { at: *at, width: pitch, straight: index == 0 };
            way.extend(turn.iter().enumerate().map(ends));
        }
        // The uppermost follows the border over the top and ends one pitch short of the line below it.
        let mut uppermost = here[count - 2].clone();
        uppermost.extend(reversed(behind(&there[count - 2], pitch)));
        way.extend(beside(&uppermost, height(count - 2), pitch));
        way.dedup_by_key(|corner| corner.at);
        Some(way.into_iter().map(|corner| Corner { at: self.back(corner.at), ..corner }).collect())
    }
}

/// A corner of the way along the lines.
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: Spot,
    /// The width of the room for the bead that ends there.
    width: f64,
    /// Whether that bead is one of the straight lines, and not a turn or along the border.
    straight: bool,
}

/// The way with as much clay as fills a room: where a line turns at a slanting border it leaves a corner open beside it, so
/// the turns get what is missing.
fn filling(way: Vec<Corner>, room: f64) -> Vec<(Spot, f64)> {
    let clay = |straight: bool| -> f64 {
        let sides = way.windows(2).filter(|side| side[1].straight == straight);
        sides.map(|side| distance(side[0].at, side[1].at) * side[1].width).sum()
    };
    let share = ((room - clay(true)) / clay(false).max(1.0)).clamp(1.0 - MOST_MORE, 1.0 + MOST_MORE);
    let filled =
        |corner: &Corner| (corner.at, if corner.straight { corner.width } else { corner.width * share });
    way.iter().map(filled).collect()
}

/// Turns get this share more or less than they have room for at most: what is missing elsewhere does not flow to them.
const MOST_MORE: f64 = 0.25;

/// A way along the border with the room that it has beside a level line: less than a pitch where the two run together.
fn beside(way: &[Spot], line: f64, pitch: f64) -> Vec<Corner> {
    let fine = divided(way, pitch);
    let corner = |at: Spot, width: f64| Corner { at, width, straight: false };
    let mut beside: Vec<Corner> = fine.first().map(|at| corner(*at, pitch)).into_iter().collect();
    beside.extend(fine.windows(2).map(|side| {
        let (from, to) = (side[0], side[1]);
        let away = (f64::midpoint(from[1], to[1]) - line).abs();
        let level = (to[0] - from[0]).abs() / distance(from, to).max(1.0);
        let width = if away < pitch * level { (away / level).max(LEAST_ROOM * pitch) } else { pitch };
        corner(to, width)
    }));
    beside
}

/// A bead is never thinner than this share of its width: it would tear.
const LEAST_ROOM: f64 = 0.25;

/// Offsets are rounded to whole microns, so a level side may seem to go down by some.
const ROUNDING: f64 = 5.0;

fn reversed(mut way: Vec<Spot>) -> Vec<Spot> {
    way.reverse();
    way
}

/// A rising side cut at the heights of the lines: below the first, between each two, and above the last.
fn bands(side: &[Spot], lines: &[f64]) -> Vec<Vec<Spot>> {
    let mut bands: Vec<Vec<Spot>> = Vec::with_capacity(lines.len() + 1);
    let mut band: Vec<Spot> = side.first().copied().into_iter().collect();
    for pair in side.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        while let Some(line) = lines.get(bands.len()).filter(|line| to[1] >= **line) {
            let rise = (to[1] - from[1]).max(f64::MIN_POSITIVE);
            let cut = between(from, to, ((line - from[1]) / rise).clamp(0.0, 1.0));
            band.push(cut);
            bands.push(std::mem::replace(&mut band, vec![cut]));
        }
        band.push(to);
    }
    bands.push(band);
    // Every line crosses a side that rises from below the first to above the last.
    bands.resize_with(lines.len() + 1, Vec::new);
    bands
}

//! What beads cover of a section. Rows are laid over both, a fraction of a bead apart; on a row everything is exact: where
//! the section begins and ends, and where each bead does.

/// How many rows there are to the width of a bead.
const ROWS: f64 = 32.0;
/// How the rows lie: at an angle to the part, so that no straight wall runs along them.
const TURN: [f64; 2] = [0.955_336_489_125_606, 0.295_520_206_661_339_6];
/// What a file says of the width of a bead is believed up to so many times the usual: clay that is pushed out on the way of
/// a hundredth of a millimetre is a heap and no bead.
const WIDEST: f64 = 20.0;
/// What beside the outline counts as its walls, in bead widths.
const WALLS: f64 = 2.0;

/// A straight piece of a bead with round ends, in mm.
#[derive(Clone, Copy, Debug)]
pub struct Bead {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub width: f64,
}

/// A side of an outline, in mm.
pub type Side = [[f64; 2]; 2];

/// What lies where, in mm².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Areas {
    /// The section of the part.
    pub section: f64,
    /// What of it no bead covers.
    pub bare: f64,
    /// What of it is within two bead widths of the outline.
    pub walls: f64,
    /// What of that no bead covers.
    pub bare_walls: f64,
    /// What the beads cover.
    pub beads: f64,
    /// What of that is beside the section.
    pub spill: f64,
    /// How much less that is than the clay would cover if no bead lay over another.
    pub overlap: f64,
    /// What of the beads lies on a layer that is not the first, and how much of that has no bead below it.
    pub raised: f64,
    pub unsupported: f64,
}

impl Bead {
    /// The bead before it was moved.
    pub fn back(&self, by: [f64; 2]) -> Self {
        let back = |at: [f64; 2]| [at[0] - by[0], at[1] - by[1]];
        Self { from: back(self.from), to: back(self.to), width: self.width }
    }
}

impl Areas {
    /// Adds those of another layer.
    pub fn add(&mut self, other: &Self) {
        let Self { section, bare, walls, bare_walls, beads, spill, overlap, raised, unsupported } = self;
        *section += other.section;
        *bare += other.bare;
        *walls += other.walls;
        *bare_walls += other.bare_walls;
        *beads += other.beads;
        *spill += other.spill;
        *overlap += other.overlap;
        *raised += other.raised;
        *unsupported += other.unsupported;
    }
}

/// What counts at a place of a row.
#[derive(Clone, Copy)]
enum What {
    /// How often the outline winds around it.
    Section,
    /// Nearness to the outline.
    Wall,
    Bead,
    Below,
}

/// The rows of a layer, each with where something begins (+1) and ends (−1).
struct Rows {
    first: f64,
    step: f64,
    events: Vec<Vec<(f64, What, i32)>>,
}

/// The areas of a layer: the outline as sides with the clay on their left, the beads, and those of the layer below.
pub fn areas(outline: &[Side], beads: &[Bead], below: Option<&[Bead]>) -> Areas {
    let width = usual_width(beads);
    let bounded = |bead: &Bead| Bead { width: bead.width.clamp(0.0, WIDEST * width), ..*bead };
    let beads: Vec<Bead> = beads.iter().map(bounded).collect();
    let below: Option<Vec<Bead>> = below.map(|below| below.iter().map(bounded).collect());
    let mut rows = Rows::over(outline, &beads, width / ROWS);
    for side in outline {
        rows.side(*side);
        rows.capsule(What::Wall, &Bead { from: side[0], to: side[1], width: 2.0 * WALLS * width });
    }
    for bead in &beads {
        rows.capsule(What::Bead, bead);
    }
    for bead in below.iter().flatten() {
        rows.capsule(What::Below, bead);
    }
    let mut areas = rows.sum();
    let laid: f64 = beads.iter().map(|bead| bead.width * flat(bead.from, bead.to)).sum();
    areas.overlap = (laid - areas.beads).max(0.0);
    match below {
        Some(_) => areas.raised = areas.beads,
        None => areas.unsupported = 0.0,
    }
    areas
}

/// The width that half of the length has or exceeds.
fn usual_width(beads: &[Bead]) -> f64 {
    let mut widths: Vec<(f64, f64)> =
        beads.iter().map(|bead| (bead.width, flat(bead.from, bead.to))).collect();
    widths.sort_by(|one, other| one.0.total_cmp(&other.0));
    let half = widths.iter().map(|(_, length)| length).sum::<f64>() / 2.0;
    let mut so_far = 0.0;
    let middle = widths.iter().find(|(_, length)| {
        so_far += length;
        so_far >= half
    });
    middle.map_or(1.0, |(width, _)| width.max(0.01))
}

fn flat(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// As the rows lie.
fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    let [cos, sin] = TURN;
    [cos * x - sin * y, sin * x + cos * y]
}

impl Rows {
    /// Empty rows over all that is there.
    fn over(outline: &[Side], beads: &[Bead], step: f64) -> Self {
        let sides = outline.iter().flatten().map(|at| (turned(*at)[1], 0.0));
        let ends =
            beads.iter().flat_map(|bead| [bead.from, bead.to].map(|at| (turned(at)[1], bead.width / 2.0)));
        let (low, high) = sides
            .chain(ends)
            .fold((f64::MAX, f64::MIN), |(low, high), (y, room)| (low.min(y - room), high.max(y + room)));
        let count = ((high - low) / step).ceil().max(0.0) as usize;
        Self { first: low + step / 2.0, step, events: vec![Vec::new(); count] }
    }

    /// The rows from one height to another.
    fn between(&self, low: f64, high: f64) -> std::ops::Range<usize> {
        let row = |y: f64| (((y - self.first) / self.step).ceil().max(0.0) as usize).min(self.events.len());
        row(low)..row(high)
    }

    fn y(&self, row: usize) -> f64 {
        self.first + self.step * row as f64
    }

    /// A side of the outline.
    fn side(&mut self, [from, to]: Side) {
        let (from, to) = (turned(from), turned(to));
        let up = to[1] > from[1];
        let (low, high) = if up { (from, to) } else { (to, from) };
        for row in self.between(low[1], high[1]) {
            let at = crossing(low, high, self.y(row));
            self.events[row].push((at, What::Section, if up { -1 } else { 1 }));
        }
    }

    /// A bead with round ends: on a row one piece.
    fn capsule(&mut self, what: What, bead: &Bead) {
        let (from, to, half) = (turned(bead.from), turned(bead.to), bead.width / 2.0);
        let length = flat(from, to);
        let across = if length > 0.0 {
            [(from[1] - to[1]) / length * half, (to[0] - from[0]) / length * half]
        } else {
            [half, 0.0]
        };
        let corner = |at: [f64; 2], sign: f64| [at[0] + sign * across[0], at[1] + sign * across[1]];
        let corners = [corner(from, 1.0), corner(to, 1.0), corner(to, -1.0), corner(from, -1.0)];
        let (low, high) = (from[1].min(to[1]) - half, from[1].max(to[1]) + half);
        for row in self.between(low, high) {
            let y = self.y(row);
            let (mut left, mut right) = (f64::MAX, f64::MIN);
            let mut reach = |x: f64| (left, right) = (left.min(x), right.max(x));
            for end in [from, to] {
                let rest = half * half - (y - end[1]) * (y - end[1]);
                if rest > 0.0 {
                    reach(end[0] - rest.sqrt());
                    reach(end[0] + rest.sqrt());
                }
            }
            for (index, corner) in corners.iter().enumerate() {
                let next = corners[(index + 1) % 4];
                if (corner[1] > y) != (next[1] > y) {
                    reach(crossing(*corner, next, y));
                }
            }
            if left < right {
                self.events[row].extend([(left, what, 1), (right, what, -1)]);
            }
        }
    }

    /// Goes along every row and adds up what lies there.
    fn sum(self) -> Areas {
        let mut areas = Areas::default();
        for mut events in self.events {
            events.sort_by(|one, other| one.0.total_cmp(&other.0));
            let mut counts = [0; 4];
            let mut at = 0.0;
            for (x, what, by) in events {
                let area = (x - at) * self.step;
                let [section, wall, bead, below] = counts.map(|count| count != 0);
                let add = |sum: &mut f64, whether: bool| *sum += if whether { area } else { 0.0 };
                add(&mut areas.section, section);
                add(&mut areas.bare, section && !bead);
                add(&mut areas.walls, section && wall);
                add(&mut areas.bare_walls, section && wall && !bead);
                add(&mut areas.beads, bead);
                add(&mut areas.spill, bead && !section);
                add(&mut areas.unsupported, bead && !below);
                counts[what as usize] += by;
                at = x;
            }
        }
        areas
    }
}

/// Where a side crosses a row.
fn crossing(from: [f64; 2], to: [f64; 2], y: f64) -> f64 {
    from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1])
}

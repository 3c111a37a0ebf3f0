//! Sparse infill in cells: the lines of each pattern, as if the clay had no end.
//!
//! Every pattern lays `density` of the plane: a bead's spacing times the length of the lines in a cell is that share of
//! the cell's area. The cells of all layers stand on each other, so that walls stand on walls.

use crate::{Fill, Pattern};
use shape::plane::clip::Line;
use skein::{Angle, Ring};

/// A pattern, measured out for one density.
pub enum Cells {
    /// Zigzags that meet their neighbours.
    Waves(Wave),
    /// Circles that touch each other.
    Circles {
        /// From the middle of a circle to the middle of its bead.
        radius: f64,
        /// From the middle of a circle to that of the next.
        step: f64,
    },
}

/// With more clay than this the cells are no wider than a bead.
const DENSEST: f64 = 0.8;

/// Lines that lead up and down by turns; where one is up and the next one is down they run side by side for a while.
pub struct Wave {
    /// From the middle of a line to the middle of the next.
    rise: f64,
    /// From one meeting with the same neighbour to the next.
    period: f64,
    /// How long two lines run side by side.
    flat: f64,
    /// How far apart they are there.
    gap: f64,
}

/// How far the meetings of the rectangular pattern are opened, as shares of the room between two lines.
#[derive(Clone, Copy)]
struct Accordion {
    /// On this layer.
    here: f64,
    /// On all layers of a band together.
    mean: f64,
}

impl Accordion {
    fn new(fill: &Fill, layer: usize) -> Self {
        let (end, middle) = (fill.junction_separation_at_end.f64(), fill.junction_separation_at_middle.f64());
        let band = fill.junction_band as usize;
        let at = |place: usize| {
            let way = 2.0 * place as f64 / band as f64;
            end + (middle - end) * way.min(2.0 - way)
        };
        // Of an odd number of layers none is in the middle.
        let odd = if band.is_multiple_of(2) { 0.0 } else { 1.0 / (band as f64 * band as f64) };
        Self { here: at(layer % band), mean: end + (middle - end) * (1.0 - odd) / 2.0 }
    }
}

impl Cells {
    /// Measures out a pattern; `None` for patterns of no cells, and where the clay is too dense to leave room for any.
    ///
    /// `step` is the room that a bead takes beside its neighbours.
    pub fn new(fill: &Fill, layer: usize, step: f64) -> Option<Self> {
        let density = fill.density.f64();
        if density > DENSEST {
            return None;
        }
        let gap = (1.0 - fill.grid_overlap.f64()) * step;
        match fill.pattern {
            Pattern::Line | Pattern::Concentric => None,
            Pattern::Rectangular => {
                Wave::square(density, step, gap, Accordion::new(fill, layer)).map(Self::Waves)
            }
            Pattern::Hexagonal => Wave::honeycomb(density, step, gap).map(Self::Waves),
            Pattern::Circular => circles(density, step, (1.0 + fill.circle_gap.f64()) * step),
        }
    }

    /// The lines across the box around an island, in the frame turned by the direction's cosine and sine.
    pub fn lines(&self, island: &[Ring], direction: (f64, f64), step: f64) -> Vec<Line> {
        let (cosine, sine) = direction;
        let Some(bounds) = Bounds::of(island, direction) else { return Vec::new() };
        let mut lines = match self {
            Self::Waves(wave) => wave.lines(&bounds),
            Self::Circles { radius, step: apart } => circle_lines(*radius, *apart, step, &bounds),
        };
        for (x, y) in lines.iter_mut().flat_map(|line| &mut line.points) {
            (*x, *y) = (*x * cosine - *y * sine, *x * sine + *y * cosine);
        }
        lines
    }
}

impl Pattern {
    /// How far the pattern is turned on each layer against the one below: by as much as it falls upon itself again. The
    /// lines that run twice side by side then lie in all directions by turns.
    pub fn turn(self, layer: usize) -> Angle {
        let (degrees, turns) = match self {
            Self::Rectangular => (90, 2),
            Self::Hexagonal => (60, 3),
            Self::Line | Self::Circular | Self::Concentric => (0, 1),
        };
        Angle(degrees * 1000 * (layer % turns) as i32)
    }
}

impl Wave {
    /// Squares on their corners: lines at 45° whose meetings are a square lattice.
    ///
    /// In a cell of period 2R and rise R a line is 2√2 (R − gap) + 2 gap long, so density · R² = step · (√2 (R − gap) +
    /// gap). The gap is `gap` + s (R − step) where the accordion opens the meetings by s; the R of all layers is that of
    /// its mean, so that cells stand on cells and a band holds the clay that was asked for.
    fn square(density: f64, step: f64, gap: f64, accordion: Accordion) -> Option<Self> {
        let root = std::f64::consts::SQRT_2;
        let Accordion { here, mean } = accordion;
        let rise = larger_root(
            density,
            -step * (root - (root - 1.0) * mean),
            (root - 1.0) * step * (gap - mean * step),
        )?;
        let gap = gap + here * (rise - step);
        Self { rise, period: 2.0 * rise, flat: gap, gap }.sound()
    }

    /// Regular hexagons of side a: lines at 60° and level by turns.
    ///
    /// In a cell of period 3a and rise √3/2 a a line is 4a − 2/√3 gap long.
    fn honeycomb(density: f64, step: f64, gap: f64) -> Option<Self> {
        let root = 3f64.sqrt();
        let side = larger_root(1.5 * root * density, -4.0 * step, 2.0 / root * step * gap)?;
        Self { rise: root / 2.0 * side, period: 3.0 * side, flat: side + gap / root, gap }.sound()
    }

    /// A wave that still goes up and down.
    fn sound(self) -> Option<Self> {
        (self.rise > self.gap && self.flat < self.period / 2.0).then_some(self)
    }

    fn lines(&self, bounds: &Bounds) -> Vec<Line> {
        let half = self.period / 2.0;
        let (first, last) =
            ((bounds.low.0 / half).floor() as i64 - 1, (bounds.high.0 / half).ceil() as i64 + 1);
        let (lowest, highest) =
            ((bounds.low.1 / self.rise).floor() as i64 - 1, (bounds.high.1 / self.rise).ceil() as i64);
        (lowest..=highest)
            .map(|number| {
                let points = (first..=last).flat_map(|place| {
                    // Where one line is up, the next one is down.
                    let up = (place + number).rem_euclid(2) == 0;
                    let meeting = (number + i64::from(up)) as f64 * self.rise;
                    let height = meeting + if up { -self.gap } else { self.gap } / 2.0;
                    let middle = place as f64 * half;
                    [(middle - self.flat / 2.0, height), (middle + self.flat / 2.0, height)]
                });
                Line { points: points.collect(), closed: false }
            })
            .collect()
    }
}

/// Circles in the corners of equal triangles, with a bead's room between the middles of their beads where they are
/// nearest (`room`).
///
/// A circle is 2πr long and has √3/2 (2r + room)² for itself.
fn circles(density: f64, step: f64, room: f64) -> Option<Cells> {
    let root = 3f64.sqrt();
    let turn = std::f64::consts::TAU * step;
    let radius = larger_root(
        2.0 * root * density,
        2.0 * root * density * room - turn,
        root / 2.0 * density * room * room,
    )?;
    (radius >= step / 2.0).then_some(Cells::Circles { radius, step: 2.0 * radius + room })
}

fn circle_lines(radius: f64, apart: f64, step: f64, bounds: &Bounds) -> Vec<Line> {
    // No chord leaves the circle by more than a fortieth of a bead.
    let corners = (std::f64::consts::PI / (2.0 * step / 40.0 / radius).sqrt()).ceil().clamp(8.0, 360.0);
    let spokes: Vec<(f64, f64)> = (0..corners as usize)
        .map(|corner| {
            let angle = std::f64::consts::TAU * corner as f64 / corners;
            (radius * libm::cos(angle), radius * libm::sin(angle))
        })
        .collect();
    let rise = apart * 3f64.sqrt() / 2.0;
    let (lowest, highest) =
        (((bounds.low.1 - radius) / rise).floor() as i64, ((bounds.high.1 + radius) / rise).ceil() as i64);
    let mut lines = Vec::new();
    for row in lowest..=highest {
        let shift = if row.rem_euclid(2) == 0 { 0.0 } else { apart / 2.0 };
        let (first, last) = (
            ((bounds.low.0 - radius - shift) / apart).floor() as i64,
            ((bounds.high.0 + radius - shift) / apart).ceil() as i64,
        );
        for column in first..=last {
            let middle = (column as f64 * apart + shift, row as f64 * rise);
            let points = spokes.iter().map(|spoke| (middle.0 + spoke.0, middle.1 + spoke.1)).collect();
            lines.push(Line { points, closed: true });
        }
    }
    lines
}

/// The larger x with a x² + b x + c = 0.
fn larger_root(a: f64, b: f64, c: f64) -> Option<f64> {
    let square = b * b - 4.0 * a * c;
    (square >= 0.0).then(|| (square.sqrt() - b) / (2.0 * a))
}

/// A box in the turned frame.
struct Bounds {
    low: (f64, f64),
    high: (f64, f64),
}

impl Bounds {
    fn of(island: &[Ring], (cosine, sine): (f64, f64)) -> Option<Self> {
        let places = island.iter().flat_map(|ring| &ring.0).map(|point| {
            let (x, y) = (f64::from(point.x), f64::from(point.y));
            (x * cosine + y * sine, y * cosine - x * sine)
        });
        places.map(|place| Self { low: place, high: place }).reduce(|one, other| Self {
            low: (one.low.0.min(other.low.0), one.low.1.min(other.low.1)),
            high: (one.high.0.max(other.high.0), one.high.1.max(other.high.1)),
        })
    }
}

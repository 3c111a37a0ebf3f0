//! Where an island lies, and how near it is to another.

use skein::{Point, Ring};

/// The outlines of an island, with boxes around stretches of them.
#[derive(Debug, Default)]
pub struct Footprint {
    stretches: Vec<Stretch>,
    bounds: Option<Bounds>,
}

#[derive(Debug)]
struct Stretch {
    bounds: Bounds,
    sides: Vec<(Point, Point)>,
}

#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: Point,
    high: Point,
}

/// How many sides have a box in common.
const STRETCH: usize = 16;

impl Footprint {
    /// A footprint with these outlines.
    pub fn new(rings: Vec<Ring>) -> Self {
        let sides: Vec<(Point, Point)> = rings.iter().flat_map(Ring::segments).collect();
        let stretches: Vec<Stretch> = sides
            .chunks(STRETCH)
            .filter_map(|sides| Some(Stretch { bounds: Bounds::of(sides)?, sides: sides.to_vec() }))
            .collect();
        Self { bounds: Bounds::of(&sides), stretches }
    }

    /// Whether some of another island lies nearer than a distance in microns.
    pub fn is_within(&self, other: &Self, distance: f64) -> bool {
        let (Some(own), Some(others)) = (self.bounds, other.bounds) else { return false };
        if own.gap(&others) >= distance {
            return false;
        }
        let near = other.stretches.iter().filter(|stretch| stretch.bounds.gap(&own) < distance);
        let touches = near.flat_map(|stretch| {
            let own = self.stretches.iter().filter(|own| own.bounds.gap(&stretch.bounds) < distance);
            own.flat_map(|own| own.sides.iter())
                .flat_map(|one| stretch.sides.iter().map(move |two| (one, two)))
        });
        let first = |footprint: &Self| footprint.stretches.first().map(|stretch| stretch.sides[0].0);
        touches.into_iter().any(|(one, two)| gap(*one, *two) < distance)
            || first(other).is_some_and(|at| self.holds(at))
            || first(self).is_some_and(|at| other.holds(at))
    }

    /// Whether all of another island lies on this one or nearer to it than a distance in microns.
    pub fn carries(&self, other: &Self, distance: f64) -> bool {
        let near = |at: Point| {
            let box_of = Bounds { low: at, high: at };
            let mut stretches =
                self.stretches.iter().filter(|stretch| stretch.bounds.gap(&box_of) <= distance);
            stretches.any(|stretch| stretch.sides.iter().any(|side| away(at, *side) <= distance))
        };
        // Nearly all of what stands on an island is near its outline, and that is found sooner than what is inside.
        other.stretches.iter().flat_map(|stretch| &stretch.sides).all(|(at, _)| near(*at) || self.holds(*at))
    }

    /// Whether a straight way stays away from all outlines.
    pub fn is_clear(&self, from: Point, to: Point) -> bool {
        let Some(way) = Bounds::of(&[(from, to)]) else { return false };
        let mut near = self.stretches.iter().filter(|stretch| stretch.bounds.gap(&way) <= 0.0);
        self.holds(from) && !near.any(|stretch| stretch.sides.iter().any(|side| crosses(*side, (from, to))))
    }

    /// Whether a place lies inside, by the crossing rule.
    fn holds(&self, at: Point) -> bool {
        let beside = |bounds: &Bounds| bounds.low.y <= at.y && at.y <= bounds.high.y && bounds.low.x <= at.x;
        let near = self.stretches.iter().filter(|stretch| beside(&stretch.bounds));
        let crossed = |(a, b): &(Point, Point)| {
            (a.y > at.y) != (b.y > at.y) && (shape::plane::cross(*a, *b, at) < 0) == (b.y > a.y)
        };
        near.flat_map(|stretch| &stretch.sides).filter(|side| crossed(side)).count() % 2 == 1
    }
}

impl Bounds {
    fn of(sides: &[(Point, Point)]) -> Option<Self> {
        let points = || sides.iter().flat_map(|(from, to)| [from, to]);
        Some(Self {
            low: Point::new(points().map(|at| at.x).min()?, points().map(|at| at.y).min()?),
            high: Point::new(points().map(|at| at.x).max()?, points().map(|at| at.y).max()?),
        })
    }

    /// How far apart two boxes are, in microns.
    fn gap(&self, other: &Self) -> f64 {
        let axis = |low: i32, high: i32, other_low: i32, other_high: i32| {
            (i64::from(low) - i64::from(other_high)).max(i64::from(other_low) - i64::from(high)).max(0) as f64
        };
        let x = axis(self.low.x, self.high.x, other.low.x, other.high.x);
        let y = axis(self.low.y, self.high.y, other.low.y, other.high.y);
        (x * x + y * y).sqrt()
    }
}

/// How far a place is from a side, in microns.
fn away(at: Point, (from, to): (Point, Point)) -> f64 {
    let (x, y) = from.delta(to);
    let (px, py) = from.delta(at);
    let (x, y, px, py) = (x as f64, y as f64, px as f64, py as f64);
    let share = ((x * px + y * py) / (x * x + y * y).max(1.0)).clamp(0.0, 1.0);
    let (dx, dy) = (px - share * x, py - share * y);
    (dx * dx + dy * dy).sqrt()
}

/// How far apart two sides are, in microns.
fn gap(one: (Point, Point), other: (Point, Point)) -> f64 {
    if crosses(one, other) {
        return 0.0;
    }
    away(one.0, other).min(away(one.1, other)).min(away(other.0, one)).min(away(other.1, one))
}

fn crosses(one: (Point, Point), other: (Point, Point)) -> bool {
    let apart = |(from, to): (Point, Point), (a, b): (Point, Point)| {
        (shape::plane::cross(from, to, a) >= 0) != (shape::plane::cross(from, to, b) >= 0)
    };
    apart(one, other) && apart(other, one)
}

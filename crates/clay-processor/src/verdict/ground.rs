//! A map of how high clay stands, seen from above: what a nozzle can run into, and where there is nothing below it.

/// Cells of a tile along each side.
const TILE: usize = 64;
/// Tiles of the map along each side.
const TILES: usize = 32;
/// The least side of a cell, mm.
const FINEST: f64 = 2.0;
/// A move is looked at in so many places at most: one of up to a metre as closely as any.
const MOST_LOOKS: f64 = 1024.0;
/// Where no clay stands.
const BARE: Cell = Cell { top: f32::NEG_INFINITY, before: f32::NEG_INFINITY };

type Tile = [Cell; TILE * TILE];

/// What stands at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    /// Where the last layer was begun. What is laid there with it may be a little higher, as where a thread climbs to and
    /// fro; were it kept, many steps of less than a layer would never make one.
    top: f32,
    /// The top before the last layer was laid.
    before: f32,
}

/// Height over places, in cells as wide as a bead; grows in tiles as clay is laid. It lies around the first clay and
/// is 4 m wide, or wider with wide beads; what is laid beyond is not on it.
#[derive(Clone, Debug)]
pub(crate) struct Ground {
    cell: f64,
    /// The corner of the map; nothing before the first clay.
    corner: Option<(f64, f64)>,
    tiles: Vec<Option<Box<Tile>>>,
}

impl Ground {
    /// Bare ground, for beads of this width.
    pub(crate) fn new(bead_width: Option<f64>) -> Self {
        let cell = bead_width.unwrap_or(FINEST).max(FINEST);
        Self { cell, corner: None, tiles: Vec::new() }
    }

    /// Places along a straight way, half a cell apart, without its start; each with its share of the way.
    pub(crate) fn along(
        &self,
        from: (f64, f64),
        to: (f64, f64),
    ) -> impl Iterator<Item = ((f64, f64), f64)> + use<> {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let squared = x * x + y * y;
        let half = self.cell / 2.0;
        // Most moves are short; a root is slow.
        let looks = if squared <= half * half { 1.0 } else { (squared.sqrt() / half).ceil().min(MOST_LOOKS) };
        (1..=looks as u32).map(move |look| {
            let share = f64::from(look) / looks;
            ((from.0 + x * share, from.1 + y * share), share)
        })
    }

    /// The side of a cell, mm.
    pub(crate) fn cell(&self) -> f64 {
        self.cell
    }

    /// How high clay stands at a place.
    #[inline]
    pub(crate) fn top(&self, place: (f64, f64)) -> Option<f64> {
        let (column, row) = self.cell_of(place)?;
        height(self.at(column, row)?.top)
    }

    /// How high clay stands at a place or beside it.
    pub(crate) fn top_near(&self, place: (f64, f64)) -> Option<f64> {
        self.highest_near(place, |cell| cell.top)
    }

    /// How high clay stands below a layer at `altitude`; what differs by less than `same` is of one layer.
    #[inline]
    pub(crate) fn below(&self, place: (f64, f64), altitude: f64, same: f64) -> Option<f64> {
        let (column, row) = self.cell_of(place)?;
        height(self.at(column, row)?.below(altitude - same))
    }

    /// As [`below`](Self::below), at a place or beside it.
    pub(crate) fn below_near(&self, place: (f64, f64), altitude: f64, same: f64) -> Option<f64> {
        self.highest_near(place, |cell| cell.below(altitude - same))
    }

    fn highest_near(&self, place: (f64, f64), of: impl Fn(&Cell) -> f32) -> Option<f64> {
        let (column, row) = self.cell_of(place)?;
        let beside = |at: usize| at.saturating_sub(1)..=(at + 1).min(TILE * TILES - 1);
        let cells = beside(row).flat_map(|row| beside(column).map(move |column| (column, row)));
        cells.filter_map(|(column, row)| height(of(self.at(column, row)?))).reduce(f64::max)
    }

    /// Clay is laid at a place, up to this height; what differs by less than `same` is of one layer.
    #[inline]
    pub(crate) fn lay(&mut self, place: (f64, f64), top: f64, same: f64) {
        if self.corner.is_none() {
            let half = self.cell * (TILE * TILES / 2) as f64;
            self.corner = Some((place.0 - half, place.1 - half));
            self.tiles.resize(TILES * TILES, None);
        }
        let Some((column, row)) = self.cell_of(place) else { return };
        let Some(tile) = self.tiles.get_mut(row / TILE * TILES + column / TILE) else { return };
        let tile = tile.get_or_insert_with(|| Box::new([BARE; TILE * TILE]));
        let Some(cell) = tile.get_mut(row % TILE * TILE + column % TILE) else { return };
        let top = top as f32;
        if top > cell.top + same as f32 {
            *cell = Cell { top, before: cell.top };
        }
    }

    /// Whether a move is so short that it is looked at in one place.
    #[inline]
    pub(crate) fn is_short(&self, from: (f64, f64), to: (f64, f64)) -> bool {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        x * x + y * y <= self.cell * self.cell / 4.0
    }

    /// The cell of a place, if it is on the map.
    #[inline]
    pub(crate) fn cell_of(&self, place: (f64, f64)) -> Option<(usize, usize)> {
        let corner = self.corner?;
        let (column, row) = ((place.0 - corner.0) / self.cell, (place.1 - corner.1) / self.cell);
        let side = (TILE * TILES) as f64;
        let is_on = column >= 0.0 && column < side && row >= 0.0 && row < side;
        is_on.then_some((column as usize, row as usize))
    }

    #[inline]
    fn at(&self, column: usize, row: usize) -> Option<&Cell> {
        let tile = self.tiles.get(row / TILE * TILES + column / TILE)?.as_deref()?;
        tile.get(row % TILE * TILE + column % TILE)
    }
}

impl Cell {
    #[inline]
    fn below(&self, limit: f64) -> f32 {
        if f64::from(self.top) < limit { self.top } else { self.before }
    }
}

/// A height, if anything stands there.
#[inline]
fn height(top: f32) -> Option<f64> {
    top.is_finite().then_some(f64::from(top))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clay_is_found_where_it_was_laid() {
        let mut ground = Ground::new(Some(3.0));
        assert_eq!(ground.top((0.0, 0.0)), None);
        for (place, _) in ground.along((0.0, 0.0), (60.0, 0.0)) {
            ground.lay(place, 1.5, 0.5);
        }
        ground.lay((30.0, 0.0), 1.0, 0.5);
        assert!((2..60).all(|x| ground.top((f64::from(x), 0.0)) == Some(1.5)));
        assert_eq!(ground.top((30.0, 20.0)), None);
        assert_eq!(ground.top((30.0, -3.0)), None);
        assert_eq!(ground.top_near((30.0, -3.0)), Some(1.5));
        ground.lay((1e30, 0.0), 9.0, 0.5);
        ground.lay((f64::NAN, 0.0), 9.0, 0.5);
        assert_eq!(ground.top((1e30, 0.0)), None, "beyond the map");

        let middle = (30.0, 0.0);
        assert_eq!(ground.below(middle, 1.5, 0.5), None, "the bed");
        ground.lay(middle, 3.0, 0.5);
        ground.lay(middle, 3.25, 0.5);
        assert_eq!(ground.below(middle, 3.25, 0.5), Some(1.5), "not what is laid with it");
        assert_eq!(ground.below_near((33.0, 0.0), 4.75, 0.5), Some(3.0));
        ground.lay(middle, 3.6, 0.5);
        assert_eq!(ground.below(middle, 3.6, 0.5), Some(3.0), "steps of less than a layer add up");
    }

    #[test]
    fn a_long_way_has_an_end() {
        assert!(Ground::new(None).along((0.0, 0.0), (1e300, 1e300)).count() <= MOST_LOOKS as usize);
        assert_eq!(Ground::new(None).along((1.0, 1.0), (1.0, 1.0)).count(), 1);
    }
}

//! Open chains of a layer are joined where the mesh has a gap.

use shape::solid::Chain;
use shape::{Point, Ring};
use skein::Notes;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// What became of open chains.
#[derive(Default)]
pub struct Joined {
    /// The rings that they form.
    pub rings: Vec<Ring>,
    /// The length in microns of those that form none.
    pub lost: f64,
}

/// Joins open chains end to start, the narrowest gap first, and closes each with a straight line.
///
/// A chain that would have to be closed across more than `limit` microns and more than a third of its own length is
/// no outline of a solid; it is reported and left out. Where there are more than [`MANY`] chains nobody can know what
/// was meant, and only `limit` counts.
pub fn joined(mut chains: Vec<Chain>, limit: f64, layer: usize, notes: &mut Notes) -> Joined {
    chains.retain(|chain| chain.points.len() > 1);
    chains.sort_by(|one, other| one.points.cmp(&other.points));
    let mut done = Joined::default();
    let mut threads = Threads::new(&chains, limit);
    let mut starts = Starts::new(&chains);
    let mut spots = Spots { layer, notes, said: [0; 2] };
    let mut waiting: BinaryHeap<Reverse<Gap>> = BinaryHeap::with_capacity(chains.len());
    let mut ask: Vec<usize> = (0..chains.len()).rev().collect();
    loop {
        // Ends that have lost their start look for another.
        while let Some(end) = ask.pop() {
            let Some(head) = threads.head_of[end] else { continue };
            waiting.extend(threads.gap(end, head, &chains, &mut starts).map(Reverse));
        }
        let Some(Reverse(gap)) = waiting.pop() else { break };
        let Some(head) = threads.head_of[gap.end] else { continue };
        let reach = threads.reach(head).min(threads.reach(gap.start));
        if starts.gone[gap.start] {
            ask.push(gap.end);
        } else if gap.width > reach {
            // Too wide for one of them as it is; when others join they are asked again.
            continue;
        } else if head == gap.start {
            spots.say(&chains[gap.end], CLOSED);
            done.rings.push(threads.ring(head, &chains));
            threads.head_of[gap.end] = None;
            starts.remove(head);
        } else {
            ask.extend(threads.join(gap, head));
            starts.remove(gap.start);
        }
    }
    for (end, head) in threads.head_of.iter().enumerate() {
        if let Some(head) = head {
            spots.say(&chains[end], LEFT_OUT);
            done.lost += threads.length[*head];
        }
    }
    done
}

/// With more loose ends than this in a layer the surface is a soup.
const MANY: usize = 1000;

/// What is said of a gap.
const LEFT_OUT: (usize, &str) =
    (0, "the mesh is open and the gap too wide to close; that part of the outline is left out");
const CLOSED: (usize, &str) = (1, "the mesh is open; the gap in the outline is closed with a straight line");

/// Remarks on gaps; of one layer nobody reads more than a few.
struct Spots<'a> {
    layer: usize,
    notes: &'a mut Notes,
    said: [usize; 2],
}

impl Spots<'_> {
    const MOST: usize = 5;

    fn say(&mut self, chain: &Chain, (kind, text): (usize, &str)) {
        self.said[kind] += 1;
        if self.said[kind] <= Self::MOST {
            self.notes.spot(self.layer, chain.points.last().copied().unwrap_or_default(), text);
        }
    }
}

/// A gap between the end of a chain and the start of another or its own.
#[derive(Clone, Copy, PartialEq)]
struct Gap {
    width: f64,
    /// Closing one is worth as much as joining two, so of equal gaps those that close come first.
    joins: bool,
    end: usize,
    start: usize,
}

impl Eq for Gap {}

impl Ord for Gap {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |gap: &Self| (gap.joins, gap.end, gap.start);
        self.width.total_cmp(&other.width).then_with(|| key(self).cmp(&key(other)))
    }
}

impl PartialOrd for Gap {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Chains that are joined, each known by its first and by its last.
struct Threads {
    /// The first chain of the thread that ends with each chain; none when it ends with another or is done with.
    head_of: Vec<Option<usize>>,
    /// The last chain of the thread that starts with each chain.
    tail_of: Vec<usize>,
    /// The chain that follows each.
    next: Vec<Option<usize>>,
    /// The length of the thread that starts with each chain.
    length: Vec<f64>,
    /// The widest gap that is closed in any case, and whether longer threads reach farther.
    limit: f64,
    stretch: bool,
}

impl Threads {
    fn new(chains: &[Chain], limit: f64) -> Self {
        Self {
            head_of: (0..chains.len()).map(Some).collect(),
            tail_of: (0..chains.len()).collect(),
            next: vec![None; chains.len()],
            length: chains.iter().map(length_of).collect(),
            limit,
            stretch: chains.len() <= MANY,
        }
    }

    /// The widest gap that a thread can have.
    fn reach(&self, head: usize) -> f64 {
        if self.stretch { self.limit.max(self.length[head] / 3.0) } else { self.limit }
    }

    /// The narrowest gap from an end to a start that is left and near enough.
    fn gap(&self, end: usize, head: usize, chains: &[Chain], starts: &mut Starts) -> Option<Gap> {
        let from = *chains[end].points.last()?;
        let (width, start) = starts.nearest(from, head, self.reach(head))?;
        Some(Gap { width, joins: start != head, end, start })
    }

    /// Joins two threads; the end of the whole may reach farther now and is to be asked again.
    fn join(&mut self, gap: Gap, head: usize) -> Option<usize> {
        let tail = self.tail_of[gap.start];
        self.next[gap.end] = Some(gap.start);
        self.head_of[gap.end] = None;
        self.head_of[tail] = Some(head);
        self.tail_of[head] = tail;
        self.length[head] += self.length[gap.start];
        self.stretch.then_some(tail)
    }

    fn ring(&self, head: usize, chains: &[Chain]) -> Ring {
        let mut points = Vec::new();
        let mut chain = Some(head);
        while let Some(here) = chain {
            points.extend_from_slice(&chains[here].points);
            chain = self.next[here];
        }
        Ring(points)
    }
}

/// The starts of chains that nothing ends at yet, from left to right.
struct Starts {
    sorted: Vec<(Point, usize)>,
    /// Where each chain stands in `sorted`.
    place: Vec<usize>,
    /// Whether each chain's start is taken.
    gone: Vec<bool>,
    /// From each place in `sorted` a step nearer to the next on its right, or on its left, that is not gone.
    right: Vec<usize>,
    left: Vec<usize>,
}

impl Starts {
    fn new(chains: &[Chain]) -> Self {
        let start = |chain: &Chain| chain.points.first().copied().unwrap_or_default();
        let mut sorted: Vec<(Point, usize)> = chains.iter().map(start).zip(0..).collect();
        sorted.sort_unstable();
        let mut place = vec![0; sorted.len()];
        sorted.iter().enumerate().for_each(|(index, (_, chain))| place[*chain] = index);
        let count = sorted.len();
        // Place 0 of `left` and the last of `right` are beyond the ends; the places are one higher there.
        Self {
            sorted,
            place,
            gone: vec![false; count],
            right: (0..=count + 1).collect(),
            left: (0..=count + 1).collect(),
        }
    }

    fn remove(&mut self, chain: usize) {
        if !std::mem::replace(&mut self.gone[chain], true) {
            let place = self.place[chain] + 1;
            self.right[place] = place + 1;
            self.left[place] = place - 1;
        }
    }

    /// The start nearest to a point within reach, of equally near ones `wanted` and then the first.
    fn nearest(&mut self, from: Point, wanted: usize, reach: f64) -> Option<(f64, usize)> {
        let middle = self.sorted.partition_point(|(point, _)| *point < from) + 1;
        let mut best: Option<(f64, bool, usize)> = None;
        let (mut right, mut left) = (settle(&mut self.right, middle), settle(&mut self.left, middle - 1));
        loop {
            let aside = |place: usize| (f64::from(self.sorted[place - 1].0.x) - f64::from(from.x)).abs();
            let within = |place: &usize| aside(*place) <= best.map_or(reach, |(best, ..)| best);
            let ahead = Some(right).filter(|place| *place <= self.sorted.len()).filter(within);
            let behind = Some(left).filter(|place| *place > 0).filter(within);
            let place = match (ahead, behind) {
                (None, None) => break,
                (Some(place), None) | (None, Some(place)) => place,
                (Some(one), Some(other)) => {
                    if aside(one) <= aside(other) {
                        one
                    } else {
                        other
                    }
                }
            };
            let (point, chain) = self.sorted[place - 1];
            let found = (from.distance(point), chain != wanted, chain);
            if found.0 <= reach
                && best.is_none_or(|best| {
                    found.0.total_cmp(&best.0).then((found.1, found.2).cmp(&(best.1, best.2))).is_lt()
                })
            {
                best = Some(found);
            }
            if Some(place) == ahead {
                right = settle(&mut self.right, place + 1);
            } else {
                left = settle(&mut self.left, place - 1);
            }
        }
        best.map(|(width, _, chain)| (width, chain))
    }
}

/// Follows the steps from a place to their end, and shortens them.
fn settle(steps: &mut [usize], mut place: usize) -> usize {
    while steps[place] != place {
        let next = steps[steps[place]];
        steps[place] = next;
        place = next;
    }
    place
}

/// The length of a chain in microns.
fn length_of(chain: &Chain) -> f64 {
    chain.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(points: &[(i32, i32)]) -> Chain {
        Chain { points: points.iter().map(|(x, y)| Point::new(*x, *y)).collect(), closed: false }
    }

    #[test]
    fn four_sides_without_their_corners_become_a_square() {
        let sides = vec![
            chain(&[(1, 0), (99, 0)]),
            chain(&[(99, 100), (1, 100)]),
            chain(&[(100, 1), (100, 99)]),
            chain(&[(0, 99), (0, 1)]),
        ];
        let mut notes = Notes::default();
        let done = joined(sides, 10.0, 0, &mut notes);
        assert_eq!((done.rings.len(), done.lost), (1, 0.0));
        assert_eq!(done.rings[0].area2(), 2 * (100 * 100 - 2));
        assert_eq!(notes.iter().count(), 1);
    }

    #[test]
    fn what_is_too_far_apart_is_left_out_and_said() {
        let mut notes = Notes::default();
        let done = joined(vec![chain(&[(0, 0), (3000, 0)])], 10.0, 4, &mut notes);
        assert_eq!((done.rings.len(), done.lost), (0, 3000.0));
        assert!(notes.iter().all(|note| note.layer == Some(4)) && notes.iter().count() == 1);
    }

    /// Twenty thousand loose ends in one layer: a search of all for each would take minutes.
    #[test]
    fn many_ends_take_no_longer_than_they_must() {
        let scattered = |index: i32| {
            chain(&[(index * 7919 % 100_003, index * 104_729 % 99_991), (index * 31 % 100_003, index)])
        };
        let done = joined((0..20_000).map(scattered).collect(), 500.0, 0, &mut Notes::default());
        assert!(done.rings.len() + (done.lost > 0.0) as usize > 0);
    }
}

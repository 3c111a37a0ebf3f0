//! How strands are visited: what a thread does from its start to its end.

/// How a strand is visited.
#[derive(Debug)]
pub struct Visit {
    /// Which strand.
    pub strand: usize,
    /// Where on it the walk begins, in microns.
    pub entry: f64,
    /// Whether it is walked in its own direction.
    pub forward: bool,
    /// How far it is walked, in microns.
    pub length: f64,
    /// Whether it is walked back again.
    pub returns: bool,
    /// What is made of its flow.
    pub share: f64,
    /// The visits that begin on the walk, from its start to its end.
    pub children: Vec<Child>,
    /// Stretches of the walk that are laid in two halves, from the first to the last.
    pub halves: Vec<(f64, f64)>,
}

/// A visit that begins on another.
#[derive(Debug)]
pub struct Child {
    /// How far along the walk it begins.
    pub leave: f64,
    /// How far along the walk the thread comes back; nothing when it stays away. When that is before where it left, what
    /// lies between is one of the parent's halves.
    pub resume: Option<f64>,
    /// The flow on the way over.
    pub flow: f64,
    /// The visit.
    pub visit: usize,
}

/// How the strands of one connected part of an island are visited.
#[derive(Debug)]
pub struct Tree {
    /// The visits; the first is the root's.
    pub visits: Vec<Visit>,
    /// How far the root is walked on beyond its end, beside what it laid first.
    pub again: f64,
    /// How far apart beads lie, in microns.
    pub spacing: f64,
}

impl Visit {
    /// The place on the strand of a place along the walk, perhaps rounds away.
    pub fn on_strand(&self, along: f64) -> f64 {
        if self.forward { self.entry + along } else { self.entry - along }
    }

    /// The part of the strand that is walked between two places, from its lower end to its upper.
    pub fn range(&self, from: f64, to: f64) -> (f64, f64) {
        let (one, other) = (self.on_strand(from), self.on_strand(to));
        (one.min(other), one.max(other))
    }

    /// Whether nothing else begins or is left out on a part of the walk, and nothing of it is laid twice.
    pub fn is_free(&self, from: f64, to: f64) -> bool {
        let after = self.children.partition_point(|child| child.leave < to);
        let before = after.checked_sub(1).map(|index| &self.children[index]);
        let half = self.half_before(to);
        to <= self.length
            && before.is_none_or(|child| child.end() <= from)
            && half.is_none_or(|(_, end)| end <= from)
    }

    /// The last stretch laid in halves that begins before a place.
    pub fn half_before(&self, place: f64) -> Option<(f64, f64)> {
        let after = self.halves.partition_point(|(start, _)| *start < place);
        after.checked_sub(1).map(|index| self.halves[index])
    }

    /// The place nearest to a place along the walk where the walk really goes.
    pub fn free_near(&self, along: f64) -> f64 {
        let along = along.min(self.length);
        let after = self.children.partition_point(|child| child.leave < along);
        match after.checked_sub(1).map(|index| &self.children[index]) {
            Some(child) if child.end() > along => {
                if along - child.leave <= child.end() - along {
                    child.leave
                } else {
                    child.end()
                }
            }
            _ => along,
        }
    }

    /// Puts a child behind those that begin earlier.
    pub fn adopt(&mut self, child: Child) {
        if let Some(resume) = child.resume.filter(|resume| *resume < child.leave) {
            let place = self.halves.partition_point(|(start, _)| *start < resume);
            self.halves.insert(place, (resume, child.leave));
        }
        let place = self.children.partition_point(|other| other.leave <= child.leave);
        self.children.insert(place, child);
    }
}

impl Child {
    /// Where on the walk it is over.
    fn end(&self) -> f64 {
        self.resume.unwrap_or(self.leave).max(self.leave)
    }
}

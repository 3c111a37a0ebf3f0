#![doc = include_str!("../README.md")]

mod around;
mod hull;
mod lead;
mod path;
#[cfg(test)]
mod tests;

use around::{base, outers, outsides};
use lead::Lead;
use path::{Path, chains};
use shape::plane::offset;
use skein::{
    Bead, BedArea, Error, Facts, Feature, Feed, Layer, Line, Micron, Move, Notes, Nozzle, Point, Point3,
    Ratio, Ring, Settings, Skein, Stage, Tag,
};

/// Draws lines around the part until the clay flows evenly.
#[derive(Clone, Debug, Settings)]
pub struct Skirt {
    /// Whether the skirt is the convex outline of everything. Otherwise it follows the part into its bays.
    #[setting(default = true)]
    pub convex: bool,
    /// The free room between the part and the skirt.
    #[setting(default = 3.0, min = 0.0, max = 100.0, unit = "beads")]
    pub gap: Ratio,
    /// How many lines go around the part on the first layer. With 0 there is no skirt.
    #[setting(default = 1, min = 0, max = 1000)]
    pub loops: u32,
    /// The clay that has to run before the part begins; lines are added on the outside until it has. An extruder that was
    /// refilled gives air and soft clay first.
    #[setting(default = 5000, min = 0, max = 10000000, unit = "mm³")]
    pub minimum_volume: u32,
    /// How many layers have a skirt; those above the first have one line. A high one keeps draughts away.
    #[setting(default = 1, min = 0, max = 1000000)]
    pub layers: u32,
    /// How many lines of brim lie against the outside of the part. They hold it on the bed and have to be cut off.
    #[setting(default = 0, min = 0, max = 1000)]
    pub brim_lines: u32,
    /// How many layers have a brim.
    #[setting(default = 1, min = 0, max = 1000000)]
    pub brim_layers: u32,
    /// Whether clay keeps flowing from the last line into the part. There is no bump where the part begins, but a short
    /// bead to cut off.
    #[setting(default = true)]
    pub into_part: bool,
}

impl Stage for Skirt {
    const NAME: &'static str = "skirt";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let high = |layers: u32, lines: u32| if lines == 0 { 0 } else { layers as usize };
        let (skirted, brimmed) = (high(self.layers, self.loops), high(self.brim_layers, self.brim_lines));
        let count = skirted.max(brimmed).min(skein.layers.len());
        if count == 0 {
            return Ok(skein);
        }
        let nozzles = skein.nozzles();
        let sites = skein.layers[..count]
            .iter()
            .enumerate()
            .map(|(index, layer)| {
                Site::new(layer, nozzles[index], &facts).map_err(|error| error.in_layer(index))
            })
            .collect::<Result<Vec<Site>, Error>>()?;
        let brims: Vec<Vec<Vec<Ring>>> =
            sites.iter().take(brimmed).map(|site| self.brim(site, &facts)).collect();
        let levels = self.levels(&skein.layers[..skirted.min(count)], &sites, &brims, &facts, notes)?;
        if brimmed > 0 && brims.first().is_none_or(Vec::is_empty) {
            notes.say("the first layer has no outline that a brim could lie against");
        }
        for (index, site) in sites.iter().enumerate() {
            let skirt = if index < skirted { levels.get(..levels.len().min(1)) } else { None };
            let skirt = if index == 0 { &levels[..] } else { skirt.unwrap_or_default() };
            let brim = brims.get(index).map_or(&[][..], Vec::as_slice);
            let layer = &mut skein.layers[index];
            layer.lines = self.layer(index, layer, site, skirt, brim, notes);
        }
        if let Some(layer) = skein.layers.get_mut(count) {
            nozzles[count].restate(&mut layer.lines);
        }
        Ok(skein)
    }
}

/// How lines are laid on one layer.
struct Site {
    /// The nozzle as it comes.
    nozzle: Nozzle,
    /// The first bead of the layer.
    lead: Lead,
    /// The bead of a skirt here.
    bead: Bead,
    /// The share of the nominal section that flows.
    flow: Ratio,
    z: i32,
    travel: Feed,
    feed: Feed,
    outers: Vec<Ring>,
}

impl Site {
    fn new(layer: &Layer, nozzle: Nozzle, facts: &Facts) -> Result<Self, Error> {
        let lead = Lead::find(layer, nozzle);
        let nominal = facts.bead()?.of_height(layer.height(facts)?);
        // A skirt around a raft has beads like the raft.
        let flow = match lead.first {
            Some(first) if first.feature() == Feature::Raft => first.flow,
            _ => nozzle.flow,
        };
        let width = nominal.section.width(nominal.area() * flow.f64(), nominal.height.mm());
        let width = Micron::from_mm(width).filter(|width| width.0 > 0).unwrap_or(nominal.width);
        Ok(Self {
            nozzle,
            bead: Bead { width, ..nominal },
            flow,
            z: match lead.start {
                Some(start) => start.z,
                None => layer.nozzle_z(facts)?.0,
            },
            travel: facts.travel_feed()?,
            feed: match lead.feed {
                Some(feed) => feed,
                None => facts.operating_feed()?,
            },
            outers: outers(layer),
            lead,
        })
    }

    fn spacing(&self) -> f64 {
        self.bead.spacing().um().max(1.0)
    }

    /// Where the lines of this layer begin: near to where the part does.
    fn target(&self) -> Option<Point> {
        self.lead.start.or(self.nozzle.at).map(|at| Point::new(at.x, at.y))
    }
}

/// More lines than this prime nothing that the first thousand have not.
const MOST_LOOPS: u32 = 1000;

impl Skirt {
    /// The lines of the brim on a layer, from the part outwards.
    fn brim(&self, site: &Site, facts: &Facts) -> Vec<Vec<Ring>> {
        if site.outers.is_empty() {
            return Vec::new();
        }
        // A neighbour of the outermost wall, which lies half a bead inside the outline.
        let first = site.spacing() - site.bead.width.um() / 2.0;
        (0..self.brim_lines)
            .map(|line| outsides(offset(&site.outers, first + f64::from(line) * site.spacing())))
            .take_while(|rings| fits(rings, &site.bead, facts))
            .collect()
    }

    /// The lines of the skirt, from the part outwards: as many as are wanted, and more until enough clay has run.
    fn levels(
        &self,
        layers: &[Layer],
        sites: &[Site],
        brims: &[Vec<Vec<Ring>>],
        facts: &Facts,
        notes: &mut Notes,
    ) -> Result<Vec<Vec<Ring>>, Error> {
        if self.brim_lines > 0
            && brims.iter().any(|brim| !brim.is_empty() && brim.len() < self.brim_lines as usize)
        {
            notes.say("some lines of the brim would lie beside the bed and are left out");
        }
        let [site, ..] = sites else { return Ok(Vec::new()) };
        let reach = site.bead.width.um() / 2.0;
        let mut obstacles = around::obstacles(layers, facts)?;
        for ring in brims.iter().filter_map(|brim| brim.last()).flatten() {
            obstacles.extend(offset(std::slice::from_ref(ring), reach));
        }
        let base = base(obstacles, self.convex);
        if base.is_empty() || self.layers == 0 || self.loops == 0 {
            return Ok(Vec::new());
        }
        let section = site.bead.area();
        let (mut levels, mut volume, mut rings) = (Vec::new(), 0.0, base);
        for level in 0..MOST_LOOPS {
            if level >= self.loops && volume >= f64::from(self.minimum_volume) {
                return Ok(levels);
            }
            let first = self.gap.f64() * site.bead.width.um() + reach;
            rings = outsides(offset(&rings, if level == 0 { first } else { site.spacing() }));
            if !fits(&rings, &site.bead, facts) {
                break;
            }
            volume += rings.iter().map(Ring::length).sum::<f64>() / 1000.0 * section;
            levels.push(rings.clone());
        }
        notes.say(match levels.len() {
            0 => "there is no room for a skirt on the bed".to_owned(),
            room => format!("the bed has room for {room} lines of skirt, which hold {volume:.0} mm³ of clay"),
        });
        Ok(levels)
    }

    /// A layer with its skirt and its brim.
    fn layer(
        &self,
        index: usize,
        layer: &Layer,
        site: &Site,
        skirt: &[Vec<Ring>],
        brim: &[Vec<Ring>],
        notes: &mut Notes,
    ) -> Vec<Line> {
        let near = 1.5 * site.spacing();
        let mut paths = chains(skirt, site.target(), near);
        let brim = chains(brim, site.target(), near);
        let mut lines = layer.lines.clone();
        if paths.is_empty() && brim.is_empty() {
            site.nozzle.restate(&mut lines);
            return lines;
        }
        let joins = index == 0 && self.into_part;
        match (paths.last_mut(), brim.as_slice()) {
            // One brim is on the way from the skirt to the part.
            (Some(path), [only]) if joins => path.extend(only),
            _ => paths.extend(brim),
        }
        let end = paths.last().and_then(|path| path.0.last()).copied();
        let start = site.lead.start.filter(|_| joins);
        let longest = 2.0 * self.gap.f64() * site.bead.width.um() + 4.0 * site.spacing();
        let lead = match (start, end) {
            (Some(start), Some(end)) if end.distance(Point::new(start.x, start.y)) <= longest => Some(start),
            (Some(_), _) => {
                notes.layer(index, "the part begins too far from the skirt to be reached without a stop");
                None
            }
            _ => None,
        };
        let mut block = vec![Line::Open(Tag::Skirt)];
        site.lay(&paths, lead, &mut block);
        block.push(Line::Close(Tag::Skirt));
        match lead {
            Some(_) => site.lead.take_over(&mut lines),
            None => site.nozzle.restate(&mut lines),
        }
        lines.splice(site.lead.at..site.lead.at, block);
        lines
    }
}

impl Site {
    /// The lines of some paths; clay flows on from the last to a place where the part begins.
    fn lay(&self, paths: &[Path], on_to: Option<Point3>, lines: &mut Vec<Line>) {
        let step = |point: &Point, feed: Option<Feed>| {
            Line::Move(Move { feed, ..Move::to(Point3 { x: point.x, y: point.y, z: self.z }) })
        };
        if self.flow != self.nozzle.flow {
            lines.push(Line::Flow(self.flow));
        }
        for (index, path) in paths.iter().enumerate() {
            let [first, second, rest @ ..] = path.0.as_slice() else { continue };
            lines.extend([step(first, Some(self.travel)), Line::On, step(second, Some(self.feed))]);
            lines.extend(rest.iter().map(|point| step(point, None)));
            match on_to {
                Some(start) if index + 1 == paths.len() => lines.push(Line::Move(Move::to(start))),
                _ => lines.push(Line::Off),
            }
        }
        if self.flow != self.nozzle.flow {
            lines.push(Line::Flow(self.nozzle.flow));
        }
    }
}

/// Whether beads along rings lie on the bed; where the header does not know it, within what a document can hold.
fn fits(rings: &[Ring], bead: &Bead, facts: &Facts) -> bool {
    let half = bead.width.um() / 2.0;
    let far = Micron::LIMIT.unsigned_abs();
    let on_bed = |bed: &BedArea, point: Point| bed.holds(point, half);
    !rings.is_empty()
        && rings.iter().flat_map(|ring| &ring.0).all(|point| {
            point.x.unsigned_abs() < far
                && point.y.unsigned_abs() < far
                && facts.bed.as_ref().is_none_or(|bed| on_bed(bed, *point))
        })
}

//! A printed part: segments, layers, paths, and questions about place and time.

mod estimate;
mod layers;

pub use layers::Layer;

use crate::bead::Bead;
use crate::operation::AdditiveOperation;
use crate::process::{Action, Moment, ProcessData};
use crate::statistics::Bounds;
use layers::Partition;

/// What a segment is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SegmentKind {
    /// The nozzle moves and material comes out.
    Deposition,
    /// The nozzle moves without.
    Travel,
    /// The nozzle waits, or only the extruder moves.
    Pause,
}

impl SegmentKind {
    pub(crate) const fn of(action: Action) -> Option<Self> {
        match action {
            Action::Deposit => Some(Self::Deposition),
            Action::Travel => Some(Self::Travel),
            Action::Extrude | Action::Dwell | Action::Purge => Some(Self::Pause),
            Action::Nothing | Action::Home => None,
        }
    }

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Deposition => "deposition",
            Self::Travel => "travel",
            Self::Pause => "pause",
        }
    }
}

/// One continuous segment: a row of the summary table. It ends where the kind, the layer or the tool changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// What it is.
    pub kind: SegmentKind,
    /// The first entry of the process data that belongs to it.
    pub start: usize,
    /// The entry behind the last one. Commands that move nothing, such as remarks, do not end a segment.
    pub end: usize,
    /// The layer, counted from zero: its own, or, of what deposits nothing, that of the next deposition. Behind the
    /// last deposition it is the last layer.
    pub layer: usize,
    /// The toolhead.
    pub tool: u16,
    /// When it begins, s.
    pub start_time: f64,
    /// When it ends, s.
    pub end_time: f64,
    /// Its way, mm.
    pub length: f64,
    /// What it deposits by the machine's own count, mm³.
    pub volume: f64,
    /// Where it begins, mm.
    pub from: [f64; 3],
    /// Where it ends, mm.
    pub to: [f64; 3],
    /// The room it takes.
    pub bounds: Bounds,
}

impl Segment {
    /// How long it takes, s.
    pub fn duration(&self) -> f64 {
        self.end_time - self.start_time
    }
}

/// The points of a continuous deposition.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The segment, as a row of the summary.
    pub segment: usize,
    /// The layer.
    pub layer: usize,
    /// The points, from the place before the first deposit on, mm. Arcs are chords.
    pub points: Vec<[f64; 3]>,
}

/// How far the chords of an arc may lie beside it, mm.
pub const CHORD_TOLERANCE: f64 = 0.01;

/// A part, as the deposits of an operation make it. Built once in linear time; every question then looks only at what
/// it is about.
///
/// ```
/// use emulate::{AdditivePart, Bead, Machine, Commands, Shape};
///
/// let program = b"M82\nG1 Z2 F600\nG1 X100 E5 F3000\nG1 Y100 E10\nG1 Z4\nG1 X0 E15\nG1 Y0 E20\n";
/// let operation = Machine::default().process_additive(Commands::read(program).steps)?;
/// let bead = Bead { width: 6.0, height: 2.0, shape: Shape::Rectangle, density: 1.9 };
/// let part = AdditivePart::new(&operation, bead, [0.0, 0.0, 1.0])?;
///
/// for path in part.deposition_paths() {
///     println!("{:?}", path.points);
/// }
/// assert_eq!(part.n_layers(), 2);
/// assert_eq!(part.deposition_length(), 400.0);
/// assert_eq!(part.volume(), 4800.0);
/// assert!((part.mass() - 9.12).abs() < 1e-12);
/// # Ok::<(), emulate::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct AdditivePart<'o, 'a> {
    operation: &'o AdditiveOperation<'a>,
    bead: Bead,
    normal: [f64; 3],
    segments: Vec<Segment>,
    layers: Vec<Layer>,
    /// Rows of the summary, layer by layer.
    by_layer: Vec<usize>,
    step_layers: Vec<u32>,
    deposition_length: f64,
}

impl<'o, 'a> AdditivePart<'o, 'a> {
    /// The part that an operation makes, with a bead of one section, in layers across `layer_normal`.
    ///
    /// # Errors
    /// When the normal has no direction or the bead no size.
    pub fn new(
        operation: &'o AdditiveOperation<'a>,
        bead: Bead,
        layer_normal: [f64; 3],
    ) -> Result<Self, crate::Error> {
        let sizes = [bead.width, bead.height, bead.density];
        if sizes.iter().any(|&size| !(size > 0.0 && size.is_finite())) {
            return Err(crate::Error::new(format!(
                "width, height and density of a bead must be more than 0, not {} mm, {} mm and {} g/cm³",
                bead.width, bead.height, bead.density
            )));
        }
        let length = layer_normal.iter().map(|side| side * side).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return Err(crate::Error::new(format!("the layer normal {layer_normal:?} has no direction")));
        }
        let normal = layer_normal.map(|side| side / length);
        let process = operation.process_data();
        let partition = Partition::new(process, normal, bead.height);
        let segments = summary(operation, &partition);
        let layers = layers::layers(process, &segments, partition.count);
        let by_layer = layers::by_layer(&segments, partition.count);
        let deposition = segments.iter().filter(|segment| segment.kind == SegmentKind::Deposition);
        let deposition_length = deposition.map(|segment| segment.length).sum();
        let step_layers = partition.layers;
        Ok(Self { operation, bead, normal, segments, layers, by_layer, step_layers, deposition_length })
    }

    /// The operation that makes it.
    pub fn operation(&self) -> &'o AdditiveOperation<'a> {
        self.operation
    }

    /// The bead.
    pub fn bead(&self) -> Bead {
        self.bead
    }

    /// The direction across the layers.
    pub fn layer_normal(&self) -> [f64; 3] {
        self.normal
    }

    /// The summary table.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The layers, from the lowest on.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// How many layers there are.
    pub fn n_layers(&self) -> usize {
        self.layers.len()
    }

    /// The segments of a layer, in the order in which they are made; none if there is no such layer.
    pub fn layer(&self, index: usize) -> impl Iterator<Item = &Segment> {
        let start = self.by_layer.partition_point(|&row| self.segments[row].layer < index);
        let rows = self.by_layer.iter().skip(start).map(|&row| &self.segments[row]);
        rows.take_while(move |segment| segment.layer == index)
    }

    /// The layer of every entry of the process data.
    pub fn step_layers(&self) -> &[u32] {
        &self.step_layers
    }

    /// The way of all deposits, mm.
    pub fn deposition_length(&self) -> f64 {
        self.deposition_length
    }

    /// The volume of the bead along all deposits, mm³.
    pub fn volume(&self) -> f64 {
        self.deposition_length * self.bead.area()
    }

    /// The volume by the machine's own count of what it extrudes, mm³.
    pub fn extruded_volume(&self) -> f64 {
        self.operation.volume()
    }

    /// The mass of [`volume`](Self::volume), g.
    pub fn mass(&self) -> f64 {
        self.bead.mass(self.volume())
    }

    /// The continuous deposits as points, arcs within [`CHORD_TOLERANCE`].
    pub fn deposition_paths(&self) -> impl Iterator<Item = Path> {
        self.deposition_paths_within(CHORD_TOLERANCE)
    }

    /// The continuous deposits as points, arcs within a tolerance of one's own, mm.
    pub fn deposition_paths_within(&self, tolerance: f64) -> impl Iterator<Item = Path> {
        let deposits =
            self.segments.iter().enumerate().filter(|(_, segment)| segment.kind == SegmentKind::Deposition);
        deposits.map(move |(row, segment)| Path {
            segment: row,
            layer: segment.layer,
            points: self.points(segment, tolerance),
        })
    }

    fn points(&self, segment: &Segment, tolerance: f64) -> Vec<[f64; 3]> {
        let process = self.operation.process_data();
        let mut points = vec![segment.from];
        for index in segment.start..segment.end {
            if process.action[index].is_path() {
                points.extend(chords(process, index, tolerance));
            }
        }
        points
    }

    /// Place, speed and segment at a time, s.
    pub fn at_time(&self, time: f64) -> Option<(Moment, Option<&Segment>)> {
        let moment = self.operation.at_time(time)?;
        let row = self.segments.partition_point(|segment| segment.end <= moment.index);
        let segment = self.segments.get(row).filter(|segment| segment.start <= moment.index);
        Some((moment, segment))
    }

    /// The entries of the process data whose moves touch a box.
    pub fn in_box(&self, bounds: Bounds) -> impl Iterator<Item = usize> {
        let process = self.operation.process_data();
        let near = self
            .segments
            .iter()
            .filter(move |segment| segment.kind != SegmentKind::Pause && segment.bounds.touches(&bounds));
        let steps = near.flat_map(|segment| segment.start..segment.end);
        steps.filter(move |&index| {
            process.action[index].is_path() && Bounds::of_step(process, index).touches(&bounds)
        })
    }
}

/// The points of a move behind its first.
pub(crate) fn chords(process: &ProcessData, index: usize, tolerance: f64) -> impl Iterator<Item = [f64; 3]> {
    let arc = process.arc(index);
    let count = arc.map_or(1, |arc| arc.chords(tolerance));
    let end = process.end(index);
    (1..=count).map(move |step| match arc {
        Some(arc) if step < count => arc.point(step as f64 / count as f64),
        _ => end,
    })
}

/// The rows of the summary.
fn summary(operation: &AdditiveOperation<'_>, partition: &Partition) -> Vec<Segment> {
    let process = operation.process_data();
    let mut segments: Vec<Segment> = Vec::new();
    for index in 0..process.len() {
        let Some(kind) = SegmentKind::of(process.action[index]) else { continue };
        let (tool, layer) = (process.tool[index], partition.layer(index));
        let bounds = Bounds::of_step(process, index);
        let volume = operation.delta_volume()[index];
        let length = if process.action[index].is_path() { process.step_distance[index] } else { 0.0 };
        match segments.last_mut() {
            Some(last) if last.kind == kind && last.tool == tool && last.layer == layer => {
                last.end = index + 1;
                last.end_time = process.elapsed_time[index];
                last.length += length;
                last.volume += volume;
                last.to = process.end(index);
                last.bounds.merge(&bounds);
            }
            _ => segments.push(Segment {
                kind,
                start: index,
                end: index + 1,
                layer,
                tool,
                start_time: process.start_time(index),
                end_time: process.elapsed_time[index],
                length,
                volume,
                from: process.start(index),
                to: process.end(index),
                bounds,
            }),
        }
    }
    segments
}

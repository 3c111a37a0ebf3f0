//! The columns of an operation as a table: one row a command.

#[cfg(feature = "tables")]
mod arrow;
mod csv;

use crate::operation::{AdditiveOperation, Operation, SubtractiveOperation};
use crate::part::AdditivePart;
use std::borrow::Cow;

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Column<'a> {
    /// Numbers.
    F64(Cow<'a, [f64]>),
    /// Whole numbers.
    U32(Cow<'a, [u32]>),
    /// Words of a small set.
    Word(Vec<&'static str>),
}

impl Column<'_> {
    /// How many rows it has.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::U32(values) => values.len(),
            Self::Word(values) => values.len(),
        }
    }

    /// Whether it has no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of a row, if the column has numbers.
    pub fn number(&self, row: usize) -> Option<f64> {
        match self {
            Self::F64(values) => values.get(row).copied(),
            Self::U32(values) => values.get(row).copied().map(f64::from),
            Self::Word(_) => None,
        }
    }
}

/// Named columns of equal length. Most are borrowed from the operation.
///
/// | column | type | |
/// |---|---|---|
/// | `line` | whole | line of the file, counted from one |
/// | `command`, `action` | word | kind of command; what it made the machine do |
/// | `x`, `y`, `z` | mm | where the step ends |
/// | `feedrate` | mm/s | the speed that was asked for |
/// | `time` | s | when the step ends |
/// | `duration` | s | how long it takes |
/// | `distance`, `step_distance` | mm | way since the beginning; of the step |
/// | `speed_entry`, `speed_peak`, `speed_exit` | mm/s | speeds of the step |
/// | `tool` | whole | toolhead |
/// | `extrusion`, `delta_extrusion` | mm³ | what went through the nozzle since the beginning; in the step |
/// | `volume` | mm³ | what is deposited, without what was only drawn back |
/// | `bead_area` | mm² | section of the bead |
/// | `spindle_rpm`, `removed_volume` | 1/min, mm³ | of a mill |
/// | `layer` | whole | of a part |
///
/// ```
/// use emulate::{Machine, Commands, Table};
///
/// let program = Commands::read(b"G1 X10 E1 F600\nG1 X20\n");
/// let operation = Machine::default().process_additive(program.steps)?;
/// let table = Table::of_additive(&operation);
/// assert_eq!(table.column("time").and_then(|times| times.number(1)), Some(2.0));
/// let mut csv = Vec::new();
/// table.write_csv(&mut csv)?;
/// assert!(csv.starts_with(b"line,command,action,x,y,z,feedrate,time,"));
/// # Ok::<(), emulate::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table<'a> {
    columns: Vec<(&'static str, Column<'a>)>,
}

impl<'a> Table<'a> {
    /// The columns that every operation has.
    pub fn of(operation: &'a Operation<'_>) -> Self {
        let process = operation.process_data();
        let numbers = |values: &'a [f64]| Column::F64(Cow::Borrowed(values));
        let commands = operation.commands().iter().take(process.len());
        let columns = vec![
            ("line", Column::U32(Cow::Borrowed(process.line()))),
            ("command", Column::Word(commands.map(|step| step.command.kind().name()).collect())),
            ("action", Column::Word(process.action().iter().map(|action| action.name()).collect())),
            ("x", numbers(process.coordinate(0))),
            ("y", numbers(process.coordinate(1))),
            ("z", numbers(process.coordinate(2))),
            ("feedrate", numbers(process.feed_rate())),
            ("time", numbers(process.elapsed_time())),
            ("duration", owned((0..process.len()).map(|index| process.duration(index)))),
            ("distance", numbers(process.distance())),
            ("step_distance", numbers(process.step_distance())),
            ("speed_entry", numbers(process.speed_entry())),
            ("speed_peak", numbers(process.speed_peak())),
            ("speed_exit", numbers(process.speed_exit())),
            ("tool", Column::U32(process.tool().iter().map(|&tool| u32::from(tool)).collect())),
        ];
        Self { columns }
    }

    /// Those, and what is deposited.
    pub fn of_additive(operation: &'a AdditiveOperation<'_>) -> Self {
        let mut table = Self::of(operation);
        let mut sum = 0.0;
        let through = operation.delta_volume().iter().map(|volume| {
            sum += volume;
            sum
        });
        table.columns.extend([
            ("extrusion", owned(through)),
            ("delta_extrusion", Column::F64(Cow::Borrowed(operation.delta_volume()))),
            ("volume", Column::F64(Cow::Borrowed(operation.deposited_volume()))),
            ("bead_area", owned((0..table.len()).map(|index| operation.bead_area(index)))),
        ]);
        table
    }

    /// Those of an additive operation, and the layers.
    pub fn of_part(part: &AdditivePart<'a, '_>) -> Self {
        let mut table = Self::of_additive(part.operation());
        table.columns.push(("layer", Column::U32(Cow::Owned(part.step_layers().to_vec()))));
        table
    }

    /// The columns that every operation has, and what a mill does.
    pub fn of_subtractive(operation: &'a SubtractiveOperation<'_>) -> Self {
        let mut table = Self::of(operation);
        table.columns.push(("spindle_rpm", owned(operation.spindle_rpm())));
        if let Some(removed) = operation.removed_volume() {
            table.columns.push(("removed_volume", Column::F64(Cow::Borrowed(removed))));
        }
        table
    }

    /// The summary of a part: one row a continuous segment, with `start` and `end` as in [`Segment`](crate::Segment).
    pub fn of_segments(part: &AdditivePart<'_, '_>) -> Table<'static> {
        let segments = part.segments();
        let number = |of: fn(&crate::Segment) -> f64| owned(segments.iter().map(of));
        // More than four thousand million steps do not fit into memory.
        let whole = |of: fn(&crate::Segment) -> usize| {
            Column::U32(
                segments.iter().map(|segment| u32::try_from(of(segment)).unwrap_or(u32::MAX)).collect(),
            )
        };
        Table {
            columns: vec![
                ("kind", Column::Word(segments.iter().map(|segment| segment.kind.name()).collect())),
                ("start", whole(|segment| segment.start)),
                ("end", whole(|segment| segment.end)),
                ("layer", whole(|segment| segment.layer)),
                ("tool", whole(|segment| usize::from(segment.tool))),
                ("t_start", number(|segment| segment.start_time)),
                ("t_end", number(|segment| segment.end_time)),
                ("length", number(|segment| segment.length)),
                ("duration", number(|segment| segment.duration())),
                ("volume", number(|segment| segment.volume)),
                ("x0", number(|segment| segment.from[0])),
                ("y0", number(|segment| segment.from[1])),
                ("z0", number(|segment| segment.from[2])),
                ("x1", number(|segment| segment.to[0])),
                ("y1", number(|segment| segment.to[1])),
                ("z1", number(|segment| segment.to[2])),
            ],
        }
    }

    /// The layers of a part: one row a layer.
    pub fn of_layers(part: &AdditivePart<'_, '_>) -> Table<'static> {
        let layers = part.layers();
        let number = |of: fn(&crate::Layer) -> f64| owned(layers.iter().map(of));
        Table {
            columns: vec![
                ("layer", Column::U32((0u32..).take(layers.len()).collect())),
                ("t_start", number(|layer| layer.start_time)),
                ("layer_time", number(|layer| layer.time)),
                ("deposition_length", number(|layer| layer.deposition_length)),
                ("travel_length", number(|layer| layer.travel_length)),
                ("mean_speed", number(|layer| layer.mean_speed())),
                ("volume", number(|layer| layer.volume)),
            ],
        }
    }

    /// The columns in order, with their names.
    pub fn columns(&self) -> &[(&'static str, Column<'a>)] {
        &self.columns
    }

    /// The column of a name.
    pub fn column(&self, name: &str) -> Option<&Column<'a>> {
        self.columns.iter().find(|(found, _)| *found == name).map(|(_, column)| column)
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

fn owned(values: impl Iterator<Item = f64>) -> Column<'static> {
    Column::F64(values.collect())
}

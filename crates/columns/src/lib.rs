//! The [`Table`]s of an emulation as Parquet and as Arrow IPC, for programs that read tables by the million rows.
//!
//! Both have the columns, names and numbers of the CSV. Numbers are 64-bit floats and unsigned 32-bit integers, words
//! are dictionaries of strings; no value is missing.
//!
//! A crate of its own because the libraries behind it take longer to build than all of clayforge: they build beside it.
//!
//! ```
//! use emulate::{Commands, Machine, Table};
//!
//! let operation = Machine::default().process_additive(Commands::read(b"G1 X10 E1 F600\nG1 X20\n").steps)?;
//! let table = Table::of_additive(&operation);
//! let (mut parquet, mut arrow) = (Vec::new(), Vec::new());
//! columns::write_parquet(&table, &mut parquet)?;
//! columns::write_arrow(&table, &mut arrow)?;
//! assert!(parquet.starts_with(b"PAR1") && parquet.ends_with(b"PAR1"));
//! assert!(arrow.starts_with(b"ARROW1") && arrow.ends_with(b"ARROW1"));
//! # Ok::<(), emulate::Error>(())
//! ```

use arrow_array::types::Int32Type;
use arrow_array::{
    Array, ArrayRef, DictionaryArray, Float64Array, Int32Array, RecordBatch, StringArray, UInt32Array,
};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, DataType, Field, Schema};
use emulate::{Column, Error, Table};
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::file::properties::WriterProperties;
use std::fmt::Display;
use std::io::Write;
use std::ops::Range;
use std::sync::Arc;

/// So many rows are handed on at once, so that a table is never in memory a second time.
const ROWS: usize = 1 << 16;

/// Writes a table as Parquet, packed with snappy.
///
/// # Errors
/// When `out` does not take it.
pub fn write_parquet(table: &Table<'_>, out: impl Write + Send) -> Result<(), Error> {
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(concat!("clayforge ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let source = Source::new(table).map_err(told)?;
    let mut writer = ArrowWriter::try_new(out, source.schema.clone(), Some(properties)).map_err(told)?;
    for batch in source.batches() {
        writer.write(&batch.map_err(told)?).map_err(told)?;
    }
    writer.close().map_err(told)?;
    Ok(())
}

/// Writes a table as an Arrow IPC file, which a program can map into its memory (`.arrow`, also called Feather 2).
///
/// # Errors
/// When `out` does not take it.
pub fn write_arrow(table: &Table<'_>, out: impl Write) -> Result<(), Error> {
    let source = Source::new(table).map_err(told)?;
    let mut writer = FileWriter::try_new_buffered(out, &source.schema).map_err(told)?;
    for batch in source.batches() {
        writer.write(&batch.map_err(told)?).map_err(told)?;
    }
    writer.finish().map_err(told)
}

fn told(error: impl Display) -> Error {
    Error::new(error.to_string())
}

/// A table on its way into batches.
struct Source<'t> {
    columns: Vec<Values<'t>>,
    rows: usize,
    schema: Arc<Schema>,
}

/// What a column is cut from.
enum Values<'t> {
    F64(&'t [f64]),
    U32(&'t [u32]),
    Word(DictionaryArray<Int32Type>),
}

impl<'t> Source<'t> {
    fn new(table: &'t Table<'_>) -> Result<Self, ArrowError> {
        let columns = table.columns().iter().map(|(_, column)| Values::of(column));
        let columns = columns.collect::<Result<Vec<_>, _>>()?;
        let names = table.columns().iter().map(|(name, _)| *name);
        let fields = names.zip(&columns).map(|(name, values)| Field::new(name, values.data_type(), false));
        let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
        Ok(Self { columns, rows: table.len(), schema })
    }

    fn batches(&self) -> impl Iterator<Item = Result<RecordBatch, ArrowError>> {
        let starts = (0..self.rows).step_by(ROWS);
        starts.map(|start| {
            let rows = start..self.rows.min(start + ROWS);
            let arrays = self.columns.iter().map(|values| values.array(rows.clone())).collect();
            RecordBatch::try_new(self.schema.clone(), arrays)
        })
    }
}

impl<'t> Values<'t> {
    fn of(column: &'t Column<'_>) -> Result<Self, ArrowError> {
        Ok(match column {
            Column::F64(values) => Self::F64(values),
            Column::U32(values) => Self::U32(values),
            Column::Word(words) => Self::Word(dictionary(words)?),
        })
    }

    fn data_type(&self) -> DataType {
        match self {
            Self::F64(_) => DataType::Float64,
            Self::U32(_) => DataType::UInt32,
            Self::Word(words) => words.data_type().clone(),
        }
    }

    fn array(&self, rows: Range<usize>) -> ArrayRef {
        match self {
            // Adding 0 makes a negative zero plain, as in the CSV.
            Self::F64(values) => {
                Arc::new(Float64Array::from_iter_values(values[rows].iter().map(|value| value + 0.0)))
            }
            Self::U32(values) => Arc::new(UInt32Array::from_iter_values(values[rows].iter().copied())),
            Self::Word(words) => Arc::new(words.slice(rows.start, rows.len())),
        }
    }
}

/// One dictionary for the whole column, in the order in which its words appear: a file may have no second one.
fn dictionary(words: &[&'static str]) -> Result<DictionaryArray<Int32Type>, ArrowError> {
    let mut known: Vec<&'static str> = Vec::new();
    // There are few words, and most are the one before.
    let keys = words.iter().map(|word| match known.iter().position(|found| found == word) {
        Some(key) => key as i32,
        None => {
            known.push(word);
            known.len() as i32 - 1
        }
    });
    let keys = Int32Array::from_iter_values(keys);
    DictionaryArray::try_new(keys, Arc::new(StringArray::from_iter_values(known)))
}

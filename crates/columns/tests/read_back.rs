//! What was written is read back by the libraries themselves, and compared with the table to the bit.

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int32Type, UInt32Type};
use arrow_array::{Array, RecordBatch};
use emulate::{AdditiveOperation, AdditivePart, Bead, Column, Commands, Machine, Shape, Table};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::io::Cursor;

const VASE: &[u8] = include_bytes!("../../emulate/tests/data/b_vase.gcode");
const BEAD: Bead = Bead { width: 6.0, height: 2.0, shape: Shape::Rectangle, density: 1.9 };

fn emulated(text: &[u8]) -> AdditiveOperation<'_> {
    Machine::default().process_additive(Commands::read(text).steps).expect("a sound machine")
}

fn parquet(table: &Table<'_>) -> Vec<RecordBatch> {
    let mut file = Vec::new();
    columns::write_parquet(table, &mut file).expect("memory takes all");
    let builder = ParquetRecordBatchReaderBuilder::try_new(bytes::Bytes::from(file)).expect("Parquet");
    let created_by = builder.metadata().file_metadata().created_by().unwrap_or_default().to_owned();
    assert!(created_by.starts_with("clayforge "), "{created_by}");
    builder.build().expect("a reader").map(|batch| batch.expect("a batch")).collect()
}

fn arrow(table: &Table<'_>) -> Vec<RecordBatch> {
    let mut file = Vec::new();
    columns::write_arrow(table, &mut file).expect("memory takes all");
    let reader = arrow_ipc::reader::FileReader::try_new(Cursor::new(file), None).expect("Arrow IPC");
    reader.map(|batch| batch.expect("a batch")).collect()
}

fn words(array: &dyn Array) -> Vec<&str> {
    let words = array.as_dictionary::<Int32Type>();
    let values = words.values().as_string::<i32>();
    words.keys().values().iter().map(|&key| values.value(key as usize)).collect()
}

#[track_caller]
fn assert_same(batches: &[RecordBatch], table: &Table<'_>) {
    let mut start = 0;
    for batch in batches {
        assert_eq!(batch.num_columns(), table.columns().len());
        let rows = start..start + batch.num_rows();
        let fields = batch.schema();
        for (index, (name, column)) in table.columns().iter().enumerate() {
            assert_eq!(fields.field(index).name(), name);
            let array = batch.column(index);
            assert_eq!(array.null_count(), 0, "{name}");
            let same = match column {
                Column::F64(values) => {
                    let found = array.as_primitive::<Float64Type>().values();
                    let bits = |value: &f64| (value + 0.0).to_bits();
                    found.iter().map(|value| value.to_bits()).eq(values[rows.clone()].iter().map(bits))
                }
                Column::U32(values) => {
                    array.as_primitive::<UInt32Type>().values()[..] == values[rows.clone()]
                }
                Column::Word(values) => words(array) == values[rows.clone()],
            };
            assert!(same, "{name} in rows {rows:?}");
        }
        start = rows.end;
    }
    assert_eq!(start, table.len());
}

#[test]
fn parquet_and_arrow_have_the_columns_of_the_table() {
    let operation = emulated(VASE);
    let part = AdditivePart::new(&operation, BEAD, [0.0, 0.0, 1.0]).expect("a sound bead");
    for table in [Table::of_part(&part), Table::of_segments(&part), Table::of_layers(&part)] {
        assert_same(&parquet(&table), &table);
        assert_same(&arrow(&table), &table);
    }
}

#[test]
fn a_long_table_is_written_in_batches_with_one_dictionary() {
    // New words come late: a second dictionary would be refused, or the first be too short.
    let mut text = b"M83\nG1 X1 E1 F600\nG1 X0 E1\n".repeat(50_000);
    text.extend_from_slice(b"G4 P10\nG1 E2\nG91\n; done\n");
    let operation = emulated(&text);
    let table = Table::of_additive(&operation);
    assert!(table.len() > 1 << 17);
    let batches = arrow(&table);
    assert!(batches.len() > 2);
    assert_same(&batches, &table);
    assert_same(&parquet(&table), &table);
    assert_eq!(words(batches[batches.len() - 1].column(1)).last(), Some(&"Comment"));
}

#[test]
fn a_table_without_rows_is_a_file_all_the_same() {
    let operation = emulated(b"");
    let table = Table::of_additive(&operation);
    assert!(table.is_empty());
    assert_same(&parquet(&table), &table);
    assert_same(&arrow(&table), &table);
}

#[test]
fn the_same_table_gives_the_same_bytes() {
    let operation = emulated(VASE);
    let table = Table::of_additive(&operation);
    let files = || {
        let (mut parquet, mut arrow) = (Vec::new(), Vec::new());
        columns::write_parquet(&table, &mut parquet).expect("memory takes all");
        columns::write_arrow(&table, &mut arrow).expect("memory takes all");
        (parquet, arrow)
    };
    assert_eq!(files(), files());
}

/// Takes so many bytes and no more.
struct Full(usize);

impl std::io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if bytes.len() > self.0 {
            return Err(std::io::Error::other("the disk is full"));
        }
        self.0 -= bytes.len();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error() {
    let operation = emulated(VASE);
    let table = Table::of_additive(&operation);
    for room in [0, 100, 5000] {
        let error = columns::write_parquet(&table, Full(room)).expect_err("no room");
        assert!(error.message.contains("the disk is full"), "{error}");
        let error = columns::write_arrow(&table, Full(room)).expect_err("no room");
        assert!(error.message.contains("the disk is full"), "{error}");
    }
}

//! Tables as Parquet and Arrow, read back by the library that wrote them; `read_back.py` does it with another.
#![cfg(feature = "tables")]

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, UInt8Type, UInt32Type};
use arrow_array::{Array, RecordBatch};
use emulate::{Column, Commands, Machine, Table};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::io::Cursor;

fn same(table: &Table<'_>, batch: &RecordBatch) {
    assert_eq!((batch.num_rows(), batch.num_columns()), (table.len(), table.columns().len()));
    for (name, column) in table.columns() {
        let found = batch.column_by_name(name).unwrap_or_else(|| panic!("no column {name}"));
        match column {
            Column::F64(values) => {
                let found = found.as_primitive::<Float64Type>();
                assert!(values.iter().zip(found.values()).all(|(a, b)| a.to_bits() == b.to_bits()), "{name}");
            }
            Column::U32(values) => {
                assert_eq!(found.as_primitive::<UInt32Type>().values().as_ref(), &**values)
            }
            Column::Word(values) => {
                let found = found.as_dictionary::<UInt8Type>();
                let words = found.downcast_dict::<arrow_array::StringArray>().expect("words");
                assert!(words.into_iter().eq(values.iter().map(|word| Some(*word))), "{name}");
            }
        }
    }
}

#[test]
fn parquet_and_arrow_read_back_to_the_bit() {
    let text = include_bytes!("data/p_tile.gcode");
    let operation = Machine::default().process_additive(Commands::read(text).steps).expect("sound");
    let table = Table::of_additive(&operation);

    let mut parquet = Vec::new();
    table.write_parquet(&mut parquet).expect("memory takes it");
    let path = concat!(env!("CARGO_TARGET_TMPDIR"), "/table.parquet");
    std::fs::write(path, &parquet).expect("room");
    let file = std::fs::File::open(path).expect("it was written");
    let mut reader = ParquetRecordBatchReaderBuilder::try_new(file)
        .expect("Parquet")
        .with_batch_size(table.len())
        .build()
        .expect("a reader");
    same(&table, &reader.next().expect("rows").expect("sound"));
    assert!(reader.next().is_none());

    let mut arrow = Vec::new();
    table.write_arrow(&mut arrow).expect("memory takes it");
    std::fs::write(concat!(env!("CARGO_TARGET_TMPDIR"), "/table.arrow"), &arrow).expect("room");
    let mut reader = arrow_ipc::reader::FileReader::try_new(Cursor::new(arrow), None).expect("Arrow");
    same(&table, &reader.next().expect("a batch").expect("sound"));
    assert!(reader.next().is_none());
}

#[test]
fn a_table_without_rows_is_a_table() {
    let operation = Machine::default().process_additive(Vec::new()).expect("sound");
    let table = Table::of_additive(&operation);
    let mut parquet = Vec::new();
    table.write_parquet(&mut parquet).expect("memory takes it");
    assert!(parquet.starts_with(b"PAR1") && parquet.ends_with(b"PAR1"));
}

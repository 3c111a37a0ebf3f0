//! Tables as Parquet and as Arrow IPC.

use super::{Column, Table};
use crate::error::Error;
use arrow_array::types::UInt8Type;
use arrow_array::{ArrayRef, DictionaryArray, Float64Array, RecordBatch, UInt32Array};
use arrow_schema::ArrowError;
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use std::io::Write;
use std::sync::Arc;

impl Table<'_> {
    /// The table as one batch of Arrow.
    ///
    /// # Errors
    /// When Arrow refuses it.
    pub fn to_batch(&self) -> Result<RecordBatch, Error> {
        let columns = self.columns().iter().map(|(name, column)| -> (&str, ArrayRef) {
            (
                *name,
                match column {
                    Column::F64(values) => Arc::new(Float64Array::from_iter_values(values.iter().copied())),
                    Column::U32(values) => Arc::new(UInt32Array::from_iter_values(values.iter().copied())),
                    Column::Word(values) => {
                        Arc::new(values.iter().copied().collect::<DictionaryArray<UInt8Type>>())
                    }
                },
            )
        });
        Ok(RecordBatch::try_from_iter(columns)?)
    }

    /// Writes the table as Parquet, packed with snappy.
    ///
    /// # Errors
    /// When `out` does not take it.
    pub fn write_parquet(&self, out: impl Write + Send) -> Result<(), Error> {
        let batch = self.to_batch()?;

        let properties = WriterProperties::builder().set_compression(Compression::SNAPPY).build();
        let mut writer = ArrowWriter::try_new(out, batch.schema(), Some(properties))?;
        writer.write(&batch)?;
        writer.close()?;
        Ok(())
    }

    /// Writes the table as an Arrow IPC file, which a program can map into its memory.
    ///
    /// # Errors
    /// When `out` does not take it.
    pub fn write_arrow(&self, out: impl Write) -> Result<(), Error> {
        let batch = self.to_batch()?;
        let mut writer = arrow_ipc::writer::FileWriter::try_new(out, &batch.schema())?;
        writer.write(&batch)?;
        writer.finish()?;
        Ok(())
    }
}

impl From<ArrowError> for Error {
    fn from(error: ArrowError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<ParquetError> for Error {
    fn from(error: ParquetError) -> Self {
        Self::new(error.to_string())
    }
}

//! Tables as comma-separated text.

use super::{Column, Table};
use crate::error::Error;
use std::io::Write;

/// So many bytes are handed on at once.
const BLOCK: usize = 1 << 16;

impl Table<'_> {
    /// Writes a header and a line for each row. Numbers are as short as they can be to read back the same.
    ///
    /// # Errors
    /// When `out` does not take them.
    pub fn write_csv(&self, mut out: impl Write) -> Result<(), Error> {
        let names: Vec<&str> = self.columns().iter().map(|(name, _)| *name).collect();
        let mut block = Vec::with_capacity(2 * BLOCK);
        writeln!(block, "{}", names.join(","))?;
        for row in 0..self.len() {
            for (index, (_, column)) in self.columns().iter().enumerate() {
                if index > 0 {
                    block.push(b',');
                }
                match column {
                    // Adding 0 makes a negative zero plain.
                    Column::F64(values) => write!(block, "{}", values[row] + 0.0)?,
                    Column::U32(values) => write!(block, "{}", values[row])?,
                    Column::Word(values) => block.extend_from_slice(values[row].as_bytes()),
                }
            }
            block.push(b'\n');
            if block.len() >= BLOCK {
                out.write_all(&block)?;
                block.clear();
            }
        }
        out.write_all(&block)?;
        Ok(())
    }
}

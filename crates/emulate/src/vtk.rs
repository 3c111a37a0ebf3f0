//! The deposits of a part as lines with data, for ParaView and everything else that reads VTK.

use crate::error::Error;
use crate::part::{AdditivePart, CHORD_TOLERANCE, SegmentKind, chords};
use std::io::Write;

/// The values of cells.
#[derive(Clone, Debug, PartialEq)]
pub enum CellData {
    /// 32-bit floats.
    F32(Vec<f32>),
    /// 64-bit floats.
    F64(Vec<f64>),
    /// 32-bit signed whole numbers.
    I32(Vec<i32>),
    /// 32-bit whole numbers.
    U32(Vec<u32>),
}

impl CellData {
    /// The type in `.vtp`, in legacy files.
    const fn types(&self) -> (&'static str, &'static str) {
        match self {
            Self::F32(_) => ("Float32", "float"),
            Self::F64(_) => ("Float64", "double"),
            Self::I32(_) => ("Int32", "int"),
            Self::U32(_) => ("UInt32", "unsigned_int"),
        }
    }

    fn bytes(&self, big: bool) -> Vec<u8> {
        match self {
            Self::F32(values) => bytes(values, big, f32::to_be_bytes, f32::to_le_bytes),
            Self::F64(values) => bytes(values, big, f64::to_be_bytes, f64::to_le_bytes),
            Self::I32(values) => bytes(values, big, i32::to_be_bytes, i32::to_le_bytes),
            Self::U32(values) => bytes(values, big, u32::to_be_bytes, u32::to_le_bytes),
        }
    }
}

fn bytes<T: Copy, const N: usize>(
    values: &[T],
    big: bool,
    to_big: fn(T) -> [u8; N],
    to_little: fn(T) -> [u8; N],
) -> Vec<u8> {
    let to = if big { to_big } else { to_little };
    values.iter().flat_map(|&value| to(value)).collect()
}

/// Lines through points, one cell for each move that deposits, and data for each cell.
///
/// ```
/// use emulate::{AdditivePart, Bead, Machine, PolyData, Commands};
///
/// let program = Commands::read(b"M83\nG1 X10 E1 F600\nG1 Y10 E1\nG1 X0\n");
/// let operation = Machine::default().process_additive(program.steps)?;
/// let part = AdditivePart::new(&operation, Bead::default(), [0.0, 0.0, 1.0])?;
/// let temperature = [38.0, 39.5];
/// let mesh = PolyData::of(&part, &[("temperature", &temperature)])?;
/// assert_eq!(mesh.cells(), 2);
/// assert!(mesh.names().any(|name| name == "layer_time"));
/// let mut file = Vec::new();
/// mesh.write_vtp(&mut file)?;
/// # Ok::<(), emulate::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolyData {
    /// The points; moves that follow one another share theirs.
    pub points: Vec<[f32; 3]>,
    /// Indices of points, cell after cell.
    pub connectivity: Vec<u32>,
    /// Where each cell ends in `connectivity`.
    pub ends: Vec<u32>,
    data: Vec<(String, CellData)>,
}

impl PolyData {
    /// The deposits of a part with everything that is known of them, and with scalars of one's own, one for each cell.
    ///
    /// # Errors
    /// When a scalar has not one value for each cell, or its name is taken or not plain, or there are more points than
    /// VTK can count.
    pub fn of(part: &AdditivePart<'_, '_>, custom: &[(&str, &[f64])]) -> Result<Self, Error> {
        let mut mesh = Self::default();
        let steps = mesh.take_lines(part)?;
        mesh.take_data(part, &steps);
        for &(name, values) in custom {
            mesh.add(name, values)?;
        }
        Ok(mesh)
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.ends.len()
    }

    /// The names of the cell data.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.data.iter().map(|(name, _)| name.as_str())
    }

    /// The cell data of a name.
    pub fn data(&self, name: &str) -> Option<&CellData> {
        self.data.iter().find(|(found, _)| found == name).map(|(_, data)| data)
    }

    fn add(&mut self, name: &str, values: &[f64]) -> Result<(), Error> {
        if values.len() != self.cells() {
            return Err(Error::new(format!(
                "`{name}` has {} values, and the part has {} cells",
                values.len(),
                self.cells()
            ))
            .hint("a cell is a move that deposits; `command_index` of the cell data says which"));
        }
        if self.names().any(|taken| taken == name) {
            return Err(Error::new(format!("the cells have `{name}` already")));
        }
        let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"_.-".contains(&byte);
        if name.is_empty() || !name.bytes().all(plain) {
            return Err(Error::new(format!("`{name}` is no name for cell data"))
                .hint("letters, digits, `_`, `.` and `-` can be read by everybody"));
        }
        self.data.push((name.to_owned(), CellData::F64(values.to_vec())));
        Ok(())
    }

    /// The lines; the entry of the process data for each, with the row of its segment.
    fn take_lines(&mut self, part: &AdditivePart<'_, '_>) -> Result<Vec<(usize, usize)>, Error> {
        let process = part.operation().process_data();
        let mut steps = Vec::new();
        for (row, segment) in part.segments().iter().enumerate() {
            if segment.kind != SegmentKind::Deposition {
                continue;
            }
            self.point(segment.from)?;
            for index in (segment.start..segment.end).filter(|&index| process.action()[index].is_path()) {
                self.connectivity.push(self.last_point());
                for point in chords(process, index, CHORD_TOLERANCE) {
                    self.point(point)?;
                    self.connectivity.push(self.last_point());
                }
                // There are less than twice as many as points.
                self.ends.push(self.connectivity.len() as u32);
                steps.push((index, row));
            }
        }
        Ok(steps)
    }

    fn point(&mut self, at: [f64; 3]) -> Result<(), Error> {
        const MOST: usize = (i32::MAX / 2) as usize;
        if self.points.len() >= MOST {
            return Err(Error::new(format!("a VTK file of this kind holds no more than {MOST} points")));
        }
        self.points.push(at.map(|side| side as f32));
        Ok(())
    }

    fn last_point(&self) -> u32 {
        // `point` has seen to it that this fits.
        self.points.len().saturating_sub(1) as u32
    }

    fn take_data(&mut self, part: &AdditivePart<'_, '_>, steps: &[(usize, usize)]) {
        let operation = part.operation();
        let process = operation.process_data();
        let bead = part.bead();
        let layer = |row: usize| part.segments()[row].layer;
        let small = |of: &dyn Fn(usize) -> f64| {
            CellData::F32(steps.iter().map(|&(index, _)| of(index) as f32).collect())
        };
        let large =
            |of: &dyn Fn(usize) -> f64| CellData::F64(steps.iter().map(|&(index, _)| of(index)).collect());
        let whole =
            |of: &dyn Fn(usize) -> u32| CellData::U32(steps.iter().map(|&(index, _)| of(index)).collect());
        let mean = |index: usize| process.step_distance()[index] / process.duration(index);
        let data = [
            ("feed_rate", small(&|index| process.feed_rate()[index])),
            ("speed_entry", small(&|index| process.speed_entry()[index])),
            ("speed_exit", small(&|index| process.speed_exit()[index])),
            ("speed_mean", small(&mean)),
            ("elapsed_time", large(&|index| process.elapsed_time()[index])),
            ("duration", small(&|index| process.duration(index))),
            ("deposited_volume", large(&|index| operation.deposited_volume()[index])),
            ("delta_volume", small(&|index| operation.delta_volume()[index])),
            ("bead_area", small(&|index| operation.bead_area(index))),
            ("bead_width", small(&|_| bead.width)),
            ("bead_height", small(&|_| bead.height)),
            ("layer", CellData::I32(steps.iter().map(|&(_, row)| layer(row) as i32).collect())),
            (
                "layer_time",
                CellData::F32(steps.iter().map(|&(_, row)| part.layers()[layer(row)].time as f32).collect()),
            ),
            ("tool", whole(&|index| u32::from(process.tool()[index]))),
            ("command_index", whole(&|index| index as u32)),
            ("line", whole(&|index| process.line()[index])),
        ];
        self.data.extend(data.map(|(name, data)| (name.to_owned(), data)));
    }

    /// Writes an XML `.vtp` file with its data appended as raw bytes.
    ///
    /// # Errors
    /// When `out` does not take it.
    pub fn write_vtp(&self, mut out: impl Write) -> Result<(), Error> {
        let flat: Vec<f32> = self.points.iter().flatten().copied().collect();
        let wide = |values: &[u32]| -> Vec<u8> {
            values.iter().flat_map(|&value| i64::from(value).to_le_bytes()).collect()
        };
        let mut head = String::new();
        let mut blocks: Vec<Vec<u8>> = Vec::new();
        let mut offset = 0u64;
        let mut array = |name: &str, kind: &str, more: &str, block: Vec<u8>| {
            let tag = format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\"{more} format=\"appended\" offset=\"{offset}\"/>\n"
            );
            offset += 8 + block.len() as u64;
            blocks.push(block);
            tag
        };
        head += "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
                 header_type=\"UInt64\">\n<PolyData>\n";
        head += &format!(
            "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"0\">\n",
            self.points.len(),
            self.cells()
        );
        let points = CellData::F32(flat).bytes(false);
        head += "<Points>\n";
        head += &array("Points", "Float32", " NumberOfComponents=\"3\"", points);
        head += "</Points>\n<Lines>\n";
        head += &array("connectivity", "Int64", "", wide(&self.connectivity));
        head += &array("offsets", "Int64", "", wide(&self.ends));
        head += "</Lines>\n<CellData Scalars=\"feed_rate\">\n";
        for (name, data) in &self.data {
            head += &array(name, data.types().0, "", data.bytes(false));
        }
        head += "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
        out.write_all(head.as_bytes())?;
        for block in blocks {
            out.write_all(&(block.len() as u64).to_le_bytes())?;
            out.write_all(&block)?;
        }
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")?;
        Ok(())
    }

    /// Writes a legacy `.vtk` file, binary.
    ///
    /// # Errors
    /// When `out` does not take it.
    pub fn write_vtk(&self, mut out: impl Write) -> Result<(), Error> {
        let flat: Vec<f32> = self.points.iter().flatten().copied().collect();
        let (cells, points) = (self.cells(), self.points.len());
        write!(
            out,
            "# vtk DataFile Version 3.0\nclayforge\nBINARY\nDATASET POLYDATA\nPOINTS {points} float\n"
        )?;
        out.write_all(&CellData::F32(flat).bytes(true))?;
        if cells > 0 {
            // VTK calls a list of no lines an error.
            write!(out, "\nLINES {cells} {}\n", cells + self.connectivity.len())?;
        }
        let mut lines = Vec::with_capacity(4 * (cells + self.connectivity.len()));
        let mut start = 0;
        for &end in &self.ends {
            let cell = &self.connectivity[start as usize..end as usize];
            lines.extend_from_slice(&(end - start).to_be_bytes());
            cell.iter().for_each(|point| lines.extend_from_slice(&point.to_be_bytes()));
            start = end;
        }
        out.write_all(&lines)?;
        write!(out, "\nCELL_DATA {cells}\n")?;
        // Old readers take one scalar and everything that is in a field.
        for (index, (name, data)) in self.data.iter().enumerate() {
            let kind = data.types().1;
            match index {
                0 => write!(out, "SCALARS {name} {kind} 1\nLOOKUP_TABLE default\n")?,
                1 => write!(out, "FIELD FieldData {}\n{name} 1 {cells} {kind}\n", self.data.len() - 1)?,
                _ => writeln!(out, "{name} 1 {cells} {kind}")?,
            }
            out.write_all(&data.bytes(true))?;
            out.write_all(b"\n")?;
        }
        Ok(())
    }
}

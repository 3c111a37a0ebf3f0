"""Reads files of `clayforge emulate` with the libraries they are for, and compares the arrays with the CSV.

    pip install vtk pyarrow numpy
    clayforge emulate part.gcode --csv part.csv --parquet part.parquet --arrow part.arrow --vtk part.vtp
    clayforge emulate part.gcode --vtk part.vtk
    python read_back.py part.csv part.parquet part.arrow part.vtp part.vtk

Not run by `cargo test`: the libraries are large. Once a release is often enough.
"""

import csv
import sys

import numpy

WORDS = {"command", "action"}
WHOLE = {"line", "tool", "layer"}
# The names of the cell data in the CSV.
CELLS = {
    "feed_rate": "feedrate", "speed_entry": "speed_entry", "speed_exit": "speed_exit", "elapsed_time": "time",
    "duration": "duration", "deposited_volume": "volume", "delta_volume": "delta_extrusion",
    "bead_area": "bead_area", "layer": "layer", "tool": "tool", "line": "line",
}


def check_table(path, rows):
    import pyarrow
    import pyarrow.parquet

    if path.endswith(".parquet"):
        table = pyarrow.parquet.read_table(path)
    else:
        table = pyarrow.ipc.open_file(path).read_all()
    assert table.column_names == list(rows[0]), (table.column_names, list(rows[0]))
    assert table.num_rows == len(rows), (table.num_rows, len(rows))
    for name in table.column_names:
        column = table[name]
        assert column.null_count == 0, (path, name)
        wanted = [row[name] for row in rows]
        if name in WORDS:
            assert pyarrow.types.is_dictionary(column.type), (path, name, column.type)
            assert column.to_pylist() == wanted, (path, name)
        else:
            kind = pyarrow.uint32() if name in WHOLE else pyarrow.float64()
            assert column.type == kind, (path, name, column.type)
            # The CSV reads back to the bit.
            numbers = numpy.array([float(cell) for cell in wanted])
            assert column.to_numpy().astype(float).tobytes() == numbers.tobytes(), (path, name)
    print(f"{path}: {table.num_rows} rows, {table.num_columns} columns: equal to the bit")


def mesh_of(path):
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    reader = vtkXMLPolyDataReader() if path.endswith(".vtp") else vtkPolyDataReader()
    if isinstance(reader, vtkPolyDataReader):
        reader.ReadAllScalarsOn()
        reader.ReadAllFieldsOn()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def check_mesh(path, rows):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    rows = [row for row in rows if row["action"] == "deposit"]
    mesh = mesh_of(path)
    data = mesh.GetCellData()
    found = [data.GetArrayName(index) for index in range(data.GetNumberOfArrays())]
    assert mesh.GetNumberOfLines() == mesh.GetNumberOfCells() == len(rows), (mesh.GetNumberOfLines(), len(rows))
    for name, column in CELLS.items():
        array = vtk_to_numpy(data.GetArray(name)).astype(float)
        wanted = numpy.array([float(row[column]) for row in rows])
        worst = numpy.max(numpy.abs(array - wanted) / numpy.maximum(1e-3, numpy.abs(wanted)), initial=0.0)
        assert worst < 1e-6, (path, name, worst)
    ends = []
    for index in range(mesh.GetNumberOfCells()):
        cell = mesh.GetCell(index)
        ends.append(mesh.GetPoint(cell.GetPointId(cell.GetNumberOfPoints() - 1)))
    wanted = numpy.array([[float(row[axis]) for axis in "xyz"] for row in rows])
    assert numpy.max(numpy.abs(numpy.array(ends) - wanted), initial=0.0) < 1e-3, path
    print(f"{path}: {mesh.GetNumberOfPoints()} points, {len(rows)} lines, arrays {', '.join(found)}: equal")


def main(table, *files):
    with open(table, newline="") as text:
        rows = list(csv.DictReader(text))
    for path in files:
        (check_mesh if path.endswith((".vtp", ".vtk")) else check_table)(path, rows)


main(*sys.argv[1:])

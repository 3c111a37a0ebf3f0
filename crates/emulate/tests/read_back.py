"""Reads files of `clayforge emulate` with the libraries they are for, and compares the arrays.

    pip install vtk numpy
    clayforge emulate part.gcode --csv part.csv --vtk part.vtp && clayforge emulate part.gcode --vtk part.vtk
    python read_back.py part.csv part.vtp part.vtk

Not run by `cargo test`: VTK is large. Once a release is often enough.
"""

import csv
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def mesh_of(path):
    reader = vtkXMLPolyDataReader() if path.endswith(".vtp") else vtkPolyDataReader()
    if isinstance(reader, vtkPolyDataReader):
        reader.ReadAllScalarsOn()
        reader.ReadAllFieldsOn()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def main(table, *meshes):
    rows = [row for row in csv.DictReader(open(table)) if row["action"] == "deposit"]
    names = {
        "feed_rate": "feedrate", "speed_entry": "speed_entry", "speed_exit": "speed_exit", "elapsed_time": "time",
        "duration": "duration", "deposited_volume": "volume", "delta_volume": "delta_extrusion",
        "bead_area": "bead_area", "layer": "layer", "tool": "tool", "line": "line",
    }
    for path in meshes:
        mesh = mesh_of(path)
        data = mesh.GetCellData()
        found = [data.GetArrayName(index) for index in range(data.GetNumberOfArrays())]
        assert mesh.GetNumberOfLines() == mesh.GetNumberOfCells() == len(rows), (mesh.GetNumberOfLines(), len(rows))
        for name, column in names.items():
            array = vtk_to_numpy(data.GetArray(name)).astype(float)
            wanted = numpy.array([float(row[column]) for row in rows])
            worst = numpy.max(numpy.abs(array - wanted) / numpy.maximum(1e-3, numpy.abs(wanted)), initial=0.0)
            assert worst < 1e-6, (path, name, worst)
        ends = numpy.array([mesh.GetPoint(mesh.GetCell(cell).GetPointId(mesh.GetCell(cell).GetNumberOfPoints() - 1))
                            for cell in range(mesh.GetNumberOfCells())])
        wanted = numpy.array([[float(row[axis]) for axis in "xyz"] for row in rows])
        assert numpy.max(numpy.abs(ends - wanted), initial=0.0) < 1e-3, path
        print(f"{path}: {mesh.GetNumberOfPoints()} points, {len(rows)} lines, arrays {', '.join(found)}: equal")


main(*sys.argv[1:])

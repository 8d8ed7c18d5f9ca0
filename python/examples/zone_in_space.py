"""The plastic zone in space: the half of bodies behind their meridional plane, by VTK (scripts/setup vtk)."""
import pathlib

import numpy as np

from axijoint.sweep import Sweep

SECTORS = 60           # on half the circle
SHOWN = 4.0            # radius and depth of what is shown over those of the body that does not yield
LEAST = 1e-4           # plastic strains below count as this: the scale is logarithmic
SIZE = (900, 680)


def strains_of(result, angles):
    """Largest equivalent plastic strain of each element at angles between 0 and 180 degrees, between planes linear:
    (angles, elements)."""
    strain, element = result.read("yield/equivalent"), result.read("stress/element") - 1
    planes = np.degrees(result.read("yield/planes"))
    largest = np.zeros((len(planes), len(result.mesh.element_material)))
    for row, values in zip(largest, strain):
        np.maximum.at(row, element, values)
    return np.stack([np.interp(angles, planes, column) for column in largest.T], axis=1)


def swept(result, shown):
    """A grid of wedges and hexahedra round half the circle, of chosen elements; plastic strains at its points, the
    geometric mean of the elements there."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk
    sweep = Sweep(result)
    angles = np.linspace(0.0, 180.0, SECTORS + 1)
    r, z = sweep.position.T
    grid, points = vtk.vtkUnstructuredGrid(), vtk.vtkPoints()
    places = np.concatenate([np.stack([r*np.cos(a), r*np.sin(a), z], axis=1) for a in np.radians(angles)])
    points.SetData(numpy_to_vtk(places, deep=True))
    grid.SetPoints(points)
    strains = np.log(np.maximum(strains_of(result, angles), LEAST))
    total, number = np.zeros((len(angles), len(r))), np.zeros(len(r))
    for elements, corners in sweep.cells(np.flatnonzero(shown)):
        kind = vtk.VTK_WEDGE if corners.shape[1] == 3 else vtk.VTK_HEXAHEDRON
        for element, corner in zip(elements, corners):
            total[:, corner] += strains[:, element, None]
            number[corner] += 1.0
            for sector in range(SECTORS):
                both = np.concatenate([corner + k*len(r) for k in (sector, sector + 1)])
                grid.InsertNextCell(kind, len(both), both.tolist())
    grid.GetPointData().SetScalars(numpy_to_vtk(np.exp(total/np.maximum(number, 1.0)).ravel(), deep=True))
    return grid


def actor_of(grid, table=None):
    """The surface of a grid, coloured by a table, or grey."""
    import vtk
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    if table is None:
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(0.45, 0.5, 0.6)
    else:
        mapper.SetLookupTable(table)
        mapper.InterpolateScalarsBeforeMappingOn()
        mapper.SetScalarRange(table.GetRange())
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetDiffuse(0.75)
    return actor


def table_to(high):
    """Colours of plastic strains: nearly white where there is hardly any."""
    import vtk
    table = vtk.vtkLookupTable()
    table.SetScaleToLog10()
    table.SetRange(LEAST, high)
    table.SetNumberOfTableValues(64)
    light, dark = np.array([0.86, 0.86, 0.84]), np.array([0.65, 0.05, 0.1])
    middle = np.array([0.98, 0.7, 0.2])
    for k, t in enumerate(np.linspace(0.0, 1.0, 64)):
        colour = light + 2*t*(middle - light) if t < 0.5 else middle + (2*t - 1)*(dark - middle)
        table.SetTableValue(k, *colour, 1.0)
    table.Build()
    return table


def draw(result, job, path):
    """Write a picture of the plastic zone at the end."""
    del job
    import vtk
    mesh = result.mesh
    material = mesh.element_material
    yields = np.unique(material[np.unique(result.read("stress/element")[result.read("yield/equivalent").max(0) > 0] - 1)])
    ground = np.isin(material, yields)
    corners = np.array([mesh.coordinates[nodes[nodes >= 0]].min(axis=0) for nodes in mesh.element_nodes]), \
        np.array([mesh.coordinates[nodes[nodes >= 0]].max(axis=0) for nodes in mesh.element_nodes])
    radius, depth = corners[1][~ground, 0].max(), -corners[0][~ground, 1].min()
    near = (corners[0][:, 0] < SHOWN*radius) & (corners[0][:, 1] > -1.4*depth)
    table = table_to(float(f"{result.read('yield/equivalent').max():.1g}"))
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(actor_of(swept(result, ground & near), table))
    renderer.AddActor(actor_of(swept(result, ~ground)))
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("plastic strain")
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.0e")
    bar.SetVerticalTitleSeparation(12)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.0, 0.0, 0.0)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    bar.SetPosition(0.86, 0.2)
    bar.SetWidth(0.1)
    bar.SetHeight(0.6)
    renderer.AddActor2D(bar)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0.0, 0.0, -0.55*depth)
    camera.SetPosition(0.0, -6.0*depth, 2.2*depth)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(14.0)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    renderer.ResetCameraClippingRange()
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(pathlib.Path(path)))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()

#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws of pictures and films: vorticity of known flows, lines that enter no body, surfaces that enclose what particles fill,
colours that stand out, films of the length that was asked for.

usage: test_rendering.py      leaves with 77 (skipped) where the packages of contrib/render are missing
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "contrib"))
try:
    import numpy
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
except ImportError:
    print("skipped: the Debian packages python3-vtk9 and python3-numpy are not installed")
    sys.exit(77)
from rendering import colours, extent, film, flow, liquid, part, particle_part, trim, vorticity  # noqa: E402

OMEGA = 1.5  # rad/s
RADIUS = 0.3  # of bodies, m
PARTICLES = 16  # along a side
READABLE = 4.5  # contrast of letters by WCAG 2.1, level AA


def rotation(points):
    """Velocities of a rigid rotation about the z axis."""
    return OMEGA * numpy.stack([-points[:, 1], points[:, 0], 0 * points[:, 2]], axis=1)


def uniform(points):
    return numpy.tile([1.0, 0.2, 0.0], (len(points), 1))


def with_fields(data, velocity):
    points = vtk_to_numpy(data.GetPoints().GetData())
    for name, values in (("velocity", velocity(points)), ("kind", numpy.zeros(len(points))),
                         ("distance", numpy.linalg.norm(points, axis=1))):
        array = numpy_to_vtk(values.astype(float), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def grid(dim, n, velocity):
    """The box -1..1 of n cells a direction, with a velocity, as cells of files have them."""
    image = vtk.vtkImageData()
    image.SetDimensions(*([n + 1] * dim + [1] * (3 - dim)))
    image.SetOrigin(*([-1] * dim + [0] * (3 - dim)))
    image.SetSpacing(2 / n, 2 / n, 2 / n)
    convert = vtk.vtkAppendFilter()
    convert.AddInputData(image)
    convert.Update()
    return with_fields(convert.GetOutput(), velocity)


def fluid(dim, n, velocity, surface=None):
    """A fluid of a grid, as contrib/render has it."""
    result = part.Part.__new__(part.Part)
    result.data, result.surface, result.is_bodies, result.is_obstacles = grid(dim, n, velocity), surface, False, False
    result.joined = True
    result.note_fields()
    return result


def ball(dim):
    """The surface of a body in the middle: lines, or triangles."""
    if dim == 3:
        shape = vtk.vtkSphereSource()
        shape.SetThetaResolution(40)
        shape.SetPhiResolution(30)
    else:
        shape = vtk.vtkRegularPolygonSource()
        shape.SetNumberOfSides(60)
        shape.GeneratePolygonOff()
    shape.SetRadius(RADIUS)
    shape.Update()
    return shape.GetOutput()


def thin_ring():
    """Both surfaces of a ring that is thinner than a cell, as lines."""
    both = vtk.vtkAppendPolyData()
    for radius in (RADIUS, 1.1 * RADIUS):
        shape = vtk.vtkRegularPolygonSource()
        shape.SetNumberOfSides(60)
        shape.GeneratePolygonOff()
        shape.SetRadius(radius)
        shape.Update()
        both.AddInputData(shape.GetOutput())
    both.Update()
    return both.GetOutput()


def with_wet(data, is_wet):
    array = numpy_to_vtk(is_wet(vtk_to_numpy(data.GetPoints().GetData())).astype(float), deep=True)
    array.SetName(trim.WET)
    data.GetPointData().AddArray(array)
    return data


def area(data):
    properties = vtk.vtkMassProperties()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(trim.polygons_of(data))
    triangles.Update()
    properties.SetInputData(triangles.GetOutput())
    properties.Update()
    return properties.GetSurfaceArea()


def block(dim, velocity):
    """Particles that fill a square or cube of side 1, a spacing apart."""
    spacing = 1 / PARTICLES
    places = (numpy.arange(PARTICLES) + 0.5) * spacing
    points = numpy.zeros((PARTICLES ** dim, 3))
    points[:, :dim] = numpy.stack(numpy.meshgrid(*[places] * dim, indexing="ij"), -1).reshape(-1, dim)
    data = vtk.vtkPolyData()
    data.SetPoints(flow.points_data(points).GetPoints())
    vertices = vtk.vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    convert = vtk.vtkAppendFilter()
    convert.AddInputConnection(vertices.GetOutputPort())
    convert.Update()
    return particle_part.ParticlePart(with_fields(convert.GetOutput(), velocity), "fluid", spacing)


class Flows(unittest.TestCase):
    def test_vorticity_of_a_rigid_rotation_is_twice_its_rate(self):
        plane = vorticity.with_vorticity(grid(2, 8, rotation), True).GetPointData().GetArray("vorticity")
        numpy.testing.assert_allclose(vtk_to_numpy(plane), 2 * OMEGA, rtol=1e-9)
        space = vorticity.with_vorticity(grid(3, 6, rotation), False).GetPointData().GetArray("vorticity")
        numpy.testing.assert_allclose(vtk_to_numpy(space), numpy.tile([0, 0, 2 * OMEGA], (7 ** 3, 1)), atol=1e-9)

    def test_vorticity_of_particles(self):
        """Away from their surface, where means of neighbours are one-sided."""
        for dim in (2, 3):
            particles = block(dim, rotation)
            particles.derive_vorticity()
            values, points = particles.values("vorticity"), particles.points()[:, :dim]
            inner = numpy.all(abs(points - 0.5) < 0.2, axis=1)
            self.assertGreater(inner.sum(), 10)
            numpy.testing.assert_allclose(values[inner], 2 * OMEGA, rtol=0.02)

    def test_no_arrow_or_stream_line_passes_a_surface(self):
        """A stream that goes through all there is would."""
        for dim in (2, 3):
            stream = fluid(dim, 24, uniform, ball(dim))
            begins, vectors, _ = flow.arrows(stream, 1.02, [])
            lines = flow.stream_lines(stream, [])
            self.assertGreater(len(begins), 200)
            self.assertGreater(len(lines), 20)
            for line in [numpy.stack(ends) for ends in zip(begins, begins + vectors)] + lines:
                inside = numpy.linalg.norm(line, axis=1) < RADIUS * numpy.cos(numpy.pi / 30)
                outside = numpy.linalg.norm(line, axis=1) > RADIUS
                self.assertFalse(inside.any() and outside.any(), f"in {dim} dimensions a line goes through the body")

    def test_arrows_stay_away_from_cells_that_bodies_divide(self):
        stream = fluid(2, 24, uniform)
        fraction = numpy.where(numpy.linalg.norm(stream.points(), axis=1) < RADIUS, 0.5, 1)
        array = numpy_to_vtk(fraction, deep=True)
        array.SetName("fluid_fraction")
        stream.data.GetPointData().AddArray(array)
        begins, vectors, _ = flow.arrows(stream, 1.02, [])
        for places in (begins, begins + vectors):
            self.assertGreater(numpy.linalg.norm(places, axis=1).min(), RADIUS)

    def test_arrows_are_as_long_as_the_flow_is_fast(self):
        begins, vectors, velocities = flow.arrows(fluid(2, 10, rotation), OMEGA, [])
        ratio = numpy.linalg.norm(vectors, axis=1) / numpy.linalg.norm(velocities, axis=1)
        numpy.testing.assert_allclose(ratio, ratio[0], rtol=1e-6)
        numpy.testing.assert_allclose(velocities, rotation(begins), atol=1e-6)

    def test_stream_lines_of_a_rotation_are_circles(self):
        for line in flow.stream_lines(fluid(2, 20, rotation), []):
            radii = numpy.linalg.norm(line, axis=1)
            self.assertLess(numpy.ptp(radii), 0.02)


class Fluids(unittest.TestCase):
    def test_a_fluid_ends_at_a_thin_body_with_nothing_behind_it(self):
        """Only what is within the ring is drawn of the cells that the ring divides, and of those beyond: nearer to a disc on
        finer grids."""
        errors = []
        for n in (24, 48):
            width = 2 / n
            within = with_wet(grid(2, n, uniform), lambda points: numpy.linalg.norm(points, axis=1) < RADIUS - 1.5 * width)
            touched = vtk.vtkThreshold()
            touched.SetInputData(within)
            touched.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "distance")
            touched.SetLowerThreshold(0)
            touched.SetUpperThreshold(RADIUS + 0.5 * width)
            touched.AllScalarsOff()
            touched.Update()
            inner = touched.GetOutput()
            drawn = trim.trimmed(inner, thin_ring())
            lengths = numpy.linalg.norm(vtk_to_numpy(drawn.GetPoints().GetData())[vtk_to_numpy(
                drawn.GetPolys().GetConnectivityArray())], axis=1)
            self.assertLessEqual(lengths.max(), RADIUS + 1e-6)
            self.assertGreater(area(inner), 1.15 * numpy.pi * RADIUS ** 2)
            errors.append(abs(area(drawn) / (numpy.pi * RADIUS ** 2) - 1))
        self.assertLess(errors[0], 0.03)
        self.assertLess(errors[1], 0.6 * errors[0])

    def test_a_fluid_on_both_sides_of_a_thin_body_is_drawn_up_to_it(self):
        data = with_wet(grid(2, 24, uniform), lambda points: abs(numpy.linalg.norm(points, axis=1) - RADIUS) > 0.1)
        self.assertLessEqual(4 - area(trim.trimmed(data, thin_ring())), numpy.pi * RADIUS ** 2 * (1.1 ** 2 - 1))


class Liquids(unittest.TestCase):
    def test_the_surface_of_a_block_encloses_its_volume(self):
        mass = vtk.vtkMassProperties()
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputData(liquid.surface_of(block(3, uniform)))
        mass.SetInputConnection(triangles.GetOutputPort())
        self.assertAlmostEqual(mass.GetVolume(), 1, delta=0.04)

    def test_what_particles_fill_in_the_plane(self):
        size = vtk.vtkCellSizeFilter()
        size.SetInputData(block(2, uniform).region())
        size.Update()
        self.assertAlmostEqual(vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Area")).sum(), 1, delta=0.02)

    def test_only_particles_without_neighbours_are_drops(self):
        for dim in (2, 3):
            self.assertEqual(liquid.drops(block(dim, uniform)).GetNumberOfPoints(), 0)
            few = block(dim, uniform)
            alone = few.points()
            alone *= 3
            few.data.GetPoints().Modified()
            self.assertEqual(liquid.drops(few).GetNumberOfPoints(), PARTICLES ** dim)


class Colours(unittest.TestCase):
    def test_slow_water_stands_out(self):
        self.assertGreaterEqual(colours.contrast(colours.SPEED[0], colours.PAPER), READABLE)
        self.assertGreaterEqual(colours.contrast(colours.BODIES[0], colours.PAPER), READABLE)
        for colour in colours.SPEED:
            self.assertGreaterEqual(colours.contrast(colour, colours.PAPER), 1.5, colour)

    def test_lightness_grows_evenly(self):
        """By CIE 1976, so that speeds are in order for who sees no hues."""
        for table in (colours.SPEED, colours.BODIES):
            lightness = numpy.array([116 * numpy.cbrt(colours.luminance(colour)) - 16 for colour in table])
            steps = numpy.diff(lightness)
            self.assertGreater(steps.min(), 6)
            self.assertLess(steps.max(), 1.5 * steps.min())

    def test_fluids_and_particles_have_the_same_scale_of_speed(self):
        self.assertIs(colours.colour_table("velocity", (0, 1)), colours.SPEED)

    def test_nothing_has_the_colour_between_both_signs(self):
        flow_part = fluid(2, 4, rotation)
        for limits in ((-1, 1), (-0.5, 1.5), (-3, 1)):
            meaning = colours.Meaning(flow_part, "velocity", limits)
            middle = colours.rgb(colours.SIGNED[len(colours.SIGNED) // 2])
            numpy.testing.assert_allclose(meaning.transfer.GetColor(0), middle, atol=1e-6)

    def test_scales_end_at_round_numbers(self):
        self.assertEqual(extent.rounded(0, 0.973), (0, 1))
        self.assertEqual(extent.rounded(0, 1.0000001), (0, 1))
        for low, high in ((0, 3.43), (-7.3, 7.3), (2.1, 2.2)):
            first, last = extent.rounded(low, high)
            self.assertLessEqual(first, low)
            self.assertGreaterEqual(last, high)
            shown = extent.ticks(first, last)
            self.assertTrue(3 <= len(shown) <= 8)
            numpy.testing.assert_allclose([shown[0], shown[-1]], [first, last])


class Films(unittest.TestCase):
    def test_real_time_where_it_is_smooth(self):
        def options(rate=None, speed=None):
            return types.SimpleNamespace(rate=rate, speed=speed)
        self.assertAlmostEqual(film.rate_of(0.05, options()), 20)
        self.assertEqual(film.rate_of(1e-3, options()), film.OTHERWISE)
        self.assertEqual(film.rate_of(2, options()), film.OTHERWISE)
        self.assertAlmostEqual(film.rate_of(0.05, options(speed=0.5)), 10)
        self.assertEqual(film.rate_of(0.05, options(rate=7)), 7)

    @unittest.skipUnless(shutil.which("Xvfb") and shutil.which("ffmpeg"), "the Debian packages xvfb and ffmpeg are not installed")
    def test_a_film_has_the_size_and_the_length_of_its_pictures(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write_run(folder, [0, 0.1, 0.2, 0.3])
            done = subprocess.run([ROOT / "contrib" / "render", folder, "--size", "320x180", "--field", "vorticity", "--vectors",
                                   "--film"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("0.4 s at 10 pictures a second, in real time", done.stdout)
            seen = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=codec_name,width,height,pix_fmt,duration",
                                   "-of", "default=noprint_wrappers=1", folder / "film.mp4"], capture_output=True, text=True).stdout
            found = dict(line.split("=") for line in seen.split())
            self.assertEqual([found[key] for key in ("codec_name", "width", "height", "pix_fmt")], ["h264", "320", "180", "yuv420p"])
            self.assertAlmostEqual(float(found["duration"]), 0.4, delta=0.01)
            self.assertGreater(share_of_picture(folder / "frames" / "frame_0003.png"), 0.2)


def write_run(folder, times):
    """Files as a run leaves them, of a fluid that turns as a whole."""
    writer = vtk.vtkXMLUnstructuredGridWriter()
    lines = []
    for number, time in enumerate(times):
        writer.SetFileName(str(folder / f"fluid_{number:06d}.vtu"))
        writer.SetInputData(grid(2, 10, rotation))
        writer.Write()
        lines.append(f'<DataSet timestep="{time}" part="0" name="fluid" file="fluid_{number:06d}.vtu"/>')
    (folder / "solution.pvd").write_text(f"<VTKFile><Collection>{''.join(lines)}</Collection></VTKFile>")


def share_of_picture(file):
    """How much of it is not paper."""
    reader = vtk.vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)
    paper = [round(255 * share) for share in colours.rgb(colours.PAPER)]
    return (abs(pixels[:, :3] - paper).max(axis=1) > 8).mean()


if __name__ == "__main__":
    unittest.main()

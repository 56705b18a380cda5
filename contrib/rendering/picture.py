# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing one run, or two side by side, at one time into a picture."""
import vtk

from .actors import body_actors, obstacle_actors, particle_actor
from .camera import aim
from .colours import PAPER, WALL, Meaning, rgb
from .flow_actors import arrow_actors, stream_line_actors
from .fluid import fluid_props, particle_props
from .room import room_actors
from .scale import colour_scale, text

LETTERS = 26  # in the height of a picture
LETTERS_ACROSS = 42  # in its width at least, or scales would not have room for their names
FEWEST = 11  # pixels of a letter
BELOW = 3.9  # letters, for scales and time
ABOVE = 4.2  # letters, for words about two runs
KEY_LIGHT = (40, 35)  # degrees above and to the right of the camera
SCALES = 3  # places below a picture at least: for scales of the fluid, the time, scales of bodies


class Painter:
    """Draws one time after the other into files."""

    def __init__(self, extent, options, digits):
        """`digits`: of times, after the point."""
        self.extent, self.options, self.digits = extent, options, digits
        self.letter = max(FEWEST, round(min(options.height / LETTERS, options.width / LETTERS_ACROSS)))
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetAlphaBitPlanes(True)
        self.window.SetNumberOfLayers(2)
        self.window.SetSize(options.width, options.height)

    def meaning(self, part, field):
        return field and Meaning(part, field, self.extent.limits(part.is_bodies, field, self.options))

    def add_part(self, renderer, part):
        """Draw a part. Returns what its colours mean."""
        if part.is_obstacles:
            is_flat = self.extent.is_flat()
            for actor in ([particle_actor(part.data, part.spacing, None, is_flat, WALL)] if part.is_particles
                          else obstacle_actors(part.data, self.extent)):
                renderer.AddActor(actor)
            return []
        meaning = self.meaning(part, part.colour_field(self.options.field))
        meanings = [meaning] if meaning else []
        if part.is_particles:
            water = self.options.surface and part.is_fluid() and not self.options.field
            props = particle_props(part, None if water else meaning, self.extent, self.options)
            meanings = [] if water else meanings
        elif part.is_bodies:
            props = body_actors(part.warped(self.options.warp), meaning, self.extent)
        else:
            props = fluid_props(part, meaning, self.extent, self.options)
            meanings = meanings if props else []
        if part.is_fluid() and "velocity" in part.fields:
            props += self.flow_props(part, meanings)
        for prop in props:
            renderer.AddViewProp(prop)
        return meanings

    def flow_props(self, part, meanings):
        """Arrows and stream lines; what their colours mean is added."""
        props, planes = [], [] if self.extent.is_flat() else self.options.slice
        if self.options.vectors or self.options.streamlines:
            speed = self.meaning(part, "velocity")
            props += arrow_actors(part, speed, self.extent, planes) if self.options.vectors else []
            props += stream_line_actors(part, speed, self.extent, planes) if self.options.streamlines else []
            if not self.extent.is_flat() and not planes:
                meanings.append(speed)
        return props

    def view(self, parts, room, viewport):
        """A renderer with all parts, and what the colours in it mean."""
        renderer, meanings = vtk.vtkRenderer(), []
        renderer.SetBackground(*rgb(PAPER))
        renderer.SetViewport(*viewport)
        if room:
            for actor in room_actors(*room, self.extent.is_flat()):
                renderer.AddActor(actor)
        for part in parts:
            meanings += self.add_part(renderer, part)
        aspect = (viewport[2] - viewport[0]) * self.options.width / ((viewport[3] - viewport[1]) * self.options.height)
        aim(renderer.GetActiveCamera(), self.extent.corners(), self.extent.is_flat(), self.options, aspect)
        renderer.ResetCameraClippingRange()
        if not self.extent.is_flat():
            lights = vtk.vtkLightKit()
            lights.SetKeyLightAngle(*KEY_LIGHT)
            lights.SetKeyLightIntensity(1)
            lights.AddLightsToRenderer(renderer)
        renderer.UseFXAAOn()
        renderer.UseDepthPeelingOn()
        renderer.SetMaximumNumberOfPeels(8)
        return renderer, meanings

    def paint(self, views, time, file):
        """`views`: triples of parts, (bounds, open sides) of a domain or None, and the words above, from left to right."""
        width, height, letter = self.options.width, self.options.height, self.letter
        above = ABOVE * letter / height if any(words for _, _, words in views) else 0.01
        share = 1 / len(views)
        paper, legend = vtk.vtkRenderer(), vtk.vtkRenderer()  # behind and before all views
        paper.SetBackground(*rgb(PAPER))
        legend.SetLayer(1)
        renderers, meanings = [paper], {}
        for number, (parts, room, words) in enumerate(views):
            renderer, found = self.view(parts, room, (number * share, BELOW * letter / height, (number + 1) * share, 1 - above))
            meanings.update((meaning.key(), meaning) for meaning in found)
            renderers.append(renderer)
            if words:
                legend.AddActor2D(text(words, letter, (number + 0.5) * share * width, height - 0.85 * ABOVE * letter))
        self.add_legend(legend, list(meanings.values()), time)
        self.write(renderers + [legend], file)

    def add_legend(self, legend, meanings, time):
        """Below, from left to right: scales of fluids, the time, scales of bodies."""
        fluids = [meaning for meaning in meanings if not meaning.is_bodies]
        bodies = [meaning for meaning in meanings if meaning.is_bodies]
        places = max(SCALES, len(meanings) + 1)
        slot = self.options.width / places
        numbered = list(enumerate(fluids)) + list(enumerate(bodies, places - len(bodies)))
        for number, meaning in numbered:
            for actor in colour_scale(meaning, (number + 0.11) * slot, 0.78 * slot, self.letter):
                legend.AddActor2D(actor)
        middle = max(len(fluids), 1) + 0.5
        legend.AddActor2D(text(f"t = {time:.{self.digits}f} s", round(1.25 * self.letter), middle * slot, 1.6 * self.letter))

    def write(self, renderers, file):
        for renderer in renderers:
            self.window.AddRenderer(renderer)
        self.window.Render()
        picture = vtk.vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(str(file))
        writer.SetInputConnection(picture.GetOutputPort())
        writer.Write()
        for renderer in renderers:
            self.window.RemoveRenderer(renderer)

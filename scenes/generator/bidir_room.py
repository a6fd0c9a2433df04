"""bidir-room: spots and a lens."""
import math

from .meshes import attribute, header, revolve, spline, trianglemesh
from .pieces import diffuse, room, table


def bidir_room():
    text = header("""
A room lit by an uplighter, whose lamp sees only the ceiling, and by a spot light that shines on a
glass egg and throws a caustic on the table.
Good here: bdpt, which connects camera paths to the lit spots on ceiling and table. Blind here:
path tracing (the lamp hides in its shade, the spot light cannot be hit) and, for what is seen
through the egg, light tracing alone.""",
        384, 256, "bidir-room",
        'LookAt .05 1.6 -2.45  -.05 1.1 1  0 1 0\nCamera "perspective" "float fov" 48',
        'Sampler "sobol" "integer pixelsamples" 64', 'Integrator "bdpt" "integer maxdepth" 8')
    sides = room((-1.9, 1.9), (0, 2.5), (-3.1, 1.6))
    text += attribute(diffuse(.76, .75, .72), *(trianglemesh(sides[s])
                                                for s in ("back", "ceiling", "front")))
    text += attribute(diffuse(.42, .5, .4), trianglemesh(sides["left"]))
    text += attribute(diffuse(.55, .45, .36), trianglemesh(sides["right"]))
    text += attribute(diffuse(.36, .28, .22), trianglemesh(sides["floor"]))
    text += "# Uplighter: a foot, a pole and a cone with the lamp at its bottom, facing up.\n"
    cone = spline([(.05, 1.66), (.07, 1.7), (.17, 1.86), (.17, 1.86)], 2)
    text += attribute(
        "Translate -1.3 0 .95", diffuse(.12, .12, .13), trianglemesh(revolve(cone, 28)),
        trianglemesh(revolve([(0, 0), (.16, 0), (.16, 0), (.16, .02), (.16, .02), (.015, .03),
                              (.015, 1.66), (.05, 1.66)], 24)),
        "Translate 0 1.7 0\nRotate -90 1 0 0",
        'AreaLightSource "diffuse" "rgb L" [ 760 660 520 ]\nShape "disk" "float radius" .06')
    text += "# Table with a glass egg, a metal bowl and a ball.\n"
    text += attribute("Translate .25 0 .35\nRotate -6 0 1 0", diffuse(.45, .3, .17),
                      table(1.7, .9, .76, .07))
    egg = [(.15 * math.sin(a) * (1 + .2 * math.cos(a)), .2 - .2 * math.cos(a))
           for a in (math.pi * i / 24 for i in range(25))]
    text += attribute("Translate .25 .761 .2", 'Material "dielectric" "float eta" 1.5',
                      trianglemesh(revolve(egg, 40)))
    bowl = spline([(0, 0), (.08, 0), (.08, 0), (.16, .05), (.22, .13), (.22, .13), (.214, .13),
                   (.214, .13), (.15, .06), (0, .012)], 3)
    text += attribute("Translate .78 .76 .45",
                      'Material "conductor" "spectrum eta" "metal-Ag-eta" '
                      '"spectrum k" "metal-Ag-k" "float roughness" .02',
                      trianglemesh(revolve(bowl, 32)))
    text += attribute("Translate -.28 .86 .4", diffuse(.7, .3, .12),
                      'Shape "sphere" "float radius" .1')
    text += "# The spot light, in a can under the ceiling.\n"
    text += attribute('LightSource "spot" "point3 from" [ 1.35 2.3 -.55 ] '
                      '"point3 to" [ .25 .95 .2 ]\n'
                      '  "float coneangle" 8 "float conedeltaangle" 2 "rgb I" [ 30 29 27 ]')
    text += attribute("Translate 1.35 2.3 -.55\nRotate -55.7 0 1 0\nRotate 45.4 1 0 0",
                      'Material "conductor" "rgb reflectance" [ .5 .5 .5 ] "float roughness" .1',
                      'Shape "cylinder" "float radius" .06 "float zmin" -.1 "float zmax" .06',
                      'Shape "disk" "float radius" .06 "float height" -.1')
    return text

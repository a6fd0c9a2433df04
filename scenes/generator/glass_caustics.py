"""glass-caustics: a lamp inside glass."""
import math

from .meshes import attribute, circle, header, revolve, spline, trianglemesh
from .pieces import diffuse, room


def glass_caustics():
    text = header("""
A lamp in a glass bulb over glass things on a diffuse floor between coloured walls. All light
passes the bulb, and most things are seen through glass: specular - diffuse - specular paths.
Good here: pssmlt over bdpt. Blind here: direct light sampling (the bulb blocks every shadow ray)
and light tracing alone (what is seen through glass); path tracing meets the lamp by chance.""",
        432, 270, "glass-caustics",
        'LookAt 0 .95 -2.35  0 .48 0  0 1 0\nCamera "perspective" "float fov" 40',
        'Sampler "pssmlt" "integer mutationsperpixel" 60',
        'Integrator "bdpt" "integer maxdepth" 12')
    sides = room((-1.3, 1.3), (0, 1.7), (-2.6, 1.1))
    text += attribute(diffuse(.72, .7, .66), *(trianglemesh(sides[s])
                                               for s in ("floor", "back", "ceiling", "front")))
    text += attribute(diffuse(.62, .14, .1), trianglemesh(sides["left"]))
    text += attribute(diffuse(.12, .3, .55), trianglemesh(sides["right"]))
    text += "# The lamp: a glowing ball in a bulb of glass 8 mm thick, hung from the ceiling.\n"
    glass = 'Material "dielectric" "float eta" 1.5\n'
    text += attribute(
        "Translate -.1 1.2 .1", glass, 'Shape "sphere" "float radius" .14',
        attribute("ReverseOrientation", 'Shape "sphere" "float radius" .132'),
        attribute(diffuse(0, 0, 0), 'AreaLightSource "diffuse" "rgb L" [ 330 270 190 ]',
                  'Shape "sphere" "float radius" .04'),
        'Material "conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" "metal-Cu-k" '
        '"float roughness" .02',
        "Rotate -90 1 0 0",
        'Shape "cylinder" "float radius" .045 "float zmin" .145 "float zmax" .26',
        'Shape "disk" "float radius" .045 "float height" .145',
        'Shape "cylinder" "float radius" .006 "float zmin" .26 "float zmax" .5')
    text += "# A ball, a ring, a goblet, an egg of rough glass and a prism.\n"
    text += attribute("Translate .45 .2 -.25", glass, 'Shape "sphere" "float radius" .2')
    text += attribute("Translate -.62 .052 -.45", glass,
                      trianglemesh(revolve(circle(.2, .05, 20), 48, closed=True)))
    goblet = spline([(0, 0), (.12, 0), (.12, 0), (.122, .006), (.03, .03), (.014, .08), (.014, .2),
                     (.03, .235), (.11, .3), (.135, .4), (.12, .53), (.12, .53), (.113, .53),
                     (.113, .53), (.127, .4), (.1, .305), (.03, .25), (0, .246)], 2)
    text += attribute("Translate -.1 .001 -.2", 'Material "dielectric" "float eta" 1.45',
                      trianglemesh(revolve(goblet, 36)))
    egg = [(.16 * math.sin(a) * (1 + .22 * math.cos(a)), .22 - .22 * math.cos(a))
           for a in (math.pi * i / 18 for i in range(19))]
    text += attribute("Translate -.62 .001 .35",
                      'Material "dielectric" "float eta" 1.5 "float roughness" .01',
                      trianglemesh(revolve(egg, 32)))
    prism = ([(-.15, 0, -.12), (.15, 0, -.12), (.15, 0, .12), (-.15, 0, .12), (-.15, .24, 0),
              (.15, .24, 0)], None,
             [(0, 1, 2), (0, 2, 3), (0, 4, 5), (0, 5, 1), (3, 2, 5), (3, 5, 4), (0, 3, 4),
              (1, 5, 2)])
    text += attribute("Translate .68 .001 .42\nRotate 35 0 1 0", glass, trianglemesh(prism))
    return text

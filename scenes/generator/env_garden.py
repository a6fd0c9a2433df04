"""env-garden: environment light, instances, cut-outs."""
import math
import random

from .meshes import (add, attribute, box, cross, header, merge, mul, number, quad, revolve, spline,
                     sub, trianglemesh, unit)
from .pieces import diffuse


def blade(root, lean, length, width, turn):
    """A curved blade of grass: a strip of three segments, seen from both sides."""
    c, s = math.cos(turn), math.sin(turn)
    points = []
    for i in range(4):
        t = i / 3
        out, half = lean * t * t * length, width * (1 - t) / 2 + .0005
        y = length * t * (1 - .25 * lean * t)
        for side in (-half, half):
            points.append((root[0] + out * c - side * s, y, root[1] + out * s + side * c))
    return points, None, [f for i in range(0, 6, 2) for f in ((i, i + 1, i + 3), (i, i + 3, i + 2))]


def petals(count, length, height, tilt):
    """A flower's head: petals as lozenges around the y axis."""
    parts = []
    for i in range(count):
        a = 2 * math.pi * i / count
        c, s, w = math.cos(a), math.sin(a), math.pi * length / count * .8
        mid, top = (length * .6, height + tilt * .6), (length, height + tilt)
        parts.append(([(0, height, 0), (mid[0] * c - w * s, mid[1], mid[0] * s + w * c),
                       (top[0] * c, top[1], top[0] * s), (mid[0] * c + w * s, mid[1],
                                                          mid[0] * s - w * c)],
                      None, [(0, 1, 2), (0, 2, 3)]))
    return merge(parts)


GRASSES = 8


def grass(rng):
    """Tufts, named g0 to g7."""
    text = ""
    greens = ((.16, .34, .07), (.22, .4, .09), (.12, .27, .06), (.3, .4, .12))
    for k in range(GRASSES):
        parts = [blade((rng.uniform(-.05, .05), rng.uniform(-.05, .05)), rng.uniform(.3, 1.1),
                       rng.uniform(.1, .24), .012, rng.uniform(0, 2 * math.pi))
                 for _ in range(9)]
        text += (f'ObjectBegin "g{k}"\n' + diffuse(*greens[k % 4]) +
                 trianglemesh(merge(parts)) + "ObjectEnd\n")
    return text


def flowers():
    """Flowers, named f0 to f3."""
    text = ""
    kinds = (((.85, .12, .1), 6), ((.9, .75, .1), 9), ((.85, .85, .9), 11), ((.45, .2, .7), 5))
    for k, (color, count) in enumerate(kinds):
        stem = [blade((0, 0), .12, .36, .012, 0), blade((0, 0), .9, .2, .03, 2 + k),
                blade((0, 0), .8, .18, .03, 5 + k)]
        text += (f'ObjectBegin "f{k}"\n' + diffuse(.15, .32, .08) + trianglemesh(merge(stem)) +
                 diffuse(*color) + trianglemesh(petals(count, .07, .352, .03)) +
                 diffuse(.6, .4, .05) + attribute(
                     "Translate .01 .355 0", 'Shape "sphere" "float radius" .016') + "ObjectEnd\n")
    return text


def bush(rng):
    """A ball of leaves."""
    text = 'ObjectBegin "bush"\n' + diffuse(.1, .24, .07)
    leaves = []
    for i in range(260):
        y = 1 - 2 * (i + .5) / 260
        a, r = i * 2.399963, math.sqrt(1 - y * y)
        n = unit((r * math.cos(a), y + .25, r * math.sin(a)))
        center = (.42 * r * math.cos(a), .45 + .42 * y, .42 * r * math.sin(a))
        u = unit(cross(n, (rng.uniform(-1, 1), 1.3, rng.uniform(-1, 1))))
        v = cross(u, n)
        tip = add(add(center, mul(v, .16)), mul(n, rng.uniform(-.05, .05)))
        leaves.append(([center, add(add(center, mul(u, .04)), mul(v, .08)), tip,
                        add(sub(center, mul(u, .04)), mul(v, .08))], None, [(0, 1, 2), (0, 2, 3)]))
    text += trianglemesh(merge(leaves)) + "ObjectEnd\n"
    return text


def ground():
    """Soil, path, screen and bowl."""
    text = "\n# Ground, path of slabs, screen, bowl with glass balls.\n"
    text += attribute(diffuse(.2, .15, .09),
                      trianglemesh(quad((-30, 0, -6), (-30, 0, 60), (30, 0, 60), (30, 0, -6))))
    text += attribute('Material "diffuse" "texture reflectance" "slabs"',
                      trianglemesh(quad((-.45, .01, -5), (-.45, .01, 9), (.45, .01, 9),
                                        (.45, .01, -5)), ' "point2 uv" [ 0 0 0 1 1 1 1 0 ]'))
    text += attribute(diffuse(.5, .33, .2),
                      'Shape "bilinearmesh" "texture alpha" "holes"\n'
                      '"point3 P" [ -4 0 5.2  4 0 5.2  -4 2 5.2  4 2 5.2 ]\n'
                      '"point2 uv" [ 0 0 1 0 0 1 1 1 ]',
                      trianglemesh(merge([box((x - .05, x + .05), (0, 2.1), (5.21, 5.31))
                                          for x in (-4, -2, 0, 2, 4)])))
    bowl = spline([(0, 0), (.12, 0), (.12, 0), (.09, .06), (.1, .3), (.3, .42), (.36, .52),
                   (.36, .52), (.32, .52), (.32, .52), (.25, .44), (0, .4)], 2)
    text += attribute("Translate 0 .01 .1", diffuse(.66, .62, .55),
                      trianglemesh(revolve(bowl, 28)))
    text += attribute('Material "dielectric" "float eta" 1.33',
                      attribute("Translate -.1 .6 .02", 'Shape "sphere" "float radius" .15'),
                      'Material "conductor" "spectrum eta" "metal-Au-eta" '
                      '"spectrum k" "metal-Au-k" "float roughness" .002',
                      attribute("Translate .17 .57 .12", 'Shape "sphere" "float radius" .12'))
    return text


def rows_of_grass(rng):
    """Rows of plants, wider with the distance."""
    text = "\n# Rows of grass; each Translate steps from the plant before.\n"
    names = [f"g{k}" for k in range(GRASSES)]
    z = -3.2
    while z < 7.5:
        half = 1.1 + .62 * (z + 3.9)
        x, before, row = -half, (0.0, 0.0), []
        while x < half:
            place = (x + rng.uniform(-.05, .05), z + rng.uniform(-.06, .06))
            kind = rng.choice(names) if rng.random() > .06 else f"f{rng.randrange(4)}"
            if abs(place[0]) > .52:
                step = (round(place[0] - before[0], 2), round(place[1] - before[1], 2))
                row.append(f'Translate {number(step[0], 2)} 0 {number(step[1], 2)} '
                           f'ObjectInstance "{kind}"')
                before = add(before, step)
            x += .15 + .01 * (z + 3.2)
        text += attribute("\n".join(row))
        z += .105 + .018 * (z + 3.2) / 2
    return text


def bushes():
    """Where the bushes stand."""
    text = ""
    for x, z, scale, turn in ((-2.4, 3.4, 1.2, 0), (2.6, 3.9, 1.4, 80), (-3.4, 4.6, 1.5, 200),
                              (1.5, 4.7, 1, 120), (-1.1, 4.6, .9, 300), (3.6, 2.6, 1.1, 30)):
        text += attribute(f"Translate {x} 0 {z}\nRotate {turn} 0 1 0",
                          f"Scale {scale} {scale} {scale}", 'ObjectInstance "bush"')
    return text


def env_garden():
    text = header("""
A garden under a constant sky and a low sun: some 2800 instances of a dozen plants, a screen whose
holes are an alpha texture, and a lens focused on the bowl: instancing, alpha, depth of field.
Good here: path under sobol. Blind here: light tracing (light paths from a sky rarely reach a
small view); Metropolis gains nothing.""",
        480, 270, "env-garden",
        'LookAt 0 1.25 -4.2  0 .55 1.5  0 1 0\nCamera "perspective" "float fov" 36\n'
        '  "float lensradius" .035 "float focaldistance" 4.3',
        'Sampler "sobol" "integer pixelsamples" 64', 'Integrator "path" "integer maxdepth" 6')
    text += """LightSource "infinite" "rgb L" [ .38 .55 .85 ]
LightSource "distant" "rgb L" [ 3.4 2.7 1.9 ] "point3 from" [ -4 3.2 -1.5 ] "point3 to" [ 0 0 0 ]

Texture "holes" "float" "checkerboard" "float uscale" 56 "float vscale" 28
  "float tex1" 1 "float tex2" 0
Texture "slabs" "spectrum" "checkerboard" "float uscale" 3 "float vscale" 24
  "rgb tex1" [ .55 .53 .5 ] "rgb tex2" [ .42 .41 .4 ]

"""
    rng = random.Random(7)
    text += grass(rng) + flowers() + bush(rng) + ground()
    return text + rows_of_grass(rng) + bushes()

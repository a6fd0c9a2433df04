#!/usr/bin/env python3
"""Writes the larger scenes of this folder: door-ajar, glass-caustics, bidir-room, mis-plates,
env-garden. Deterministic; standard library only. Usage: python3 scenes/generate.py [folder]

Conventions are pbrt's: x right, y up, z into the picture (left-handed as seen by the camera),
lengths in metres, and a triangle's normal is cross(p1 - p0, p2 - p0), out of the solid.
"""
import math
import os
import random
import sys

from meshes import (add, attribute, box, circle, cross, header, merge, mul, number, quad, revolve,
                    spline, sub, trianglemesh, tube, unit)


# ---- shared pieces -------------------------------------------------------------------------------

def teapot():
    """A round pot about 0.2 m high: body with foot, lid with knob, spout, handle."""
    body = spline([(0, 0), (.06, 0), (.06, 0), (.064, .008), (.06, .014), (.094, .045), (.104, .08),
                   (.09, .118), (.062, .138), (.058, .142), (.052, .14), (.052, .135)], 3)
    lid = spline([(.05, .137), (.048, .146), (.028, .157), (.009, .162), (.008, .168), (.016, .177),
                  (.013, .188), (0, .192)], 3)
    spout = spline([(.08, .05), (.125, .066), (.146, .105), (.172, .142)], 4)
    taper = [.029 - .019 * (i / (len(spout) - 1)) ** .7 for i in range(len(spout))]
    handle = spline([(-.082, .115), (-.12, .138), (-.158, .118), (-.154, .078), (-.125, .048),
                     (-.092, .04)], 4)
    return "".join(trianglemesh(m) for m in (
        revolve(body, 30), revolve(lid, 20), tube(spout, taper, 12),
        tube(handle, [.009] * len(handle), 8)))


def table(width, depth, height, leg):
    """Table standing on y = 0, centred on the axis: one mesh."""
    parts = [box((-width / 2, width / 2), (height - .035, height), (-depth / 2, depth / 2)),
             box((-width / 2 + .06, width / 2 - .06), (height - .11, height - .035),
                 (-depth / 2 + .06, depth / 2 - .06))]
    for sx in (-1, 1):
        for sz in (-1, 1):
            x, z = sx * (width / 2 - .08), sz * (depth / 2 - .08)
            parts.append(box((x - leg / 2, x + leg / 2), (0, height - .11),
                             (z - leg / 2, z + leg / 2)))
    return trianglemesh(merge(parts))


def diffuse(r, g, b):
    return f'Material "diffuse" "rgb reflectance" [ {number(r)} {number(g)} {number(b)} ]\n'


def room(x, y, z):
    """The six sides of a room by name, normals inward."""
    def corner(i, j, k):
        return (x[i], y[j], z[k])
    return {"floor": quad(corner(0, 0, 0), corner(0, 0, 1), corner(1, 0, 1), corner(1, 0, 0)),
            "ceiling": quad(corner(0, 1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1)),
            "left": quad(corner(0, 0, 0), corner(0, 1, 0), corner(0, 1, 1), corner(0, 0, 1)),
            "right": quad(corner(1, 0, 0), corner(1, 0, 1), corner(1, 1, 1), corner(1, 1, 0)),
            "front": quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)),
            "back": quad(corner(0, 0, 1), corner(0, 1, 1), corner(1, 1, 1), corner(1, 0, 1))}


UV = ' "point2 uv" [ 0 0 1 0 1 1 0 1 ]'


# ---- door-ajar -----------------------------------------------------------------------------------

def door_ajar():
    text = header("""
A living room that is dark but for a door standing fourteen degrees open: behind it a lamp shines
on the next room's far wall, and all light comes from that bright patch through a gap 20 cm wide.
Good here: pssmlt over bdpt, whose chains stay on the paths through the gap once one is found.
Blind here: direct light sampling (no lamp is visible from this room); path tracing finds the
patch only by chance, and most light paths of plain bdpt never leave the lamp's room.""",
        480, 270, "door-ajar",
        'LookAt .3 1.5 -2.15  -.16 .95 2.4  0 1 0\nCamera "perspective" "float fov" 41',
        'Sampler "pssmlt" "integer mutationsperpixel" 40',
        'Integrator "bdpt" "integer maxdepth" 12')
    text += """Texture "tiles" "spectrum" "checkerboard" "float uscale" 10 "float vscale" 14
  "rgb tex1" [ .56 .42 .29 ] "rgb tex2" [ .30 .19 .11 ]
MakeNamedMaterial "boards" "string type" "diffuse" "texture reflectance" "tiles"
MakeNamedMaterial "varnish" "string type" "conductor" "rgb reflectance" [ .9 .9 .9 ]
  "float roughness" .01
MakeNamedMaterial "floor" "string type" "mix" "string materials" [ "boards" "varnish" ]
  "float amount" .1
MakeNamedMaterial "copper" "string type" "conductor" "spectrum eta" "metal-Cu-eta"
  "spectrum k" "metal-Cu-k" "float roughness" .012
MakeNamedMaterial "brass" "string type" "conductor" "spectrum eta" "metal-Au-eta"
  "spectrum k" "metal-Au-k" "float roughness" .03
MakeNamedMaterial "glass" "string type" "dielectric" "float eta" 1.5

"""
    here = room((-2.2, 2.2), (0, 2.6), (-3.2, 2.4))
    there = room((-3.8, .4), (0, 2.6), (2.52, 4.9))
    wall = diffuse(.74, .71, .64)
    text += "# This room; its back wall is a slab with the doorway cut out.\n"
    text += attribute('NamedMaterial "floor"',
                      trianglemesh(quad((-3.8, 0, -3.2), (-3.8, 0, 4.9), (2.2, 0, 4.9),
                                        (2.2, 0, -3.2)), UV))
    text += attribute(diffuse(.8, .8, .78), trianglemesh(here["ceiling"]))
    text += attribute(diffuse(.32, .44, .52), trianglemesh(here["left"]))
    text += attribute(diffuse(.66, .36, .25), trianglemesh(here["right"]))
    text += attribute(wall, trianglemesh(here["front"]), trianglemesh(merge([
        box((-3.8, -1.9), (0, 2.6), (2.4, 2.52)), box((-1, 2.2), (0, 2.6), (2.4, 2.52)),
        box((-1.9, -1), (2.05, 2.6), (2.4, 2.52))])))
    text += "# Skirting boards and the door's frame.\n"
    text += attribute(diffuse(.78, .77, .74), trianglemesh(merge([
        box((-.9, 2.2), (0, .1), (2.382, 2.399)), box((2.182, 2.199), (0, .1), (-3.2, 2.38)),
        box((-2.199, -2.182), (0, .1), (-3.2, 2.38)), box((-2.18, -2), (0, .1), (2.382, 2.399)),
        box((-2, -1.9), (0, 2.15), (2.375, 2.399)), box((-1, -.9), (0, 2.15), (2.375, 2.399)),
        box((-1.9, -1), (2.05, 2.15), (2.375, 2.399))])))
    text += "# The door: hinges on its right, opens into the next room.\n"
    panels = [box((-.892, -.006), (.008, 2.044), (-.018, .018))]
    for y in ((.18, .9), (1.06, 1.9)):
        for x in ((-.8, -.49), (-.41, -.1)):
            panels.append(box(x, y, (-.026, -.0181)))
    text += attribute("Translate -1 0 2.5\nRotate 14 0 1 0", diffuse(.82, .8, .75),
                      trianglemesh(merge(panels)),
                      'NamedMaterial "brass"\n' + attribute(
                          'Translate -.845 1 -.065\nShape "sphere" "float radius" .032\n'
                          'Shape "cylinder" "float radius" .012 "float zmin" 0 "float zmax" .05'))
    text += "# The next room, and the lamp that shines on its left wall out of a dark shade.\n"
    text += attribute(diffuse(.82, .8, .76), *(trianglemesh(there[s])
                                                for s in ("ceiling", "left", "right", "back")))
    text += attribute(
        "Translate -3.22 1.75 4.1\nRotate -90 0 1 0", diffuse(.1, .1, .1),
        'Shape "cylinder" "float radius" .1 "float zmin" -.06 "float zmax" .2',
        "Translate 0 0 -.02", 'Shape "disk" "float radius" .1 "float height" -.02',
        'AreaLightSource "diffuse" "rgb L" [ 260 228 180 ] "float scale" 200',
        'Shape "disk" "float radius" .085')
    text += "# Table and what stands on it.\n"
    text += attribute("Translate .42 0 .75\nRotate 8 0 1 0", diffuse(.36, .2, .1),
                      table(1.5, .9, .74, .06))
    text += attribute('Translate .2 .74 .72\nRotate 200 0 1 0\nScale 1.35 1.35 1.35',
                      'NamedMaterial "copper"', teapot())
    text += attribute('Translate .62 .85 .56', 'NamedMaterial "glass"',
                      'Shape "sphere" "float radius" .11')
    vase = spline([(0, 0), (.05, 0), (.05, 0), (.08, .05), (.1, .13), (.07, .23), (.036, .29),
                   (.052, .345), (.055, .35), (.055, .35), (.05, .35), (.05, .35), (.03, .29),
                   (.03, .2)], 2)
    text += attribute('Translate .93 .74 .95', diffuse(.12, .27, .5),
                      trianglemesh(revolve(vase, 24)))
    cup = spline([(0, 0), (.03, 0), (.03, 0), (.04, .02), (.047, .078), (.047, .078), (.044, .078),
                  (.044, .078), (.036, .02), (0, .012)], 2)
    text += attribute('Translate -.12 .74 .5', diffuse(.85, .84, .8),
                      trianglemesh(revolve(cup, 18)))
    text += "# A picture in a gilt frame, a stool and a tall jar.\n"
    frame = [box((-.62, .62), (.4, .46), (-.035, 0)), box((-.62, .62), (-.46, -.4), (-.035, 0)),
             box((-.62, -.56), (-.4, .4), (-.035, 0)), box((.56, .62), (-.4, .4), (-.035, 0))]
    paint = [((-.56, .56), (-.4, .4), (.84, .8, .7)), ((-.5, -.05), (-.33, .08), (.62, .16, .1)),
             ((-.22, .36), (-.12, .32), (.13, .25, .46)), ((.1, .5), (-.34, .02), (.85, .6, .13))]
    text += attribute("Translate .62 1.58 2.398", 'NamedMaterial "brass"',
                      trianglemesh(merge(frame)), *(
                          diffuse(*color) + trianglemesh(quad(
                              (x[0], y[0], -.01 - .002 * i), (x[0], y[1], -.01 - .002 * i),
                              (x[1], y[1], -.01 - .002 * i), (x[1], y[0], -.01 - .002 * i)))
                          for i, (x, y, color) in enumerate(paint)))
    text += attribute('Translate -1.35 0 .55', diffuse(.5, .13, .1),
                      trianglemesh(revolve(spline(
                          [(0, .42), (.2, .42), (.2, .42), (.22, .45), (.2, .49), (0, .5)],
                          2), 24)),
                      diffuse(.3, .17, .09), trianglemesh(merge(
                          [box((x - .02, x + .02), (0, .42), (z - .02, z + .02))
                           for x in (-.13, .13) for z in (-.13, .13)])))
    jar = spline([(0, 0), (.11, 0), (.11, 0), (.17, .12), (.2, .35), (.15, .58), (.09, .68),
                  (.12, .765), (.12, .765), (.1, .765), (.1, .765), (.08, .68), (.08, .5)], 2)
    text += attribute('Translate 1.72 0 1.85', diffuse(.62, .3, .16),
                      trianglemesh(revolve(jar, 24)))
    return text


# ---- glass-caustics ------------------------------------------------------------------------------

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


# ---- bidir-room ----------------------------------------------------------------------------------

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


# ---- mis-plates ----------------------------------------------------------------------------------

def mis_plates():
    text = header("""
Four metal plates of roughness (GGX alpha) 0.005, 0.02, 0.05 and 0.1 reflect five ball lamps of
equal power and radius 0.03 to 0.9. Small lamps on rough plates need light sampling, large lamps
on smooth plates need BSDF sampling. Good here: multiple importance sampling (path, bdpt).
Blind here: either of the two samplings alone; light tracing for the mirror-like plates.""",
        480, 270, "mis-plates",
        'LookAt 0 2.4 -12  0 1.45 0  0 1 0\nCamera "perspective" "float fov" 27',
        'Sampler "sobol" "integer pixelsamples" 64', 'Integrator "path" "integer maxdepth" 5')
    text += attribute(diffuse(.4, .4, .4),
                      trianglemesh(quad((-20, -.6, -14), (-20, -.6, 6), (20, -.6, 6),
                                        (20, -.6, -14))),
                      trianglemesh(quad((-20, -.6, 6), (-20, 12, 6), (20, 12, 6), (20, -.6, 6))))
    lamps = (0, 4.1, 2.6)
    eye = (0, 2.4, -12)
    text += "# Each plate's normal halves the angle between the camera and the row of lamps.\n"
    for alpha, center in ((.005, (0, 2.25, 1.9)), (.02, (0, 1.42, .9)), (.05, (0, .72, -.3)),
                          (.1, (0, .15, -1.7))):
        n = unit(add(unit(sub(eye, center)), unit(sub(lamps, center))))
        up = unit(cross(n, (1, 0, 0)))
        up = up if up[1] > 0 else mul(up, -1)
        half = .42
        low, high = sub(center, mul(up, half)), add(center, mul(up, half))
        text += attribute(
            f'Material "conductor" "rgb reflectance" [ .8 .8 .82 ] "float roughness" {alpha}',
            '  "bool remaproughness" false',
            trianglemesh(quad((-3.6, *low[1:]), (-3.6, *high[1:]), (3.6, *high[1:]),
                              (3.6, *low[1:]))))
    text += "# Lamps: L = power / (4 pi^2 r^2), 60 W each in every channel's share.\n"
    colors = ((1, .45, .3), (1, .85, .4), (.5, 1, .5), (.4, .8, 1), (.8, .5, 1))
    for x, r, color in zip((-3.2, -1.85, -.55, 1.0, 3.0), (.03, .1, .25, .5, .9), colors):
        radiance = 60 / (4 * math.pi ** 2 * r * r)
        light = " ".join(number(c * radiance, 3) for c in color)
        text += attribute(f"Translate {number(x)} 4.1 2.6",
                          f'AreaLightSource "diffuse" "rgb L" [ {light} ]',
                          f'Shape "sphere" "float radius" {r}')
    return text


# ---- env-garden ----------------------------------------------------------------------------------

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
    greens = ((.16, .34, .07), (.22, .4, .09), (.12, .27, .06), (.3, .4, .12))
    names = []
    for k in range(8):
        parts = [blade((rng.uniform(-.05, .05), rng.uniform(-.05, .05)), rng.uniform(.3, 1.1),
                       rng.uniform(.1, .24), .012, rng.uniform(0, 2 * math.pi))
                 for _ in range(9)]
        names.append(f"g{k}")
        text += (f'ObjectBegin "g{k}"\n' + diffuse(*greens[k % 4]) +
                 trianglemesh(merge(parts)) + "ObjectEnd\n")
    flowers = (((.85, .12, .1), 6), ((.9, .75, .1), 9), ((.85, .85, .9), 11), ((.45, .2, .7), 5))
    for k, (color, count) in enumerate(flowers):
        stem = [blade((0, 0), .12, .36, .012, 0), blade((0, 0), .9, .2, .03, 2 + k),
                blade((0, 0), .8, .18, .03, 5 + k)]
        text += (f'ObjectBegin "f{k}"\n' + diffuse(.15, .32, .08) + trianglemesh(merge(stem)) +
                 diffuse(*color) + trianglemesh(petals(count, .07, .352, .03)) +
                 diffuse(.6, .4, .05) + attribute(
                     "Translate .01 .355 0", 'Shape "sphere" "float radius" .016') + "ObjectEnd\n")
    leaf = spline([(0, 0), (.035, .05), (.03, .1), (0, .16)], 3)
    text += 'ObjectBegin "bush"\n' + diffuse(.1, .24, .07)
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

    text += "\n# Ground, path of slabs, screen, bowl with glass balls.\n"
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
    text += "\n# Rows of grass; each Translate steps from the plant before.\n"
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
    for x, z, scale, turn in ((-2.4, 3.4, 1.2, 0), (2.6, 3.9, 1.4, 80), (-3.4, 4.6, 1.5, 200),
                              (1.5, 4.7, 1, 120), (-1.1, 4.6, .9, 300), (3.6, 2.6, 1.1, 30)):
        text += attribute(f"Translate {x} 0 {z}\nRotate {turn} 0 1 0",
                          f"Scale {scale} {scale} {scale}", 'ObjectInstance "bush"')
    return text


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for name, scene in (("door-ajar", door_ajar), ("glass-caustics", glass_caustics),
                        ("bidir-room", bidir_room), ("mis-plates", mis_plates),
                        ("env-garden", env_garden)):
        text = scene()
        with open(os.path.join(folder, name + ".txt"), "w", encoding="ascii", newline="\n") as file:
            file.write(text)
        print(f"{name}.txt: {len(text) // 1000} kB")


if __name__ == "__main__":
    main()

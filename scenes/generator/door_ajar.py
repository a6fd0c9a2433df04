"""door-ajar: light through a narrow opening."""
from .meshes import attribute, box, header, merge, quad, revolve, spline, trianglemesh
from .pieces import UV, diffuse, room, table, teapot


def this_room():
    """The room that the camera stands in, with the doorway."""
    here = room((-2.2, 2.2), (0, 2.6), (-3.2, 2.4))
    wall = diffuse(.74, .71, .64)
    text = "# This room; its back wall is a slab with the doorway cut out.\n"
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
    return text


def door():
    """The door itself, ajar."""
    text = "# The door: hinges on its right, opens into the next room.\n"
    panels = [box((-.892, -.006), (.008, 2.044), (-.018, .018))]
    for y in ((.18, .9), (1.06, 1.9)):
        for x in ((-.8, -.49), (-.41, -.1)):
            panels.append(box(x, y, (-.026, -.0181)))
    text += attribute("Translate -1 0 2.5\nRotate 14 0 1 0", diffuse(.82, .8, .75),
                      trianglemesh(merge(panels)),
                      'NamedMaterial "brass"\n' + attribute(
                          'Translate -.845 1 -.065\nShape "sphere" "float radius" .032\n'
                          'Shape "cylinder" "float radius" .012 "float zmin" 0 "float zmax" .05'))
    return text


def next_room():
    """The only light."""
    there = room((-3.8, .4), (0, 2.6), (2.52, 4.9))
    text = "# The next room, and the lamp that shines on its left wall out of a dark shade.\n"
    text += attribute(diffuse(.82, .8, .76), *(trianglemesh(there[s])
                                                for s in ("ceiling", "left", "right", "back")))
    text += attribute(
        "Translate -3.22 1.75 4.1\nRotate -90 0 1 0", diffuse(.1, .1, .1),
        'Shape "cylinder" "float radius" .1 "float zmin" -.06 "float zmax" .2',
        "Translate 0 0 -.02", 'Shape "disk" "float radius" .1 "float height" -.02',
        'AreaLightSource "diffuse" "rgb L" [ 260 228 180 ] "float scale" 200',
        'Shape "disk" "float radius" .085')
    return text


def table_set():
    """Copper, glass and porcelain."""
    text = "# Table and what stands on it.\n"
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
    return text


def decoration():
    """What shows the light on other materials."""
    text = "# A picture in a gilt frame, a stool and a tall jar.\n"
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
    return text + this_room() + door() + next_room() + table_set() + decoration()

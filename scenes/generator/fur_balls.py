"""fur-balls: hair on curves, lit from the side and from behind."""
import math
import random

from .meshes import header, number

HAIRS = 230
TURNS = 16  # instances of a ball's hairs, turned differently


def hairs(rng, length, curl):
    """Curves that leave the unit sphere's surface and curl to one side."""
    text = ""
    for _ in range(HAIRS):
        z = rng.uniform(-1, 1)
        a, r = rng.uniform(0, 2 * math.pi), math.sqrt(1 - z * z)
        n = (r * math.cos(a), z, r * math.sin(a))
        side = (-n[2], rng.uniform(-.3, .3), n[0])
        points = []
        for i, out in enumerate((.95, 1.12, 1.3, 1.38)):
            reach = 1 + (out - 1) * length * rng.uniform(.85, 1.1)
            bend = curl * (i / 3) ** 2 * rng.uniform(.8, 1.2)
            points += [reach * n[k] + bend * side[k] for k in range(3)]
        points[-2] -= .12 * length  # they hang
        text += 'Shape "curve" "point3 P" [' + " ".join(number(p) for p in points) + "]\n"
    return text


def fur_balls():
    rng = random.Random(8)
    text = header(
        """
Three balls of fur: some 11000 curves with the material hair, dark by pigments, blond and red by
their colours, between a lamp and a light behind them.
Good here: path, bdpt. Blind here: whitted, since fibres light one another.
""", 480, 270, "fur-balls",
        'LookAt 0 1.1 -5  0 .52 0  0 1 0\nCamera "perspective" "float fov" 28',
        'Sampler "sobol" "integer pixelsamples" 256', 'Integrator "path" "integer maxdepth" 12')
    text += """LightSource "infinite" "rgb L" [ .2 .25 .35 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 90 82 70 ]
  Translate -2.5 3.6 -4
  Shape "sphere" "float radius" .7
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 40 43 50 ]
  Translate 1.5 3 4
  Shape "sphere" "float radius" .35
AttributeEnd
Material "diffuse" "rgb reflectance" [ .4 .38 .36 ]
Shape "bilinearmesh" "point3 P" [ -9 0 9  9 0 9  -9 0 -9  9 0 -9 ]

"""
    kinds = (("brown", '"float eumelanin" 1', 1, .12),
             ("blond", '"float eumelanin" .2 "float pheomelanin" .15 "float beta_m" .25', 1.35, .3),
             ("red", '"rgb reflectance" [ .75 .2 .08 ] "float beta_n" .4', .8, .05))
    for name, colour, length, curl in kinds:
        text += f'ObjectBegin "{name}"\nAttribute "shape" "float width0" .022 "float width1" .006\n'
        text += f'Material "hair" {colour}\n' + hairs(rng, length, curl)
        text += "ObjectEnd\n"
    for i, (name, *_) in enumerate(kinds):
        text += f'AttributeBegin\n  Translate {number(1.35 * (i - 1))} .56 {number(.2 * (i % 2))}\n'
        text += '  Scale .42 .42 .42\n'
        text += '  Material "diffuse" "rgb reflectance" [ .1 .07 .05 ]\n'
        text += '  Shape "sphere" "float radius" .97\n'
        for _ in range(TURNS):
            axis = " ".join(number(rng.uniform(-1, 1)) for _ in range(3))
            text += (f'  AttributeBegin\n    Rotate {number(rng.uniform(-40, 40))} {axis}\n'
                     f'    Rotate {number(rng.uniform(0, 360))} 0 1 0\n'
                     f'    ObjectInstance "{name}"\n  AttributeEnd\n')
        text += "AttributeEnd\n"
    return text

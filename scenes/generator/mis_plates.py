"""mis-plates: plates of different roughness under lamps of different size."""
import math

from .meshes import add, attribute, cross, header, mul, number, quad, sub, trianglemesh, unit
from .pieces import diffuse


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

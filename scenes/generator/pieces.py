"""Pieces that several scenes share."""
from .meshes import box, merge, number, quad, revolve, spline, trianglemesh, tube


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

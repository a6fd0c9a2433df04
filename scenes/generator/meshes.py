"""Meshes and their text, for the scenes. Standard library only.

A mesh is (points, normals or None, triangles); a triangle's normal is cross(p1 - p0, p2 - p0), out
of the solid.
"""
import math


# ---- text ----------------------------------------------------------------------------------------

def number(x, digits=4):
    text = f"{x:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    if text in ("", "-", "-0"):
        return "0"
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text


def numbers(rows, digits=4):
    """Rows of numbers as text, broken into lines of at most about 100 columns."""
    lines, line = [], ""
    for row in rows:
        item = " ".join(number(x, digits) for x in row)
        if line and len(line) + len(item) > 95:
            lines.append(line)
            line = ""
        line += (" " if line else "") + item
    lines.append(line)
    return "\n".join(lines)


def trianglemesh(mesh, extra=""):
    points, normals, faces = mesh
    text = f'Shape "trianglemesh"{extra}\n"point3 P" [\n{numbers(points)} ]\n'
    if normals:
        text += f'"normal N" [\n{numbers(normals, 3)} ]\n'
    return text + f'"integer indices" [\n{numbers(faces, 0)} ]\n'


def attribute(*parts):
    return "AttributeBegin\n" + "".join(p.rstrip("\n") + "\n" for p in parts) + "AttributeEnd\n"


def header(comment, width, height, filename, camera, sampler, integrator, pixel_filter="gaussian"):
    text = "".join(f"# {line}".rstrip() + "\n" for line in comment.strip().split("\n"))
    text += "# Written by scenes/generate.py.\n\n"
    text += f'Film "rgb" "integer xresolution" {width} "integer yresolution" {height}\n'
    text += f'  "string filename" "{filename}.exr"\nPixelFilter "{pixel_filter}"\n'
    return text + f"{camera}\n{sampler}\n{integrator}\n\nWorldBegin\n\n"


# ---- vectors -------------------------------------------------------------------------------------

def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def mul(a, s):
    return tuple(x * s for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return mul(a, 1 / length) if length > 0 else (0.0, 1.0, 0.0)


# ---- meshes: (points, normals or None, triangles) ------------------------------------------------

def quad(a, b, c, d):
    """Normal along cross(b - a, d - a)."""
    return [a, b, c, d], None, [(0, 1, 2), (0, 2, 3)]


def box(x, y, z):
    """Axis-aligned box, normals outward; x, y, z are (low, high)."""
    p = [(x[i & 1], y[i >> 1 & 1], z[i >> 2 & 1]) for i in range(8)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3)]
    return p, None, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]


def merge(meshes):
    points, faces = [], []
    for p, _, f in meshes:
        faces += [tuple(i + len(points) for i in t) for t in f]
        points += p
    return points, None, faces


def skin(rings, closed=False):
    """Joins rings of points (each n points, or one for a pole) into a surface with smooth normals.
    Two equal neighbouring rings make a crease."""
    points, start = [], []
    for ring in rings:
        start.append(len(points))
        points += ring
    faces = []
    for i in range(len(rings) if closed else len(rings) - 1):
        k = (i + 1) % len(rings)
        low, high = rings[i], rings[k]
        if low == high:
            continue
        n = max(len(low), len(high))
        for j in range(n):
            a, b = start[i] + j % len(low), start[i] + (j + 1) % len(low)
            c, d = start[k] + j % len(high), start[k] + (j + 1) % len(high)
            faces += [(a, c, b)] if a != b else []
            faces += [(b, c, d)] if c != d else []
    normals = [(0.0, 0.0, 0.0)] * len(points)
    for f in faces:
        a, b, c = (points[i] for i in f)
        n = cross(sub(b, a), sub(c, a))
        for i in f:
            normals[i] = add(normals[i], n)
    return points, [unit(n) for n in normals], faces


def revolve(profile, segments, closed=False):
    """Turns a profile of (radius, height) about the y axis. Going up its outer side, the normals
    point away from the axis."""
    rings = []
    for r, y in profile:
        angles = [2 * math.pi * j / segments for j in range(segments)] if r > 1e-6 else [0]
        rings.append([(r * math.cos(a), y, r * math.sin(a)) for a in angles])
    return skin(rings, closed)


def tube(path, radii, segments):
    """A tube of given radii around a curve in the plane z = 0; open ends."""
    rings = []
    for i, (x, y) in enumerate(path):
        before, after = path[max(i - 1, 0)], path[min(i + 1, len(path) - 1)]
        tx, ty, _ = unit((after[0] - before[0], after[1] - before[1], 0))
        ring = []
        for j in range(segments):
            a = 2 * math.pi * j / segments
            ring.append((x + radii[i] * math.cos(a) * ty, y - radii[i] * math.cos(a) * tx,
                         radii[i] * math.sin(a)))
        rings.append(ring)
    return skin(rings)


def spline(knots, steps):
    """Catmull-Rom curve through the knots; a knot given twice is a corner."""
    out = []
    for i in range(len(knots) - 1):
        p1, p2 = knots[i], knots[i + 1]
        if p1 == p2:
            out.append(p1)
            continue
        p0 = knots[i - 1] if i > 0 and knots[i - 1] != p1 else p1
        p3 = knots[i + 2] if i + 2 < len(knots) and knots[i + 2] != p2 else p2
        for s in range(steps):
            t = s / steps
            out.append(tuple(
                0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t
                       + (3 * b - a - 3 * c + d) * t ** 3)
                for a, b, c, d in zip(p0, p1, p2, p3)))
    return out + [knots[-1]]


def circle(radius, tube_radius, steps):
    """Profile of a torus, for revolve(..., closed=True)."""
    return [(radius + tube_radius * math.cos(2 * math.pi * i / steps),
             tube_radius * math.sin(2 * math.pi * i / steps)) for i in range(steps)]

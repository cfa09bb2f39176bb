"""Shapes that furniture and rooms are made of: boxes, prisms, lathes, tubes, cushions, free surfaces.

A Shape is a bag of triangles without a material: vertices (position, normal, uv), counter-clockwise from the front.
Metres, Y up. Standard library only.
"""
import math

TAU = 2 * math.pi


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    l = length(a)
    return (a[0] / l, a[1] / l, a[2] / l)


class Shape:
    def __init__(self, vertices=(), triangles=()):
        self.vertices = list(vertices)  # (position, normal, uv)
        self.triangles = list(triangles)

    def add(self, *others):
        for other in others:
            first = len(self.vertices)
            self.vertices += other.vertices
            self.triangles += [(a + first, b + first, c + first) for a, b, c in other.triangles]
        return self

    def mapped(self, point, direction):
        return Shape([(point(p), direction(n), t) for p, n, t in self.vertices], self.triangles)

    def moved(self, x=0.0, y=0.0, z=0.0):
        return self.mapped(lambda p: (p[0] + x, p[1] + y, p[2] + z), lambda n: n)

    def turned(self, axis, degrees):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        i, j = {'x': (1, 2), 'y': (2, 0), 'z': (0, 1)}[axis]

        def turn(v):
            w = list(v)
            w[i], w[j] = c * v[i] - s * v[j], s * v[i] + c * v[j]
            return tuple(w)

        return self.mapped(turn, turn)

    def scaled(self, x, y=None, z=None):
        y = x if y is None else y
        z = x if z is None else z
        return self.mapped(lambda p: (p[0] * x, p[1] * y, p[2] * z), lambda n: unit((n[0] / x, n[1] / y, n[2] / z)))

    def laid(self, width, depth):
        """uv as seen from above, a picture of `width` by `depth` repeated."""
        return Shape([(p, n, (p[0] / width, p[2] / depth)) for p, n, _ in self.vertices], self.triangles)

    def flipped(self):
        return Shape([(p, times(n, -1), t) for p, n, t in self.vertices], [(a, c, b) for a, b, c in self.triangles])


def polygon(points, uv=None):
    """A flat convex polygon, counter-clockwise from the front."""
    normal = (0, 0, 0)
    for i in range(len(points)):  # Newell's normal
        normal = add(normal, cross(points[i], points[(i + 1) % len(points)]))
    normal = unit(normal)
    uv = uv or [(0.0, 0.0)] * len(points)
    return Shape([(p, normal, t) for p, t in zip(points, uv)], [(0, i, i + 1) for i in range(1, len(points) - 1)])


PICTURE_UV = [(0, 1), (1, 1), (1, 0), (0, 0)]  # of a quad given from its lower left corner


def rectangle(corner, side, up, uv=None):
    return polygon([corner, add(corner, side), add(add(corner, side), up), add(corner, up)], uv)


def box(low, high, without=()):
    """An axis-aligned box. `without` leaves out faces that lie on something: any of -x +x -y +y -z +z."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    assert x0 < x1 and y0 < y1 and z0 < z1, (low, high)
    faces = {
        '-x': [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
        '+x': [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
        '-y': [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        '+y': [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
        '-z': [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
        '+z': [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
    }
    return Shape().add(*[polygon(points, PICTURE_UV) for name, points in faces.items() if name not in without])


def bevelled(width, height, depth, bevel):
    """A box around the origin whose edges and corners are cut off; its faces stay flat."""
    half = (width / 2, height / 2, depth / 2)

    def corner(signs, whole):
        return tuple(s * (h if k == whole else h - bevel) for k, (s, h) in enumerate(zip(signs, half)))

    def outwards(points):
        middle = (0, 0, 0)
        for p in points:
            middle = add(middle, p)
        shape = polygon(points)
        return shape if dot(shape.vertices[0][1], middle) > 0 else polygon(points[::-1])

    shape = Shape()
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        for s in (-1, 1):
            ring = []
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                signs = [0, 0, 0]
                signs[k], signs[i], signs[j] = s, a, b
                ring.append(tuple(signs))
            shape.add(outwards([corner(signs, k) for signs in ring]))
        for a in (-1, 1):
            for b in (-1, 1):
                ends = []
                for s in (-1, 1):
                    signs = [0, 0, 0]
                    signs[k], signs[i], signs[j] = s, a, b
                    ends.append(tuple(signs))
                shape.add(outwards([corner(ends[0], i), corner(ends[1], i), corner(ends[1], j), corner(ends[0], j)]))
    for x in (-1, 1):
        for y in (-1, 1):
            for z in (-1, 1):
                shape.add(outwards([corner((x, y, z), k) for k in range(3)]))
    return shape


def block(width, height, depth, x=0.0, y=0.0, z=0.0, without=()):
    """A box that stands on y, centred on x and z."""
    return box((x - width / 2, y, z - depth / 2), (x + width / 2, y + height, z + depth / 2), without)


def surface(rows, closed_u=False, closed_v=False, flip=False, uv=None):
    """A smooth surface through a grid of points rows[v][u]; normals from the grid, poles (a row in one point) closed without
    degenerate triangles. The front is where u runs to the right and v up."""
    nv, nu = len(rows), len(rows[0])

    def at(v, u):
        v = v % nv if closed_v else min(max(v, 0), nv - 1)
        u = u % nu if closed_u else min(max(u, 0), nu - 1)
        return rows[v][u]

    pole = [all(length(sub(p, row[0])) < 1e-7 for p in row) for row in rows]
    vertices, index = [], {}
    for v in range(nv):
        for u in range(1 if pole[v] else nu):
            if pole[v]:
                other = rows[v + 1] if v == 0 else rows[v - 1]
                around = [sub(p, rows[v][0]) for p in other]
                normal = (0, 0, 0)
                for k in range(nu if closed_u else nu - 1):
                    normal = add(normal, cross(around[k], around[(k + 1) % nu]))
                normal = times(unit(normal), -1 if v == 0 else 1)
            else:
                normal = unit(cross(sub(at(v, u + 1), at(v, u - 1)), sub(at(v + 1, u), at(v - 1, u))))
            index[v, u] = len(vertices)
            t = uv(u / (nu if closed_u else nu - 1), v / (nv if closed_v else nv - 1)) if uv else (0.0, 0.0)
            vertices.append((rows[v][u], normal, t))
    triangles = []
    for v in range(nv if closed_v else nv - 1):
        for u in range(nu if closed_u else nu - 1):
            v1, u1 = (v + 1) % nv, (u + 1) % nu
            a, b = index[v, 0 if pole[v] else u], index[v, 0 if pole[v] else u1]
            c, d = index[v1, 0 if pole[v1] else u1], index[v1, 0 if pole[v1] else u]
            if not pole[v]:
                triangles.append((a, b, c))
            if not pole[v1]:
                triangles.append((a, c, d))
    shape = Shape(vertices, triangles)
    return shape.flipped() if flip else shape


def lathe(profile, sides=20, sharp=35):
    """A surface of revolution about y. `profile` is (radius, y) from the top of the outside downwards (or once around for
    a ring: closed when first equals last). Edges sharper than `sharp` degrees stay sharp."""
    closed = profile[0] == profile[-1]
    pieces, piece = [], [profile[0]]

    def turn(a, b, c):
        u, w = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
        cosine = (u[0] * w[0] + u[1] * w[1]) / (math.hypot(*u) * math.hypot(*w))
        return math.degrees(math.acos(max(-1, min(1, cosine))))

    for i in range(1, len(profile) - 1):
        piece.append(profile[i])
        if turn(profile[i - 1], profile[i], profile[i + 1]) > sharp:
            pieces.append(piece)
            piece = [profile[i]]
    piece.append(profile[-1])
    pieces.append(piece)
    shape = Shape()
    for piece in pieces:
        vertices, rings = [], []
        for k, (r, y) in enumerate(piece):
            before, after = piece[max(k - 1, 0)], piece[min(k + 1, len(piece) - 1)]
            if closed and len(pieces) == 1 and k in (0, len(piece) - 1):
                before, after = piece[-2], piece[1]
            d = (after[0] - before[0], after[1] - before[1])
            l = math.hypot(*d)
            nr, ny = -d[1] / l, d[0] / l  # outwards when the profile runs downwards
            ring = []
            if r < 1e-9:
                ring = [len(vertices)] * sides
                vertices.append(((0.0, y, 0.0), (0.0, math.copysign(1, ny), 0.0), (0.5, 0.5)))
            else:
                for s in range(sides):
                    a = TAU * s / sides
                    c, z = math.cos(a), math.sin(a)
                    ring.append(len(vertices))
                    vertices.append(((r * c, y, r * z), (nr * c, ny, nr * z), (0.0, 0.0)))
            rings.append(ring)
        triangles = []
        for upper, lower in zip(rings, rings[1:]):
            for s in range(sides):
                a, b = upper[s], upper[(s + 1) % sides]
                c, d = lower[(s + 1) % sides], lower[s]
                if a != b:
                    triangles.append((a, b, c))
                if c != d:
                    triangles.append((a, c, d))
        shape.add(Shape(vertices, triangles))
    return shape


def disk_capped(profile, sides=20, sharp=35):
    """A lathe closed by flat disks above and below."""
    return lathe([(0, profile[0][1])] + profile + [(0, profile[-1][1])], sides, sharp)


def cylinder(radius, y0, y1, sides=16, top_radius=None):
    return disk_capped([(radius if top_radius is None else top_radius, y1), (radius, y0)], sides)


def smooth_path(points, steps):
    """A Catmull-Rom curve through the points."""
    out = []
    for i in range(len(points) - 1):
        p0, p1, p2, p3 = points[max(i - 1, 0)], points[i], points[i + 1], points[min(i + 2, len(points) - 1)]
        for k in range(steps):
            t = k / steps
            out.append(
                tuple(
                    0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t**3)
                    for a, b, c, d in zip(p0, p1, p2, p3)
                )
            )
    out.append(points[-1])
    return out


def frames(path, closed=False):
    """Tangent, side and up along a path, carried without twist."""
    n = len(path)
    tangents = []
    for i in range(n):
        a = path[(i - 1) % n] if closed else path[max(i - 1, 0)]
        b = path[(i + 1) % n] if closed else path[min(i + 1, n - 1)]
        tangents.append(unit(sub(b, a)))
    start = (0.0, 1.0, 0.0) if abs(tangents[0][1]) < 0.9 else (1.0, 0.0, 0.0)
    side = unit(cross(tangents[0], start))
    result = []
    for t in tangents:
        side = unit(sub(side, times(t, dot(side, t))))
        result.append((t, side, cross(side, t)))
    return result


def tube(path, radius, sides=8, closed=False, capped=True):
    """A round tube along a path; `radius` is a number or a function of the place along it, 0..1."""
    n = len(path)
    rows = []
    for i, (p, (_, side, up)) in enumerate(zip(path, frames(path, closed))):
        r = radius(i / (n if closed else n - 1)) if callable(radius) else radius
        rows.append(
            [
                add(p, add(times(side, r * math.cos(TAU * k / sides)), times(up, r * math.sin(TAU * k / sides))))
                for k in range(sides)
            ]
        )
    shape = surface(rows, closed_u=True, closed_v=closed, flip=True)
    if capped and not closed:
        for ring, outwards in ((rows[0], sub(path[0], path[1])), (rows[-1], sub(path[-1], path[-2]))):
            cap = polygon(ring)
            shape.add(cap if dot(cap.vertices[0][1], outwards) > 0 else polygon(ring[::-1]))
    return shape


def rod(a, b, radius, sides=8):
    return tube([a, b], radius, sides)


def extrude(outline, y0, y1, smooth=False, without=()):
    """A prism over a convex outline of (x, z), counter-clockwise seen from above (z towards the viewer: x to the right means
    the outline runs x, then -z). With `smooth`, the sides carry smooth normals."""
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(outline, outline[1:] + outline[:1]))
    if area > 0:  # seen from above with z down the page this is clockwise
        outline = outline[::-1]
    n = len(outline)
    shape = Shape()
    if 'top' not in without:
        shape.add(polygon([(x, y1, z) for x, z in outline]))
    if 'bottom' not in without:
        shape.add(polygon([(x, y0, z) for x, z in outline[::-1]]))
    if smooth:
        rows = [[(x, y, z) for x, z in outline] for y in (y0, y1)]
        shape.add(surface(rows, closed_u=True))
    else:
        for (ax, az), (bx, bz) in zip(outline, outline[1:] + outline[:1]):
            shape.add(polygon([(ax, y0, az), (bx, y0, bz), (bx, y1, bz), (ax, y1, az)]))
    return shape


def rounded_outline(width, depth, radius, steps=5):
    """A rectangle with round corners in (x, z)."""
    points = []
    for cx, cz, first in ((1, 1, 0), (-1, 1, 1), (-1, -1, 2), (1, -1, 3)):
        for k in range(steps + 1):
            a = TAU / 4 * (first + k / steps)
            points.append(
                (cx * (width / 2 - radius) + radius * math.cos(a), cz * (depth / 2 - radius) + radius * math.sin(a))
            )
    return points


def cushion(width, height, depth, sides=16, rings=(0.0, 0.55, 0.85, 0.97, 1.0), power=4.0, bend=None):
    """A pillow: superellipse in plan, rounded edges, smooth all over. `bend(x, y, z)` may move its points."""

    def ring(scale, y):
        points = []
        for k in range(sides):
            a = TAU * k / sides
            c, s = math.cos(a), math.sin(a)
            r = 1 / (abs(c) ** power + abs(s) ** power) ** (1 / power)
            points.append((r * c * scale * width / 2, y, -r * s * scale * depth / 2))
        return points

    half = height / 2
    rows = [[(0.0, -half, 0.0)] * sides]
    for s in rings[1:]:
        rows.append(ring(s, -half + 0.5 * height * (1 - math.sqrt(max(0, 1 - s**6)))))
    for s in rings[-2:0:-1]:
        rows.append(ring(s, half - 0.5 * height * (1 - math.sqrt(max(0, 1 - s**6)))))
    rows.append([(0.0, half, 0.0)] * sides)
    if bend:
        rows = [[bend(*p) for p in row] for row in rows]
    return surface(rows, closed_u=True)

"""An art gallery of two rooms: `python3 gallery.py` writes ../gallery.glb.

The first room is x 0..9, the second x 9.3..14.5, both z 0..7 and 4 m high; a wide opening joins them. All faces look inwards."""
import math
import os

from furniture import framed_picture
from glb import Mesh, Model, report, srgb
from shapes import TAU, Shape, add, block, box, cross, polygon, rectangle, rod, rounded_outline, extrude, surface, times
from office import cells

LENGTH, WALL, END, DEPTH, HEIGHT = 9.0, 0.3, 14.5, 7.0, 4.0
OPENING = (2.1, 4.9, 3.0)  # z, z, height
TRACK = 3.86  # height of the tracks' underside
SPOT = 3.72  # height of the middle of a spot's mouth

# picture, frame, width, height, (x, z) on its wall, turn about y
PICTURES = [
    ('dunes', 'black frame', 1.5, 1.0, (1.7, 0.0), 0),
    ('currents', 'oak frame', 1.6, 1.2, (4.3, 0.0), 0),
    ('sea', 'white frame', 1.5, 1.0, (6.9, 0.0), 0),
    ('birches', 'black frame', 0.90, 1.22, (LENGTH, 1.05), -90),
    ('circles', 'white frame', 0.92, 1.15, (LENGTH, 5.95), -90),
    ('arcs', 'black frame', 1.15, 1.15, (5.3, DEPTH), 180),
    ('fields', 'oak frame', 0.95, 1.29, (3.0, DEPTH), 180),
    ('marble', 'oak frame', 1.9, 1.9, (END, 3.5), -90),
    ('moonlight', 'black frame', 1.9, 0.95, (11.9, 0.0), 0),
    ('seeds', 'white frame', 1.2, 1.2, (11.9, DEPTH), 180),
]

# x, z, turn of the beam about y (0: towards +z), tilt from the vertical
SPOTS = [
    (1.7, 1.85, 180, 44),
    (4.3, 1.85, 180, 44),
    (6.9, 1.85, 180, 44),
    (7.25, 1.85, 90, 44),
    (7.25, 5.15, 90, 44),
    (5.3, 5.15, 0, 44),
    (3.0, 5.15, 0, 44),
    (12.65, 2.9, 90, 44),
    (12.65, 4.1, 90, 44),
    (11.9, 1.85, 180, 44),
    (11.9, 5.15, 0, 44),
    (6.35, 1.85, 0, 35),
    (6.65, 5.15, 180, 35),
]
TRACKS = [
    ((0.8, 1.85), (7.6, 1.85)),
    ((2.0, 5.15), (7.6, 5.15)),
    ((12.65, 2.2), (12.65, 4.8)),
    ((10.4, 1.85), (12.3, 1.85)),
    ((10.4, 5.15), (12.3, 5.15)),
]


def materials(model):
    for name, colour in (
        ('gallery white', (0.82, 0.81, 0.79)),
        ('terracotta paint', srgb('#a85f48')),
        ('deep blue paint', srgb('#2b4c73')),
        ('ceiling white', (0.84, 0.84, 0.83)),
        ('skirting lacquer', (0.74, 0.73, 0.71)),
        ('black frame', srgb('#2a2928')),
        ('oak frame', srgb('#b08a5c')),
        ('white frame', srgb('#dedbd4')),
        ('picture mount', srgb('#e6e3da')),
        ('plaster', (0.78, 0.76, 0.72)),
        ('plinth white', (0.76, 0.76, 0.75)),
        ('black metal', srgb('#2b2b2c')),
        ('track black', srgb('#333333')),
        ('brushed steel', srgb('#b4b4b0')),
        ('door lacquer', srgb('#cfccc4')),
        ('label card', srgb('#e4e2dc')),
        ('bronze', srgb('#6e5a42')),
    ):
        model.material(name, colour)
    model.material('oak parquet', texture='pictures/parquet.png')
    model.material('bench walnut', texture='pictures/walnut.png')
    for picture in PICTURES:
        model.material('painting, ' + picture[0], texture='pictures/%s.png' % picture[0])
    model.material('spot lens', (0.5, 0.5, 0.5), emissive=True)


def rooms(model):
    def one(name, material, *shapes):
        model.place(Mesh(name, solid=False).add(material, *shapes))

    z0, z1, top = OPENING
    second = LENGTH + WALL
    floor = Mesh('floor', solid=False)
    cells(
        floor,
        'oak parquet',
        [0.0, LENGTH, second, END],
        [0.0, z0, z1, DEPTH],
        [(LENGTH, second, 0.0, z0), (LENGTH, second, z1, DEPTH)],
        lambda u, v: (u, 0.0, v),
        lambda u, v: (u / 3.2, v / 1.28),
    )
    for material, shape in floor.parts.items():
        floor.parts[material] = shape.flipped()
    model.place(floor)
    one('ceiling, first room', 'ceiling white', rectangle((0, HEIGHT, 0), (LENGTH, 0, 0), (0, 0, DEPTH)))
    one('ceiling, second room', 'ceiling white', rectangle((second, HEIGHT, 0), (END - second, 0, 0), (0, 0, DEPTH)))
    one('long wall', 'gallery white', rectangle((0, 0, 0), (LENGTH, 0, 0), (0, HEIGHT, 0)))
    one('door wall', 'gallery white', rectangle((LENGTH, 0, DEPTH), (-LENGTH, 0, 0), (0, HEIGHT, 0)))
    one('end wall', 'gallery white', rectangle((0, 0, DEPTH), (0, 0, -DEPTH), (0, HEIGHT, 0)))
    one('second room, left wall', 'gallery white', rectangle((second, 0, 0), (END - second, 0, 0), (0, HEIGHT, 0)))
    one('second room, right wall', 'gallery white', rectangle((END, 0, DEPTH), (second - END, 0, 0), (0, HEIGHT, 0)))
    one('blue wall', 'deep blue paint', rectangle((END, 0, 0), (0, 0, DEPTH), (0, HEIGHT, 0)))
    hole = [(z0, z1, 0.0, top)]
    for name, material, x, flip in (
        ('terracotta wall', 'terracotta paint', LENGTH, False),
        ('second room, near wall', 'gallery white', second, True),
    ):
        wall = Mesh(name, solid=False)
        cells(wall, material, [0.0, z0, z1, DEPTH], [0.0, top, HEIGHT], hole, lambda u, v: (x, v, u))
        if flip:
            wall.parts[material] = wall.parts[material].flipped()
        model.place(wall)
    one(
        'opening',
        'gallery white',
        rectangle((LENGTH, 0, z0), (WALL, 0, 0), (0, top, 0)),
        rectangle((second, 0, z1), (-WALL, 0, 0), (0, top, 0)),
        rectangle((LENGTH, top, z0), (WALL, 0, 0), (0, 0, z1 - z0)),
    )

    skirting = Mesh('skirting', solid=False)
    t, h, e = 0.015, 0.10, 0.001
    door = 6.85, 8.05
    skirting.add(
        'skirting lacquer',
        box((0, -e, -e), (LENGTH, h, t)),
        box((-e, -e, t), (t, h, DEPTH - t)),
        box((0, -e, DEPTH - t), (door[0], h, DEPTH + e)),
        box((door[1], -e, DEPTH - t), (LENGTH, h, DEPTH + e)),
        box((LENGTH - t, -e, t), (LENGTH + e, h, z0)),
        box((LENGTH - t, -e, z1), (LENGTH + e, h, DEPTH - t)),
        box((second, -e, -e), (END, h, t)),
        box((END - t, -e, t), (END + e, h, DEPTH - t)),
        box((second, -e, DEPTH - t), (END, h, DEPTH + e)),
        box((second - e, -e, t), (second + t, h, z0)),
        box((second - e, -e, z1), (second + t, h, DEPTH - t)),
    )
    model.place(skirting)


def door():
    """On a wall at z = 0, seen from +z; origin at its foot. With its frame 1.2 m wide."""
    frame = Mesh('door frame').add(
        'skirting lacquer',
        box((-0.60, -0.001, -0.001), (-0.52, 2.28, 0.025)),
        box((0.52, -0.001, -0.001), (0.60, 2.28, 0.025)),
        box((-0.5205, 2.20, -0.001), (0.5205, 2.2795, 0.0245)),
    )
    leaf = Mesh('door').add('door lacquer', box((-0.517, 0.006, -0.001), (0.517, 2.197, 0.014)))
    x = -0.43
    leaf.add(
        'brushed steel',
        box((x - 0.02, 0.94, 0.0135), (x + 0.02, 1.10, 0.0205)),
        rod((x, 1.05, 0.020), (x, 1.05, 0.065), 0.009, 8),
        rod((x - 0.009, 1.05, 0.058), (x + 0.13, 1.05, 0.058), 0.009, 8),
    )
    return frame, leaf


def spot(tilt):
    """A square spot that shines down and, by `tilt`, towards +z: housing, and its lens 75 mm up in the mouth. Origin in the mouth."""
    outside, inside, deep, long = 0.05, 0.041, 0.075, 0.19
    housing, lens = Mesh('spot housing', solid=False), Mesh('spot lens', solid=False)
    square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    shape = Shape().add(box((-outside, 0, -outside), (outside, long, outside), ('-y',)))
    for (ax, az), (bx, bz) in zip(square, square[1:] + square[:1]):
        shape.add(
            polygon(
                [
                    (ax * outside, 0, az * outside),
                    (bx * outside, 0, bz * outside),
                    (bx * inside, 0, bz * inside),
                    (ax * inside, 0, az * inside),
                ]
            ),
            polygon(
                [
                    (ax * inside, 0, az * inside),
                    (bx * inside, 0, bz * inside),
                    (bx * inside, deep, bz * inside),
                    (ax * inside, deep, az * inside),
                ]
            ),
        )
    up = 0.12 * math.cos(math.radians(tilt))
    back = -0.12 * math.sin(math.radians(tilt))
    housing.add('black metal', shape.turned('x', -tilt))
    housing.add(
        'black metal',
        box((-0.058, up - 0.012, back - 0.014), (-0.049, TRACK - SPOT - 0.008, back + 0.014)),
        box((0.049, up - 0.012, back - 0.014), (0.058, TRACK - SPOT - 0.008, back + 0.014)),
        box((-0.058, TRACK - SPOT - 0.0085, back - 0.0145), (0.058, TRACK - SPOT + 0.001, back + 0.0145)),
    )
    lens.add('spot lens', polygon([(x * inside, deep, z * inside) for x, z in square]).turned('x', -tilt))
    return housing, lens, back


def light(model):
    for k, ((ax, az), (bx, bz)) in enumerate(TRACKS):
        track = Mesh('track %d' % (k + 1), solid=False)
        track.add(
            'track black',
            box(
                (min(ax, bx) - 0.018, TRACK, min(az, bz) - 0.018),
                (max(ax, bx) + 0.018, TRACK + 0.03, max(az, bz) + 0.018),
            ),
        )
        for t in (0.08, 0.92):
            x, z = ax + (bx - ax) * t, az + (bz - az) * t
            track.add('track black', rod((x, TRACK + 0.029, z), (x, HEIGHT + 0.001, z), 0.006, 6))
        model.place(track)
    kinds = {tilt: spot(tilt) for tilt in (44, 35)}
    for k, (x, z, turn, tilt) in enumerate(SPOTS):
        housing, lens, back = kinds[tilt]
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        at = (x - s * back, SPOT, z - c * back)
        model.place(housing, 'spot housing %d' % (k + 1), at, turn)
        model.place(lens, 'spot lens %d' % (k + 1), at, turn)


def knot(along=300, around=14):
    """A torus knot (2, 3) of a flattened, turning band: one closed smooth surface about 0.8 m high, standing on y = 0."""

    def centre(t):
        r = 0.235 + 0.105 * math.cos(3 * t)
        return (r * math.cos(2 * t), r * math.sin(2 * t), 0.125 * math.sin(3 * t))

    rows = []
    n = along
    for i in range(n):
        t = TAU * i / n
        p = centre(t)
        d = tuple(b - a for a, b in zip(centre(t - 1e-4), centre(t + 1e-4)))
        l = math.sqrt(sum(c * c for c in d))
        d = times(d, 1 / l)
        out = (p[0], p[1], 0.0)  # a frame that returns to itself: outwards from the axis of the torus
        out = add(out, times(d, -sum(a * b for a, b in zip(out, d))))
        l = math.sqrt(sum(c * c for c in out))
        out = times(out, 1 / l)
        side = cross(d, out)
        wide, thin = 0.060 + 0.014 * math.sin(2 * t), 0.034
        turn = 3 * t
        row = []
        for k in range(around):
            a = TAU * k / around
            u, v = wide * math.cos(a), thin * math.sin(a)
            u, v = u * math.cos(turn) - v * math.sin(turn), u * math.sin(turn) + v * math.cos(turn)
            row.append(add(p, add(times(out, u), times(side, v))))
        rows.append(row)
    shape = surface(rows, closed_u=True, closed_v=True, flip=False)
    position, normal, _ = shape.vertices[0]
    if sum(a * b for a, b in zip(normal, add(position, times(centre(0.0), -1)))) < 0:
        shape = shape.flipped()
    low = min(p[1] for p, _, _ in shape.vertices)
    return shape.moved(0, -low)


def art(model):
    for name, frame, width, height, (x, z), turn in PICTURES:
        y = 1.58
        model.place(
            framed_picture('painting, ' + name, 'painting, ' + name, frame, width, height, 0.0), None, (x, y, z), turn
        )
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        label = Mesh('label, ' + name).add('label card', box((-0.06, -0.04, -0.001), (0.06, 0.04, 0.003)))
        off = width / 2 + 0.20
        model.place(label, None, (x + c * off, 1.35, z - s * off), turn)
    plinth = Mesh('plinth').add('plinth white', block(0.52, 1.0, 0.52, y=-0.001))
    model.place(plinth, None, (6.5, 0, 3.3), 12)
    sculpture = Mesh('sculpture').add('plaster', knot().scaled(1.12).moved(0, 0.02))
    model.place(sculpture, None, (6.5, 1.0, 3.3), -62)
    model.place(Mesh('sculpture foot').add('bronze', block(0.15, 0.045, 0.12, y=-0.0015)), None, (6.5, 1.0, 3.3), -62)


def furnish(model):
    bench = Mesh('bench', solid=False)
    bench.add('bench walnut', extrude(rounded_outline(1.9, 0.46, 0.05, 4), 0.40, 0.46, smooth=True).laid(1.6, 0.8))
    for x in (-0.72, 0.72):
        bench.add(
            'black metal',
            box((x - 0.025, -0.001, -0.19), (x + 0.025, 0.05, 0.19)),
            box((x - 0.025, 0.049, -0.19), (x + 0.025, 0.401, -0.15)),
            box((x - 0.025, 0.049, 0.15), (x + 0.025, 0.401, 0.19)),
        )
    model.place(bench, 'bench 1', (4.2, 0, 3.25), 0)
    model.place(bench, 'bench 2', (11.7, 0, 3.5), 90)
    frame, leaf = door()
    for mesh in (frame, leaf):
        model.place(mesh, None, (7.45, 0, DEPTH), 180)


def gallery():
    model = Model()
    materials(model)
    rooms(model)
    light(model)
    art(model)
    furnish(model)
    return model


if __name__ == '__main__':
    model = gallery()
    for fault in report(model):
        print(fault)
    model.write(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'gallery.glb'), 'assets/make/gallery.py')
    print(
        '%d triangles, %d meshes, %d nodes, %d materials'
        % (model.triangles(), len(model.meshes), len(model.nodes), len(model.materials))
    )

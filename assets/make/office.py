"""An open-plan office, 12 m by 9 m by 2.8 m: `python3 office.py` writes ../office.glb.

x runs from the near wall to the far wall, z from the windows (z = 0) to the corridor (z = 9). Walls, floor and ceiling face inwards
and close the room; what is behind a window is a panel that stands for the sky or the ground."""
import math
import os
import random

import furniture as f
from glb import Mesh, Model, report, srgb
from shapes import PICTURE_UV, bevelled, block, box, disk_capped, extrude, polygon, rectangle, rod, surface

WIDTH, DEPTH, HEIGHT = 12.0, 9.0, 2.8
TILE = 0.6
LAMPS = [(i, j) for j in (2, 7, 12) for i in (2, 7, 12, 17)]  # ceiling tiles, counted from the corner
WINDOWS = [(0.375 + 2.325 * k, 0.375 + 2.325 * k + 1.95) for k in range(5)]
SILL, HEAD, REVEAL = 0.85, 2.5, 0.26
DRAWN = [0.62, 0.34, 0.82, 0.30, 0.50]  # metres of blind let down


def materials(model):
    for name, colour in (
        ('white wall paint', (0.80, 0.79, 0.76)),
        ('sage wall paint', srgb('#a9bba6')),
        ('skirting lacquer', (0.72, 0.71, 0.69)),
        ('white reveal paint', (0.78, 0.78, 0.76)),
        ('window aluminium', srgb('#4a4e52')),
        ('sill stone', srgb('#c9c4ba')),
        ('radiator enamel', (0.76, 0.76, 0.74)),
        ('lamp frame', (0.75, 0.75, 0.75)),
        ('white steel', srgb('#d9d9d6')),
        ('grey steel', srgb('#8b8f92')),
        ('black steel', srgb('#2c2d2f')),
        ('brushed steel', srgb('#b4b4b0')),
        ('polished aluminium', srgb('#bfc1c2')),
        ('black plastic', srgb('#2b2c2e')),
        ('grey plastic', srgb('#5e6266')),
        ('cabinet steel', srgb('#b9bdbd')),
        ('drawer front', srgb('#c6cac9')),
        ('white laminate', (0.74, 0.74, 0.72)),
        ('beech', srgb('#c79f70')),
        ('teal felt', srgb('#3f7f83')),
        ('ochre felt', srgb('#d09a3a')),
        ('grey felt', srgb('#8f959a')),
        ('wool', srgb('#3b4a63')),
        ('graphite fabric', srgb('#45494f')),
        ('ochre fabric', srgb('#bd8430')),
        ('ochre shell', srgb('#d19a36')),
        ('white shell', srgb('#dcdad4')),
        ('paper', srgb('#e6e2d6')),
        ('book red', srgb('#a83a32')),
        ('book navy', srgb('#2c4468')),
        ('book ochre', srgb('#c8963c')),
        ('book green', srgb('#4c7a58')),
        ('book cream', srgb('#ddd0b2')),
        ('book grey', srgb('#7a7f85')),
        ('book teal', srgb('#3b8288')),
        ('book plum', srgb('#6d3f5c')),
        ('red enamel', srgb('#c0422e')),
        ('blue glaze', srgb('#3f6f9c')),
        ('white glaze', srgb('#e2e0da')),
        ('yellow glaze', srgb('#dcb04a')),
        ('terracotta', srgb('#b5694a')),
        ('white ceramic', srgb('#dedbd4')),
        ('soil', srgb('#3b2d24')),
        ('bark', srgb('#6b5440')),
        ('door lacquer', srgb('#5d7280')),
        ('picture mount', srgb('#e6e3da')),
        ('clock face', srgb('#e8e8e4')),
    ):
        model.material(name, colour)
    for name, colour in (
        ('leaf, light', srgb('#5f8f45')),
        ('leaf, dark', srgb('#3a6b3a')),
        ('blind slat', srgb('#d3d1c9')),
    ):
        model.material(name, colour, two_sided=True)
    for name, picture in (
        ('carpet tiles', 'carpet'),
        ('ceiling tiles', 'ceiling'),
        ('oak veneer', 'oak'),
        ('walnut veneer', 'walnut'),
        ('keys', 'keyboard'),
        ('screen picture', 'screens'),
        ('whiteboard', 'whiteboard'),
        ('print, arcs', 'arcs'),
        ('print, seeds', 'seeds'),
        ('print, birches', 'birches'),
        ('print, dunes', 'dunes'),
    ):
        model.material(name, texture='pictures/%s.png' % picture)
    for name, colour in (
        ('lamp diffuser', (0.6, 0.6, 0.6)),
        ('sky', (0.0, 0.0, 0.0)),
        ('ground outside', (0.0, 0.0, 0.0)),
    ):
        model.material(name, colour, emissive=True)


def cells(mesh, material, us, vs, holes, at, uv=lambda u, v: (0.0, 0.0)):
    """A wall cut into rectangles along the lines us and vs, so that neighbours share whole edges around the holes."""
    for u0, u1 in zip(us, us[1:]):
        for v0, v1 in zip(vs, vs[1:]):
            if not any(a <= u0 and u1 <= b and c <= v0 and v1 <= d for a, b, c, d in holes):
                corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)]
                mesh.add(material, polygon([at(u, v) for u, v in corners], [uv(u, v) for u, v in corners]))


def room(model):
    def one(name, material, *shapes):
        model.place(Mesh(name, solid=False).add(material, *shapes))

    uv = [(0, DEPTH / 2), (WIDTH / 2, DEPTH / 2), (WIDTH / 2, 0), (0, 0)]
    one('floor', 'carpet tiles', rectangle((0, 0, DEPTH), (WIDTH, 0, 0), (0, 0, -DEPTH), uv))
    one('far wall', 'sage wall paint', rectangle((WIDTH, 0, 0), (0, 0, DEPTH), (0, HEIGHT, 0)))
    one('near wall', 'white wall paint', rectangle((0, 0, DEPTH), (0, 0, -DEPTH), (0, HEIGHT, 0)))
    one('corridor wall', 'white wall paint', rectangle((WIDTH, 0, DEPTH), (-WIDTH, 0, 0), (0, HEIGHT, 0)))
    ceiling = Mesh('ceiling', solid=False)
    us = sorted({0.0, WIDTH} | {round((i + k) * TILE, 6) for i, _ in LAMPS for k in (0, 1)})
    vs = sorted({0.0, DEPTH} | {round((j + k) * TILE, 6) for _, j in LAMPS for k in (0, 1)})
    holes = [(i * TILE - 1e-6, (i + 1) * TILE + 1e-6, j * TILE - 1e-6, (j + 1) * TILE + 1e-6) for i, j in LAMPS]
    cells(ceiling, 'ceiling tiles', us, vs, holes, lambda u, v: (u, HEIGHT, v), lambda u, v: (u / TILE, v / TILE))
    model.place(ceiling)
    wall = Mesh('window wall', solid=False)
    us = sorted({0.0, WIDTH} | {x for w in WINDOWS for x in w})
    cells(
        wall,
        'white wall paint',
        us,
        [0.0, SILL, HEAD, HEIGHT],
        [(a, b, SILL, HEAD) for a, b in WINDOWS],
        lambda u, v: (u, v, 0.0),
    )
    model.place(wall)
    skirting = Mesh('skirting', solid=False)
    t, h = 0.012, 0.08
    door = 5.25, 6.35
    skirting.add(
        'skirting lacquer',
        box((0, -0.001, -0.001), (WIDTH, h, t)),
        box((-0.001, -0.001, t), (t, h, DEPTH - t)),
        box((WIDTH - t, -0.001, t), (WIDTH + 0.001, h, DEPTH - t)),
        box((0, -0.001, DEPTH - t), (door[0], h, DEPTH + 0.001)),
        box((door[1], -0.001, DEPTH - t), (WIDTH, h, DEPTH + 0.001)),
    )
    model.place(skirting)


def ceiling_lamp():
    """Recessed panel lamp of one ceiling tile; origin in the middle of the tile. Frame and panel are meshes of their own."""
    o, i, low, up = TILE / 2, 0.27, -0.004, 0.035
    square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    frame = Mesh('ceiling lamp frame', solid=False)
    for (ax, az), (bx, bz) in zip(square, square[1:] + square[:1]):
        frame.add(
            'lamp frame',
            polygon([(ax * o, low, az * o), (bx * o, low, bz * o), (bx * i, low, bz * i), (ax * i, low, az * i)]),
            polygon([(ax * o, 0, az * o), (bx * o, 0, bz * o), (bx * o, low, bz * o), (ax * o, low, az * o)]),
            polygon([(ax * i, low, az * i), (bx * i, low, bz * i), (bx * i, up, bz * i), (ax * i, up, az * i)]),
        )
    panel = Mesh('ceiling lamp panel', solid=False)
    panel.add('lamp diffuser', polygon([(x * i, up, z * i) for x, z in square]))
    return frame, panel


def windows(model):
    width = WINDOWS[0][1] - WINDOWS[0][0]
    w, back = width / 2, -REVEAL
    reveal = Mesh('window reveal', solid=False)
    reveal.add(
        'white reveal paint',
        rectangle((-w, SILL, 0), (2 * w, 0, 0), (0, 0, back)),
        rectangle((-w, HEAD, back), (2 * w, 0, 0), (0, 0, -back)),
        rectangle((-w, SILL, 0), (0, 0, back), (0, HEAD - SILL, 0)),
        rectangle((w, SILL, back), (0, 0, -back), (0, HEAD - SILL, 0)),
    )
    frame = Mesh('window frame', solid=False)
    z0, z1, p = -0.20, -0.14, 0.06
    m = 0.18  # the mullion stands off the middle: one wing opens
    aluminium = [
        box((-w, SILL, z0), (-w + p, HEAD, z1), ('-x', '-y', '+y')),
        box((w - p, SILL, z0), (w, HEAD, z1), ('+x', '-y', '+y')),
        box((-w + p, SILL, z0), (w - p, SILL + p, z1), ('-x', '+x', '-y')),
        box((-w + p, HEAD - p, z0), (w - p, HEAD, z1), ('-x', '+x', '+y')),
        box((m - 0.03, SILL + p, z0), (m + 0.03, HEAD - p, z1), ('-y', '+y')),
        box((m + 0.0305, SILL + p, z0 + 0.01), (m + 0.075, HEAD - p, z1 + 0.012), ('-y', '+y')),
        box((w - p - 0.045, SILL + p, z0 + 0.01), (w - p - 0.0005, HEAD - p, z1 + 0.012), ('-y', '+y')),
        box((m + 0.075, SILL + p + 0.0005, z0 + 0.01), (w - p - 0.045, SILL + p + 0.045, z1 + 0.012), ('-x', '+x')),
        box((m + 0.075, HEAD - p - 0.045, z0 + 0.01), (w - p - 0.045, HEAD - p - 0.0005, z1 + 0.012), ('-x', '+x')),
    ]
    frame.add('window aluminium', *aluminium)
    frame.add(
        'brushed steel',
        box((m + 0.045, 1.50, z1 + 0.011), (m + 0.062, 1.53, z1 + 0.035)),
        box((m + 0.042, 1.40, z1 + 0.034), (m + 0.065, 1.53, z1 + 0.046)),
    )
    sill = Mesh('window sill').add(
        'sill stone', box((-w + 0.001, SILL - 0.001, z1 - 0.01), (w - 0.001, SILL + 0.026, 0.05))
    )
    split = 1.28
    sky = Mesh('sky panel', solid=False).add('sky', rectangle((-w, split, back), (2 * w, 0, 0), (0, HEAD - split, 0)))
    ground = Mesh('ground panel', solid=False).add(
        'ground outside', rectangle((-w, SILL, back), (2 * w, 0, 0), (0, split - SILL, 0))
    )
    radiator_ = radiator()
    for k, (a, b) in enumerate(WINDOWS):
        at = ((a + b) / 2, 0, 0)
        for mesh in (reveal, frame, sill, sky, ground, radiator_):
            model.place(mesh, '%s %d' % (mesh.name, k + 1), at)
        model.place(blind(width - 0.02, DRAWN[k], 66 + 2 * (k % 3), k + 1), None, (at[0], HEAD, -0.075))


def blind(width, drawn, tilt, number):
    """A venetian blind that hangs from y = 0."""
    mesh = Mesh('blind %d' % number, solid=False)
    w = width / 2
    mesh.add('white steel', box((-w, -0.045, -0.022), (w, 0.001, 0.022)))
    count = int((drawn - 0.08) / 0.042)
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    for k in range(count):
        y = -0.075 - 0.042 * k
        rows = [
            [(x, y + (d * s + 0.003 * (1 - (d / 0.024) ** 2)), -d * c) for x in (-w + 0.005, w - 0.005)]
            for d in (-0.024, 0.0, 0.024)
        ]
        mesh.add('blind slat', surface(rows))
    low = -0.075 - 0.042 * count
    mesh.add('white steel', box((-w + 0.005, low - 0.008, -0.022), (w - 0.005, low + 0.008, 0.022)))
    for x in (-0.6 * w, 0.6 * w):
        mesh.add(
            'white steel',
            box((x - 0.0015, low, -0.0275), (x + 0.0015, -0.03, -0.0255)),
            box((x - 0.0015, low, 0.0255), (x + 0.0015, -0.03, 0.0275)),
        )
    return mesh


def radiator():
    mesh = Mesh('radiator')
    w, y0, y1 = 0.80, 0.13, 0.68
    mesh.add('radiator enamel', box((-w, y0, 0.045), (w, y1, 0.120)))
    n = 18
    for k in range(n):
        x = -w + 0.02 + (2 * w - 0.04) * (k + 0.5) / n
        rib = [(x - 0.032, 0.119), (x + 0.032, 0.119), (x + 0.020, 0.134), (x - 0.020, 0.134)]
        mesh.add('radiator enamel', extrude(rib, y0 + 0.03, y1 - 0.03))
    for x in (-0.55, 0.55):
        mesh.add('radiator enamel', box((x - 0.02, 0.25, -0.001), (x + 0.02, 0.55, 0.046)))
    mesh.add(
        'white steel',
        rod((w - 0.04, -0.001, 0.08), (w - 0.04, y0 + 0.001, 0.08), 0.009, 8),
        rod((w - 0.09, -0.001, 0.08), (w - 0.09, y0 + 0.001, 0.08), 0.009, 8),
    )
    mesh.add(
        'white glaze',
        disk_capped([(0.018, 0.075), (0.024, 0.065), (0.024, -0.001)], 12).turned('z', -90).moved(w, y1 - 0.06, 0.083),
    )
    return mesh


def door():
    """On a wall at z = 0, seen from +z; origin at its foot. With its frame 1.1 m wide."""
    mesh = Mesh('door')
    mesh.add(
        'white laminate',
        box((-0.55, -0.001, -0.001), (-0.475, 2.16, 0.022)),
        box((0.475, -0.001, -0.001), (0.55, 2.16, 0.022)),
        box((-0.4755, 2.085, -0.001), (0.4755, 2.1595, 0.0215)),
    )
    leaf = Mesh('door leaf').add('door lacquer', box((-0.472, 0.006, -0.001), (0.472, 2.082, 0.012)))
    for y0, y1 in ((0.18, 0.92), (1.12, 1.92)):
        leaf.add('door lacquer', box((-0.34, y0, 0.011), (0.34, y1, 0.017)))
    x = -0.40
    leaf.add(
        'brushed steel',
        box((x - 0.022, 0.93, 0.0115), (x + 0.022, 1.10, 0.0195)),
        rod((x, 1.05, 0.019), (x, 1.05, 0.062), 0.009, 8),
        rod((x - 0.009, 1.05, 0.056), (x + 0.125, 1.05, 0.056), 0.009, 8),
    )
    return mesh, leaf


def whiteboard():
    mesh = Mesh('whiteboard', solid=False)
    w, h = 1.2, 0.6
    mesh.add(
        'polished aluminium',
        box((-w - 0.02, h, -0.001), (w + 0.02, h + 0.02, 0.022)),
        box((-w - 0.02, -h - 0.02, -0.001), (w + 0.02, -h, 0.022)),
        box((-w - 0.02, -h, -0.001), (-w, h, 0.022), ('-y', '+y')),
        box((w, -h, -0.001), (w + 0.02, h, 0.022), ('-y', '+y')),
        box((-0.45, -h - 0.03, 0.021), (0.45, -h - 0.018, 0.09)),
    )
    mesh.add('whiteboard', rectangle((-w, -h, 0.012), (2 * w, 0, 0), (0, 2 * h, 0), PICTURE_UV))
    for k, ink in enumerate(('book red', 'book navy', 'book green')):
        mesh.add(ink, rod((-0.36 + 0.16 * k, -h - 0.0115, 0.06), (-0.23 + 0.16 * k, -h - 0.0115, 0.06), 0.0075, 6))
    mesh.add('book grey', box((0.22, -h - 0.0185, 0.04), (0.36, -h + 0.012, 0.085)))
    return mesh


def low_shelf(seed):
    """1.2 m wide, 0.8 m high, 0.4 m deep, its back to -z, with binders."""
    generator = random.Random(seed)
    mesh = Mesh('low shelf %d' % seed, solid=False)
    mesh.add(
        'oak veneer',
        block(1.22, 0.025, 0.41, y=0.775),
        box((-0.6, -0.001, -0.2), (-0.578, 0.776, 0.2)),
        box((0.578, -0.001, -0.2), (0.6, 0.776, 0.2)),
        box((-0.579, 0.04, -0.2), (0.579, 0.062, 0.195)),
        box((-0.579, 0.41, -0.2), (0.579, 0.432, 0.195)),
        box((-0.579, 0.0, -0.198), (0.579, 0.776, -0.19)),
    )
    for y in (0.061, 0.431):
        x = -0.57
        tone = 'book grey'
        while x + 0.08 < 0.57:
            if generator.random() < 0.3:
                tone = generator.choice(['book teal', 'book ochre', 'book grey', 'book cream'])
            if generator.random() > 0.16:
                mesh.add(tone, box((x, y, -0.13), (x + 0.072, y + 0.315, 0.15), ('-y', '-z')))
                mesh.add('paper', rectangle((x + 0.012, y + 0.16, 0.151), (0.048, 0, 0), (0, 0.12, 0)))
            x += 0.0745
    return mesh


def seats(model, generator):
    """Desks in facing pairs, their chairs and what lies on them."""
    desk, drawers, keyboard, mouse, pen_cup = f.desk(), f.drawer_unit(), f.keyboard(), f.mouse(), f.pen_cup()
    screens = [f.monitor('monitor, editor', 0), f.monitor('monitor, plan', 1)]
    mugs = [f.mug(glaze) for glaze in ('white glaze', 'blue glaze', 'yellow glaze', 'red enamel')]
    lamps = [f.desk_lamp('red enamel'), f.desk_lamp('white steel'), f.desk_lamp('black steel')]
    chairs = [f.task_chair('graphite fabric'), f.task_chair('ochre fabric')]
    papers = [f.paper_stack(k) for k in (1, 2, 3)]
    divider = f.divider(1.58)
    place = 0
    for group, (x, zs) in enumerate(((4.25, (1.85, 3.47)), (8.35, (1.85, 3.47)), (4.05, (6.45,)))):
        for z in zs:
            model.place(
                divider, 'divider %d' % (len([n for n in model.names if n.startswith('divider')]) + 1), (x, 0, z), 90
            )
            for side in (-1, 1):
                place += 1
                turn = 90 * side
                c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))

                def put(mesh, name, px, pz, up=0.74, angle=0.0):
                    at = (x + side * 0.425 + c * px + s * pz, up, z - s * px + c * pz)
                    model.place(mesh, name if name[-1].isdigit() else '%s %d' % (name, place), at, turn + angle)

                put(desk, 'desk', 0, 0, 0)
                put(drawers, 'drawer unit', 0.46 if place % 3 else -0.46, 0.05, 0)
                shift = generator.uniform(-0.08, 0.08)
                if place % 4 == 1:
                    put(screens[0], 'monitor %d' % (10 + place), -0.34, -0.17, angle=9)
                    put(screens[1], 'monitor', 0.32, -0.17, angle=-9)
                else:
                    put(screens[place % 2], 'monitor', shift, -0.16, angle=generator.uniform(-6, 6))
                put(keyboard, 'keyboard', shift, 0.17, angle=generator.uniform(-4, 4))
                put(mouse, 'mouse', shift + 0.33, 0.18, angle=generator.uniform(-20, 20))
                put(
                    mugs[place % 4],
                    'mug',
                    -0.48 + generator.uniform(-0.05, 0.1),
                    0.10 + generator.uniform(-0.1, 0.08),
                    angle=generator.uniform(0, 360),
                )
                if place % 3 != 2:
                    put(
                        papers[place % 3],
                        'books and papers',
                        -0.60,
                        -0.14 if place % 4 == 1 else -0.06,
                        angle=generator.uniform(-25, 25),
                    )
                if place % 2:
                    put(lamps[place % 3], 'desk lamp', 0.68, -0.24, angle=150 + generator.uniform(-20, 20))
                else:
                    put(pen_cup, 'pen cup', 0.60, -0.20)
                put(
                    chairs[place in (3, 5, 6, 8)],
                    'task chair',
                    generator.uniform(-0.15, 0.15),
                    0.62 + generator.uniform(0, 0.28),
                    0,
                    180 + generator.uniform(-35, 35),
                )


def furnish(model):
    generator = random.Random(2)
    seats(model, generator)
    x, z = 8.75, 6.75
    model.place(f.meeting_table(), None, (x, 0, z))
    shells = [f.meeting_chair('ochre shell'), f.meeting_chair('white shell')]
    spots = [
        (x + dx, z + s * (0.80 + generator.uniform(0, 0.12)), 180 if s > 0 else 0)
        for dx in (-0.8, 0.0, 0.8)
        for s in (-1, 1)
    ]
    spots += [(x - 1.62, z + 0.05, 90), (x + 1.66, z, -90)]
    for k, (cx, cz, turn) in enumerate(spots):
        model.place(
            shells[k in (1, 4, 6)], 'meeting chair %d' % (k + 1), (cx, 0, cz), turn + generator.uniform(-16, 16)
        )
    model.place(f.paper_stack(4), 'books and papers on the meeting table', (x - 0.7, 0.74, z + 0.2), 30)
    model.place(f.mug('white glaze'), 'mug on the meeting table', (x + 0.55, 0.74, z - 0.25), 100)

    for k in range(3):
        model.place(f.bookcase(20 + k, 'bookcase %d' % (k + 1)), None, (WIDTH - 0.162, 0, 1.35 + 0.902 * k), -90)
    cabinet = f.filing_cabinet()
    for k in range(3):
        model.place(cabinet, 'filing cabinet %d' % (k + 1), (2.35 + 0.802 * k, 0, DEPTH - 0.227), 180)
    for k in range(3):
        model.place(low_shelf(k + 1), None, (7.5 + 1.225 * k, 0, DEPTH - 0.207), 180)

    door_frame, leaf = door()
    model.place(door_frame, 'door frame', (5.8, 0, DEPTH), 180)
    model.place(leaf, 'door', (5.8, 0, DEPTH), 180)
    model.place(f.wall_clock(), None, (5.8, 2.45, DEPTH), 180)
    model.place(whiteboard(), None, (WIDTH, 1.55, 6.75), -90)
    for name, picture, px, w, h in (
        ('picture, arcs', 'print, arcs', 2.35, 0.5, 0.5),
        ('picture, birches', 'print, birches', 3.15, 0.42, 0.57),
        ('picture, seeds', 'print, seeds', 3.95, 0.5, 0.5),
    ):
        model.place(f.framed_picture(name, picture, 'black steel', w, h), None, (px, 1.75, DEPTH), 180)
    model.place(f.framed_picture('picture, dunes', 'print, dunes', 'beech', 0.9, 0.6), None, (0.0, 1.6, 4.5), 90)

    tones = ['teal felt', 'grey felt', 'ochre felt', 'grey felt', 'teal felt', 'grey felt']
    panels = [
        Mesh('acoustic panel, ' + tone).add(tone, bevelled(0.60, 0.90, 0.045, 0.01))
        for tone in ('teal felt', 'grey felt', 'ochre felt')
    ]
    for k, tone in enumerate(tones):
        mesh = next(p for p in panels if p.name.endswith(tone))
        model.place(mesh, 'acoustic panel %d' % (k + 1), (7.15 + 0.64 * k, 1.72, DEPTH - 0.0215), 180)
    for k, tone in enumerate(('ochre felt', 'teal felt')):
        mesh = next(p for p in panels if p.name.endswith(tone))
        model.place(mesh, 'acoustic panel %d' % (7 + k), (WIDTH - 0.0215, 1.72, 4.05 + 0.64 * k), -90)

    model.place(f.ficus(1, 1.75, 42, 'leaf, dark', 'white ceramic'), 'plant 1', (11.45, 0, 0.5), 20)
    model.place(f.ficus(2, 1.45, 36, 'leaf, light', 'terracotta'), 'plant 2', (6.75, 0, 8.5), 70)
    model.place(f.ficus(3, 1.6, 40, 'leaf, dark', 'terracotta'), 'plant 3', (2.0, 0, 0.62), 0)
    model.place(f.ficus(4, 1.5, 36, 'leaf, light', 'white ceramic'), 'plant 4', (11.5, 0, 5.0), 120)
    small = [f.snake_plant(1, 'white ceramic'), f.snake_plant(2, 'terracotta')]
    for k, (px, py, pz) in enumerate(
        (
            (3.15, SILL + 0.026, -0.03),
            (5.35, SILL + 0.026, -0.03),
            (8.05, SILL + 0.026, -0.03),
            (3.6, 1.1, 8.8),
            (9.9, 0.8, 8.8),
        )
    ):
        model.place(small[k % 2], 'small plant %d' % (k + 1), (px, py, pz), 77 * k)
    bin_ = f.bin_()
    for k, (px, pz) in enumerate(((3.75, 4.45), (7.9, 4.45), (4.75, 7.42), (11.65, 4.25))):
        model.place(bin_, 'waste bin %d' % (k + 1), (px, 0, pz))
    model.place(f.coat_stand(), None, (11.5, 0, 8.45), 12)
    model.place(f.coat(), None, (11.5 - 0.075, 1.665, 8.45 - 0.155), 65)
    model.place(f.paper_stack(5), 'books and papers on the cabinets', (2.5, 1.1, 8.78), 10)
    model.place(f.mug('yellow glaze'), 'mug on the low shelf', (8.6, 0.8, 8.75), 0)


def office():
    model = Model()
    materials(model)
    room(model)
    windows(model)
    frame, panel = ceiling_lamp()
    for k, (i, j) in enumerate(LAMPS):
        at = ((i + 0.5) * TILE, HEIGHT, (j + 0.5) * TILE)
        model.place(panel, 'ceiling lamp panel %d' % (k + 1), at)
        model.place(frame, 'ceiling lamp frame %d' % (k + 1), at)
    furnish(model)
    return model


if __name__ == '__main__':
    model = office()
    for fault in report(model):
        print(fault)
    model.write(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'office.glb'), 'assets/make/office.py')
    print(
        '%d triangles, %d meshes, %d nodes, %d materials'
        % (model.triangles(), len(model.meshes), len(model.nodes), len(model.materials))
    )

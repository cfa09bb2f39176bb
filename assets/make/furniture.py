"""Furniture and small things of an office. Each function makes one Mesh: origin on the floor (or what it stands on) in the middle,
its user on the +z side. What touches something is sunk 1 mm into it, so that no two faces lie in one plane and no gap is left."""
import math
import random

from glb import Mesh
from shapes import (
    TAU,
    Shape,
    bevelled,
    block,
    box,
    cushion,
    cylinder,
    disk_capped,
    extrude,
    lathe,
    polygon,
    rectangle,
    rod,
    rounded_outline,
    smooth_path,
    surface,
    tube,
    PICTURE_UV,
)

SUNK = 0.001


def desk():
    mesh = Mesh('desk')
    mesh.add('oak veneer', block(1.6, 0.026, 0.8, y=0.714))
    for x in (-0.7, 0.7):
        mesh.add(
            'white steel',
            block(0.05, 0.04, 0.68, x, -SUNK),
            block(0.07, 0.64, 0.05, x, 0.038, -0.05),
            block(0.05, 0.04, 0.66, x, 0.675),
        )
    mesh.add('white steel', box((-0.68, 0.64, -0.08), (0.68, 0.68, -0.04)))
    mesh.add(
        'grey steel',
        box((-0.5, 0.55, -0.33), (0.5, 0.552, -0.17)),
        box((-0.5, 0.551, -0.172), (0.5, 0.63, -0.17)),
        box((-0.5, 0.551, -0.33), (0.5, 0.63, -0.328)),
        box((-0.42, 0.629, -0.33), (-0.40, 0.715, -0.328)),
        box((0.40, 0.629, -0.33), (0.42, 0.715, -0.328)),
    )
    for x in (-0.3, -0.24):  # cables down to the floor
        mesh.add(
            'black plastic',
            tube(
                smooth_path([(x, 0.56, -0.25), (x + 0.03, 0.4, -0.3), (x, 0.2, -0.27), (x + 0.02, -SUNK, -0.3)], 2),
                0.004,
                4,
            ),
        )
    return mesh


def drawer_unit():
    mesh = Mesh('drawer unit')
    mesh.add('cabinet steel', box((-0.2, 0.05, -0.27), (0.2, 0.56, 0.26)))
    for k in range(3):
        y = 0.06 + 0.166 * k
        mesh.add('drawer front', box((-0.197, y, 0.259), (0.197, y + 0.160, 0.278)))
        mesh.add('brushed steel', box((-0.06, y + 0.125, 0.277), (0.06, y + 0.135, 0.296)))
    mesh.add('black plastic', box((-0.17, -SUNK, -0.24), (0.17, 0.051, 0.22)))
    return mesh


def divider(width):
    mesh = Mesh('divider')
    mesh.add('teal felt', bevelled(width, 0.46, 0.036, 0.008).moved(0, 0.97, 0))
    for x in (-0.55, 0.55):
        mesh.add('white steel', box((x - 0.03, 0.68, -0.008), (x + 0.03, 0.78, 0.008)))
    return mesh


def monitor(name, half):
    mesh = Mesh(name, solid=False)
    u = 0.5 * half
    tilt = Shape().add(box((-0.305, -0.175, -0.022), (0.305, 0.185, 0.004)))
    back = Shape().add(bevelled(0.36, 0.24, 0.05, 0.015).moved(0, 0.0, -0.03))
    screen = rectangle(
        (-0.297, -0.160, 0.0048), (0.594, 0, 0), (0, 0.337, 0), [(u, 1), (u + 0.5, 1), (u + 0.5, 0), (u, 0)]
    )
    for material, shape in (('black plastic', tilt), ('black plastic', back), ('screen picture', screen)):
        mesh.add(material, shape.turned('x', -5).moved(0, 0.36, 0))
    mesh.add(
        'grey steel',
        box((-0.028, 0.008, -0.075), (0.028, 0.36, -0.055)),
        extrude(rounded_outline(0.25, 0.19, 0.03, 3), -SUNK, 0.010, smooth=True).moved(0, 0, -0.01),
    )
    return mesh


def keyboard():
    mesh = Mesh('keyboard', solid=False)
    low, high = 0.006, 0.021  # front and back height
    points = [(-0.22, low, 0.07), (0.22, low, 0.07), (0.22, high, -0.07), (-0.22, high, -0.07)]
    mesh.add('keys', polygon([(x, y + 0.0006, z) for x, y, z in points], PICTURE_UV))
    foot = [(x, -SUNK, z) for x, _, z in points]
    shape = Shape().add(polygon(points), polygon(foot[::-1]))
    for k in range(4):
        j = (k + 1) % 4
        shape.add(polygon([foot[k], foot[j], points[j], points[k]]))
    mesh.add('black plastic', shape)
    return mesh


def mouse():
    mesh = Mesh('mouse')
    rows = [
        [
            (
                0.031 * s * math.cos(TAU * k / 12),
                y + 0.004 * s * math.sin(TAU * k / 12) * (y > 0.01),
                -0.055 * s * math.sin(TAU * k / 12),
            )
            for k in range(12)
        ]
        for s, y in ((0, -SUNK), (0.95, -SUNK), (1, 0.008), (0.9, 0.024), (0.55, 0.036), (0, 0.039))
    ]
    mesh.add('black plastic', surface(rows, closed_u=True))
    return mesh


def mug(material):
    mesh = Mesh('mug, ' + material)
    mesh.add(
        material,
        lathe(
            [
                (0, 0.008),
                (0.035, 0.008),
                (0.0365, 0.093),
                (0.0385, 0.096),
                (0.0405, 0.093),
                (0.040, 0.01),
                (0.034, -SUNK),
                (0, -SUNK),
            ][::-1],
            12,
        ).flipped(),
    )
    handle = [(0.038, 0.075, 0), (0.062, 0.078, 0), (0.070, 0.052, 0), (0.058, 0.026, 0), (0.038, 0.024, 0)]
    mesh.add(material, tube(smooth_path(handle, 2), 0.0055, 5))
    return mesh


def pen_cup():
    mesh = Mesh('pen cup')
    mesh.add(
        'grey steel',
        lathe(
            [(0, 0.004), (0.036, 0.004), (0.036, 0.100), (0.039, 0.100), (0.039, -SUNK), (0, -SUNK)][::-1], 12
        ).flipped(),
    )
    for k, material in enumerate(('book red', 'book navy', 'black plastic', 'book ochre')):
        a = 1.3 + 1.7 * k
        mesh.add(
            material,
            rod(
                (0.012 * math.cos(a), 0.006, 0.012 * math.sin(a)),
                (0.030 * math.cos(a), 0.15 + 0.01 * k, 0.030 * math.sin(a)),
                0.004,
                4,
            ),
        )
    return mesh


def book(mesh, cover, low, high, top='+y', hidden=('-y', '-z')):
    """The top edge shows its paper. In a shelf a book's foot and its back edge are never seen."""
    mesh.add(cover, box(low, high, without=(top,) + hidden))
    mesh.add('paper', box(low, high, without=tuple(sorted({'-x', '+x', '-y', '+y', '-z', '+z'} - {top}))))


def paper_stack(seed):
    generator = random.Random(seed)
    mesh = Mesh('books and papers %d' % seed)
    y = -SUNK
    for cover in generator.sample(['book navy', 'book ochre', 'book red', 'book green', 'book cream', 'book teal'], 3):
        thick, w, d = generator.uniform(0.012, 0.035), generator.uniform(0.15, 0.21), generator.uniform(0.21, 0.29)
        turn = generator.uniform(-14, 14)
        mesh.add(cover, block(w, thick, d, y=y).turned('y', turn))
        y += thick - SUNK / 2
    mesh.add('paper', block(0.21, 0.003, 0.297, 0.27, -SUNK, 0.03).turned('y', generator.uniform(-8, 8)))
    return mesh


def desk_lamp(material):
    mesh = Mesh('desk lamp, ' + material)
    mesh.add(material, disk_capped([(0.07, 0.020), (0.085, 0.014), (0.088, -SUNK)], 18))
    elbow, head = (-0.16, 0.34, 0.02), (0.10, 0.50, 0.02)
    mesh.add(
        'brushed steel', rod((0, 0.018, 0), (-0.155, 0.335, 0.0), 0.006, 6), rod((-0.165, 0.330, 0.014), head, 0.006, 6)
    )
    mesh.add(material, tube([(elbow[0], elbow[1], -0.012), (elbow[0], elbow[1], 0.028)], 0.014, 8))
    shade = lathe(
        [(0.022, 0.055), (0.030, 0.045), (0.072, -0.045), (0.069, -0.045), (0.028, 0.040), (0, 0.042)][::-1], 16
    ).flipped()
    cap = lathe([(0, 0.058), (0.022, 0.055)], 16)
    mesh.add(material, Shape().add(shade, cap).turned('z', 24).moved(head[0] + 0.012, head[1] - 0.03, head[2]))
    return mesh


def task_chair(fabric):
    mesh = Mesh('task chair, ' + fabric)

    def seat(x, y, z):
        drop = max(0.0, z - 0.08) ** 2 * 1.6
        return x, y + 0.25 * x * x - drop, z

    def back(x, y, z):  # lies down: z is the height, y the thickness
        return x, y + 0.9 * x * x - 0.05 * math.sin((z + 0.30) / 0.60 * math.pi) + 0.02, z

    mesh.add(fabric, cushion(0.50, 0.075, 0.48, 14, (0, 0.65, 0.95, 1), bend=seat).moved(0, 0.475, 0.02))
    mesh.add(
        fabric,
        cushion(0.45, 0.045, 0.60, 20, (0, 0.5, 0.82, 0.96, 1), bend=back).turned('x', -97).moved(0, 0.86, -0.27),
    )
    spine = smooth_path([(0, 0.40, -0.06), (0, 0.415, -0.24), (0, 0.52, -0.315), (0, 0.74, -0.30)], 3)
    mesh.add('black plastic', tube(spine, lambda t: 0.026 - 0.008 * t, 6), block(0.22, 0.06, 0.24, y=0.385, z=0.0))
    for s in (-1, 1):
        arm = smooth_path(
            [(s * 0.10, 0.42, 0.0), (s * 0.26, 0.43, 0.0), (s * 0.285, 0.54, -0.01), (s * 0.285, 0.665, -0.01)], 2
        )
        mesh.add('black plastic', tube(arm, 0.014, 5))
        mesh.add(
            'black plastic', cushion(0.075, 0.03, 0.25, 8, rings=(0, 0.85, 1.0), power=3).moved(s * 0.285, 0.675, 0.03)
        )
    mesh.add('brushed steel', cylinder(0.016, 0.22, 0.39, 8))
    mesh.add('black plastic', disk_capped([(0.026, 0.25), (0.028, 0.12)], 8))
    mesh.add('polished aluminium', disk_capped([(0.036, 0.125), (0.045, 0.068)], 10))
    for k in range(5):
        a = 360 / 5 * k + 90
        leg = tube([(0.02, 0.098, 0), (0.16, 0.090, 0), (0.305, 0.055, 0)], lambda t: 0.024 - 0.009 * t, 5)
        mesh.add('polished aluminium', leg.turned('y', a))
        wheel = disk_capped([(0.025, 0.020), (0.025, -0.020)], 8).turned('x', 90).moved(0.30, 0.025, 0)
        mesh.add('black plastic', wheel.turned('y', a))
    return mesh


def meeting_chair(shell):
    mesh = Mesh('meeting chair, ' + shell)
    profile = smooth_path(
        [(0.205, 0.425), (0.16, 0.448), (0.0, 0.438), (-0.14, 0.445), (-0.205, 0.50), (-0.235, 0.62), (-0.255, 0.82)], 2
    )
    nu, rows = 6, {1: [], -1: []}
    n = len(profile)
    for v, (z, y) in enumerate(profile):
        t = v / (n - 1)
        width = 0.235 - 0.03 * abs(t - 0.55) - 0.05 * max(0, t - 0.8) ** 2 * 25
        upright = min(1.0, max(0.0, (t - 0.35) / 0.4))  # seat -> back
        for side in (1, -1):
            row = []
            for u in range(nu + 1):
                s = 2 * u / nu - 1
                curl, off = 0.055 * s**4, 0.005 * side
                row.append(
                    (
                        width * s * (1 - 0.06 * s * s),
                        y + curl * (1 - 0.85 * upright) + off * (1 - 0.7 * upright),
                        z + curl * (0.25 + 0.75 * upright) + off * (0.2 + 0.8 * upright),
                    )
                )
            rows[side].append(row)
    rim = [r[0] for r in rows[1]], [r[-1] for r in rows[1]], [r[0] for r in rows[-1]], [r[-1] for r in rows[-1]]
    mesh.add(shell, surface(rows[1]), surface(rows[-1]).flipped())
    mesh.add(shell, surface([rim[0], rim[2]]), surface([rim[1], rim[3]]).flipped())
    mesh.add(shell, surface([rows[1][0], rows[-1][0]]).flipped(), surface([rows[1][-1], rows[-1][-1]]))
    for sx in (-1, 1):
        for z0, z1 in ((0.15, 0.21), (-0.13, -0.22)):
            mesh.add('beech', tube([(sx * 0.14, 0.435, z0), (sx * 0.21, -SUNK, z1)], lambda t: 0.015 - 0.005 * t, 8))
    mesh.add(
        'black plastic',
        box((-0.15, 0.412, 0.125), (0.15, 0.427, 0.16)),
        box((-0.15, 0.412, -0.15), (0.15, 0.427, -0.115)),
    )
    return mesh


def meeting_table():
    mesh = Mesh('meeting table')
    mesh.add('walnut veneer', extrude(rounded_outline(2.6, 1.15, 0.28, 6), 0.712, 0.74, smooth=True).laid(1.6, 0.8))
    for x in (-0.75, 0.75):
        mesh.add(
            'black steel',
            disk_capped(
                [(0.16, 0.7125), (0.05, 0.69), (0.05, 0.06), (0.10, 0.03), (0.30, 0.012), (0.31, -SUNK)], 20, 50
            ).moved(x),
        )
    mesh.add('black plastic', box((-0.16, 0.739, -0.05), (0.16, 0.748, 0.05)))
    return mesh


def bookcase(seed, name):
    """0.9 m wide, 2.1 m high, 0.32 m deep; its back to -z."""
    generator = random.Random(seed)
    mesh = Mesh(name, solid=False)
    mesh.add(
        'white laminate',
        box((-0.45, -SUNK, -0.16), (-0.428, 2.1, 0.16)),
        box((0.428, -SUNK, -0.16), (0.45, 2.1, 0.16)),
        box((-0.429, 0.0, -0.158), (0.429, 2.09, -0.148)),
        box((-0.429, -SUNK, 0.10), (0.429, 0.071, 0.12)),
        box((-0.429, 2.078, -0.149), (0.429, 2.0999, 0.159)),
    )
    covers = ['book red', 'book navy', 'book ochre', 'book green', 'book cream', 'book grey', 'book teal', 'book plum']
    levels = [0.07, 0.48, 0.88, 1.28, 1.68]
    for level, y in enumerate(levels):
        mesh.add('white laminate', box((-0.429, y, -0.149), (0.429, y + 0.022, 0.155)))
        floor = y + 0.021
        x = -0.425
        if level == 0 or (level == 1 and generator.random() < 0.6):
            binder = generator.choice(['book navy', 'book grey', 'book plum'])
            while x + 0.082 < (0.42 if level == 0 else 0.15):
                if generator.random() > 0.08:
                    mesh.add(binder, box((x, floor, -0.13), (x + 0.075, floor + 0.32, 0.145), ('-y', '-z')))
                    mesh.add('paper', rectangle((x + 0.012, floor + 0.16, 0.146), (0.051, 0, 0), (0, 0.13, 0)))
                    mesh.add(
                        'black plastic',
                        polygon(
                            [
                                (
                                    x + 0.0375 + 0.012 * math.cos(TAU * k / 8),
                                    floor + 0.06 + 0.012 * math.sin(TAU * k / 8),
                                    0.146,
                                )
                                for k in range(8)
                            ]
                        ),
                    )
                x += 0.0775
        stop = generator.choice([0.41, 0.41, 0.3, 0.16])
        run = 0
        while x < stop:
            if run == 0:
                run, cover, high, deep = (
                    generator.randint(1, 5),
                    generator.choice(covers),
                    generator.uniform(0.19, 0.32),
                    generator.uniform(0.15, 0.23),
                )
            thick = generator.uniform(0.016, 0.045)
            if x + thick > 0.425:
                break
            h = high + generator.uniform(-0.012, 0.012)
            front = 0.135 - generator.uniform(0, 0.015)
            book(mesh, cover, (x, floor, front - deep), (x + thick, floor + h, front))
            x += thick + generator.choice((0.0012, 0.0012, 0.002))
            run -= 1
        room = 0.425 - x
        if room > 0.20:  # a lying stack at the end
            yy = floor
            for _ in range(generator.randint(2, 5)):
                thick, w = generator.uniform(0.018, 0.04), generator.uniform(0.15, min(0.24, room - 0.03))
                book(
                    mesh,
                    generator.choice(covers),
                    (x + 0.02, yy, -0.11),
                    (x + 0.02 + w, yy + thick, 0.12),
                    '+x',
                    ('-z',),
                )
                yy += thick - 0.0005
        elif room > 0.07:  # one that leans on its neighbours
            leaning = Mesh('')
            h = 0.24
            book(leaning, generator.choice(covers), (0, 0, -0.06), (0.025, h, 0.125), hidden=('-z',))
            for material, shape in leaning.parts.items():
                mesh.add(material, shape.turned('z', 11).moved(x + 0.048, floor, 0))
    return mesh


def filing_cabinet():
    """0.8 m wide, 1.1 m high, 0.45 m deep; three drawers."""
    mesh = Mesh('filing cabinet')
    mesh.add('cabinet steel', box((-0.4, 0.04, -0.225), (0.4, 1.1, 0.215)))
    mesh.add('black plastic', box((-0.39, -SUNK, -0.22), (0.39, 0.041, 0.19)))
    for k in range(3):
        y = 0.052 + 0.347 * k
        mesh.add('drawer front', box((-0.392, y, 0.214), (0.392, y + 0.338, 0.232)))
        mesh.add('brushed steel', box((-0.09, y + 0.285, 0.231), (0.09, y + 0.297, 0.252)))
        mesh.add('paper', box((-0.04, y + 0.225, 0.2315), (0.04, y + 0.262, 0.2335)))
    return mesh


def leaf(length, width, droop, bend=0.25):
    """A leaf that grows from the origin along +z and hangs by `droop`; a sheet."""
    rows = []
    for v in range(5):
        t = v / 4
        half = width / 2 * math.sin(math.pi * min(1.0, 0.08 + 0.92 * t)) ** 0.8 if v < 4 else 0.0
        y, z = length * (0.25 * t - droop * t * t), length * t * (1 - 0.25 * droop * t)
        rows.append([(-s * half, y + bend * abs(s) * half, z) for s in (1, 0, -1)] if v < 4 else [(0.0, y, z)] * 3)
    return surface(rows).flipped()


def pot(radius, height, sides=18):
    """A pot with its soil left out: (outside and rim, height of the soil)."""
    soil = height * 0.9
    return (
        lathe(
            [
                (0, -SUNK),
                (radius * 0.72, -SUNK),
                (radius * 0.97, height * 0.94),
                (radius, height),
                (radius * 0.9, height),
                (radius * 0.86, soil),
                (0, soil - 0.001),
            ],
            sides,
        ).flipped(),
        soil,
    )


def ficus(seed, height, leaves, material, pot_material):
    generator = random.Random(seed)
    mesh = Mesh('plant %d' % seed, solid=False)
    shape, soil = pot(0.17, 0.34)
    mesh.add(pot_material, shape)
    mesh.add('soil', disk_capped([(0.147, soil + 0.002), (0.147, soil - 0.01)], 14))
    stems = []
    for k in range(3):
        a = TAU * k / 3 + 0.4
        top = (0.16 * math.cos(a), height * generator.uniform(0.82, 1.0), 0.16 * math.sin(a))
        path = smooth_path(
            [
                (0.03 * math.cos(a), soil - 0.01, 0.03 * math.sin(a)),
                (0.05 * math.cos(a + 0.5), height * 0.5, 0.05 * math.sin(a + 0.5)),
                top,
            ],
            3,
        )
        stems.append(path)
        mesh.add('bark', tube(path, lambda t: 0.013 - 0.008 * t, 6))
    for k in range(leaves):
        path = stems[k % 3]
        t = 0.38 + 0.62 * (k + 0.5) / leaves
        place = t * (len(path) - 1)
        i = min(int(place), len(path) - 2)
        f = place - i
        x, y, z = (a + (b - a) * f for a, b in zip(path[i], path[i + 1]))
        size = generator.uniform(0.22, 0.32) * (1.15 - 0.35 * t)
        one = leaf(size, size * 0.48, generator.uniform(0.25, 0.75)).turned('x', -generator.uniform(0, 45) * t)
        mesh.add(material, one.turned('y', math.degrees(k * 2.39996) + generator.uniform(-15, 15)).moved(x, y, z))
    return mesh


def snake_plant(seed, pot_material):
    generator = random.Random(seed)
    mesh = Mesh('small plant %d' % seed, solid=False)
    shape, soil = pot(0.075, 0.13, 14)
    mesh.add(pot_material, shape)
    mesh.add('soil', disk_capped([(0.064, soil + 0.002), (0.064, soil - 0.01)], 10))
    for k in range(11):
        a, high = TAU * k * 0.382, generator.uniform(0.16, 0.32)
        lean, foot = generator.uniform(0.05, 0.16), 0.012 + 0.028 * (k / 11)
        rows = []
        for t in (0, 0.33, 0.7, 1.0):
            half = 0.019 * (1 - t**2.2)
            out = foot + lean * t * t
            rows.append([(s * half, soil - 0.005 + high * t, out + 0.35 * abs(s) * half) for s in (-1, 0, 1)])
        mesh.add('leaf, dark', surface(rows).turned('y', math.degrees(a)))
    return mesh


def bin_():
    mesh = Mesh('waste bin')
    mesh.add(
        'grey plastic',
        lathe(
            [(0, 0.006), (0.098, 0.006), (0.128, 0.318), (0.136, 0.322), (0.138, 0.315), (0.105, -SUNK), (0, -SUNK)][
                ::-1
            ],
            18,
        ).flipped(),
    )
    return mesh


def coat_stand():
    mesh = Mesh('coat stand')
    mesh.add(
        'beech', disk_capped([(0.02, 0.03), (0.19, 0.024), (0.20, -SUNK)], 20), cylinder(0.022, 0.025, 1.75, 8, 0.018)
    )
    mesh.add('beech', lathe([(0, 1.79), (0.018, 1.783), (0.026, 1.765), (0.018, 1.745), (0, 1.742)], 10))
    for k in range(6):
        low = k % 2
        arm = smooth_path([(0.01, 1.60 - 0.2 * low, 0), (0.10, 1.63 - 0.2 * low, 0), (0.15, 1.70 - 0.2 * low, 0)], 3)
        mesh.add('beech', tube(arm, lambda t: 0.012 - 0.003 * t, 5).turned('y', 60 * k))
        mesh.add(
            'beech',
            lathe([(0, 0.016), (0.013, 0.008), (0.013, -0.008), (0, -0.016)], 6, 90)
            .moved(0.152, 1.705 - 0.2 * low, 0)
            .turned('y', 60 * k),
        )
    return mesh


def coat():
    """A coat that hangs from a hook, as a closed form."""
    mesh = Mesh('coat')
    rows = [[(0.0, 0.0, 0.0)] * 18]
    for t in (0.03, 0.09, 0.2, 0.4, 0.6, 0.8, 1.0):
        wide, deep = 0.05 + 0.17 * min(1, t * 4) ** 0.7 + 0.03 * t, 0.03 + 0.05 * min(1, t * 3) + 0.015 * t
        rows.append(
            [
                (
                    (wide + 0.012 * t * math.sin(5 * TAU * k / 18)) * math.cos(TAU * k / 18),
                    -0.98 * t - 0.04 * min(1, t * 4) * abs(math.cos(TAU * k / 18)) ** 2,
                    -(deep + 0.014 * t * math.cos(4 * TAU * k / 18)) * math.sin(TAU * k / 18),
                )
                for k in range(18)
            ]
        )
    rows.append([(0.0, -0.97, 0.0)] * 18)
    mesh.add('wool', surface(rows[::-1], closed_u=True))
    for s in (-1, 1):
        sleeve = smooth_path([(s * 0.17, -0.10, 0), (s * 0.235, -0.30, 0.01), (s * 0.25, -0.62, 0.035)], 3)
        mesh.add('wool', tube(sleeve, lambda t: 0.062 - 0.012 * t, 8))
    return mesh


def framed_picture(name, picture, frame, width, height, margin=0.07):
    """Hangs on a wall at z = 0, seen from +z; its middle at the origin. `width` and `height` are the picture's own."""
    mesh = Mesh(name, solid=False)
    w, h, b = width / 2 + margin, height / 2 + margin, 0.025
    mesh.add(
        frame,
        box((-w - b, h, -SUNK), (w + b, h + b, 0.03)),
        box((-w - b, -h - b, -SUNK), (w + b, -h, 0.03)),
        box((-w - b, -h, -SUNK), (-w, h, 0.03), without=('-y', '+y')),
        box((w, -h, -SUNK), (w + b, h, 0.03), without=('-y', '+y')),
    )
    x, y = width / 2, height / 2
    if margin > 0:  # the mount is a ring, so that nothing lies behind the picture
        mesh.add(
            'picture mount',
            rectangle((-w, -h, 0.012), (2 * w, 0, 0), (0, h - y, 0)),
            rectangle((-w, y, 0.012), (2 * w, 0, 0), (0, h - y, 0)),
            rectangle((-w, -y, 0.012), (w - x, 0, 0), (0, 2 * y, 0)),
            rectangle((x, -y, 0.012), (w - x, 0, 0), (0, 2 * y, 0)),
        )
    mesh.add(picture, rectangle((-x, -y, 0.012), (2 * x, 0, 0), (0, 2 * y, 0), PICTURE_UV))
    return mesh


def wall_clock():
    mesh = Mesh('clock')
    mesh.add(
        'black plastic',
        lathe([(0.150, 0.0), (0.150, 0.035), (0.140, 0.038), (0.138, 0.022)], 28).flipped().turned('x', 90),
    )
    mesh.solid = False
    mesh.add(
        'clock face',
        polygon([(0.139 * math.cos(TAU * k / 28), 0.139 * math.sin(TAU * k / 28), 0.022) for k in range(28)]),
    )
    for k in range(12):
        mesh.add('black plastic', box((-0.004, 0.108, 0.0215), (0.004, 0.13, 0.0235)).turned('z', 30 * k))
    mesh.add(
        'black plastic',
        box((-0.005, -0.02, 0.0245), (0.005, 0.075, 0.0265)).turned('z', 55),
        box((-0.0035, -0.02, 0.0275), (0.0035, 0.11, 0.029)).turned('z', -62),
    )
    return mesh

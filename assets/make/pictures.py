"""The pictures of the office and the gallery: `python3 pictures.py [NAME...]` writes ../pictures/NAME.png.

Every picture is a function of the place and of fixed random numbers, so each run gives the same bytes. Colours are written as
sRGB; the darkest and lightest stay where paint and print can be (reflectance about 0.03 to 0.85). Standard library only.
"""
import math
import os
import random
import sys

from canvas import Canvas, Noise, clamp, colour, mix, ramp, shade, smooth

TAU = 2 * math.pi


# ---- paintings ----


def dunes():
    w, h = 840, 560
    sky = [(0.0, colour('#2f4b6e')), (0.35, colour('#8f7f9c')), (0.55, colour('#e3a27f')), (0.68, colour('#f2cf9a'))]
    tones = ['#d99a6c', '#c47a55', '#a85c48', '#84453f', '#5e3238', '#3a2430']
    noise = Noise(11)
    ridges = [
        [
            h * (0.52 + 0.085 * k)
            + h * (0.11 - 0.008 * k) * noise.layers(3.1 * k + x / w * (2.2 + 0.5 * k), 7.7 * k, 3)
            for x in range(w)
        ]
        for k in range(6)
    ]

    def paint(x, y):
        result = ramp(sky, y / h + 0.03 * noise.layers(x / w * 3, y / h * 14, 3))
        d = math.hypot(x - 0.64 * w, y - 0.43 * h)
        result = mix(result, colour('#fbe3b0'), 0.55 * math.exp(-d / 95))
        result = mix(result, colour('#fdf0cf'), clamp(37.5 - d))
        for k in range(6):
            below = y - ridges[k][int(x)]
            if below > -0.5:
                tone = mix(colour(tones[k]), colour('#f0b07c'), 0.42 * math.exp(-max(below, 0) / (26 + 8 * k)))
                grain = 0.04 * noise.layers(x / 46, (y + 0.3 * x) / 9 + 20 * k, 2)
                result = mix(result, shade(tone, 1 + grain), clamp(below + 0.5))
        return result

    return Canvas(w, h, paint)


def sea():
    w, h = 840, 560
    noise = Noise(23)
    horizon = 0.46 * h

    def paint(x, y):
        if y < horizon:
            t = y / horizon
            result = mix(colour('#5f8fb5'), colour('#e8dcc4'), smooth(0.05, 1.0, t))
            depth = 1.15 - t
            cloud = noise.layers(x / w * 4 / depth + 3, t * 5 / depth, 5)
            lit = noise.layers(x / w * 4 / depth + 3.12, t * 5 / depth - 0.12, 5)
            cover = smooth(-0.02, 0.42, cloud)
            result = mix(
                result, mix(colour('#b7b4bd'), colour('#f4ece0'), smooth(-0.15, 0.3, cloud - 0.4 * lit)), 0.9 * cover
            )
            return result
        t = (y - horizon) / (h - horizon)
        scale = 0.05 + t
        wave = noise.layers(x / w * 5 / scale, 9 * math.log(scale) * 2.6, 4)
        result = ramp(
            [(0, colour('#9db4b5')), (0.12, colour('#4d8593')), (0.55, colour('#1f5d70')), (1, colour('#12394d'))], t
        )
        result = mix(result, colour('#cfe0da'), smooth(0.22, 0.5, wave) * (0.75 - 0.35 * t))
        result = mix(result, colour('#0f2f42'), smooth(0.1, 0.55, -wave) * 0.6)
        glint = math.exp(-(((x - 0.36 * w) / (30 + 190 * t)) ** 2)) * smooth(0.0, 0.4, wave + 0.15)
        return mix(result, colour('#f6ead2'), 0.7 * glint)

    return Canvas(w, h, paint)


def circles():
    w, h = 600, 750
    generator = random.Random(5)
    palette = [
        colour(c)
        for c in ('#d8432f', '#f0a830', '#f3e3c3', '#1f4e79', '#2f8f83', '#17202e', '#e07a8b', '#7fb2d6', '#8a3b62')
    ]
    cell = 150
    grid = {}
    for j in range(5):
        for i in range(4):
            choice = generator.sample(palette, 5)
            radii = sorted((generator.uniform(14, 70) for _ in range(4)), reverse=True)
            grid[i, j] = (choice, radii, generator.uniform(-5, 5), generator.uniform(-5, 5))
    noise = Noise(6)

    def paint(x, y):
        choice, radii, dx, dy = grid[min(int(x / cell), 3), min(int(y / cell), 4)]
        px, py = x % cell - cell / 2, y % cell - cell / 2
        wobble = 2.2 * noise.layers(x / 40, y / 40, 2)
        result = choice[0]
        for k, r in enumerate(radii):
            d = math.hypot(px - dx * k / 3, py - dy * k / 3) + wobble
            result = mix(result, choice[k + 1], clamp(r - d + 0.5))
        return shade(result, 0.95 + 0.05 * noise.layers(x / 9, y / 120, 2))

    return Canvas(w, h, paint)


def fields():
    w, h = 560, 760
    noise = Noise(31)
    blocks = [
        (0.07, 0.06, 0.93, 0.36, '#c8371f'),
        (0.07, 0.39, 0.93, 0.55, '#e98a1c'),
        (0.07, 0.58, 0.93, 0.94, '#5b1425'),
    ]

    def paint(x, y):
        u, v = x / w, y / h
        result = shade(colour('#8f2a22'), 1 + 0.09 * noise.layers(u * 6, v * 6, 4))
        bu, bv = u + 0.012 * noise.layers(v * 20, u * 20, 3), v + 0.010 * noise.layers(u * 20, v * 20, 3)
        for x0, y0, x1, y1, tone in blocks:
            edge = min(bu - x0, x1 - bu, bv - y0, y1 - bv)
            wash = 1 + 0.11 * noise.layers(u * 9, v * 4, 4) + 0.05 * noise.at(u * 60, v * 3)
            result = mix(result, shade(colour(tone), wash), 0.93 * smooth(-0.012, 0.022, edge))
        return result

    return Canvas(w, h, paint)


def arcs():
    w, h = 640, 640
    canvas = Canvas(w, h, lambda x, y: colour('#efe4d0'))
    generator = random.Random(77)
    palette = ['#1c3d5a', '#d1495b', '#edae49', '#66a182', '#2e4057', '#e8d7b5', '#8d5a97', '#00798c']
    cell = 160
    for j in range(4):
        for i in range(4):
            a, b, c = (colour(t) for t in generator.sample(palette, 3))
            kind, corner = generator.randrange(4), generator.randrange(4)
            ox, oy = i * cell, j * cell
            cx, cy = ox + cell * (corner & 1), oy + cell * (corner >> 1)
            for y in range(oy, oy + cell):
                for x in range(ox, ox + cell):
                    d = math.hypot(x + 0.5 - cx, y + 0.5 - cy)
                    result = a
                    if kind == 0:
                        for k, tone in enumerate((b, a, c, a, b)):
                            result = mix(result, tone, clamp(cell * (1 - 0.2 * k) - d + 0.5))
                    elif kind == 1:
                        result = mix(mix(a, b, clamp(cell - d + 0.5)), c, clamp(cell * 0.5 - d + 0.5))
                    elif kind == 2:
                        px, py = x + 0.5 - ox, y + 0.5 - oy
                        side = (px - py) if corner & 1 else (px + py - cell)
                        result = mix(a, b, clamp(side + 0.5))
                        result = mix(result, c, clamp(38 - math.hypot(px - cell / 2, py - cell / 2) + 0.5))
                    else:
                        px = (x + 0.5 - ox) if corner & 1 else (y + 0.5 - oy)
                        wave = px % 40
                        result = mix(a, b, clamp(min(wave, 40 - wave) - 10 + 0.5))
                    canvas.rows[y][x] = result
    noise = Noise(78)
    for y in range(h):
        for x in range(w):
            canvas.rows[y][x] = shade(canvas.rows[y][x], 0.96 + 0.04 * noise.layers(x / 70, y / 70, 3))
    return canvas


def currents():
    w, h = 800, 600
    noise = Noise(41)
    ground = Canvas(
        w, h, lambda x, y: mix(colour('#10202f'), colour('#1d3a4f'), 0.5 + 0.5 * noise.layers(x / 260, y / 260, 3))
    )
    generator = random.Random(42)
    palette = [
        colour(c) for c in ('#f2e8cf', '#e9c46a', '#f4a261', '#e76f51', '#2a9d8f', '#8ecae6', '#8ecae6', '#457b9d')
    ]
    for _ in range(620):
        x, y = generator.uniform(-20, w + 20), generator.uniform(-20, h + 20)
        tone = palette[
            int(
                clamp(0.5 + 0.5 * noise.layers(x / 300 + 9, y / 300 + 5, 2) + generator.uniform(-0.2, 0.2), 0, 0.999)
                * 8
            )
        ]
        steps, width = generator.randint(30, 110), generator.choice((1.2, 1.6, 2.4, 3.6))
        for k in range(steps):
            angle = TAU * 0.9 * noise.layers(x / 310, y / 310, 2)
            nx, ny = x + 4.0 * math.cos(angle), y + 4.0 * math.sin(angle)
            fade = math.sin(math.pi * (k + 0.5) / steps)
            ground.line(x, y, nx, ny, width * (0.4 + 0.6 * fade), tone, 0.8)
            x, y = nx, ny
    return ground


def marble():
    w, h = 640, 640
    noise = Noise(51)
    stops = [
        (-0.55, colour('#0c2733')),
        (-0.25, colour('#14505c')),
        (-0.05, colour('#3f8f8c')),
        (0.08, colour('#cfe0cf')),
        (0.16, colour('#f1e6c8')),
        (0.24, colour('#c99a3f')),
        (0.34, colour('#7c4a25')),
        (0.6, colour('#1b2430')),
    ]

    def paint(x, y):
        u, v = x / w * 2.4, y / h * 2.4
        qx, qy = noise.layers(u, v, 3), noise.layers(u + 5.2, v + 1.3, 3)
        rx = noise.layers(u + 2.2 * qx + 1.7, v + 2.2 * qy + 9.2, 3)
        ry = noise.layers(u + 2.2 * qx + 8.3, v + 2.2 * qy + 2.8, 3)
        value = noise.layers(u + 2.4 * rx, v + 2.4 * ry, 4)
        return shade(ramp(stops, 1.15 * value), 0.92 + 0.25 * qx)

    return Canvas(w, h, paint)


def birches():
    w, h = 560, 760
    noise = Noise(61)
    generator = random.Random(62)

    def ground(x, y):
        v = y / h
        leaves = noise.layers(x / 30, y / 30, 4)
        sky = mix(colour('#f3dfa6'), colour('#d9903a'), smooth(0.0, 0.75, v + 0.22 * leaves))
        result = mix(sky, colour('#a8481f'), smooth(0.05, 0.5, leaves) * 0.75)
        result = mix(result, colour('#f0c24a'), smooth(0.1, 0.5, -leaves) * 0.6)
        floor = smooth(0.74, 0.80, v + 0.04 * noise.layers(x / 80, 3.3, 3))
        litter = mix(colour('#5c3a1e'), colour('#c0732c'), 0.5 + 0.7 * noise.layers(x / 26, y / 7, 3))
        return mix(result, litter, floor)

    canvas = Canvas(w, h, ground)
    for depth in (0.35, 0.6, 1.0):
        for _ in range({0.35: 9, 0.6: 6, 1.0: 4}[depth]):
            x0, lean, radius = (
                generator.uniform(0, w),
                generator.uniform(-0.05, 0.05),
                7 + 19 * depth * generator.uniform(0.8, 1.15),
            )
            foot, phase = h * (0.78 + 0.20 * depth), generator.uniform(0, 60)
            bark = mix(colour('#d8b98a'), colour('#efe9dc'), depth)
            for y in range(int(foot)):
                cx = x0 + lean * (foot - y) + 5 * noise.at(y / 170 + phase, phase)
                r = radius * (0.72 + 0.28 * y / foot)
                for x in range(int(cx - r - 1), int(cx + r + 2)):
                    s = (x + 0.5 - cx) / r
                    if abs(s) < 1.1:
                        mark = smooth(
                            0.30, 0.46, noise.layers(x / (0.9 * radius) + phase, y / (0.20 * radius) + phase, 2)
                        )
                        tone = shade(mix(bark, colour('#38302c'), 0.9 * mark), 1 - 0.45 * smooth(-0.4, 1.0, s))
                        canvas.blend(x, y, tone, clamp((1 - abs(s)) * r + 0.5) * (0.55 + 0.45 * depth))
    return canvas


def moonlight():
    w, h = 960, 480
    noise = Noise(71)
    tones = ['#4b6a8c', '#34527a', '#233d63', '#16294a']
    shore = 0.66 * h
    ridges = [
        [
            h * (0.36 + 0.075 * k) + h * 0.16 * noise.layers(5.3 * k + x / w * (3 + k), 3.1 * k, 5, 0.45)
            for x in range(w)
        ]
        for k in range(4)
    ]
    generator = random.Random(72)
    stars = [(generator.uniform(0, w), generator.uniform(0, 0.4 * h), generator.uniform(0.5, 1.3)) for _ in range(150)]

    def scene(x, y):
        result = ramp([(0, colour('#0d1b34')), (0.55, colour('#27446b')), (0.75, colour('#6f89a3'))], y / h)
        d = math.hypot(x - 0.3 * w, y - 0.2 * h)
        result = mix(result, colour('#dfe6e6'), 0.5 * math.exp(-d / 60))
        result = mix(result, shade(colour('#f4efdc'), 1 + 0.09 * noise.layers(x / 22, y / 22, 3)), clamp(34.5 - d))
        for k in range(4):
            below = y - ridges[k][min(int(x), w - 1)]
            if below > -0.5:
                mist = 0.5 * smooth(0, 0.30 * h, below) * (1 - k / 5)
                result = mix(result, mix(colour(tones[k]), colour('#8ea6b8'), mist), clamp(below + 0.5))
        return result

    def paint(x, y):
        if y < shore:
            return scene(x, y)
        t = (y - shore) / (h - shore)
        ripple = noise.layers(x / (18 + 60 * t), (y - shore) / (1.5 + 5 * t), 3)
        result = scene(
            clamp(x + 9 * ripple * t * 2, 0, w - 1), clamp(2 * shore - y - (y - shore) * 0.6 + 7 * ripple, 0, shore)
        )
        result = mix(shade(result, 0.8), colour('#0f2038'), 0.2 + 0.3 * t)
        path = math.exp(-(((x - 0.3 * w) / (22 + 40 * t)) ** 2)) * smooth(-0.1, 0.35, ripple)
        return mix(result, colour('#eef0e4'), 0.8 * path)

    canvas = Canvas(w, h, paint)
    for x, y, r in stars:
        if y < min(ridge[int(x)] for ridge in ridges) - 4:
            canvas.disk(x, y, r, colour('#f2f2e6'), 0.8)
    return canvas


def seeds():
    w, h = 640, 640
    canvas = Canvas(w, h, lambda x, y: mix(colour('#f4ead5'), colour('#ead7b4'), math.hypot(x - 320, y - 320) / 450))
    stops = [
        (0, colour('#7a2e1f')),
        (0.25, colour('#c8502e')),
        (0.5, colour('#eaa23b')),
        (0.72, colour('#5f9e84')),
        (1, colour('#1f5673')),
    ]
    golden = math.pi * (3 - math.sqrt(5))
    for k in range(1, 720):
        r = 10.9 * math.sqrt(k)
        x, y = 320 + r * math.cos(k * golden), 320 + r * math.sin(k * golden)
        canvas.disk(x, y, 2.4 + 5.4 * math.sqrt(k / 720), ramp(stops, k / 720))
    return canvas


# ---- materials ----


def carpet():
    """Carpet tiles of 0.5 m, laid quarter-turned: 2 m by 2 m, repeats."""
    n = 512
    noise, tiles, generator = Noise(81, 64), {}, random.Random(82)
    for j in range(4):
        for i in range(4):
            tiles[i, j] = generator.uniform(0.95, 1.05) * (1.035 if (i + j) % 2 else 0.965)
    base = colour('#80868b')

    def paint(x, y):
        i, j = int(x / 128), int(y / 128)
        along, across = (x, y) if (i + j) % 2 else (y, x)
        loop = 0.060 * noise.at(along / 8, across / 2) + 0.045 * noise.at(along / 32, across / 4)
        fleck = 0.11 if noise.at(along / 4 + 7, across / 2 + 3) > 0.72 else 0.0
        seam = min(x % 128, 128 - x % 128, y % 128, 128 - y % 128)
        tone = shade(base, tiles[i, j] * (1 + loop - 0.10 * smooth(2.0, 0.5, seam)))
        return mix(tone, colour('#a3aeae'), fleck * 3)

    return Canvas(n, n, paint)


def ceiling():
    """A mineral ceiling tile of 0.6 m in its white T-grid; repeats."""
    n = 256
    noise = Noise(91, 64)
    generator = random.Random(92)
    canvas = Canvas(n, n, lambda x, y: shade(colour('#ecebe6'), 1 + 0.012 * noise.at(x / 4, y / 4)))
    for _ in range(420):
        x, y = generator.uniform(8, n - 8), generator.uniform(8, n - 8)
        canvas.line(
            x,
            y,
            x + generator.uniform(-3, 3),
            y + generator.uniform(-1.5, 1.5),
            generator.uniform(0.7, 1.5),
            colour('#cfcdc6'),
            0.7,
        )
    for k in (0, n - 5):
        canvas.area(k, 0, k + 5, n, colour('#f0f0ee'))
        canvas.area(0, k, n, k + 5, colour('#f0f0ee'))
    for k in (5, n - 6.5):
        canvas.area(k, 5, k + 1.5, n - 5, colour('#b9b8b4'))
        canvas.area(5, k, n - 5, k + 1.5, colour('#b9b8b4'))
    return canvas


def grain(x, y, noise, dark, light):
    """Wood whose grain runs along x; x and y in millimetres."""
    ring = 0.5 + 0.5 * math.sin(0.13 * y + 8.0 * noise.layers(x / 800, y / 110, 3))
    fade = 0.5 + 0.5 * noise.at(x / 900 + 3, y / 130)
    tone = noise.layers(x / 1200, y / 60, 2)
    fibre = 0.5 + 0.5 * noise.layers(x / 90, y / 3.2, 2)
    return mix(light, dark, (0.14 + 0.22 * fade) * ring * ring + 0.42 * fibre + 0.14 * tone)


def oak():
    """A veneer of 1.6 m by 0.8 m."""
    noise = Noise(101)
    return Canvas(512, 256, lambda x, y: grain(x * 3.125, y * 3.125, noise, colour('#a47a4c'), colour('#d3ad7c')))


def walnut():
    """A veneer of 1.6 m by 0.8 m."""
    noise = Noise(103)
    return Canvas(512, 256, lambda x, y: grain(x * 3.125, y * 3.125, noise, colour('#50331f'), colour('#8a6141')))


def parquet():
    """Oak planks of 1.6 m by 0.16 m, staggered: 3.2 m by 1.28 m, repeats."""
    w, h = 1024, 410
    noise, generator = Noise(111), random.Random(112)
    planks = {
        (i, j): (generator.uniform(0.86, 1.08), generator.uniform(0, 40), generator.uniform(0, 1))
        for i in range(2)
        for j in range(8)
    }

    def paint(x, y):
        mx, my = x / w * 3200, y / h * 1280
        j = min(int(my / 160), 7)
        shifted = (mx + (0, 610, 1130, 380, 930, 210, 1340, 760)[j]) % 3200
        i = int(shifted / 1600)
        tone, phase, warm = planks[i, j]
        result = grain(
            shifted % 1600 + 900 * phase, my % 160 + 300 * phase, noise, colour('#8a6a4a'), colour('#b99a74')
        )
        result = mix(shade(result, tone), shade(colour('#b39672'), tone), 0.25 * warm)
        seam = min(shifted % 1600, 1600 - shifted % 1600, my % 160, 160 - my % 160)
        return shade(result, 1 - 0.45 * smooth(4.0, 1.2, seam))

    return Canvas(w, h, paint)


def keyboard():
    """The keys of a keyboard, seen from above: 440 mm by 140 mm."""
    w, h = 352, 112
    canvas = Canvas(w, h, lambda x, y: colour('#33363b'))
    rows = [
        [1.0] * 15,
        [1.5] + [1.0] * 12 + [1.5],
        [1.8] + [1.0] * 11 + [2.2],
        [2.3] + [1.0] * 10 + [2.7],
        [1.3, 1.3, 1.3, 6.2, 1.3, 1.3, 2.3],
    ]
    for j, row in enumerate(rows):
        x = 6.0
        for k, width in enumerate(row):
            step = width * 15.2
            special = (j > 0 and k in (0, len(row) - 1)) or j == 4 and k != 3
            canvas.area(
                x + 1, 9 + 19.4 * j, x + step - 1.5, 9 + 19.4 * j + 16, colour('#5a5e64' if special else '#d4d5d3')
            )
            x += step
    for j in range(5):
        for i in range(7):
            canvas.area(
                240 + 15 * i + 1,
                9 + 19.4 * j,
                240 + 15 * i + 13.5,
                9 + 19.4 * j + 16,
                colour('#d4d5d3' if i > 3 else '#5a5e64'),
                1.0 if i != 3 else 0.0,
            )
    return canvas


def screens():
    """Two screens at work, side by side: a programmer's editor in the left half and a floor plan in the right."""
    w, h = 768, 216
    canvas = Canvas(w, h, lambda x, y: colour('#232a33') if x < w / 2 else colour('#e4e6e4'))
    generator = random.Random(121)
    canvas.area(0, 0, 384, 9, colour('#39424d'))
    canvas.area(0, 9, 62, h, colour('#1c2229'))
    for k in range(22):
        canvas.area(
            8 + 5 * (k % 3), 16 + 9 * k, 8 + 5 * (k % 3) + generator.uniform(18, 38), 19 + 9 * k, colour('#66727f')
        )
    tones = ['#7fb4d8', '#c9d1d9', '#d9a66c', '#8fc08a', '#b48ead', '#c9d1d9']
    for k in range(24):
        x = 74 + 12 * generator.choice((0, 1, 1, 2, 2, 3))
        while x < 74 + generator.uniform(60, 215):
            step = generator.uniform(8, 42)
            canvas.area(x, 15 + 8.2 * k, x + step, 18.4 + 8.2 * k, colour(generator.choice(tones)), 0.9)
            x += step + 5
    canvas.area(318, 9, 384, h, colour('#2a323c'))
    for k in range(60):
        canvas.area(324, 14 + 3.3 * k, 324 + generator.uniform(8, 46), 15.5 + 3.3 * k, colour('#5d6b79'))
    canvas.area(384, 0, 768, 13, colour('#3c6e8f'))
    canvas.area(384, 13, 450, h, colour('#d0d5d6'))
    for k in range(12):
        canvas.area(392, 22 + 15 * k, 392 + generator.uniform(24, 48), 27 + 15 * k, colour('#7b868c'))
    ink = colour('#3a4650')
    for x0, y0, x1, y1 in (
        (470, 30, 745, 30),
        (470, 30, 470, 195),
        (470, 195, 745, 195),
        (745, 30, 745, 195),
        (560, 30, 560, 110),
        (560, 110, 470, 110),
        (640, 80, 640, 195),
        (640, 80, 745, 80),
    ):
        canvas.line(x0, y0, x1, y1, 3, ink)
    for x0, y0, x1, y1, tone in (
        (480, 40, 550, 100, '#f0c987'),
        (650, 90, 735, 185, '#9cc4b2'),
        (570, 125, 630, 185, '#c7d7e6'),
        (490, 125, 550, 165, '#e2a79a'),
    ):
        canvas.area(x0, y0, x1, y1, colour(tone))
    return canvas


def whiteboard():
    """What somebody left on the whiteboard, 2:1."""
    w, h = 640, 320
    noise = Noise(131)
    canvas = Canvas(
        w, h, lambda x, y: shade(colour('#eceeee'), 1 - 0.02 * smooth(0.1, 0.6, noise.layers(x / 150, y / 40, 3)))
    )
    generator = random.Random(132)

    def stroke(points, tone, width=2.2):
        for (x0, y0), (x1, y1) in zip(points, points[1:]):
            canvas.line(x0, y0, x1, y1, width, colour(tone), 0.9)

    def writing(x, y, words, tone, size=7):
        for _ in range(words):
            points = []
            for k in range(generator.randint(5, 11)):
                points.append(
                    (x, y + generator.uniform(-size / 2, size / 2) * (1.6 if generator.random() < 0.2 else 1))
                )
                x += generator.uniform(2.5, 4.5)
            stroke(points, tone, 1.6)
            x += 8

    blue, red, green, black = '#24509a', '#b5322c', '#2f7d4a', '#2b2f33'
    writing(38, 40, 4, black, 11)
    stroke([(38, 54), (200, 53)], red)
    for k in range(5):
        canvas.disk(46, 82 + 24 * k, 3, colour(blue))
        writing(58, 82 + 24 * k, 2 + k % 3, blue)
    stroke([(300, 250), (300, 60)], black)
    stroke([(290, 240), (470, 240)], black)
    stroke([(300 + 8 * k, 235 - 160 * (1 - math.exp(-k / 5))) for k in range(20)], red, 2.6)
    stroke([(300 + 8 * k, 235 - 110 * (1 - math.exp(-k / 11)) - 3 * math.sin(k)) for k in range(20)], green, 2.6)
    writing(330, 262, 2, black)
    for k, (x, y) in enumerate(((545, 70), (545, 150), (545, 230))):
        tone = (green, blue, red)[k]
        stroke([(x - 48, y - 22), (x + 48, y - 23), (x + 49, y + 21), (x - 47, y + 22), (x - 48, y - 22)], tone)
        writing(x - 36, y, 2, tone)
        if k < 2:
            stroke([(x, y + 24), (x, y + 54), (x - 6, y + 46)], black)
    return canvas


ALL = [
    dunes,
    sea,
    circles,
    fields,
    arcs,
    currents,
    marble,
    birches,
    moonlight,
    seeds,
    carpet,
    ceiling,
    oak,
    walnut,
    parquet,
    keyboard,
    screens,
    whiteboard,
]

if __name__ == '__main__':
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'pictures')
    os.makedirs(folder, exist_ok=True)
    for picture in ALL:
        if len(sys.argv) < 2 or picture.__name__ in sys.argv[1:]:
            picture().write(os.path.join(folder, picture.__name__ + '.png'))

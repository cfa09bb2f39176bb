"""What pictures are painted with: colours, repeatable noise, a canvas, and PNG files. Standard library only."""
import math
import random
import struct
import zlib


# ---- numbers ----


def clamp(x, low=0.0, high=1.0):
    return low if x < low else high if x > high else x


def smooth(low, high, x):
    t = clamp((x - low) / (high - low))
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return (a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t)


def shade(colour, factor):
    return (colour[0] * factor, colour[1] * factor, colour[2] * factor)


def colour(text):
    return tuple(int(text[i : i + 2], 16) / 255 for i in (1, 3, 5))


def ramp(stops, t):
    """stops: [(place, colour)], rising."""
    if t <= stops[0][0]:
        return stops[0][1]
    for (a, ca), (b, cb) in zip(stops, stops[1:]):
        if t <= b:
            return mix(ca, cb, smooth(a, b, t))
    return stops[-1][1]


class Noise:
    """Value noise on a lattice that repeats each `period` cells, -1..1."""

    def __init__(self, seed, period=64):
        generator = random.Random(seed)
        self.n = period
        self.values = [generator.uniform(-1, 1) for _ in range(period * period)]

    def at(self, x, y):
        n, values = self.n, self.values
        ix, iy = math.floor(x), math.floor(y)
        fx, fy = x - ix, y - iy
        fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
        x0, x1, r0, r1 = ix % n, (ix + 1) % n, (iy % n) * n, ((iy + 1) % n) * n
        a = values[r0 + x0] + (values[r0 + x1] - values[r0 + x0]) * fx
        b = values[r1 + x0] + (values[r1 + x1] - values[r1 + x0]) * fx
        return a + (b - a) * fy

    def layers(self, x, y, octaves=4, gain=0.5):
        total, weight, norm = 0.0, 1.0, 0.0
        for _ in range(octaves):
            total += weight * self.at(x, y)
            norm += weight
            x, y, weight = 2 * x, 2 * y, weight * gain
        return total / norm


# ---- canvas ----


class Canvas:
    def __init__(self, width, height, paint):
        """paint(x, y) gives the colour at the centre of a pixel; x and y in pixels, y down."""
        self.width, self.height = width, height
        self.rows = [[paint(x + 0.5, y + 0.5) for x in range(width)] for y in range(height)]

    def blend(self, x, y, paint, share):
        if share > 0 and 0 <= x < self.width and 0 <= y < self.height:
            self.rows[y][x] = mix(self.rows[y][x], paint, min(share, 1.0))

    def disk(self, cx, cy, radius, paint, share=1.0):
        for y in range(int(cy - radius - 1), int(cy + radius + 2)):
            for x in range(int(cx - radius - 1), int(cx + radius + 2)):
                self.blend(x, y, paint, share * clamp(radius + 0.5 - math.hypot(x + 0.5 - cx, y + 0.5 - cy)))

    def area(self, x0, y0, x1, y1, paint, share=1.0):
        for y in range(max(0, math.floor(y0)), min(self.height, math.ceil(y1))):
            cover_y = min(y + 1, y1) - max(y, y0)
            for x in range(max(0, math.floor(x0)), min(self.width, math.ceil(x1))):
                self.blend(x, y, paint, share * cover_y * (min(x + 1, x1) - max(x, x0)))

    def line(self, x0, y0, x1, y1, width, paint, share=1.0):
        l2 = (x1 - x0) ** 2 + (y1 - y0) ** 2 or 1.0
        reach = width / 2 + 1
        for y in range(int(min(y0, y1) - reach), int(max(y0, y1) + reach) + 1):
            for x in range(int(min(x0, x1) - reach), int(max(x0, x1) + reach) + 1):
                px, py = x + 0.5 - x0, y + 0.5 - y0
                t = clamp((px * (x1 - x0) + py * (y1 - y0)) / l2)
                d = math.hypot(px - t * (x1 - x0), py - t * (y1 - y0))
                self.blend(x, y, paint, share * clamp(width / 2 + 0.5 - d))

    def write(self, path):
        """A PNG of 8 bits, each row with the filter that leaves the smallest differences."""
        previous = bytes(3 * self.width)
        data = bytearray()
        for row in self.rows:
            line = bytes(int(clamp(c) * 255 + 0.5) for p in row for c in p)
            left = bytes(3) + line[:-3]
            corner = bytes(3) + previous[:-3]
            sub = bytes((a - b) & 255 for a, b in zip(line, left))
            up = bytes((a - b) & 255 for a, b in zip(line, previous))
            paeth = bytearray()
            for a, b, c, d in zip(line, left, previous, corner):
                pb, pc, pd = abs(c - d), abs(b - d), abs(b + c - 2 * d)
                paeth.append((a - (b if pb <= pc and pb <= pd else c if pc <= pd else d)) & 255)
            choices = ((1, sub), (2, up), (4, bytes(paeth)))
            kind, best = min(choices, key=lambda choice: sum(v if v < 128 else 256 - v for v in choice[1]))
            data.append(kind)
            data += best
            previous = line

        def chunk(name, body):
            return struct.pack('>I', len(body)) + name + body + struct.pack('>I', zlib.crc32(name + body))

        header = struct.pack('>IIBBBBB', self.width, self.height, 8, 2, 0, 0, 0)
        with open(path, 'wb') as file:
            file.write(
                b'\x89PNG\r\n\x1a\n'
                + chunk(b'IHDR', header)
                + chunk(b'sRGB', b'\0')
                + chunk(b'IDAT', zlib.compress(bytes(data), 9))
                + chunk(b'IEND', b'')
            )

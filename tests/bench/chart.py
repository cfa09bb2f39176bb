#!/usr/bin/env python3
"""chart.py IN.csv OUT.svg TITLE: relative RMS error against time, log-log, one curve a method."""
import csv
import math
import sys
from html import escape

COLOURS = ["#e8a33d", "#5aa9c9", "#9a9a9a", "#c96a5a"]
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 420, 70, 20, 46, 54


def main(source, target, title):
    curves = {}
    with open(source, newline="") as file:
        for row in csv.DictReader(file):
            curves.setdefault(row["method"], []).append((1e3 * float(row["seconds"]), float(row["rms_percent"])))
    points = [p for curve in curves.values() for p in curve]
    x0, x1 = (f(math.log10(p[0]) for p in points) for f in (min, max))
    y0, y1 = (f(math.log10(max(p[1], 0.1)) for p in points) for f in (min, max))
    x0, x1, y0, y1 = math.floor(x0 * 2) / 2, math.ceil(x1 * 2) / 2, min(0, math.floor(y0)), math.ceil(y1)

    def place(x, y):
        return (LEFT + (math.log10(x) - x0) / (x1 - x0) * (WIDTH - LEFT - RIGHT),
                HEIGHT - BOTTOM - (math.log10(max(y, 0.1)) - y0) / (y1 - y0) * (HEIGHT - TOP - BOTTOM))

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="Inter, sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#1e1e1e"/>',
           f'<text x="{LEFT}" y="24" fill="#eeeeee" font-size="15">{escape(title)}</text>']
    for decade in range(math.floor(x0), math.ceil(x1) + 1):
        for step in (1, 2, 5):
            if x0 <= math.log10(step * 10 ** decade) <= x1:
                x, _ = place(step * 10 ** decade, 1)
                out.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{HEIGHT - BOTTOM}" stroke="#{"555" if step == 1 else "333"}"/>')
                out.append(f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 18}" fill="#aaaaaa" text-anchor="middle">{step * 10 ** decade:g}</text>')
    for decade in range(math.floor(y0), math.ceil(y1) + 1):
        for step in (1, 2, 5):
            if y0 <= math.log10(step * 10 ** decade) <= y1:
                _, y = place(1, step * 10 ** decade)
                out.append(f'<line x1="{LEFT}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" stroke="#{"555" if step == 1 else "333"}"/>')
                out.append(f'<text x="{LEFT - 8}" y="{y + 4:.1f}" fill="#aaaaaa" text-anchor="end">{step * 10 ** decade:g} %</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 12}" fill="#aaaaaa" text-anchor="middle">solve time, ms</text>')
    for k, (name, curve) in enumerate(curves.items()):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (place(*p) for p in curve))
        out.append(f'<polyline points="{path}" fill="none" stroke="{COLOURS[k % len(COLOURS)]}" stroke-width="2"/>')
        out.append(f'<text x="{WIDTH - RIGHT - 8}" y="{TOP + 18 + 18 * k}" fill="{COLOURS[k % len(COLOURS)]}" text-anchor="end">{escape(name)}</text>')
    out.append("</svg>")
    with open(target, "w") as file:
        file.write("\n".join(out) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])

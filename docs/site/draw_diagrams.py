#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the diagrams of "How it works", by the very rules that they explain, in the plane instead of space.

usage: draw_diagrams.py FOLDER [--check]; --check writes nothing and names the files that would change
"""
import math
import pathlib
import sys

BLUE, ORANGE, GREEN, GREY, LIGHT = "#1f6fb4", "#d95f0e", "#2c8a3d", "#777777", "#dddddd"
# The angle criterion of the thesis, Table 2.4: acos(sqrt(1/3)).
CRITERION = math.acos(math.sqrt(1 / 3))


class Picture:
    """An SVG picture; x to the right, y upwards, in units of the page."""

    def __init__(self, width, height):
        self.width, self.height, self.parts = width, height, []

    def place(self, point):
        return f"{point[0]:.1f}", f"{self.height - point[1]:.1f}"

    def line(self, a, b, color="black", width=1.0, dash="", arrow=False):
        (x1, y1), (x2, y2) = self.place(a), self.place(b)
        style = f' stroke-dasharray="{dash}"' if dash else ""
        style += ' marker-end="url(#arrow)"' if arrow else ""
        self.parts.append(f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" stroke="{color}" stroke-width="{width}"{style}/>')

    def box(self, low, high, fill="none", color=GREY, width=1.0):
        x, y = self.place((low[0], high[1]))
        self.parts.append(f'<rect x="{x}" y="{y}" width="{high[0] - low[0]:.1f}" height="{high[1] - low[1]:.1f}" '
                          f'fill="{fill}" stroke="{color}" stroke-width="{width}"/>')

    def circle(self, center, radius, fill="none", color="none", width=1.0, dash=""):
        x, y = self.place(center)
        style = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="{radius:.1f}" fill="{fill}" stroke="{color}" '
                          f'stroke-width="{width}"{style}/>')

    def text(self, point, words, size=13, color="black", anchor="middle", family="sans-serif"):
        x, y = self.place(point)
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        self.parts.append(f'<text x="{x}" y="{y}" font-size="{size}" fill="{color}" text-anchor="{anchor}" '
                          f'font-family="{family}">{words}</text>')

    def write(self):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" '
                f'viewBox="0 0 {self.width} {self.height}">\n<defs><marker id="arrow" viewBox="0 0 8 8" refX="8" refY="4" '
                'markerWidth="8" markerHeight="8" orient="auto"><path d="M0,0 L8,4 L0,8 z"/></marker></defs>\n'
                '<rect width="100%" height="100%" fill="white"/>\n')
        return head + "\n".join(self.parts) + "\n</svg>\n"


def make_samples(side, seed):
    """side^2 points of the unit square, one in each cell of a lattice; their own generator, so that no library
    changes the pictures."""
    points, state = [], seed
    for cell in range(side * side):
        pair = []
        for _ in range(2):
            state = (6364136223846793005 * state + 1442695040888963407) % 2**64
            pair.append(0.1 + 0.8 * (state >> 33) / 2**31)
        points.append(((cell % side + pair[0]) / side, (cell // side + pair[1]) / side))
    return points


def split(points, low=(0.0, 0.0), high=(1.0, 1.0), node=1, axis=0):
    """Leaves (node, point, low, high) and splits (node, axis, place, low, high) of the kd-tree."""
    if len(points) == 1:
        return [(node, points[0], low, high)], []
    ordered = sorted(points, key=lambda p: (p[axis], p[1 - axis]))
    half = (len(ordered) + 1) // 2
    cut = ordered[half][axis]
    below = tuple(cut if i == axis else high[i] for i in range(2))
    above = tuple(cut if i == axis else low[i] for i in range(2))
    leaves, splits = [], [(node, axis, cut, low, high)]
    for part, corners, child in ((ordered[:half], (low, below), 2 * node), (ordered[half:], (above, high), 2 * node + 1)):
        more_leaves, more_splits = split(part, *corners, child, 1 - axis)
        leaves += more_leaves
        splits += more_splits
    return leaves, splits


def do_touch(a, b):
    """Whether two boxes share a piece of a side."""
    overlaps = [min(a[3][i], b[3][i]) - max(a[2][i], b[2][i]) for i in range(2)]
    return min(overlaps) >= -1e-12 and max(overlaps) > 1e-12


def scaler(x, y, size):
    return lambda p: (x + size * p[0], y + size * p[1])


def draw_tree():
    picture = Picture(720, 340)
    at = scaler(20, 20, 300)
    leaves, splits = split(make_samples(3, 282)[1:])
    colors = [BLUE, ORANGE, GREEN]
    picture.box(at((0, 0)), at((1, 1)))
    for node, axis, cut, low, high in splits:
        level = node.bit_length() - 1
        ends = ((cut, low[1]), (cut, high[1])) if axis == 0 else ((low[0], cut), (high[0], cut))
        picture.line(at(ends[0]), at(ends[1]), colors[level], 4 - level)
    for node, point, low, high in leaves:
        picture.circle(at(point), 4, "black")
        x = (low[0] + high[0]) / 2
        y = max((low[1] + (high[1] - low[1]) * part for part in (0.3, 0.7)), key=lambda y: math.dist((x, y), point))
        picture.text((at((x, y))[0], at((x, y))[1] - 4), f"{node:b}", 13, GREY, family="monospace")

    def spot(node):
        level = node.bit_length() - 1
        return (360 + 340 * (node - 2**level + 0.5) / 2**level, 290 - 80 * level)

    for node in range(1, 8):
        for child in (2 * node, 2 * node + 1):
            picture.line(spot(node), spot(child), GREY)
    for node in range(1, 16):
        level = node.bit_length() - 1
        picture.circle(spot(node), 19, "white", colors[level] if level < 3 else "black", 2)
        picture.text((spot(node)[0], spot(node)[1] - 4), f"{node:b}", 11, family="monospace")
    return picture


def draw_neighbors():
    picture = Picture(720, 360)
    leaves, _ = split(make_samples(7, 3))
    inner = [leaf for leaf in leaves if math.dist(leaf[1], (0.5, 0.5)) < 0.3]
    own = max(inner, key=lambda leaf: sum(do_touch(leaf, other) for other in leaves))
    candidates = [leaf for leaf in leaves if leaf is not own and do_touch(own, leaf)]
    for panel, x in enumerate((20, 390)):
        at = scaler(x, 40, 300)
        for leaf in leaves:
            fill = "#bcd8ee" if leaf is own else "#f6dcc6" if leaf in candidates else "none"
            picture.box(at(leaf[2]), at(leaf[3]), fill, LIGHT if panel else GREY)
        for leaf in leaves:
            picture.circle(at(leaf[1]), 3, BLUE if leaf is own else ORANGE if leaf in candidates else GREY)
    picture.text((170, 15), "boxes that touch that of a sample: candidates")
    picture.text((540, 15), "angle criterion: solid stays, dashed goes")
    kept = []
    for leaf in sorted(candidates, key=lambda leaf: math.dist(own[1], leaf[1])):
        way = [leaf[1][i] - own[1][i] for i in range(2)]
        angles = [abs(math.remainder(math.atan2(way[1], way[0]) - angle, math.tau)) for angle in kept]
        stays = min(angles, default=math.pi) >= CRITERION
        if stays:
            kept.append(math.atan2(way[1], way[0]))
        picture.line(at(own[1]), at(leaf[1]), GREEN if stays else GREY, 2.5 if stays else 1.2, "" if stays else "5,4")
    return picture


def solve(matrix, right):
    """Gauss's elimination with pivots."""
    rows = [row + [value] for row, value in zip(matrix, right)]
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(len(rows)):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


CUBIC = [(i, j) for i in range(4) for j in range(4 - i)]


def fit_cubic(points, values, center, radius):
    """Coefficients by weighted least squares, weights (1 - d^2/h^2)^2."""
    rows, weights = [], []
    for point in points:
        x, y = ((point[i] - center[i]) / radius for i in range(2))
        rows.append([x**i * y**j for i, j in CUBIC])
        weights.append(max(0.0, 1 - x * x - y * y)**2)
    size = range(len(CUBIC))
    normal = [[sum(w * r[i] * r[j] for w, r in zip(weights, rows)) for j in size] for i in size]
    return solve(normal, [sum(w * r[i] * v for w, r, v in zip(weights, rows, values)) for i in size])


def draw_root():
    """The field is exp(-5 d^2), d the distance to a centre; the fit is that of the library, in the plane."""
    picture = Picture(720, 390)
    samples = make_samples(9, 5)
    middle, level = (0.15, 0.1), 0.5

    def field(p):
        return math.exp(-5 * level**2) - math.exp(-5 * math.dist(p, middle)**2)

    def deviation(p):
        return abs(math.dist(p, middle) - level)

    def root_on(a, b):
        share = field(a) / (field(a) - field(b))
        return tuple(a[i] + share * (b[i] - a[i]) for i in range(2))

    # An edge with a root near the middle of the picture that lies off.
    edges = [(p, q) for p in samples for q in samples if field(p) < 0 <= field(q) and math.dist(p, q) < 0.2]
    a, b = max(edges, key=lambda e: deviation(root_on(*e)) - 0.2 * math.dist(root_on(*e), (0.5, 0.5)))
    linear = root_on(a, b)
    support = sorted(samples, key=lambda p: math.dist(p, linear))[:21]
    radius = math.dist(support.pop(), linear)
    fit = fit_cubic(support, [field(p) for p in support], linear, radius)

    def value(p):
        x, y = ((p[i] - linear[i]) / radius for i in range(2))
        return sum(c * x**i * y**j for c, (i, j) in zip(fit, CUBIC))

    root, step = linear, 1e-5
    for _ in range(5):
        slope = [(value(tuple(root[k] + (k == i) * step for k in range(2))) -
                  value(tuple(root[k] - (k == i) * step for k in range(2)))) / (2 * step) for i in range(2)]
        factor = value(root) / (slope[0]**2 + slope[1]**2)
        root = tuple(root[i] - factor * slope[i] for i in range(2))

    def draw(x, half, name):
        def at(p):
            return tuple(c + 160 * (p[i] - linear[i]) / half for i, c in enumerate((x + 160, 200)))

        def is_shown(p):
            return max(abs(p[i] - linear[i]) for i in range(2)) <= half

        def draw_line(points, *style):
            for p, q in zip(points, points[1:]):
                if is_shown(p) and is_shown(q):
                    picture.line(at(p), at(q), *style)

        turns = [math.tau * t / 5000 for t in range(5001)]
        draw_line([(middle[0] + level * math.cos(t), middle[1] + level * math.sin(t)) for t in turns], "#9cc5e5", 4)
        draw_line([tuple(a[i] + t / 1000 * (b[i] - a[i]) for i in range(2)) for t in range(1001)], "black", 1.5)
        if radius < half:
            picture.circle(at(linear), 160 * radius / half, color=GREY, dash="5,4")
        for p in samples:
            if is_shown(p):
                picture.circle(at(p), 3.5, BLUE if field(p) < 0 else ORANGE)
        picture.circle(at(linear), 4.5, "white", "black", 1.5)
        picture.circle(at(root), 4.5, GREEN)
        picture.box((x, 40), (x + 320, 360))
        picture.text((x + 160, 18), name)

    ratio = deviation(linear) / deviation(root)
    draw(20, 1.08 * radius, "an edge, and in the circle the samples of its fit")
    draw(380, 1.5 * deviation(linear), f"nearer: on the edge (white) {ratio:.0f} times as far off")
    return picture


def draw_dual():
    picture = Picture(720, 360)
    leaves, _ = split(make_samples(11, 3))
    middle, level = (0.5, 0.5), 0.33

    def is_in(leaf):
        center = tuple((leaf[2][i] + leaf[3][i]) / 2 for i in range(2))
        return math.dist(center, middle) < level

    pairs = {}  # a vertex for each pair of touching boxes of different sides
    for i, one in enumerate(leaves):
        for j, other in enumerate(leaves[:i]):
            if is_in(one) != is_in(other) and do_touch(one, other):
                low = [max(one[2][k], other[2][k]) for k in range(2)]
                high = [min(one[3][k], other[3][k]) for k in range(2)]
                pairs[j, i] = tuple((low[k] + high[k]) / 2 for k in range(2))
    # Where three boxes meet, the two of their pairs that are of different sides are joined.
    edges = []
    for i, j in pairs:
        for k in range(len(leaves)):
            other = [pair for pair in (tuple(sorted((i, k))), tuple(sorted((j, k)))) if pair in pairs]
            if k in (i, j) or not other or not all(do_touch(leaves[k], leaves[m]) for m in (i, j)):
                continue
            edges += [((i, j), pair) for pair in other if pair > (i, j)]
    for panel, x in enumerate((20, 390)):
        at = scaler(x, 40, 300)
        for leaf in leaves:
            picture.box(at(leaf[2]), at(leaf[3]), "#dcebf7" if is_in(leaf) else "none", LIGHT)
        for leaf in leaves:
            picture.circle(at(leaf[1]), 2, BLUE if math.dist(leaf[1], middle) < level else ORANGE)

        def shown(pair):
            vertex = pairs[pair]
            if panel == 0:
                return at(vertex)
            factor = level / math.dist(vertex, middle)
            return at(tuple(middle[k] + factor * (vertex[k] - middle[k]) for k in range(2)))

        for one, other in edges:
            picture.line(shown(one), shown(other), GREEN, 2)
        for pair in pairs:
            picture.circle(shown(pair), 2.5, GREEN)
    picture.text((170, 15), "a vertex between any two boxes of different sides")
    picture.text((540, 15), "vertices moved onto the zero level")
    return picture


def draw_ranks():
    """Who sends what when."""
    picture = Picture(720, 700)
    lines = [90, 270, 450, 630]
    top = 668
    for number, x in enumerate(lines):
        picture.line((x, top - 12), (x, 30), LIGHT, 2)
        picture.box((x - 55, top - 12), (x + 55, top + 14), "#eeeeee")
        picture.text((x, top - 4), f"process {number}")

    def work(y, words):
        for x in lines:
            picture.box((x - 68, y - 12), (x + 68, y + 12), "white")
            picture.text((x, y - 4), words, 12)

    def send(y, words, pairs, color):
        picture.text((360, y), words, 12, color)
        for a, b in pairs:
            for start, end in ((lines[a], lines[b]), (lines[b], lines[a])):
                picture.line((start, y - 8), (end, y - 50), color, 1.2, arrow=True)

    def add_up(y, words):
        picture.text((360, y), words, 12, GREEN)
        picture.line((lines[0], y - 14), (lines[-1], y - 14), GREEN, 2)
        for x in lines:
            picture.circle((x, y - 14), 4, GREEN)

    everyone = [(a, b) for a in range(4) for b in range(a)]
    touching = [(0, 1), (2, 3), (1, 3), (0, 2)]
    work(632, "reads its part")
    add_up(598, "a few rounds per level of the tree: how many samples lie below a plane, summed over all")
    work(556, "knows all cuts")
    send(524, "once: every sample goes to the process of its piece", everyone, ORANGE)
    work(450, "builds its subtree")
    send(418, "samples along the cuts, between pieces that touch", touching, BLUE)
    work(344, "edges, linear roots")
    send(312, "samples that fits reach across the cuts, between pieces that touch", touching, BLUE)
    work(238, "isopoints, fields")
    add_up(204, "counts and warnings of the report")
    work(162, "writes its piece")
    picture.text((360, 122), "or, for one file,", 12, GREY)
    picture.text((360, 100), "isopoints go to process 0, in the order of their edges", 12, BLUE)
    for x in lines[1:]:
        picture.line((x, 92), (lines[0], 50), BLUE, 1.2, arrow=True)
    picture.text((360, 10), "time runs downwards", 12, GREY)
    return picture


def draw_axes():
    """The axes of -rotate: a plane that dips to the right of its strike, and a line that plunges in it."""
    strike, dip, plunge = (math.radians(angle) for angle in (30.0, 40.0, 12.0))
    along = (math.sin(strike), math.cos(strike), 0.0)
    down = (math.cos(dip) * math.cos(strike), -math.cos(dip) * math.sin(strike), -math.sin(dip))
    normal = (math.sin(dip) * math.cos(strike), -math.sin(dip) * math.sin(strike), math.cos(dip))
    sine = math.sin(plunge) / math.sin(dip)
    cosine = math.sqrt(1.0 - sine * sine)
    first = [cosine * d - sine * a for d, a in zip(down, along)]
    second = [cosine * a + sine * d for d, a in zip(down, along)]

    def at(*terms, shift=(0.0, 0.0)):
        """A sum of vectors, seen from the south-west and from above."""
        x, y, z = (sum(factor * vector[axis] for factor, vector in terms) for axis in range(3))
        return 190 + 150 * (0.9 * x + 0.35 * y) + shift[0], 210 + 150 * (-0.3 * x + 0.45 * y + 0.8 * z) + shift[1]

    picture = Picture(620, 400)
    east, north, up = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    for way, word in ((east, "x, east"), (north, "y, north"), (up, "z, up")):
        picture.line(at((0, east)), at((1.3, way)), GREY, arrow=True)
        picture.text(at((1.3, way), shift=(6, 6)), word, color=GREY, anchor="start")
    corners = [at((u, along), (v, down)) for u, v in ((-0.6, 0.0), (1.4, 0.0), (1.4, 1.0), (-0.6, 1.0))]
    for a, b in zip(corners, corners[1:] + corners[:1]):
        picture.line(a, b, LIGHT, 2)
    picture.line(at((-0.6, along)), at((1.4, along)), BLUE, 1.5, dash="5 4")
    picture.text(at((1.4, along), shift=(6, 8)), "strike, 30 from y", color=BLUE, anchor="start")
    picture.line(at((0, down)), at((1.0, down)), BLUE, 1.5, dash="5 4")
    picture.text(at((1.0, down), shift=(6, -12)), "dip, 40 down to the right", color=BLUE, anchor="start")
    for way, length, word, shift in ((first, 0.9, "first axis, sx", (-96, -8)),
                                     (second, 1.2, "second axis, sy: plunges by 12", (8, -6)),
                                     (normal, 1.0, "third axis, sz", (8, 4))):
        picture.line(at((0, east)), at((length, way)), ORANGE, 2.5, arrow=True)
        picture.text(at((length, way), shift=shift), word, color=ORANGE, anchor="start")
    return picture


DIAGRAMS = {"kd_tree": draw_tree, "neighbors": draw_neighbors, "root": draw_root, "dual": draw_dual, "ranks": draw_ranks,
            "axes": draw_axes}


def main():
    words = [word for word in sys.argv[1:] if word != "--check"]
    if len(words) != 1:
        sys.exit(__doc__)
    folder, old = pathlib.Path(words[0]), []
    for name, draw in DIAGRAMS.items():
        path, text = folder / f"{name}.svg", draw().write()
        if "--check" not in sys.argv:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            old.append(f"{path} is not what draw_diagrams.py draws.")
    sys.exit("\n".join(old) or 0)


if __name__ == "__main__":
    main()

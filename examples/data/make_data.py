#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the data of the tutorials in docs/start, from formulas and seeded random numbers alone.

usage: make_data.py [FOLDER]; writes the files into FOLDER (default: the folder of this script)
Needs Python 3.8 or newer and its standard library. README.md describes the files.
"""
import math
import pathlib
import random
import struct
import sys
import zlib


def write_table(path, header, rows):
    lines = [",".join(header)] + [",".join("" if value is None else f"{value:.{digits}f}"
                                           for value, digits in row) for row in rows]
    path.write_text("\n".join(lines) + "\n")


def random_waves(generator, lengths, number):
    """A random field of variance 1: a sum of cosines whose correlation falls over these lengths (x, y, z)."""
    waves = [([generator.gauss(0, 1) / length for length in lengths], generator.uniform(0, 2 * math.pi))
             for _ in range(number)]
    return lambda x, y, z: math.sqrt(2 / number) * sum(math.cos(k[0] * x + k[1] * y + k[2] * z + phase)
                                                       for k, phase in waves)


# A binary star: two gas spheres with Gaussian density in contact, as a snapshot of Gadget (format 1).
STARS = [(1.0, 0.45, -0.5), (0.5, 0.35, 0.65)]  # mass, scale length, x of the centre
PARTICLES = 4500


def star_density(x, y, z):
    return sum(mass / (math.pi ** 1.5 * scale ** 3) * math.exp(-((x - centre) ** 2 + y * y + z * z) / scale ** 2)
               for mass, scale, centre in STARS)


def gaussian_radius(part):
    """The radius, in scale lengths, that encloses this part of the mass of a sphere with Gaussian density."""
    low, high = 0.0, 6.0
    for _ in range(60):
        r = 0.5 * (low + high)
        inside = math.erf(r) - 2 / math.sqrt(math.pi) * r * math.exp(-r * r)
        low, high = (r, high) if inside < part else (low, r)
    return low


def binary_star(path):
    generator = random.Random(1)
    particle_mass = sum(mass for mass, _, _ in STARS) / PARTICLES
    positions = []
    for mass, scale, centre in STARS:
        number = round(mass / particle_mass)
        for i in range(number):
            r = scale * gaussian_radius((i + 0.5) / number)
            # Directions along a golden spiral keep the particles apart, as the forces of SPH do.
            height = 1 - 2 * ((i * 0.7548776662466927 + generator.uniform(-0.02, 0.02)) % 1)
            angle = 2 * math.pi * (i * 0.5698402909980532 % 1)
            flat = math.sqrt(1 - height * height)
            positions.append((centre + r * flat * math.cos(angle), r * flat * math.sin(angle), r * height))
    densities = [star_density(*p) for p in positions]
    blocks = [
        [c for p in positions for c in p],
        [c for x, y, _ in positions for c in (-0.8 * y, 0.8 * x, 0.0)],  # velocities: it turns about z
        list(range(1, PARTICLES + 1)),
        [0.9 * rho ** (2 / 3) for rho in densities],  # internal energy of a monatomic gas of equal entropy
        densities,
        [1.2 * (particle_mass / rho) ** (1 / 3) for rho in densities],
    ]
    header = struct.pack("<6I6d2d2i6I2i", PARTICLES, 0, 0, 0, 0, 0, particle_mass, 0, 0, 0, 0, 0, 0.0, 0.0, 0, 0,
                         PARTICLES, 0, 0, 0, 0, 0, 0, 1)
    records = [header.ljust(256, b"\0")]
    records += [struct.pack(f"<{len(b)}{'I' if isinstance(b[0], int) else 'f'}", *b) for b in blocks]
    path.write_bytes(b"".join(struct.pack("<I", len(r)) + r + struct.pack("<I", len(r)) for r in records))


# Supersonic flow around a sphere of radius 1: a model with a bow shock and a boundary layer, on a curvilinear
# grid around the half of the sphere with y >= 0. The fluid comes along x.
def flow(x, y, z):
    """Density, pressure and velocity."""
    r = math.sqrt(x * x + y * y + z * z)
    polar = math.acos(max(-1.0, min(1.0, -x / r)))  # 0 upstream
    shock = 1.28 + 0.42 * (1 - math.cos(polar)) + 0.25 * (1 - math.cos(polar)) ** 2
    behind = 0.5 * (1 - math.tanh((r - shock) / 0.08))
    strength = math.cos(0.75 * polar) ** 2
    wall = 1 - math.exp(-(r - 1) / 0.04)  # 0 at the wall, 1 outside of the boundary layer
    density = 1 + behind * strength * (1.9 + 0.5 * (shock - r) / (shock - 1)) - 0.35 * (1 - wall) * strength
    pressure = 0.1786 + behind * strength * (0.80 + 0.2 * (shock - r) / (shock - 1))
    axial = -x / r  # of the unit vector that leaves the sphere
    along = (1 + axial * x / r, axial * y / r, axial * z / r)
    normal = tuple(c / r for c in (x, y, z))
    slow = 1 - behind * strength
    velocity = [wall * (0.3 * behind + slow) * a - axial * slow * max(0.0, 1 - 1 / r ** 3) * n
                for a, n in zip(along, normal)]
    return density, pressure, velocity


def sphere_flow(path):
    radial, polar, azimuthal = 26, 23, 21
    growth = 1.12
    radii = [1 + 1.4 * (growth ** i - 1) / (growth ** (radial - 1) - 1) for i in range(radial)]
    points, density, pressure, velocity = [], [], [], []
    for k in range(azimuthal):
        turn = math.pi * k / (azimuthal - 1) - math.pi / 2
        for j in range(polar):
            theta = math.radians(2 + 98 * j / (polar - 1))
            for r in radii:
                p = (-r * math.cos(theta), r * math.sin(theta) * math.cos(turn), r * math.sin(theta) * math.sin(turn))
                points.append(p)
                fields = flow(*p)
                density.append(fields[0])
                pressure.append(fields[1])
                velocity.append(fields[2])

    def packed(values):  # the header of one block that zlib has packed, and the block
        data = struct.pack(f"<{len(values)}f", *(round(v, 4) for v in values))
        block = zlib.compress(data, 9)
        return struct.pack("<4I", 1, len(data), 0, len(block)) + block

    arrays = [("Points", 3, [c for p in points for c in p]), ("Density", 1, density), ("Pressure", 1, pressure),
              ("Velocity", 3, [c for v in velocity for c in v])]
    described, appended = [], b""
    for name, components, values in arrays:
        described.append(f'<DataArray type="Float32" Name="{name}" NumberOfComponents="{components}" '
                         f'format="appended" offset="{len(appended)}"/>')
        appended += packed(values)
    extent = f"0 {radial - 1} 0 {polar - 1} 0 {azimuthal - 1}"
    attributes = 'byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor"'
    text = f"""<?xml version="1.0"?>
<VTKFile type="StructuredGrid" version="1.0" {attributes}>
<StructuredGrid WholeExtent="{extent}"><Piece Extent="{extent}">
<PointData Scalars="Density" Vectors="Velocity">
{described[1]}
{described[2]}
{described[3]}
</PointData>
<Points>
{described[0]}
</Points>
</Piece></StructuredGrid>
<AppendedData encoding="raw">
_"""
    path.write_bytes(text.encode() + appended + b"\n</AppendedData>\n</VTKFile>\n")


# Gas that leaks in a hall of 40 m x 30 m x 10 m with a draught along x: a Gaussian plume.
LEAK = (6.0, 14.0, 2.0)


def concentration(x, y, z):
    """In ppm. Floor and ceiling reflect the plume."""
    along = math.sqrt((x - LEAK[0]) ** 2 + 1)
    width = 1.0 + 0.12 * along
    upstream = 1 / (1 + math.exp(-(x - LEAK[0]) / 0.8))
    heights = (LEAK[2], -LEAK[2], 20 - LEAK[2])
    across = math.exp(-(y - LEAK[1] - 0.08 * (x - LEAK[0])) ** 2 / (2 * width ** 2))
    return 200 * upstream / width ** 2 * across * sum(math.exp(-(z - h - 0.05 * (along - 1)) ** 2 / (2 * width ** 2))
                                                      for h in heights)


def gas(drone_path, sensor_path):
    generator = random.Random(2)
    rows, time, number = [], 0.0, 0
    for level in range(6):
        for leg in range(10):
            number += 1
            x = (2 + 4 * leg) if level % 2 == 0 else (38 - 4 * leg)
            x += generator.gauss(0, 0.15)
            for i in range(72):
                y = 0.8 + 0.4 * i
                y = y if number % 2 else 30 - y
                p = (x + 0.2 * math.sin(0.3 * y + number), y, 1 + 1.5 * level + generator.gauss(0, 0.05))
                true = concentration(*p)
                rows.append([(time, 1), (number, 0), (p[0], 2), (p[1], 2), (p[2], 2),
                             (true * generator.gauss(1, 0.03) + generator.gauss(0, 0.3), 2)])
                time += 0.5
            time += 3
    write_table(drone_path, ["time_s", "pass", "x", "y", "z", "ppm"], rows)
    sensors = []
    places = [(x, y, z) for x in (8, 20, 32) for y in (6, 15, 24) for z in (1.5, 5.0)]
    for number, (x, y, z) in enumerate(places, 1):
        true = concentration(x, y, z)
        measured = true * generator.gauss(1, 0.03) + generator.gauss(0, 0.3)
        sensors.append([(number, 0), (x, 1), (y, 1), (z, 1), (measured, 2)])
    write_table(sensor_path, ["sensor", "x", "y", "z", "ppm"], sensors)


# Copper along drill holes: an ore layer that dips to the east, richer and poorer parts within it, and noise from
# sample to sample (the nugget).
def copper_model():
    generator = random.Random(3)
    rich = random_waves(generator, (70, 90, 12), 150)
    fold = random_waves(generator, (220, 260, 1e9), 40)

    def grade(x, y, z):
        """In per cent. The layer strikes to the north (y) and dips by 30 degrees to the east (x)."""
        depth = -(z + math.tan(math.radians(30)) * (x - 150) + 75) * math.cos(math.radians(30)) + 8 * fold(x, y, 0)
        across = math.exp(-0.5 * (depth / 16) ** 2)
        dip_x = x * math.cos(math.radians(30)) - z * math.sin(math.radians(30))
        return 0.05 + 0.85 * across * math.exp(0.55 * rich(dip_x, y, depth))

    return grade


def drill_holes(path):
    generator = random.Random(4)
    grade = copper_model()
    rows, hole = [], 0
    for i in range(7):
        for j in range(6):
            hole += 1
            x, y, z = 50 * i + generator.gauss(0, 5), 50 * j + generator.gauss(0, 5), generator.gauss(0, 2)
            # Every third hole is inclined to the west, across the layer.
            slope = math.radians(25) if hole % 3 == 0 else math.radians(generator.uniform(0, 4))
            step = (-math.sin(slope), 0.0, -math.cos(slope))
            for k in range(80):
                d = 1 + 2 * k
                p = [c + d * s for c, s in zip((x, y, z), step)]
                value = grade(*p) * math.exp(generator.gauss(0, 0.18))
                if p[2] < -165 or generator.random() < 0.02:
                    continue  # below the model, or a core that was lost
                rows.append([(hole, 0), (p[0], 2), (p[1], 2), (p[2], 2), (d - 1, 0), (d + 1, 0), (value, 3)])
    write_table(path, ["hole", "x", "y", "z", "from", "to", "cu_pct"], rows)


# A glider that dives through the thermocline over a warm eddy, on four parallel legs.
def glider(path):
    generator = random.Random(5)
    wave = random_waves(generator, (9, 9, 1e9), 60)
    rows, time = [], 0
    for leg in range(4):
        for dive in range(6):
            for i in range(130):
                part = i / 130
                along = 3.0 * (dive + part)  # km on this leg
                east = (along if leg % 2 == 0 else 18 - along) - 9 + 0.4 * math.sin(0.5 * along + leg)
                north = 5.0 * leg - 7.5 + 0.4 * math.cos(0.4 * along + 2 * leg)
                depth = 600 * (2 * part if part < 0.5 else 2 - 2 * part) + 1.5
                eddy = math.exp(-((east - 2) ** 2 + (north - 1) ** 2) / (2 * 5 ** 2))
                thermocline = 200 + 140 * eddy + 8 * wave(east, north, 0)
                temperature = 4.2 + 0.8 * eddy - 0.0012 * depth + 3.6 * (1 - math.tanh((depth - thermocline) / 90))
                temperature += generator.gauss(0, 0.03)
                salinity = 34.25 + 0.055 * (temperature - 4) + generator.gauss(0, 0.01)
                rows.append([(6 * leg + dive + 1, 0), (time, 0), (8.4 + east / 81.3, 5), (-43.0 + north / 111.1, 5),
                             (depth, 1), (temperature, 3), (salinity, 3)])
                time += 60
    write_table(path, ["dive", "time_s", "lon", "lat", "depth", "temperature", "salinity"], rows)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent
    binary_star(folder / "binary.gadget")
    sphere_flow(folder / "sphere_flow.vts")
    gas(folder / "drone.csv", folder / "sensors.csv")
    drill_holes(folder / "drill_holes.csv")
    glider(folder / "glider.csv")


if __name__ == "__main__":
    main()

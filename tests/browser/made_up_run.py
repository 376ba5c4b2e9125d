"""An output folder of a made-up crushed cylinder in a sleeve, as platen-compress would write it: numbers that a test knows, the same
on every machine."""

import csv
import math
import random

RADIUS, HEIGHT, WALL = 0.025, 0.1, 0.003  # m
END, PEAK, TOP_STRESS = 2.0, 1.0, 50e6  # s, s, Pa
SLEEVE = (24, 12)  # elements around and along
FIRST_ID = 100


class Sphere:
    """Where it lay before the test, and how it moves."""

    def __init__(self, number, place, radius, draw):
        self.id, self.place, self.radius = FIRST_ID + number, place, radius
        self.height = place[2] / HEIGHT
        in_middle = 1 - abs(2 * self.height - 1)
        self.breaks = draw.random() < 0.9 * in_middle  # some of its bonds, in the second half
        self.share = 0.3 + 0.7 * in_middle
        self.piece = 2 + number if self.breaks and in_middle > 0.85 else int(self.height > 0.5)

    def displacement(self, time):
        """Shorter from below to above, wider in the middle once the peak is over."""
        bulge = 0.06 * math.sin(math.pi * self.height) * max(0.0, time - 0.8 * PEAK)
        return [bulge * self.place[0], bulge * self.place[1], -0.01 * time / END * self.place[2]]

    def broken(self, time):
        """Of ten bonds."""
        return round(10 * self.share * max(0.0, time / END - 0.4) / 0.6) if self.breaks else 0


def spheres(radius):
    """Layers of triangles, a little shaken, that fill the cylinder."""
    draw, found = random.Random(5), []
    across, up = 2 * radius, 2 * radius * math.sqrt(2 / 3)
    reach = int(RADIUS / radius) + 2
    for k in range(int((HEIGHT - 2 * radius) / up) + 1):
        for j in range(-reach, reach + 1):
            for i in range(-reach, reach + 1):
                x = (i + 0.5 * (j & 1) + 0.5 * (k & 1)) * across + draw.uniform(-0.1, 0.1) * radius
                y = (j + (k & 1) / 3) * across * math.sqrt(0.75) + draw.uniform(-0.1, 0.1) * radius
                if math.hypot(x, y) < RADIUS - radius:
                    found.append(Sphere(len(found), (x, y, radius + k * up), radius * draw.uniform(0.85, 1), draw))
    return found


def array(name, values, components=1, kind="Float64"):
    text = " ".join(map(repr, values))
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">{text}</DataArray>\n'


def write_grid(file, points, cells, cell_type, arrays):
    """A VTU file; `cells` are lists of points, `arrays` texts of array()."""
    flat, offsets = [p for cell in cells for p in cell], [len(cells[0]) * (k + 1) for k in range(len(cells))]
    file.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<PointData>\n{"".join(arrays)}</PointData>\n'
        f'<Points>\n{array("Points", [x for p in points for x in p], 3)}</Points>\n<Cells>\n'
        + array("connectivity", flat, kind="Int64") + array("offsets", offsets, kind="Int64")
        + array("types", [cell_type] * len(cells), kind="UInt8")
        + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def write_spheres(file, all_spheres, time):
    moved = [s.displacement(time) for s in all_spheres]
    points = [[a + b for a, b in zip(s.place, u)] for s, u in zip(all_spheres, moved)]
    broken = [s.broken(time) for s in all_spheres]
    write_grid(file, points, [[k] for k in range(len(points))], 1, [
        array("radius", [s.radius for s in all_spheres]), array("displacement", [x for u in moved for x in u], 3),
        array("intact_bonds", [10 - b for b in broken]), array("broken_bonds", broken),
        array("id", [s.id for s in all_spheres], kind="Int32"),
        array("fragment", [s.piece if time >= 1.5 else 0 for s in all_spheres], kind="Int32")])


def brick(low, high):
    """Corners of a hexahedron as VTK counts them."""
    (a, b, c), (d, e, f) = low, high
    return [(x, y, z) for z in (c, f) for x, y in ((a, b), (d, b), (d, e), (a, e))]


def write_platens(file, time):
    """The lower one is of two blocks, as supports are."""
    shortened = HEIGHT * (1 - 0.01 * time / END)
    points = (brick((-0.03, -0.03, -0.012), (-0.005, 0.03, 0)) + brick((0.005, -0.03, -0.012), (0.03, 0.03, 0))
              + brick((-0.03, -0.03, shortened), (0.03, 0.03, shortened + 0.012)))
    write_grid(file, points, [list(range(8 * k, 8 * k + 8)) for k in range(3)], 12, [])


def write_sleeve(file, time):
    """Each element with corners of its own."""
    around, along = SLEEVE
    points, moved = [], []
    for j in range(along):
        for i in range(around):
            for height in (j / along, (j + 1) / along):
                for radius, turn in ((RADIUS, i), (RADIUS + WALL, i), (RADIUS + WALL, i + 1), (RADIUS, i + 1)):
                    angle = 2 * math.pi * (turn % around) / around
                    bulge = 0.06 * math.sin(math.pi * height) * max(0.0, time - 0.8 * PEAK)
                    x, y, z = radius * math.cos(angle), radius * math.sin(angle), HEIGHT * height
                    u = (bulge * x, bulge * y, -0.01 * time / END * z)
                    moved.append(u)
                    points.append((x + u[0], y + u[1], z + u[2]))
    pressure = [9e6 if time > 0 else 0.0] * len(points)
    write_grid(file, points, [list(range(8 * k, 8 * k + 8)) for k in range(around * along)], 12, [
        array("displacement", [x for u in moved for x in u], 3), array("contact_pressure", pressure),
        array("slip", [1e-4 * time] * len(points))])


def write_series(folder, name, times, write):
    entries = []
    for number, time in enumerate(times):
        file = folder / f"{name}_{number}.vtu"
        write(file, time)
        entries.append(f'<DataSet timestep="{time!r}" part="0" file="{file.name}"/>')
    (folder / f"{name}.pvd").write_text('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
                                        + "\n".join(entries) + "\n</Collection>\n</VTKFile>\n")


def cracks(all_spheres):
    """Rows of cracks.csv: discs beside the spheres that break, nine in ten of them in tension, upright."""
    for number, s in enumerate(s for s in all_spheres if s.breaks):
        angle, time = 2.4 * number, END * (0.45 + 0.5 * ((7 * number) % 100) / 100)
        x, y, z = s.place
        yield [time, 0.01 * time / END, x, y, z + s.radius, math.cos(angle), math.sin(angle), 0.0, math.pi * s.radius**2,
               "shear" if number % 10 == 0 else "tension", 1e-6, s.id, s.id]


def stress_at(time):
    return TOP_STRESS * (math.sin(0.5 * math.pi * time / PEAK) if time < PEAK else 1 - 0.6 * (time - PEAK) / (END - PEAK))


def write_run(folder, radius=0.0022, frames=5):
    """Makes the folder; gives its spheres and the times of its frames."""
    folder.mkdir(parents=True)
    all_spheres = spheres(radius)
    times = [END * k / (frames - 1) for k in range(frames)]
    write_series(folder, "specimen", times, lambda file, time: write_spheres(file, all_spheres, time))
    write_series(folder, "platens", times, write_platens)
    write_series(folder, "sleeve", times, write_sleeve)
    with open(folder / "history.csv", "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["time_s", "axial_strain_platen", "axial_stress_top_pa", "axial_stress_bottom_pa"])
        rows.writerows([t, 0.01 * t / END, stress_at(t), stress_at(t)] for t in (END * k / 200 for k in range(201)))
    with open(folder / "cracks.csv", "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow("time_s axial_strain x_m y_m z_m nx ny nz area_m2 mode energy_j particle_a particle_b".split())
        rows.writerows(cracks(all_spheres))
    (folder / "scene.prm").write_text("subsection Scene\n  set Title = A made-up cylinder in a sleeve\nend\n")
    return all_spheres, times

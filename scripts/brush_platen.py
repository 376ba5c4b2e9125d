"""Gmsh mesh (.msh 2.2, hexahedra, millimetres) of a brush platen: square pins on a block, pins towards +z.

Usage: brush_platen.py FILE [--pins 6] [--pins-y N] [--pin 10] [--gap 0.5] [--length 50] [--block 10] [--along 3]
Without `--pins-y` there are as many pins along y as along x. With `--down` the pins point to -z, for the platen above, on the
right or at the back. Of a side platen of a box x and y are, in turn, the axes that follow that of its normal: of one that
presses along x they are y and z of the box. `--block 0` leaves the block out: the machine holds the pins where they would stand on
it. In a block, cells as narrow as the gaps set the time step of a brush that has inertia, several times smaller than pins alone need.
"""
import argparse


def lattice(pins, pin, gap):
    """Places of the grid lines across, symmetric about 0; cells 0, 2, 4, ... are pins."""
    at, lines = -0.5 * (pins * pin + (pins - 1) * gap), []
    for k in range(pins):
        lines += [at, at + pin]
        at += pin + gap
    return lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("--pins", type=int, default=6, help="along x")
    parser.add_argument("--pins-y", type=int, help="along y; as many as along x where it is not given")
    parser.add_argument("--pin", type=float, default=10, help="width, mm")
    parser.add_argument("--gap", type=float, default=0.5, help="mm")
    parser.add_argument("--length", type=float, default=50, help="of the pins, mm")
    parser.add_argument("--block", type=float, default=10, help="thickness, mm; 0: none")
    parser.add_argument("--along", type=int, default=3, help="elements along a pin")
    parser.add_argument("--down", action="store_true")
    a = parser.parse_args()

    x = lattice(a.pins, a.pin, a.gap)
    y = lattice(a.pins if a.pins_y is None else a.pins_y, a.pin, a.gap)
    z = ([-a.block - a.length] if a.block > 0 else []) + [-a.length] + [-a.length * (1 - (k + 1) / a.along) for k in range(a.along)]
    number, nodes, cells = {}, [], []

    def node(i, j, k):
        if (i, j, k) not in number:
            number[i, j, k] = len(nodes) + 1
            nodes.append((x[i], y[j], z[k]))
        return number[i, j, k]

    for k in range(len(z) - 1):
        for j in range(len(y) - 1):
            for i in range(len(x) - 1):
                if (k > 0 or not a.block > 0) and (i % 2 or j % 2):
                    continue  # between the pins
                cells.append([node(i + di, j + dj, k + dk) for dk in (0, 1)
                              for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))])
    if a.down:  # turned about x, so that no cell is turned inside out
        nodes = [(px, -py, -pz) for px, py, pz in nodes]
    with open(a.file, "w") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" % len(nodes))
        for n, p in enumerate(nodes, 1):
            out.write("%d %.10g %.10g %.10g\n" % (n, *p))
        out.write("$EndNodes\n$Elements\n%d\n" % len(cells))
        for n, c in enumerate(cells, 1):
            out.write("%d 5 2 1 1 %s\n" % (n, " ".join(map(str, c))))
        out.write("$EndElements\n")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""host.py - a Python code with its own particles, a numpy structured array whose fields are read in place;
without numpy, array.array.

    python3 examples/hosts/host.py ./libsph_shim.so
        (from the repository's root, where tests/known/kernels.csv is; how to build the library: README.md)

A corrected gradient of a linear field and a row of the M-SPH Laplacian, both exact on a disordered cloud; and
the kernels against the known answers. Exit status 0 if all is right."""

import array
import csv
import itertools
import math
import sys

import sph

failures = 0


def expect(what, value, exact, tolerance):
    global failures
    right = abs(value - exact) <= tolerance
    print(f"{what:52} {value:18.12f}  exact {exact:g}{'' if right else '  WRONG'}")
    failures += not right


def known_answers(path):
    """every kernel: W and F of the rows of one h at once"""
    with open(path) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    off = 0
    kind = lambda row: (row["kernel"], int(row["dim"]), float(row["h"]))
    for (kernel, dim, h), group in itertools.groupby(rows, kind):
        group = list(group)
        w, f = sph.kernel_wf(kernel, dim, array.array("d", (float(row["r"]) for row in group)), h)
        for got, name in ((w, "W"), (f, "F")):
            exact = [float(row[name]) for row in group]
            largest = max(map(abs, exact))
            off += sum(not abs(a - b) <= 8 * sys.float_info.epsilon * largest for a, b in zip(got, exact))
    print(f"known answers: {len(rows)} rows, {off} off")
    return off or not rows


sph.load(sys.argv[1] if len(sys.argv) > 1 else "./libsph_shim.so")
side, mobility = 21, 0.5
dx = 1.0 / side
n = side * side
middle = n // 2
px = [dx * (i % side + 0.5 + 0.2 * math.sin(37.0 * i)) for i in range(n)]
py = [dx * (i // side + 0.5 + 0.2 * math.cos(53.0 * i)) for i in range(n)]

if sph.numpy:
    # whatever the code has
    fields = [("position", "f8", 2), ("velocity", "f8", 2), ("temperature", "f8")]
    particles = sph.numpy.zeros(n, dtype=fields)
    particles["position"][:, 0], particles["position"][:, 1] = px, py
    # views: nothing is copied
    x, y, temperature = particles["position"][:, 0], particles["position"][:, 1], particles["temperature"]
else:
    x, y, temperature = array.array("d", px), array.array("d", py), array.array("d", bytes(8 * n))
for i in range(n):
    temperature[i] = 0.7 + 1.3 * x[i] - 0.8 * y[i]
if sph.numpy:
    print("arrays of numpy, %d bytes from one particle to the next" % x.strides[0])
else:
    print("arrays of the array module")

cloud = sph.Cloud("wendland-c2", [x, y], h=1.3 * dx, volume=dx * dx)
cloud.find_lists()
cloud.check()  # once, for the sweeps to come
gx, gy = cloud.gradient(temperature)
failures += cloud.not_ok
expect("gradient at a corner, x", gx[0], 1.3, 1e-12)
expect("gradient at a corner, y", gy[0], -0.8, 1e-12)
expect("gradient in the middle, x", gx[middle], 1.3, 1e-12)
expect("gradient in the middle, y", gy[middle], -0.8, 1e-12)

cloud.range(middle, middle + 1)  # one row of div(m grad u): with trace exact for a linear u and for |x|^2
rows = cloud.elliptic_rows_msph(mobility, trace=True)
row, diagonal = rows.row, rows.diagonal
failures += cloud.not_ok
entries = range(cloud.start[middle], cloud.start[middle + 1])
square = [a * a + b * b for a, b in zip(x, y)]
print(f"M-SPH row of particle {middle}: {len(entries)} neighbours, diagonal {diagonal[middle]:.6f}")
expect("M-SPH, sum of the row", diagonal[middle] + sum(row[p] for p in entries), 0, 1e-9)
expect("M-SPH, div(m grad u) of a linear u", cloud.rows_apply(row, diagonal, temperature)[middle], 0, 1e-9)
of_square = sum(row[p] * (square[cloud.index[p]] - square[middle]) for p in entries)
expect("M-SPH, div(m grad u) of u = x^2 + y^2", of_square, 4 * mobility, 1e-9)

failures += known_answers("tests/known/kernels.csv")
sys.exit(failures != 0)

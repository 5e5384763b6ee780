# SPDX-License-Identifier: MIT
"""Every operator, called on one cloud through the shim and inline, and through Python.

    python3 tests/hosts/shim_calls.py C
        writes a C program: it compares each function of the shim with the inline one, and prints the sums of
        what the inline one gave
    python3 tests/hosts/shim_calls.py LIBRARY SUMS
        makes the same calls through Python, and compares the sums

From the repository's root. All inputs are functions of their names, so that both know them: a new operator
needs nothing here, unless it takes what no other does. Functions that need a grid or memory of the caller's
are called by test_shim.c and test_python.py."""

import math
import os
import sys

sys.path.insert(0, os.path.join("examples", "hosts"))
import generate_python  # noqa: E402
from generate import NUMBERS, exported, read, shim_name  # noqa: E402

SIDES = {1: 40, 2: 12, 3: 6}
KERNELS = {
    "wendland-c2": 3,
    "quintic-spline": 2,
}  # the first is compiled as a constant in the shim, the second is not
# numbers that must be in some range; all others are 0.3, and int are 0
REALS = {
    "distance": 0.9,
    "within": 0.2,
    "farthest": 2.0,
    "number_density": 1.0,
    "tau": 0.1,
    "r": 0.7,
    "h": 1.3,
    "tolerance": 1e-3,
    "eta": 1.3,
    "support": 2.6,
}
INTS = {"viscosity": 1, "bins": 8, "left": 0, "right": SIDES[1] - 1, "n": 100, "pairs": 1000, "mean": 1}


def seed(name):
    return sum((k + 1) * ord(letter) for k, letter in enumerate(name)) % 1000


def value(name, i):
    """the number called name of particle i"""
    more = 3.0 if name == "list_radius" else 1.3 if name == "h" else 1.0
    return more + 0.04 * math.sin(11.0 * (i + seed(name)))


def position(axis, i, side):
    return i // side**axis % side + 0.1 * math.sin((37.0 + 16 * axis) * i)


# ---------------------------------------------------------------- C

C_BEGIN = """\
#include "examples/hosts/sph_shim.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
enum { ROOM = 40000, OUTPUTS = 20 };
static sph_real inputs[64][ROOM], outputs[2][OUTPUTS][ROOM], x[3][ROOM];
static sph_index counts[2][ROOM], ones[ROOM];
static unsigned char states[2][ROOM];
static sph_points points;
static sph_cloud cloud;
static int used, wrong, compared, kernel, dim, pairs;
static const double tolerance = sizeof(sph_real) == 8 ? 1e-8 : 5e-2;

/* an input: a number of each particle, or of each entry of the lists */
static const sph_real *in(int seed, double more)
{
    sph_real *const p = inputs[used++];
    int i;
    for (i = 0; i < ROOM; i++) p[i] = (sph_real)(more + 0.04 * sin(11.0 * (i + seed)));
    return p;
}
static sph_scalars scalars(int seed, double more) { return sph_scalars_array(in(seed, more)); }
static void begin(void)
{
    int i;
    used = 0;
    memset(outputs, 0, sizeof outputs);
    memset(counts, 0, sizeof counts);
    memset(states, 0, sizeof states);
    for (i = 0; i < ROOM; i++) ones[i] = 1;
}
static void compare(const char *name, const char *field, const sph_real *a, const sph_real *b, int n)
{
    double largest = 0, off = 0, sum = 0;
    int i;
    for (i = 0; i < n; i++) {
        const double difference = fabs((double)a[i] - (double)b[i]), size = fabs((double)b[i]);
        if (!(difference <= off)) off = difference;
        if (size > largest) largest = size;
        sum += (1 + i % 7) * (double)b[i];
    }
    if (!(off <= tolerance * largest)) {
        fprintf(stderr, "%s, %s: kernel %d, dim %d: off by %g of %g\\n", name, field, kernel, dim, off,
                largest);
        wrong++;
    }
    printf("%s %d %d %s %.15e %.15e\\n", name, kernel, dim, field, sum, largest);
    compared++;
}
static void answers(const char *name, double a, double b)
{
    if (!(fabs(a - b) <= tolerance * fabs(b)) || memcmp(states[0], states[1], sizeof states[0]) != 0 ||
        memcmp(counts[0], counts[1], sizeof counts[0]) != 0) {
        fprintf(stderr, "%s: kernel %d, dim %d: %g, not %g, or another status\\n", name, kernel, dim, a, b);
        wrong++;
    }
    printf("%s %d %d answer %.15e 0\\n", name, kernel, dim, b);
    compared++;
}
"""
C_MAIN = """\
int main(void)
{
    static const int sides[] = {0, %d, %d, %d}, kernels[] = {%s};
    int k, i;
    for (k = 0; k < (int)(sizeof kernels / sizeof kernels[0]); k++)
        for (dim = 1; dim <= 3; dim++) {
            const int side = sides[dim], n = dim == 1 ? side : dim == 2 ? side * side : side * side * side;
            static sph_real h[ROOM], volume[ROOM], radius[ROOM];
            sph_neighbors found;
            void *memory;
            size_t size;
            kernel = kernels[k];
            for (i = 0; i < n; i++) {
                x[0][i] = (sph_real)(i %% side + 0.1 * sin(37.0 * i));
                x[1][i] = (sph_real)(i / side %% side + 0.1 * sin(53.0 * i));
                x[2][i] = (sph_real)(i / side / side + 0.1 * sin(69.0 * i));
                h[i] = (sph_real)(1.3 + 0.04 * sin(11.0 * (i + %d)));
                volume[i] = (sph_real)(1.0 + 0.04 * sin(11.0 * (i + %d)));
                radius[i] = sph_kernel_support((sph_kernel)kernel, h[i]);
            }
            points = sph_points_separate(n, x[0], x[1], x[2]);
            size = sph_search_size(dim, n, ROOM);
            memory = malloc(size);
            if (sph_search(dim, points, sph_scalars_array(radius), SPH_LARGER, memory, size, &found) != 0)
                return 2;
            cloud = sph_cloud_of(points, found.list, sph_scalars_array(h), sph_scalars_array(volume));
            pairs = (int)found.pairs;
            every_call();
            free(memory);
        }
    fprintf(stderr, "shim_calls: %%d passed, %%d failed\\n", compared - wrong, wrong);
    return wrong != 0;
}
"""


class InC:
    """one call, of the shim and inline, with outputs of their own, as lines of C"""

    def __init__(self, function, structs):
        self.function, self.structs = function, structs
        self.lines, self.both, self.shim, self.inline, self.outs = [], [], [], [], []
        self.arrays = 0
        for a in function.arguments:
            self.argument(a)

    def member(self, path, kind, name):
        if kind == "sph_scalars":
            more = {"list_radius": "3.0", "h": "1.3"}.get(name, "1.0")
            self.lines.append(f"{path} = scalars({seed(name)}, {more});")
        elif kind in ("sph_vectors", "sph_diagonal"):
            for axis in "xyz":
                self.lines.append(
                    f"if (dim > {'xyz'.index(axis)}) {path}.{axis} = scalars({seed(name + '.' + axis)}, 1.0);"
                )
        elif kind == "sph_matrices":
            for row in "xyz":
                for axis in "xyz":
                    least = max("xyz".index(row), "xyz".index(axis))
                    self.lines.append(
                        f"if (dim > {least}) {path}.{row}.{axis} = scalars({seed(f'{name}.{row}.{axis}')}, 1.0);"
                    )
        elif kind in ("sph_vec", "sph_sym"):
            for axis in [f.name for f in self.structs[kind].fields]:
                least = max("xyz".index(letter) for letter in axis)
                self.lines.append(f"if (dim > {least}) {path}.{axis} = SPH_R(0.5);")
        elif kind == "sph_points":
            self.lines.append(f"{path} = points;")
        elif kind == "sph_real":
            self.lines.append(f"{path} = SPH_R({REALS.get(name, 0.3)});")
        elif kind in NUMBERS:
            self.lines.append(f"{path} = {INTS.get(name, 0)};")
        else:
            for field in self.structs[kind].fields:
                self.member(f"{path}.{field.name}", field.type, field.name)

    def output(self, path, name, of, field="", entries=False):
        """a pointer of an output, of both calls"""
        at = self.arrays
        self.arrays += 1
        for copy, struct in ((0, "a"), (1, "b")):
            self.both.append(f"{struct}_{path} = outputs[{copy}][{at}];")
        if name in ("h", "velocity", "position"):  # changed in place
            axis = max("xyz".find(field[1:]), 0) if field else 0
            self.both.append(
                f"for (i = 0; dim > {axis} && i < {of}; i++) outputs[0][{at}][i] = outputs[1][{at}][i] = "
                + (
                    f"(sph_real)({1.3 if name == 'h' else 1.0} + 0.04 * sin(11.0 * (i + "
                    f"{seed(name + field)})));"
                    if name != "position"
                    else f"x[{axis}][i];"
                )
            )
        self.outs.append((name + field, f"outputs[0][{at}], outputs[1][{at}]", of))

    def out(self, path, kind, name):
        for field in self.structs[kind].fields:
            at = f"{path}.{field.name}"
            entries = (
                kind == "sph_rows_out"
                and field.name == "row"
                or kind in ("sph_gradient_rows_out", "sph_interpolation_rows_out")
                and field.name in "xyz"
                or kind == "sph_interpolation_rows_out"
                and field.name == "value"
            )
            if field.name == "status":
                self.both += [f"a_{at} = states[0];", f"b_{at} = states[1];"]
            elif field.type in ("sph_vector_out", "sph_matrix_out"):
                self.out(at, field.type, f"{name}.{field.name}" if kind == "sph_matrix_out" else field.name)
            elif field.pointer:
                label = f".{field.name}" if kind == "sph_vector_out" else ""
                self.output(
                    at,
                    name if label or kind == "sph_scalar_out" else field.name,
                    "pairs" if entries else "cloud.points.n",
                    label,
                )

    def argument(self, a):
        e = exported(a)
        shim, inline = a.name, a.name
        if a.name == "kernel":
            inline = "(sph_kernel)kernel"
        elif a.name == "dim":
            pass
        elif a.type == "sph_cloud":
            shim, inline = "&cloud", "cloud"
        elif a.type == "sph_points":
            shim, inline = "&points", "points"
        elif generate_python.is_output(a.type):
            for copy in "ab":
                self.lines.insert(0, f"{a.type} {copy}_{a.name} = {{0}};")
            self.out(a.name, a.type, a.name)
            shim, inline = f"&a_{a.name}", f"b_{a.name}"
        elif a.pointer and a.type in self.structs:
            for copy in "ab":
                self.lines.insert(0, f"{a.type} {copy}_{a.name} = {{0}};")
            for field in self.structs[a.type].fields:
                parts = [f".{axis}" for axis in "xyz"] if field.type == "sph_vec" else [""]
                for part in parts:
                    at = self.arrays
                    self.arrays += 1
                    for copy, struct in ((0, "a"), (1, "b")):
                        self.outs.append(
                            (
                                None,
                                f"outputs[{copy}][{at}][0] = (sph_real){struct}_{a.name}.{field.name}{part};",
                                "",
                            )
                        )
                    self.outs.append((field.name + part, f"outputs[0][{at}], outputs[1][{at}]", "1"))
            shim, inline = f"&a_{a.name}", f"&b_{a.name}"
        elif a.pointer and a.const:
            self.lines.append(
                f"const {a.type} *const {a.name} = "
                + ("ones;" if a.type == "sph_index" else f"in({seed(a.name)}, 1.0);")
            )
        elif a.pointer and a.type == "sph_real":
            at = self.arrays
            self.arrays += 1
            shim, inline = f"outputs[0][{at}]", f"outputs[1][{at}]"
            self.outs.append(
                (a.name, f"{shim}, {inline}", {"g": "8", "re": "1", "im": "1"}.get(a.name, "cloud.points.n"))
            )
        elif a.pointer:
            store = "counts" if a.type == "sph_index" else "states"
            shim, inline = f"{store}[0]", f"{store}[1]"
        else:
            zero = " = {0}" if a.type in self.structs else " = 0"
            self.lines.insert(0, f"{e.type if a.type == 'sph_kernel' else a.type} {a.name}{zero};")
            self.member(a.name, a.type, a.name)
            shim = f"&{a.name}" if e.pointer != a.pointer else a.name
        self.shim.append(shim)
        self.inline.append(inline)

    def text(self):
        f, name = self.function, self.function.name[len("sph_") :]
        declarations = [
            line for line in self.lines if line.startswith(("const ", "sph_", "int ", "size_t ", "int64_t "))
        ]
        rest = [line for line in self.lines if line not in declarations]
        body = ["begin();"] + rest + self.both
        body += [
            f"a = (double){shim_name(f)}({', '.join(self.shim)});",
            f"b = (double){f.name}({', '.join(self.inline)});",
            f'answers("{name}", a, b);',
            "if (b < 0 && sizeof(sph_index) == 4) return;" if f.kind == "sweep" else "",
        ]
        for label, what, n in self.outs:
            body.append(f'compare("{name}", "{label}", {what}, {n});' if label else what)
        late = [line for line in declarations if " in(" in line or "ones;" in line]
        early = [line for line in declarations if line not in late]
        lines = [f"static void call_{name}(void)", "{", "    int i = 0;", "    double a, b;"] + [
            "    " + line for line in early
        ]
        lines += (
            ["    begin();"] + ["    " + line for line in late] + ["    " + line for line in body[1:] if line]
        )
        return "\n".join(lines + ["    (void)i;", "}"])


def called(model):
    return [f for f in model.functions if f.kind != "text" and f.name not in generate_python.BY_HAND]


def write_c():
    model = read()
    structs = {s.name: s for s in model.structs}
    print(C_BEGIN)
    for function in called(model):
        print(InC(function, structs).text())
    print("static void every_call(void)\n{")
    for function in called(model):
        print(f"    call_{function.name[len('sph_'):]}();")
    print("}")
    print(
        C_MAIN
        % (SIDES[1], SIDES[2], SIDES[3], ", ".join(map(str, KERNELS.values())), seed("h"), seed("volume"))
    )


# ---------------------------------------------------------------- Python


def flat(label, result):
    """{path: numbers} of a result"""
    if isinstance(result, complex):
        return {"re": [result.real], "im": [result.imag]}
    if hasattr(result, "_fields_"):
        out = {}
        for field, _ in result._fields_:
            member = getattr(result, field)
            if hasattr(member, "_fields_"):
                out.update({f"{field}.{axis}": [getattr(member, axis)] for axis in "xyz"})
            else:
                out[field] = [float(member)]
        return out
    if hasattr(result, "__dict__") and not hasattr(result, "__len__"):
        out = {}
        for name, member in vars(result).items():
            out.update(flat(name, member))
        return out
    if hasattr(result, "ndim") and result.ndim == 2:
        result = [result[:, axis] for axis in range(result.shape[1])]
    if hasattr(result, "ndim") and result.ndim == 3:
        result = [[result[:, row, axis] for axis in range(result.shape[2])] for row in range(result.shape[1])]
    if isinstance(result, list) and isinstance(result[0], list):
        return {
            f"{label}.{row}.{axis}": part for row, parts in zip("xyz", result) for axis, part in zip("xyz", parts)
        }
    if isinstance(result, list):
        return {
            f"g{axis}" if label == "gradient" else f"{label}.{axis}": part
            for axis, part in zip("xyz", result)
        }
    return {label: result}


def through_python(path, sums):
    import inspect

    if "without-numpy" in sys.argv:
        sys.modules["numpy"] = None
    import array

    import sph

    sph.load(path)
    want = {}
    with open(sums, encoding="utf-8") as file:
        for line in file:
            name, kernel, dim, field, total, largest = line.split()
            want.setdefault((name, int(kernel), int(dim)), {})[field] = float(total), float(largest)
    passed = failed = 0
    accepted = set()
    model = read()
    for kernel in KERNELS.values():
        for dim, side in SIDES.items():
            n = side**dim
            make = lambda name, count=n: array.array(
                "d", [value(name, i) for i in range(count)]
            )  # noqa: E731
            x = [array.array("d", [position(axis, i, side) for i in range(n)]) for axis in range(dim)]
            if sph.numpy:
                x = sph.numpy.array(x).T.copy()
            cloud = sph.Cloud(kernel, x, make("h"), make("volume"))
            cloud.find_lists(criterion=sph.LARGER)
            for function in called(model):
                name = function.name[len("sph_") :]
                wanted = dict(want[name, kernel, dim])
                answer = wanted.pop("answer")[0]
                call = getattr(cloud, name) if function.kind == "sweep" else getattr(sph, name)
                arguments, changed = {}, {}
                for p, hint in (
                    (p, str(v.annotation)) for p, v in inspect.signature(call).parameters.items()
                ):
                    vectors = [make(f"{p}.{axis}") for axis in "xyz"[:dim]]
                    matrices = [[make(f"{p}.{row}.{axis}") for axis in "xyz"[:dim]] for row in "xyz"[:dim]]
                    if p == "kernel" or p == "dim":
                        arguments[p] = kernel if p == "kernel" else dim
                    elif p in ("sources", "points", "x"):
                        arguments[p] = x
                    elif p == "position":
                        parts = x.T if sph.numpy else x
                        arguments[p] = changed[p] = [array.array("d", part) for part in parts]
                    elif p == "velocity" and name == "collision_sequential":
                        arguments[p] = changed[p] = vectors
                    elif p == "count":
                        arguments[p] = [1] * n
                    elif p == "row":
                        arguments[p] = make(p, len(cloud.index))
                    elif (p == "gradient" or p == "hessian") and name.startswith("derivatives_rows"):
                        arguments[p] = [0.5] * (dim if p == "gradient" else dim * (dim + 1) // 2)
                    elif p in ("wave", "gravity"):
                        arguments[p] = [0.5] * dim
                    elif hint == str(sph.Matrices):
                        arguments[p] = matrices
                    elif hint == str(sph.Vectors):
                        arguments[p] = vectors
                    elif hint == str(sph.Scalars):
                        arguments[p] = make(p)
                    elif "int" in hint:
                        arguments[p] = INTS.get(p, 0)
                    else:
                        arguments[p] = REALS.get(p, 0.3)
                try:
                    result = call(**arguments)
                except (sph.Error, ValueError) as error:
                    if answer >= 0 and "is for" not in str(error):  # C reads y and z in any case
                        print(f"{name}, kernel {kernel}, dim {dim}: {error}")
                        failed += 1
                    continue
                accepted.add(name)
                if function.kind != "sweep":
                    good = abs(result - answer) <= 1e-12 * abs(answer)
                    passed, failed = passed + good, failed + (not good)
                    if not good:
                        print(f"{name}, kernel {kernel}, dim {dim}: {result}, not {answer}")
                    continue
                if answer < 0:
                    print(f"{name}, kernel {kernel}, dim {dim}: not refused")
                    failed += 1
                got = dict(flat(next(iter(wanted), "").split(".")[0], result)) if wanted else {}
                for label, parts in changed.items():
                    got.update(flat(label, parts))
                ok = cloud.not_ok == answer
                for field, (total, largest) in wanted.items():
                    if field not in got:  # beyond the dimension, or not filled
                        ok = ok and total == 0
                        continue
                    numbers = got.pop(field)
                    mine = sum((1 + i % 7) * float(number) for i, number in enumerate(numbers))
                    right = abs(mine - total) <= 1e-7 * (largest * len(numbers) + 1e-300)
                    if not right:
                        print(f"{name}, {field}, kernel {kernel}, dim {dim}: {mine}, not {total}")
                    ok = ok and right
                passed, failed = passed + ok, failed + (not ok)
                if not ok:
                    print(
                        f"{name}, kernel {kernel}, dim {dim}: not as inline (answer {cloud.not_ok}, {answer})"
                    )
    never = [f.name for f in called(model) if f.name[len("sph_") :] not in accepted]
    print("never accepted:" if never else "", *never)
    failed += len(never)
    print(f"shim_calls through Python: {passed} passed, {failed} failed")
    return failed != 0


if __name__ == "__main__":
    sys.exit(write_c() if sys.argv[1] == "C" else through_python(sys.argv[1], sys.argv[2]))

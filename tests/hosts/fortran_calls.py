# SPDX-License-Identifier: MIT
"""Writes a Fortran program that calls every operator on a cloud, and every function of numbers, through the
module of examples/hosts/sph_c.f90, and C functions that make the same calls of the shim with structs filled
in C: answers and outputs must be the same to the last bit, because it is the same code that computes them.

    python3 tests/hosts/fortran_calls.py FOLDER       writes calls.f90 and calls.c; from the repository's root

Operators that need more than a cloud (a grid, memory) are called by test_fortran.f90: what is in neither is
an error."""

import os
import re
import sys

sys.path.insert(0, os.path.join("examples", "hosts"))
from generate import exported, read, shim_name  # noqa: E402
from generate_fortran import fortran_name  # noqa: E402

ROOM = 20000  # for one output: more than the lists have entries

C_OPENING = """\
#include "examples/hosts/sph_shim.h"
#include <string.h>
enum { ROOM = %d, SLOTS = 24 };
static sph_cloud cloud;
static sph_index all_n;
static const sph_real *all_in;
static sph_real all_out[ROOM * SLOTS];
static unsigned char all_state[ROOM];
static sph_index all_number[ROOM * 2];
void calls_cloud(sph_index count, const sph_real *x, const sph_real *h, const sph_real *volume,
                 const sph_index *start, const sph_index *index, const sph_real *values);
void calls_cloud(sph_index count, const sph_real *x, const sph_real *h, const sph_real *volume,
                 const sph_index *start, const sph_index *index, const sph_real *values)
{
    const sph_list list = {start, index};
    all_n = count;
    all_in = values;
    cloud = sph_cloud_of(sph_points_strided(all_n, x, x + 1, x + 2, 3), list, sph_scalars_array(h),
                         sph_scalars_array(volume));
}
static void blank(void)
{
    size_t i;
    for (i = 0; i < ROOM * SLOTS; i++) all_out[i] = SPH_R(1.25);
    memset(all_state, 77, sizeof all_state);
    for (i = 0; i < ROOM * 2; i++) all_number[i] = 1;
}
static int differences(int64_t a, int64_t b, const sph_real *o, const unsigned char *s, const sph_index *m)
{
    return (a != b) + (memcmp(o, all_out, sizeof all_out) != 0) +
           (memcmp(s, all_state, sizeof all_state) != 0) + (memcmp(m, all_number, sizeof all_number) != 0);
}
""" % ROOM

F_OPENING = """\
program calls
    use sph
    implicit none
    integer, parameter :: side = 6, n = side**3, room = %d, slots = 24
    real(sph_real), target :: x(3, n), h(n), volume(n), all_in(room + 1000), all_out(room * slots)
    integer(sph_state), target :: all_state(room)
    integer(sph_index), target :: all_number(room * 2)
    type(sph_cloud) :: cloud
    integer :: i, error, off = 0, refused = 0, all = 0
    interface
        subroutine calls_cloud(n, x, h, volume, start, index, in) bind(c)
            import
            integer(sph_index), value :: n
            real(sph_real), intent(in) :: x(*), h(*), volume(*), in(*)
            integer(sph_index), intent(in) :: start(*), index(*)
        end subroutine
    end interface
    do i = 1, n
        x(:, i) = [mod(i - 1, side), mod((i - 1) / side, side), (i - 1) / side**2] + &
            0.1_sph_real * [sin(37.0_sph_real * i), cos(53.0_sph_real * i), sin(91.0_sph_real * i)]
        h(i) = 1.3_sph_real + 0.05_sph_real * sin(29.0_sph_real * i)
        volume(i) = 1.0_sph_real + 0.1_sph_real * cos(17.0_sph_real * i)
    end do
    do i = 1, size(all_in)
        all_in(i) = 0.95_sph_real + 0.04_sph_real * sin(11.0_sph_real * i)
    end do
    call cloud%%init('cubic-spline', n, sph_scalars(h), sph_scalars(volume), sph_scalars(x(1, :)), &
                    sph_scalars(x(2, :)), sph_scalars(x(3, :)), not_ok=error)
    if (error == 0) call cloud%%find_lists(error, SPH_LARGER)
    if (error /= 0 .or. size(cloud%%index) > room) error stop 'calls: no cloud'
    call calls_cloud(int(n, sph_index), x, h, volume, cloud%%start, cloud%%index, all_in)
""" % ROOM

F_END = """\
    print '(a, i0, a, i0, a, i0, a)', 'calls: ', all, ' operators, ', refused, ' refused, ', off, ' unlike C'
    if (off > 0 .or. refused > 0) error stop 1

contains

    subroutine blank()
        all_out = 1.25_sph_real ! sph_density_adaptive begins with such an h
        all_state = 77
        all_number = 1
    end subroutine

    subroutine told(name, answer, differences)
        character(*), intent(in) :: name
        integer(c_int64_t), intent(in) :: answer
        integer(c_int), intent(in) :: differences
        all = all + 1
        if (answer < 0) then
            print '(4a)', name, ': ', sph_error_text(int(answer)), ''
            refused = refused + 1
        end if
        if (differences == 0) return
        print '(2a)', name, ' answers another thing than in C'
        off = off + 1
    end subroutine
"""

END_OF_C = ["                integer(c_int) :: differences", "            end function",
            "        end interface"]


class Call:
    """one operator, with numbered inputs and outputs, as lines of C and of Fortran"""

    def __init__(self, function, structs):
        self.function, self.structs = function, structs
        self.inputs = self.slots = self.arrays = 0
        self.c, self.f, self.given_c, self.given_f, self.types, self.results = [], [], [], [], [], []
        for argument in function.arguments:
            self.argument(exported(argument))

    def set(self, path, c, f):
        self.c.append(f"    {path} = {c};")
        self.f.append(f"        {path.replace('.', '%')} = {f}")

    def input(self):
        self.inputs += 7
        return self.inputs

    def fill(self, path, field):
        """one field of a struct"""
        if field.type == "sph_scalars":
            k = self.input()
            self.set(path + ".p", f"all_in + {k}", f"c_loc(all_in({k + 1}))")
            self.set(path + ".stride", "1", "1")
        elif field.type == "sph_points":
            self.set(path, "cloud.points", "cloud%view%points")
        elif field.type in self.structs and not field.pointer:
            for inner in self.structs[field.type].fields:
                self.fill(path + "." + inner.name, inner)
        elif field.type == "sph_real" and field.pointer and field.const:
            k = self.input()
            self.set(path, f"all_in + {k}", f"c_loc(all_in({k + 1}))")
        elif field.type == "sph_real" and field.pointer:
            self.set(path, f"all_out + {self.slots} * ROOM", f"c_loc(all_out({self.slots} * room + 1))")
            self.slots += 1
        elif field.type == "unsigned char":
            self.set(path, "all_state", "c_loc(all_state)")
        elif field.type == "sph_index" and field.pointer:
            k = self.arrays
            self.set(path, f"all_number + {k} * ROOM", f"c_loc(all_number({k} * room + 1))")
            self.arrays += 1
        elif field.type == "sph_real":
            value = f"0.{25 + self.input()}"
            self.set(path, value, value + "_sph_real")
        elif field.type == "int64_t":
            self.set(path, "ROOM", "room")
        else:
            self.set(path, "1", "1")

    def argument(self, a):
        name = a.name
        if a.type == "sph_cloud":
            c, f = "&cloud", "cloud%view"
        elif a.type == "sph_points":
            c, f = "&cloud.points", "cloud%view%points"
        elif a.type in self.structs and not a.const:  # a result
            self.types.append((a.type, name))
            self.results.append((a.type, name))
            self.c.append(f"    memset(&{name}, 0, sizeof {name});")
            c, f = "&" + name, name
        elif a.type in self.structs:
            self.types.append((a.type, name))
            self.c.append(f"    memset(&{name}, 0, sizeof {name});")
            for field in self.structs[a.type].fields:
                self.fill(name + "." + field.name, field) if a.type != "sph_scalars" else None
            if a.type == "sph_scalars":
                k = self.input()
                self.set(name, f"sph_scalars_array(all_in + {k})", f"sph_scalars(all_in({k + 1}:))")
            c, f = "&" + name, name
        elif a.pointer and a.type == "sph_real" and a.const:
            k = self.input()
            c, f = f"all_in + {k}", f"all_in({k + 1}:)"
        elif a.pointer and a.type == "sph_real":
            c, f = f"all_out + {self.slots} * ROOM", f"all_out({self.slots} * room + 1:)"
            self.slots += 1
        elif a.pointer and a.type == "unsigned char":
            c, f = "all_state", "all_state"
        elif a.pointer and a.type == "sph_index":
            c, f = f"all_number + {self.arrays} * ROOM", f"all_number({self.arrays} * room + 1:)"
            self.arrays += not a.const
        elif a.pointer:  # a size that comes back
            self.types.append(("int64_t", name))
            self.results.append(("int64_t", name))
            self.set(name, "0", "0")
            c, f = "&" + name, name
        elif a.type == "sph_real":
            value = f"0.{25 + self.input()}"
            c, f = value, value + "_sph_real"
        else:
            value = {"kernel": "SPH_CUBIC_SPLINE", "dim": "3", "left": "0", "bins": "8"}.get(name, "1")
            value = "215" if name == "right" else value
            c = f = value
        self.given_c.append(c)
        self.given_f.append(f"{name}={f}")

    def compared(self, kind, mine, theirs):
        """differences of two results, as a sum in C"""
        if kind not in self.structs:
            return [f"({mine} != {theirs})"]
        terms = []
        for field in self.structs[kind].fields:
            a, b = f"{mine}.{field.name}", f"{theirs}.{field.name}"
            if field.array:
                terms.append(f"(memcmp({a}, {b}, sizeof {a}) != 0)")
            else:
                terms += self.compared(field.type, a, b)
        return terms

    def in_c(self):
        name = self.function.name
        taken = ["int64_t answer", "const sph_real *f_out"]
        taken += ["const unsigned char *f_state", "const sph_index *f_number"]
        taken += [f"const {kind} *{label}_f" for kind, label in self.results]
        head = f"int calls_{name}({', '.join(taken)})"
        lines = [head + ";", head, "{"] + [f"    {kind} {label};" for kind, label in self.types]
        lines += ["    int64_t mine;", "    blank();"] + self.c
        lines.append(f"    mine = {shim_name(self.function)}({', '.join(self.given_c)});")
        terms = ["differences(answer, mine, f_out, f_state, f_number)"]
        for kind, label in self.results:
            terms += self.compared(kind, label, f"(*{label}_f)")
        return lines + ["    return " + " +\n        ".join(terms) + ";", "}"]

    def in_fortran(self, model):
        name = fortran_name(self.function, model)
        kinds = {"int64_t": "integer(c_int64_t)"}
        labels = "".join(", " + label for _, label in self.results)
        lines = [f"    subroutine call_{name}()", "        interface",
                 f"            function c(answer, o, s, m{labels}) &",
                 f"                bind(c, name='calls_{self.function.name}') result(differences)",
                 "                import", "                integer(c_int64_t), value :: answer",
                 "                real(sph_real), intent(in) :: o(*)",
                 "                integer(sph_state), intent(in) :: s(*)",
                 "                integer(sph_index), intent(in) :: m(*)"]
        lines += [f"                {kinds.get(kind, f'type({kind})')}, intent(in) :: {label}"
                  for kind, label in self.results]
        lines += END_OF_C
        lines += [f"        {kinds.get(kind, f'type({kind})')} :: {label}" for kind, label in self.types]
        lines += ["        integer(c_int64_t) :: answer", "        call blank()"] + self.f
        lines.append(f"        answer = {name}({', '.join(self.given_f)})")
        lines.append(f"        call told('{name}', answer, &")
        lines.append(f"            c(answer, all_out, all_state, all_number{labels}))")
        return [cut for line in lines + ["    end subroutine", ""] for cut in folded_code(line)]


def number_in_c(function):
    values = ", ".join(value_of(a) for a in function.arguments)
    head = f"int calls_{function.name}(double answer)"
    # >= and <=, because some compilers warn of ==
    return [head + ";", head, "{", f"    const double mine = (double){shim_name(function)}({values});",
            "    return !(answer >= mine && answer <= mine);", "}"]


def number_in_fortran(function, model):
    name = fortran_name(function, model)
    kinds = {"sph_real": "_sph_real", "sph_index": "_sph_index", "size_t": "_c_size_t",
             "int64_t": "_c_int64_t"}
    values = ", ".join(value_of(a) + (kinds.get(a.type, "_c_int") if value_of(a)[0].isdigit() else "")
                       for a in function.arguments)
    lines = [f"    subroutine call_{name}()", "        interface",
             f"            function c(answer) bind(c, name='calls_{function.name}') result(differences)",
             "                import", "                real(c_double), value :: answer",
             *END_OF_C,
             f"        call told('{name}', 0_c_int64_t, c(real({name}({values}), c_double)))"]
    return [cut for line in lines + ["    end subroutine", ""] for cut in folded_code(line)]


def value_of(argument):
    """of a function of numbers: each letter of its name another one"""
    if argument.type == "sph_kernel":
        return "SPH_CUBIC_SPLINE"
    if argument.type == "sph_real":
        return f"{0.5 + (sum(map(ord, argument.name)) % 32) / 64}"
    return {"dim": "2"}.get(argument.name, "1")


def folded_code(line):
    """in lines of at most 110 columns"""
    parts = []
    while len(line) > 110:
        at = line.rfind(" ", 0, 108)
        parts.append(line[:at] + " &")
        line = " " * 12 + line[at + 1:]
    return parts + [line]


def main(folder):
    model = read()
    structs = {s.name: s for s in model.structs}
    with open("tests/hosts/test_fortran.f90", encoding="utf-8") as file:
        elsewhere = file.read()
    calls, numbers = [], []
    for function in model.functions:
        kinds = {a.type for a in function.arguments}
        if function.kind == "sweep" and "sph_cloud" in kinds:
            calls.append(Call(function, structs))
        elif function.kind == "number":
            numbers.append(function)
        elif not re.search(fortran_name(function, model).replace("c_", "(c|sph)_") + r"\b", elsewhere):
            raise SystemExit(f"tests/hosts/test_fortran.f90 does not call {fortran_name(function, model)}")
    with open(os.path.join(folder, "calls.c"), "w", encoding="utf-8") as file:
        file.write("\n".join([C_OPENING] + [line for call in calls for line in call.in_c()] +
                             [line for function in numbers for line in number_in_c(function)]) + "\n")
    with open(os.path.join(folder, "calls.f90"), "w", encoding="utf-8") as file:
        names = [fortran_name(function, model) for function in [call.function for call in calls] + numbers]
        lines = [f"    call call_{name}()" for name in names] + [F_END]
        lines += [line for call in calls for line in call.in_fortran(model)]
        lines += [line for function in numbers for line in number_in_fortran(function, model)]
        file.write(F_OPENING + "\n".join(lines + ["end program"]) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])

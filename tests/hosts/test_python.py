# SPDX-License-Identifier: MIT
"""What sph.py (examples/hosts) refuses, and that it reads strided arrays in place: test_python.py LIBRARY [without-numpy]"""

import array
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "hosts"))
if "without-numpy" in sys.argv:
    sys.modules["numpy"] = None
import sph

passed = failed = 0


def check(what, holds):
    global passed, failed
    passed, failed = passed + bool(holds), failed + (not holds)
    if not holds:
        print("failed:", what)


def refuses(error, text, call, *arguments, **named):
    try:
        call(*arguments, **named)
    except error as e:
        return check(f"'{e}' says '{text}'", text in str(e))
    except Exception as e:
        return check(f"{type(e).__name__}: {e}, not {error.__name__}: {text}", False)
    check(f"{text}: not refused", False)


def array_of(values):
    return array.array("d", values)


sph.load(sys.argv[1])
side = 12
n, dx = side * side, 1.0 / side
x = array_of(dx * (i % side + 0.1 * math.sin(5 * i)) for i in range(n))
y = array_of(dx * (i // side + 0.1 * math.cos(7 * i)) for i in range(n))
f = array_of(2 * a - 3 * b for a, b in zip(x, y))
cloud = sph.Cloud("w4", [x, y], 1.4 * dx, dx * dx)
cloud.find_lists()
gx, gy = cloud.gradient(f)
check("gradient", all(abs(a - 2) < 1e-11 and abs(b + 3) < 1e-11 for a, b in zip(gx, gy)))
check("density of a lattice, inside", abs(cloud.density(dx * dx)[n // 2 + side // 2] - 1) < 0.1)
check("own lists", (cloud.use_lists(cloud.start, cloud.index), list(cloud.gradient(f)[0]) == list(gx))[1])
one = array_of([0, 1]), array_of([0, 0])
velocity = array_of([1, -1]), array_of([0, 0])
pair = sph.Cloud("m4", one, 1.0, 1.0)
pair.find_lists()
pair.collide(1.5, 1.0, 1.0, velocity)
check("collision", list(velocity[0]) == [-1, 1])

refuses(ValueError, "no kernel is called 'nonsense'", sph.Cloud, "nonsense", [x, y], 1.0, 1.0)
refuses(TypeError, "f: an array of float64 is wanted, not one of 'f'", cloud.gradient, array.array("f", f))
refuses(TypeError, "y: an array is wanted, not list", sph.Cloud, "m4", [x, list(y)], 1.0, 1.0)
refuses(ValueError, "f: 144 numbers are wanted, not 143", cloud.gradient, f[1:])
refuses(ValueError, "start: 145 numbers are wanted, not 144", cloud.use_lists, cloud.start[1:], cloud.index)
refuses(TypeError, "index: an array of int32 is wanted, not one of 'q'", cloud.use_lists, cloud.start, array.array("q", cloud.index))
refuses(ValueError, "entries are wanted", cloud.use_lists, cloud.start, cloud.index[1:])
refuses(sph.Error, "h must be finite and positive", sph.Cloud("m4", [x, y], -1.0, 1.0).find_lists, radius=-1.0)
cloud.range(0, n + 1)
refuses(sph.Error, "the range must obey", cloud.gradient, f)
cloud.range(0, n)

spoilt = array_of(f)
spoilt[17] = math.nan
refuses(sph.Error, "f: a value is not finite, or a parameter is out of range, first at particle 17", cloud.gradient, spoilt)
cloud.check()
check("checked", list(cloud.gradient(f)[0]) == list(gx))
spoilt = array_of(1.4 * dx for _ in range(n))
spoilt[5] = -1
unwell = sph.Cloud("w4", [x, y], spoilt, dx * dx)
unwell.use_lists(cloud.start, cloud.index)
refuses(sph.Error, "h: h must be finite and positive, first at particle 5", unwell.check)
check("a status in words", sph.status_text(1) == "too few neighbours inside the support")
empty = sph.Cloud("m4", [array_of([]), array_of([])], array_of([]), array_of([]))
empty.find_lists()
check("an empty cloud", [len(g) for g in empty.gradient(array_of([]))] == [0, 0] and len(empty.density(1.0)) == 0)
check("its rows", len(empty.rows_msph(1.0)[0]) == 0 and len(empty.derivatives(array_of([]))) == 0)

if sph.numpy:
    numpy = sph.numpy
    whole = numpy.array([x, y, f]).T.copy()  # n rows of 3
    strided = sph.Cloud("w4", [whole[:, 0], whole[:, 1]], 1.4 * dx, dx * dx)
    strided.use_lists(cloud.start, cloud.index)
    check("columns in place", list(strided.gradient(whole[:, 2])[0]) == list(gx))
    whole[:, 2] *= 2
    check("seen when they change", abs(strided.gradient(whole[:, 2])[0][0] - 4) < 1e-11)
    read_only = numpy.array(f)
    read_only.setflags(write=False)
    check("read-only inputs", list(cloud.gradient(read_only)[0]) == list(gx))
    refuses(ValueError, "velocity: is read-only", cloud.collide, dx, 1.0, 0.5, [read_only, read_only])
    refuses(ValueError, "f: one dimension is wanted, not 2", cloud.gradient, whole)
    refuses(ValueError, "-8 bytes apart cannot be read in place", cloud.gradient, numpy.array(f)[::-1])
    refuses(TypeError, "f: an array of float64", cloud.gradient, numpy.array(f).astype(">f8"))
    refuses(TypeError, "f: an array of float64", cloud.gradient, numpy.array(f).astype(numpy.float32))
    refuses(ValueError, "same stride", sph.Cloud, "w4", [whole[:, 0], y], 1.0, 1.0)
print(f"test_python: {passed} passed, {failed} failed")
sys.exit(failed != 0)

# SPDX-License-Identifier: MIT
"""What the module of examples/hosts/sph takes, converts and refuses, and what it adds to the functions of C.

    test_python.py LIBRARY [without-numpy]
    SPH_LIBRARY=LIBRARY python3 -m pytest tests/hosts/test_python.py

shim_calls.py compares every operator with the inline one."""

import array
import math
import os
import sys
import warnings

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "hosts"))
if "without-numpy" in sys.argv or os.environ.get("SPH_WITHOUT_NUMPY"):
    sys.modules["numpy"] = None
import sph  # noqa: E402

side = 12
n, dx = side * side, 1.0 / side


def array_of(values):
    return array.array("d", values)


x = array_of(dx * (i % side + 0.1 * math.sin(5 * i)) for i in range(n))
y = array_of(dx * (i // side + 0.1 * math.cos(7 * i)) for i in range(n))
f = array_of(2 * a - 3 * b for a, b in zip(x, y))
library = os.environ.get("SPH_LIBRARY") or (sys.argv[1] if __name__ == "__main__" else None)
if library:
    sph.load(library)
numpy = sph.numpy


def new_cloud(positions=None, h=1.4 * dx, volume=dx * dx):
    cloud = sph.Cloud("w4", [x, y] if positions is None else positions, h, volume)
    cloud.find_lists()
    return cloud


def refuses(error, text, call, *arguments, **named):
    try:
        call(*arguments, **named)
    except error as e:
        assert text in str(e), f"'{e}' does not say '{text}'"
        return
    raise AssertionError(f"not refused: {text}")


def near(a, b, tolerance=1e-11):
    a, b = list(a), list(b)
    assert len(a) == len(b) and max(map(lambda p: abs(p[0] - p[1]), zip(a, b)), default=0) <= tolerance


def test_gradient_and_density():
    cloud = new_cloud()
    gx, gy = cloud.gradient(f)
    near(gx, [2] * n)
    near(gy, [-3] * n)
    assert cloud.not_ok == 0 and sph.status_text(cloud.status[0]) == "ok"
    assert abs(cloud.density(dx * dx)[n // 2 + side // 2] - 1) < 0.1
    result = cloud.derivatives_wls(f)
    near(result.gradient[0], [2] * n, 1e-8)
    assert not hasattr(result, "hzz") and len(result.hxy) == n and min(result.conditioning) > 0


def test_own_lists():
    cloud = new_cloud()
    g = list(cloud.gradient(f)[0])
    other = sph.Cloud("w4", [x, y], 1.4 * dx, dx * dx)
    other.use_lists(cloud.start, cloud.index)
    assert list(other.gradient(f)[0]) == g
    other.use_lists(list(cloud.start), list(cloud.index))
    assert list(other.gradient(f)[0]) == g
    refuses(
        ValueError, "start: 145 numbers are wanted, not 144", cloud.use_lists, cloud.start[1:], cloud.index
    )
    refuses(ValueError, "entries are wanted", cloud.use_lists, cloud.start, cloud.index[1:])
    refuses(
        TypeError,
        "index: an array of whole numbers" if numpy else "index: ",
        cloud.use_lists,
        cloud.start,
        array_of(cloud.index),
    )
    cloud.use_lists(array.array("q", cloud.start), array.array("q", cloud.index))
    assert list(cloud.gradient(f)[0]) == g


def test_a_sweep_before_the_search():
    cloud = sph.Cloud("w4", [x, y], 1.4 * dx, dx * dx)
    refuses(sph.Error, "no neighbour lists yet: find_lists() makes them", cloud.gradient, f)
    refuses(sph.Error, "no neighbour lists yet", cloud.examine)


def test_inputs_that_are_converted():
    cloud = new_cloud()
    g = cloud.gradient(f)
    for values in (list(f), tuple(f), memoryview(f)):
        near(cloud.gradient(values)[0], g[0], 0)
    near(cloud.gradient(array.array("f", f))[0], g[0], 1e-5)
    whole = [i % 3 for i in range(n)]
    near(cloud.interpolate_shepard(array.array("q", whole)), cloud.interpolate_shepard(array_of(whole)), 0)
    near(cloud.interpolate_shepard(array_of([1, 2] * n)[::2]), [1] * n, 1e-12)
    of_lists = new_cloud([list(x), list(y)])
    near(of_lists.gradient(f)[0], g[0], 0)
    assert new_cloud(h=list([1.4 * dx] * n)).density(dx * dx)[5] == cloud.density(dx * dx)[5]
    if numpy:
        assert sph.kernel_w("m4", numpy.int64(2), numpy.float32(0), 1) > 0
        near(cloud.density(numpy.float64(2)), cloud.density(2), 0)
        near(cloud.density(numpy.int64(2)), cloud.density(2), 0)
        near(cloud.density(numpy.array(2)), cloud.density(2), 0)
    one_dimension = sph.Cloud(0, [0.0, 0.5, 1.0], 0.5, 0.5)
    one_dimension.find_lists()
    assert one_dimension.dim == 1 and len(one_dimension.density(1)) == 3


def test_inputs_that_are_refused():
    cloud = new_cloud()
    refuses(
        ValueError,
        "no kernel is called 'nonsense'; there are: cubic-spline",
        sph.Cloud,
        "nonsense",
        [x, y],
        1.0,
        1.0,
    )
    refuses(ValueError, "kernel: a name or a number from 0", sph.Cloud, -1, [x, y], 1.0, 1.0)
    refuses(ValueError, "f: 144 numbers are wanted, not 143", cloud.gradient, f[1:])
    refuses(TypeError, "f: ", cloud.gradient, "text")
    refuses(TypeError, "f: ", cloud.gradient, ["1"] * n)
    refuses(TypeError, "f: ", cloud.gradient, [1j] * n)
    refuses(TypeError, "f: ", cloud.gradient, object())
    refuses(ValueError, "y: 144 numbers are wanted, not 143", sph.Cloud, "m4", [x, y[1:]], 1.0, 1.0)
    refuses(
        ValueError, "a list of 1 to 3 arrays, one for each component", sph.Cloud, "m4", [x, y, x, y], 1.0, 1.0
    )
    refuses(ValueError, "box: 2 lengths are wanted, not 3", sph.Cloud, "m4", [x, y], 1.0, 1.0, box=(1, 1, 1))
    refuses(ValueError, "h: 144 numbers are wanted, not 3", sph.Cloud, "m4", [x, y], [1.0] * 3, 1.0)
    refuses(
        TypeError,
        "viscosity: a whole number is wanted, not float",
        cloud.fluid_rates_monaghan,
        1,
        1,
        f,
        1,
        [x, y],
        viscosity=0.5,
    )
    refuses(
        TypeError,
        "alpha: a number is wanted, not str",
        cloud.fluid_rates_monaghan,
        1,
        1,
        f,
        1,
        [x, y],
        alpha="1",
    )
    refuses(ValueError, "v: 2 components are wanted, not 1", cloud.fluid_rates_monaghan, 1, 1, f, 1, [x])
    refuses(ValueError, "gravity_direct is for 3D, and this cloud has 2D", cloud.gravity_direct, 1.0, 1.0)
    refuses(ValueError, "dim: 1, 2 or 3 is wanted", sph.kernel_sigma, "m4", 4)
    refuses(sph.Error, "rho: " + sph.status_text(sph.ERROR_NULL), cloud.fluid_rates_monaghan, m=1)
    refuses(
        sph.Error, sph.status_text(sph.ERROR_H), sph.Cloud("m4", [x, y], -1.0, 1.0).find_lists, radius=-1.0
    )
    refuses(sph.Error, "without h has no support", sph.Cloud("m4", [x, y]).find_lists)
    cloud.range(0, n + 1)
    refuses(sph.Error, sph.status_text(sph.ERROR_RANGE), cloud.gradient, f)


def test_values_that_are_refused():
    cloud = new_cloud()
    spoilt = array_of(f)
    spoilt[17] = math.nan
    refuses(
        sph.Error, "f: " + sph.status_text(sph.ERROR_VALUE) + ", first at particle 17", cloud.gradient, spoilt
    )
    g = list(cloud.gradient(f)[0])
    cloud.check()
    assert list(cloud.gradient(f)[0]) == g
    spoilt = array_of(1.4 * dx for _ in range(n))
    spoilt[5] = -1
    unwell = sph.Cloud("w4", [x, y], spoilt, dx * dx)
    unwell.use_lists(cloud.start, cloud.index)
    refuses(sph.Error, "h: " + sph.status_text(sph.ERROR_H) + ", first at particle 5", unwell.check)


def test_ranges_and_checks():
    cloud = new_cloud()
    g = list(cloud.gradient(f)[0])
    cloud.check()
    cloud.range(10, 20)
    part = list(cloud.gradient(f)[0])
    assert part[10:20] == g[10:20] and part[9] == part[20] == 0
    spoilt = array_of([math.nan] * n)
    cloud.h = spoilt  # takes the mark away
    refuses(sph.Error, sph.status_text(sph.ERROR_H), cloud.gradient, f)


def test_rows_and_matrices():
    cloud = new_cloud()
    rows = cloud.elliptic_rows_msph(0.5, trace=1)
    near(cloud.rows_apply(rows.row, rows.diagonal, f), [0] * n, 1e-9)
    start, column, value = cloud.csr_assemble(rows.row, rows.diagonal)
    assert start[n] == len(column) == len(value) <= cloud.csr_size()
    near(
        [sum(value[p] * f[column[p]] for p in range(start[i], start[i + 1])) for i in range(n)], [0] * n, 1e-9
    )
    refuses(ValueError, "row: ", cloud.rows_apply, rows.row[1:], rows.diagonal, f)


def test_changed_in_place():
    pair = sph.Cloud("m4", [array_of([0, 1]), array_of([0, 0])], 1.0, 1.0)
    pair.find_lists()
    velocity = array_of([1, -1]), array_of([0, 0])
    report = pair.collision_sequential(velocity, distance=1.5, restitution=1.0, inverse_mass=1.0)
    assert list(velocity[0]) == [-1, 1] and report.collisions == 1
    refuses(
        TypeError,
        "velocity: is changed in place: an array of float64 is wanted, not list",
        pair.collision_sequential,
        [[1, -1], [0, 0]],
        1.5,
        1.0,
        1.0,
    )
    refuses(
        TypeError,
        "velocity: is changed in place",
        pair.collision_sequential,
        [array.array("f", [1, -1]), array.array("f", [0, 0])],
        1.5,
        1.0,
        1.0,
    )
    refuses(
        ValueError,
        "velocity: is changed in place: 2 numbers are wanted",
        pair.collision_sequential,
        [array_of([1]), array_of([0])],
        1.5,
        1.0,
        1.0,
    )


def warned(call, *arguments):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        call(*arguments)
    return [str(w.message) for w in said if issubclass(w.category, sph.StaleWarning)]


def test_positions_that_are_not_handed_over():
    px, py = array_of(x), array_of(y)
    cloud = new_cloud([px, py])
    assert not warned(cloud.gradient, f) and not warned(cloud.gradient, f)
    px = array_of(value + 0.01 for value in px)  # what a step does, and the cloud cannot see
    said = warned(cloud.gradient, f)
    assert len(said) == 1 and "cloud.positions = a" in said[0]
    assert not warned(cloud.gradient, f)  # told once
    cloud.find_lists([px, py])
    assert cloud.positions[0] is px and not warned(cloud.gradient, f)
    px[0] += 0.001  # in place: seen
    assert cloud.positions[0][0] == px[0] and not warned(cloud.gradient, f)
    h = array_of([1.4 * dx] * n)
    cloud.h = h
    assert not warned(cloud.gradient, f)
    h = array_of([1.5 * dx] * n)
    assert len(warned(cloud.gradient, f)) == 1
    temporary = new_cloud([array_of(x), array_of(y)])  # nobody else ever had these
    assert not warned(temporary.gradient, f) and not warned(temporary.gradient, f)
    refuses(ValueError, "144 particles in 2D are wanted, as before, not 144 in 1D", cloud.find_lists, [x])
    if not numpy:
        return
    pos = numpy.array([x, y]).T.copy()
    cloud = new_cloud(pos)
    assert not warned(cloud.gradient, f)
    before = list(cloud.density(1.0))
    pos *= 1.5  # in place: seen
    assert not warned(cloud.gradient, f) and list(cloud.density(1.0)) != before
    pos = pos + 0.01
    assert len(warned(cloud.gradient, f)) == 1
    cloud.positions = pos
    assert not warned(cloud.gradient, f)
    cloud.positions += 0.01
    assert cloud.positions is pos and not warned(cloud.gradient, f)
    single = numpy.array([x, y], dtype=numpy.float32).T.copy()  # converted anew in each call
    cloud = new_cloud(single)
    before = list(cloud.density(1.0))
    single *= 1.5
    assert list(cloud.density(1.0)) != before


def test_search():
    cloud = new_cloud()
    order = cloud.order()
    assert sorted(order) == list(range(n))
    sorted_x = sph.permute(order, x)
    assert sorted_x[3] == x[order[3]]
    assert sph.permute_inverse(order)[order[7]] == 7
    moved = array_of(value + 0.1 for value in x)
    assert sph.rebuild_due([x, y], [moved, y], 0.1) and not sph.rebuild_due([x, y], [x, y], 0.1)
    assert cloud.examine() == []
    wrong = sph.Cloud("w4", [x, y], 1.4 * dx, 5.0)
    wrong.find_lists()
    assert any("volume" in text for text in wrong.examine())
    periodic = sph.Cloud("w4", [x, y], 1.4 * dx, dx * dx, box=(1, 0))
    periodic.find_lists()
    assert len(periodic.index) > len(cloud.index)
    cloud.find_lists(criterion=sph.MEAN)
    refuses(sph.Error, "", cloud.find_lists, None, None, 9)


def test_empty():
    empty = sph.Cloud("m4", [array_of([]), array_of([])], array_of([]), array_of([]))
    empty.find_lists()
    assert [len(g) for g in empty.gradient(array_of([]))] == [0, 0] and len(empty.density(1.0)) == 0
    assert len(empty.elliptic_rows_msph(1.0).row) == 0 and len(empty.derivatives_icspm(array_of([])).hxx) == 0
    if numpy:
        empty = sph.Cloud("m4", numpy.zeros((0, 3)), 1.0, 1.0)
        empty.find_lists()
        assert empty.dim == 3 and empty.gradient(numpy.zeros(0)).shape == (0, 3)


def test_kernels():
    w, g = sph.kernel_wf("m4", 3, array_of([0, 0.5]), 1.0)
    assert abs(w[0] - 1 / math.pi) < 1e-15 and w[1] == sph.kernel_w("m4", 3, 0.5, 1.0) and g[1] < 0
    assert sph.kernel_support("m6", 2.0) == 6 and sph.kernel_support_ratio(sph.QUINTIC_SPLINE) == 3
    assert sph.kernel_name("w2") == "wendland-c2" and len(sph.kernel_names()) == sph.KERNEL_COUNT
    assert sph.time_step_sound(1.0, 10.0, 0.0) > 0
    refuses(TypeError, "h: a number is wanted, not str", sph.kernel_w, "m4", 3, 0.5, "1")


def test_help():
    for name in dir(sph.Operators):
        method = getattr(sph.Operators, name)
        if not name.startswith("_"):
            assert method.__doc__.startswith("sph_" + name), name
            assert "return" in method.__annotations__, name


def test_arrays_of_numpy():
    if not numpy:
        return
    cloud = new_cloud()
    g = list(cloud.gradient(f)[0])
    pos = numpy.array([x, y]).T
    of_shape = new_cloud(pos)
    assert of_shape.gradient(f).shape == (n, 2) and list(of_shape.gradient(f)[:, 0]) == g
    assert of_shape.gradient_difference(f).shape == (n, 2)
    whole = numpy.array([x, y, f]).T.copy()  # n rows of 3
    strided = sph.Cloud("w4", [whole[:, 0], whole[:, 1]], 1.4 * dx, dx * dx)
    strided.use_lists(cloud.start, cloud.index)
    assert list(strided.gradient(whole[:, 2])[0]) == g
    whole[:, 2] *= 2
    assert abs(strided.gradient(whole[:, 2])[0][0] - 4) < 1e-11
    read_only = numpy.array(f)
    read_only.setflags(write=False)
    assert list(cloud.gradient(read_only)[0]) == g
    assert list(cloud.gradient(numpy.array(f)[::-1].copy()[::-1])[0]) == g
    assert list(cloud.gradient(numpy.array(f).astype(">f8"))[0]) == g
    near(cloud.gradient(numpy.array(f).astype(numpy.float32))[0], g, 1e-5)
    packed = numpy.zeros(n, dtype=numpy.dtype([("flag", "u1"), ("f", "f8")]))
    packed["f"] = f
    assert list(cloud.gradient(packed["f"])[0]) == g
    near(sph.Cloud("w4", [whole[:, 0], y], 1.4 * dx, dx * dx).positions[1], y, 0)  # other strides: packed
    refuses(
        ValueError,
        "velocity: is changed in place, and the array is read-only",
        cloud.collision_sequential,
        [read_only, read_only],
        dx,
        0.5,
        1.0,
    )
    refuses(
        ValueError,
        "f: one dimension is wanted, not 2: 144 numbers, not the shape (144, 3)",
        cloud.gradient,
        whole,
    )
    refuses(
        ValueError,
        "an array of shape (n, dim) with dim = 1, 2 or 3 is wanted, not (2, 144)",
        sph.Cloud,
        "w4",
        pos.T,
        1.0,
        1.0,
    )
    refuses(
        TypeError,
        "f: an array of numbers is wanted, not one of complex128",
        cloud.gradient,
        numpy.array(f) + 1j,
    )
    refuses(
        TypeError,
        "f: an array of numbers is wanted, not one of object",
        cloud.gradient,
        numpy.array([None] * n),
    )
    refuses(TypeError, "masked", cloud.gradient, numpy.ma.masked_array(f, mask=[0] * n))
    refuses(ValueError, "32 bits", cloud.use_lists, cloud.start.astype(numpy.int64) + 2**40, cloud.index)
    velocity = numpy.zeros((n, 2))
    velocity[:, 0] = -numpy.array(x)
    before = velocity.copy()
    cloud.collision_sequential(velocity, 1.2 * dx, 0.5, 1.0)
    assert (velocity != before).any()
    rows = cloud.elliptic_rows_msph(numpy.ones(n), gradient=sph.GRADIENT_FULL)
    assert rows.row.shape == cloud.index.shape


def main():
    passed = failed = 0
    for name, test in sorted(globals().items()):
        if name.startswith("test_") and callable(test):
            try:
                test()
                passed += 1
            except Exception as e:
                import traceback

                failed += 1
                print(f"failed: {name}: {type(e).__name__}: {e}")
                print("".join(traceback.format_tb(e.__traceback__)[-2:]))
    print(f"test_python: {passed} passed, {failed} failed")
    return failed != 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: MIT
"""sph - the operators of sph.h for Python, on numpy's arrays, or without numpy on those of the module array.

    import sph

    cloud = sph.Cloud("wendland-c2", pos, h=h, volume=V)    pos: of shape (n, dim), or [x, y, z]
    while t < end:
        cloud.find_lists(pos)                               the positions of this step, and who is near whom
        grad = cloud.gradient(f)                            like pos: of shape (n, dim), or a list
        ...

Every operator of the headers is a method of Cloud under its C name without sph_ (help(sph.Cloud) lists them),
and every function of numbers a function here. Outputs are new arrays; several of them are the members of one
result: rates = cloud.fluid_rates_monaghan(...); rates.acceleration.

Inputs are numbers (one for all particles), arrays, or lists. Arrays of float64 are read where they are, also
with strides (columns, slices, fields of structured arrays) and if they are read-only. Others are converted
for each call: float32, integers, lists, reversed or big-endian arrays. What cannot be meant is refused by a
sentence that says what is expected: a wrong length or shape, complex numbers, texts. The velocity of
collision_sequential and the position of coincident_separate are changed in place, and must be writable arrays
of float64.

A cloud keeps the positions, h and volume that it was given, and looks at them anew in each call: it sees
`pos += v * dt`. `pos = pos + v * dt` makes another array, which the cloud cannot know of: hand it over by
find_lists(pos) or `cloud.positions = pos`. Where an array that a program held at an earlier sweep is now held
by the cloud alone, the cloud warns (StaleWarning). As long as the program keeps the old array, too, the cloud
cannot tell.

A sweep that is refused raises sph.Error, which names the argument and the first particle at fault.
cloud.not_ok is the number of targets that are not ok after the last sweep, and cloud.status says why, of each
target: status_text(status)."""

import array
import ctypes
import numbers
import os
import sys
import types
import warnings
from typing import Any, Optional, Sequence, Tuple, Union

from . import c, operators
from .c import *  # noqa: F401,F403 - the constants of the headers, without SPH_
from .operators import *  # noqa: F401,F403 - the functions of numbers
from .operators import Array, Indices, Matrices, Operators, Scalars, Vectors

try:
    import numpy
except ImportError:
    numpy = None

_library = None
_COORDINATES = "xyz"


class Error(RuntimeError):
    """a call that the toolkit refused; nothing was written"""


class StaleWarning(UserWarning):
    """positions, h or volume of a cloud are held by nobody else any more"""


# ---------------------------------------------------------------- the library


def load(path: str) -> None:
    """Opens a shared library of the shim. Without it the first call opens the one beside this module."""
    global _library
    library = ctypes.CDLL(path)
    if (library.sph_shim_real_size(), library.sph_shim_index_size()) != (8, 4):
        raise Error(f"{path} was not compiled with double and int32_t")
    if library.sph_shim_version() != c.VERSION:
        raise Error(f"{path} is of release {library.sph_shim_version()}, and this module of {c.VERSION}")
    library.sph_shim_struct_size.restype = ctypes.c_size_t
    for struct in c.STRUCTS:
        size = library.sph_shim_struct_size(struct.__name__.encode())
        if size != ctypes.sizeof(struct):
            raise Error(f"{path}: {struct.__name__} has {size} bytes there, and {ctypes.sizeof(struct)} here")
    for name, (answer, arguments) in c.FUNCTIONS.items():
        function = getattr(library, "sph_shim_" + name)
        function.restype = answer
        function.argtypes = [
            ctypes.c_void_p if isinstance(kind, tuple) or issubclass(kind, ctypes.Structure) else kind
            for _, kind in arguments
        ]
    pointer, real, integer = ctypes.c_void_p, ctypes.c_double, ctypes.c_int
    library.sph_shim_refused.restype = ctypes.c_char_p
    library.sph_shim_refused.argtypes = [integer, pointer]
    library.sph_shim_kernel_wf.argtypes = [integer, integer, ctypes.c_int32, pointer, real, pointer, pointer]
    library.sph_shim_cloud_checked.argtypes = [integer, pointer]
    _library = library


def library() -> ctypes.CDLL:
    """The shim itself, for calls that this module has no function for: sph_shim_grid_build, ..."""
    if not _library:
        folder = os.path.dirname(os.path.abspath(__file__))
        found = [
            name for name in sorted(os.listdir(folder)) if name.split(".")[0] in ("libsph_shim", "sph_shim")
        ]
        found = [name for name in found if name.endswith((".so", ".dylib", ".dll", ".pyd"))]
        if not found:
            raise Error("no library of the shim stands beside this module: pip install, or sph.load(path)")
        load(os.path.join(folder, found[0]))
    return _library


def _answer(value):
    if value < 0:
        particle = ctypes.c_int32()
        argument = library().sph_shim_refused(value, ctypes.byref(particle)).decode()
        where = f", first at particle {particle.value}" if particle.value >= 0 else ""
        raise Error((argument + ": " if argument else "") + status_text(value) + where)
    return value


# ---------------------------------------------------------------- arrays


def _new(kind, n):
    """a new array of n zeros: 'd', 'i' or 'B'"""
    if numpy:
        return numpy.zeros(n, dtype={"d": numpy.float64, "i": numpy.int32, "B": numpy.uint8}[kind])
    return array.array(kind, bytes(n * array.array(kind).itemsize))


def _address(a):
    """of the first number of an array"""
    if numpy and isinstance(a, numpy.ndarray):
        return a.ctypes.data if a.size else None
    if len(a) == 0:
        return None
    return ctypes.addressof(ctypes.c_char.from_buffer(a))


_KINDS = {"d": ("numbers", 8), "i": ("whole numbers that fit into 32 bits", 4)}


def _numpy_array(name, a, kind):
    """a as an array of one dimension, of float64 or int32, in place where that can be"""
    wanted = _KINDS[kind][0]
    if isinstance(a, numpy.ma.MaskedArray):
        raise TypeError(f"{name}: {wanted} are wanted, not a masked array: fill it, or leave particles out")
    try:
        given = numpy.asarray(a)
    except ValueError:
        raise ValueError(f"{name}: an array of {wanted} is wanted, not rows of different lengths") from None
    if given.dtype.kind not in ("fiu" if kind == "d" else "iu") and given.size:
        raise TypeError(
            f"{name}: an array of {wanted} is wanted, not one of {given.dtype} ({type(a).__name__})"
        )
    return given


def _cast(given, kind):
    """an array of numpy as one that the library can read: itself, or a copy"""
    dtype = numpy.dtype(numpy.float64 if kind == "d" else numpy.int32)
    strides = given.strides if given.size > 1 else (given.itemsize,) * given.ndim
    readable = given.dtype == dtype and given.dtype.isnative and given.flags.aligned
    if readable and all(s % dtype.itemsize == 0 and s >= 0 for s in strides):
        return given
    return numpy.ascontiguousarray(given, dtype=dtype)


def _plain_array(name, a, kind):
    """without numpy: (a as array or memoryview of kind, its stride)"""
    wanted = _KINDS[kind][0]
    try:
        view = memoryview(a)
    except TypeError:
        view = None
    if view is not None and view.ndim != 1:
        raise ValueError(f"{name}: one dimension is wanted, not {view.ndim}")
    if view is not None and view.format not in (("d",) if kind == "d" else ("i", "l")) or view is None:
        if view is not None and view.format not in ("bBhHiIlLqQfd" if kind == "d" else "bBhHiIlLqQ"):
            raise TypeError(
                f"{name}: an array of {wanted} is wanted, not one of '{view.format}' ({type(a).__name__})"
            )
        try:
            return array.array(kind, view.tolist() if view is not None else a), 1
        except (TypeError, OverflowError):
            raise TypeError(f"{name}: a list of {wanted} is wanted; one of them is something else") from None
    if view.itemsize != _KINDS[kind][1]:
        return array.array(kind, view.tolist()), 1
    stride, rest = divmod(view.strides[0], view.itemsize)
    if view.readonly or rest or stride < 1:
        return array.array(kind, view.tolist()), 1
    return a, stride


def _is_number(a):
    return isinstance(a, numbers.Real) or (numpy is not None and getattr(a, "ndim", None) == 0)


def _real(name, a):
    try:
        if isinstance(a, (str, bytes)):
            raise TypeError
        return float(a)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: a number is wanted, not {type(a).__name__}") from None


def _whole(name, a):
    try:
        return a.__index__()
    except (AttributeError, TypeError):
        raise TypeError(f"{name}: a whole number is wanted, not {type(a).__name__}") from None


def _look(name, a, n, kind="d"):
    """(address, stride, what must stay alive) of n numbers; None: none; a single number: the stride 0"""
    if a is None:
        return None, 0, None
    if kind == "d" and _is_number(a):
        one = ctypes.c_double(_real(name, a))
        return ctypes.addressof(one), 0, one
    if numpy:
        given = _numpy_array(name, a, kind)
        if given.ndim != 1:
            raise ValueError(
                f"{name}: one dimension is wanted, not {given.ndim}: {n} numbers, not the shape "
                f"{given.shape}; a column a[:, 0] will do"
            )
        if kind == "i" and given.size and (given.max() > 2**31 - 1 or given.min() < -(2**31)):
            raise ValueError(f"{name}: {_KINDS[kind][0]} are wanted; one of them does not")
    elif isinstance(a, (str, bytes)) or not hasattr(a, "__len__"):
        raise TypeError(f"{name}: an array or a list of {_KINDS[kind][0]} is wanted, not {type(a).__name__}")
    if len(a) != n:
        raise ValueError(f"{name}: {n} numbers are wanted, not {len(a)}")
    if numpy:
        ready = _cast(given, kind)
        stride = ready.strides[0] // ready.itemsize if n > 1 else 1
        if kind == "i" and stride != 1:
            ready, stride = numpy.ascontiguousarray(ready), 1
        return _address(ready), stride, ready
    ready, stride = _plain_array(name, a, kind)
    if kind == "i" and stride != 1:
        ready, stride = array.array(kind, memoryview(ready).tolist()), 1
    return _address(ready), stride, ready


def _components(name, a, n=None, writable=False):
    """a vector for each particle as (n, dim) arrays of one component: an array of shape (n, dim), a sequence
    of 1 to 3 arrays, or one array for one dimension"""
    if numpy and isinstance(a, numpy.ndarray):
        if a.ndim == 1 and a.dtype.kind != "O":
            return [a]
        if a.ndim != 2 or not 1 <= a.shape[1] <= 3:
            raise ValueError(
                f"{name}: an array of shape (n, dim) with dim = 1, 2 or 3 is wanted, not {a.shape}; "
                "give separate components as a list: [x, y]"
            )
        a = a if writable else _numpy_array(name, a, "d")
        return [a[:, axis] for axis in range(a.shape[1])]
    if not hasattr(a, "__len__") or isinstance(a, (str, bytes)):
        raise TypeError(
            f"{name}: an array of shape (n, dim) or a list of 1 to 3 arrays is wanted, not {type(a).__name__}"
        )
    if len(a) > 0 and all(_is_number(value) for value in a):
        return [a]
    if isinstance(a, array.array) or isinstance(a, memoryview):
        return [a]
    if not 1 <= len(a) <= 3:
        raise ValueError(
            f"{name}: a list of 1 to 3 arrays, one for each component, is wanted, not of {len(a)}; "
            "points [[x, y], ...] need an array of numpy"
        )
    return list(a)


def _look_together(name, parts, n):
    """addresses, common stride and what must stay alive of the components of positions"""
    looked = [_look(part_name, part, n) for part_name, part in zip(_names(name, len(parts)), parts)]
    if any(stride != looked[0][1] for _, stride, _ in looked):  # one stride is all there is: copy
        looked = [_look(name, _packed(alive), n) for _, _, alive in looked]
    return [p for p, _, _ in looked], looked[0][1], [alive for _, _, alive in looked]


def _packed(a):
    return numpy.array(a, dtype=numpy.float64) if numpy else array.array("d", memoryview(a).tolist())


def _names(name, dim):
    return list(_COORDINATES[:dim]) if name == "positions" else [name] * dim


def _writable(name, parts, n):
    """the same for vectors that are changed in place"""
    looked = []
    for part in parts:
        try:
            view = memoryview(part)
        except (TypeError, ValueError):
            raise TypeError(
                f"{name}: is changed in place: an array of float64 is wanted, not {type(part).__name__}"
            ) from None
        if view.format != "d" or view.ndim != 1:
            raise TypeError(
                f"{name}: is changed in place: an array of float64 is wanted, not of '{view.format}'"
            )
        if view.readonly:
            raise ValueError(f"{name}: is changed in place, and the array is read-only")
        if view.shape[0] != n:
            raise ValueError(f"{name}: is changed in place: {n} numbers are wanted, not {view.shape[0]}")
        stride, rest = divmod(view.strides[0], 8)
        if n > 1 and (rest or stride < 1):
            raise ValueError(f"{name}: is changed in place: elements {view.strides[0]} bytes apart cannot be")
        looked.append((_address(part), stride if n > 1 else 1))
    if any(stride != looked[0][1] for _, stride in looked):
        raise ValueError(f"{name}: is changed in place: all components must have the same stride")
    return [p for p, _ in looked], looked[0][1]


def _points(name, positions, box=()):
    """an sph_points of the positions, its dimension, and what must stay alive"""
    parts = _components(name, positions)
    n = len(parts[0])
    addresses, stride, alive = _look_together(name, parts, n)
    points = c.sph_points(stride=stride or 1, n=n)
    for axis, address in enumerate(addresses):
        setattr(points, _COORDINATES[axis], address)
    for axis, length in enumerate(box):
        setattr(points.box, _COORDINATES[axis], length)
    return points, len(parts), alive


# ---------------------------------------------------------------- functions


def status_text(status: int) -> str:
    """an entry of cloud.status, or an error, in words"""
    return library().sph_shim_status_text(int(status)).decode()


def finding_text(finding: int) -> str:
    """a finding of Cloud.examine in words, and what to do"""
    return library().sph_shim_finding_text(int(finding)).decode()


def kernel_from_name(name: str) -> int:
    """the number of a kernel; it also knows the usual aliases: m4, cubic, w2, lucy, ..."""
    number = library().sph_shim_kernel_from_name(str(name).encode())
    if number < 0:
        raise ValueError(f"no kernel is called '{name}'; there are: {', '.join(kernel_names())}")
    return number


def kernel_name(kernel: Union[str, int]) -> str:
    """the name of a kernel"""
    return library().sph_shim_kernel_name(_kernel(kernel)).decode()


def kernel_names() -> Sequence[str]:
    """the names of all kernels"""
    return [library().sph_shim_kernel_name(k).decode() for k in range(c.KERNEL_COUNT)]


def _kernel(kernel):
    if isinstance(kernel, str):
        return kernel_from_name(kernel)
    number = _whole("kernel", kernel)
    if not 0 <= number < c.KERNEL_COUNT:
        raise ValueError(f"kernel: a name or a number from 0 to {c.KERNEL_COUNT - 1} is wanted, not {number}")
    return number


def _number(name, values):
    """calls a function of numbers"""
    _, arguments = c.FUNCTIONS[name]
    taken = []
    for (label, kind), value in zip(arguments, values):
        if label == "kernel":
            taken.append(_kernel(value))
        elif kind is ctypes.c_double:
            taken.append(_real(label, value))
        else:
            taken.append(_whole(label, value))
        if label == "dim" and taken[-1] not in (1, 2, 3):
            raise ValueError(f"dim: 1, 2 or 3 is wanted, not {value}")
    return getattr(library(), "sph_shim_" + name)(*taken)


def kernel_wf(kernel: Union[str, int], dim: int, r: Array, h: float) -> Tuple[Array, Array]:
    """W and F = (1/r) dW/dr of the distances r"""
    n = len(r)
    address, stride, alive = _look("r", r, n)
    if stride != 1:
        alive = _packed(alive)
        address = _address(alive)
    w, f = _new("d", n), _new("d", n)
    _answer(
        library().sph_shim_kernel_wf(
            _kernel(kernel), _whole("dim", dim), n, address, _real("h", h), _address(w), _address(f)
        )
    )
    return w, f


def permute(order: Indices, a: Array) -> Array:
    """sph_permute: result[slot] = a[order[slot]]; the order of Cloud.order puts particles that are near each
    other next to each other, and every sweep is faster"""
    n = len(order)
    by, _, keep = _look("order", order, n, "i")
    address, stride, alive = _look("a", a, n)
    out = _new("d", n)
    _answer(library().sph_shim_permute(n, by, address, stride or 1, _address(out)))
    return out


def permute_inverse(order: Indices) -> Array:
    """sph_permute_inverse: result[order[slot]] = slot"""
    n = len(order)
    by, _, keep = _look("order", order, n, "i")
    out = _new("i", n)
    _answer(library().sph_shim_permute_inverse(n, by, _address(out)))
    return out


def rebuild_due(now: Vectors, then: Vectors, skin: float, box: Sequence[float] = ()) -> bool:
    """sph_rebuild_due: a particle moved by more than skin / 2 since the lists were made"""
    first, dim, alive = _points("now", now, box)
    second, other, kept = _points("then", then, box)
    if dim != other:
        raise ValueError(f"then: {dim} components are wanted, as in now, not {other}")
    return bool(
        _answer(
            library().sph_shim_rebuild_due(
                dim, ctypes.byref(first), ctypes.byref(second), _real("skin", skin)
            )
        )
    )


# ---------------------------------------------------------------- clouds


def _owner(a):
    """who owns the memory of an array: its base, if it is a view"""
    while numpy and isinstance(a, numpy.ndarray) and a.base is not None:
        a = a.base
    return a.obj if isinstance(a, memoryview) else a


def _callers():
    """how far above the caller of this function the program's own line is"""
    level, frame = 1, sys._getframe(1)
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        level, frame = level + 1, frame.f_back
    return level


class _Kept:
    """What a cloud was given and looks at in each call. It notices when nobody else holds that any more, by
    the counts of references of CPython."""

    def __init__(self, name, value):
        self.name, self.value = name, value
        several = isinstance(value, (list, tuple)) and len(value) > 0 and not _is_number(value[0])
        self.parts = tuple(part for part in (value if several else (value,)) if hasattr(part, "__len__"))
        self.seen = [False] * len(self.parts)

    def others(self, at):
        """somebody else holds this part, what it is a view of, or the list it was given in"""
        owner, part = _owner(self.parts[at]), self.parts[at]
        several = self.parts and self.value is not part  # value holds the parts, too
        own = 2 + 1 + (sum(p is part for p in self.value) if several else 1) + (owner is part)
        views = 2 + sum(_owner(p) is owner for p in self.parts)
        return (
            sys.getrefcount(part) > own
            or (owner is not part and sys.getrefcount(owner) > views)
            or (several and sys.getrefcount(self.value) > 2)
        )

    def look(self, remember):
        """warns once if an array was held by others at an earlier sweep, and is not any more"""
        for at in range(len(self.parts)) if hasattr(sys, "getrefcount") else ():
            held, before = self.others(at), self.seen[at]
            self.seen[at] = held and (before or remember)
            if before and not held:
                warnings.warn(
                    f"{self.name}: nobody but this cloud holds an array that it was given. If a line like "
                    f"`a = a + ...` has made another one, hand it over: cloud.{self.name} = a"
                    + (", or cloud.find_lists(a)" if self.name == "positions" else ""),
                    StaleWarning,
                    stacklevel=_callers(),
                )


def _kept(name):
    def get(self):
        return self._given[name].value

    def put(self, value):
        self._put(name, value)

    return property(get, put, doc=f"{name}, as given; a new array is handed over by setting it")


class Cloud(Operators):
    """Particles: a kernel's name or number, positions (an array of shape (n, dim), or a list of one array for
    each dimension), smoothing lengths h and volumes (a number or an array of n; None where no operator needs
    them), and box: periodic lengths, 0 for an open axis. find_lists or use_lists says who is near whom."""

    positions: Any = _kept("positions")
    h: Any = _kept("h")
    volume: Any = _kept("volume")

    def __init__(
        self,
        kernel: Union[str, int],
        positions: Vectors,
        h: Scalars = None,
        volume: Scalars = None,
        box: Optional[Sequence[float]] = None,
    ) -> None:
        self._given = {}
        self.kernel = _kernel(kernel)
        self.dim = 0
        self.n = 0
        self._box = ()
        self._put("positions", positions)
        if box is not None:
            box = [_real("box", length) for length in box]
            if len(box) != self.dim:
                raise ValueError(f"box: {self.dim} lengths are wanted, not {len(box)}")
            self._box = tuple(box)
        self._put("h", h)
        self._put("volume", volume)
        self.first, self.last = 0, self.n
        self.start: Optional[Array] = None
        self.index: Optional[Array] = None
        self._lists: Any = None
        self._grid = c.sph_grid()
        self._checked = None
        self.status, self.not_ok = _new("B", self.n), 0

    def _put(self, name, value):
        if name == "positions":
            points, dim, _ = _points(name, value)
            if self.dim and (points.n, dim) != (self.n, self.dim):
                raise ValueError(
                    f"positions: {self.n} particles in {self.dim}D are wanted, as before, not {points.n} "
                    f"in {dim}D: make another cloud"
                )
            self.n, self.dim = points.n, dim
        else:
            _look(name, value, self.n)
        self._given[name] = _Kept(name, value)
        self._checked = None

    def _struct(self, need_lists=True):
        """an sph_cloud of what the cloud was given, as it is now; and what must stay alive"""
        for kept in self._given.values():
            kept.look(need_lists)
        if need_lists and self._lists is None:
            raise Error(
                "this cloud has no neighbour lists yet: find_lists() makes them, or use_lists(start, index)"
            )
        points, dim, alive = _points("positions", self.positions, self._box)
        if (points.n, dim) != (self.n, self.dim):
            raise ValueError(
                f"positions: {self.n} particles in {self.dim}D are wanted, as before, not {points.n} in "
                f"{dim}D"
            )
        cloud = c.sph_cloud(points=points, first=self.first, last=self.last)
        for name in ("h", "volume"):
            address, stride, keep = _look(name, getattr(self, name), self.n)
            setattr(cloud, name, c.sph_scalars(address, stride))
            alive.append(keep)
        if self._lists is not None:
            cloud.list = c.sph_list(self._lists[0], self._lists[1])
        if self._checked and self._checked[0] <= self.first and self.last <= self._checked[1]:
            cloud.checked, cloud.largest_h = 1, self._checked[2]
        return cloud, alive

    def range(self, first: int, last: int) -> None:
        """the targets of the sweeps to come: first ... last - 1"""
        self.first, self.last = _whole("first", first), _whole("last", last)

    def check(self) -> None:
        """sph_cloud_checked: scans positions, lists, h and volume once, and no more in each sweep until one
        of them is set anew. Who changes the numbers in an array that was checked calls it again."""
        self._checked = None
        cloud, alive = self._struct(need_lists=False)
        _answer(library().sph_shim_cloud_checked(self.dim, ctypes.byref(cloud)))
        self._checked = self.first, self.last, cloud.largest_h

    def use_lists(self, start: Indices, index: Indices) -> None:
        """the host's own: neighbours of i are index[start[i]] ... index[start[i + 1] - 1], without i, from
        0"""
        rows, _, keep = _look("start", start, self.n + 1, "i")
        entries, _, kept = _look("index", index, len(index), "i")
        if len(index) < keep[self.n]:
            raise ValueError(f"index: {keep[self.n]} entries are wanted, not {len(index)}")
        self.start, self.index = start, index
        self._lists, self._checked, self._grid = (rows, entries, keep, kept), None, c.sph_grid()

    def find_lists(
        self, positions: Vectors = None, radius: Scalars = None, criterion: int = c.GATHER
    ) -> None:
        """sph_search: finds the neighbours. positions: the ones of this step (None: the array that the cloud
        has). radius: the support radius unless one is given, more for lists that are kept for several steps.
        criterion: GATHER, or for pair-symmetric operators where h varies LARGER or MEAN (M-SPH)."""
        if positions is not None:
            self.positions = positions
        if radius is None:
            radius = self._support()
        cloud, alive = self._struct(need_lists=False)
        address, stride, keep = _look("radius", radius, self.n)
        found, pairs = c.sph_neighbors(), len(self.index) * 5 // 4 if self.index is not None else 0
        look_for = c.sph_scalars(address, stride)
        while True:
            size = library().sph_shim_search_size(self.dim, self.n, pairs)
            memory = numpy.empty(size, dtype=numpy.uint8) if numpy else bytearray(size)
            answer = library().sph_shim_search(
                self.dim,
                ctypes.byref(cloud.points),
                ctypes.byref(look_for),
                _whole("criterion", criterion),
                _address(memory),
                size,
                ctypes.byref(found),
            )
            if answer != c.ERROR_CAPACITY:
                break
            pairs = found.pairs
        _answer(answer)
        begin = _address(memory)
        self.start = _part(memory, found.list.start, begin, self.n + 1)
        self.index = _part(memory, found.list.index, begin, found.pairs)
        self._lists, self._checked, self._grid = (
            (found.list.start, found.list.index, memory),
            None,
            found.grid,
        )

    def _support(self):
        ratio = library().sph_shim_kernel_support_ratio(self.kernel)
        if self.h is None:
            raise Error("h: a cloud without h has no support: give a radius to find_lists")
        if _is_number(self.h):
            return float(self.h) * ratio
        if numpy:
            return numpy.asarray(self.h, dtype=numpy.float64) * ratio
        return array.array("d", (value * ratio for value in self.h))

    def order(self) -> Array:
        """sph_grid_permutation: the order of particles in space after find_lists, for permute"""
        if self._lists is None or not self._grid.n:
            raise Error("there is an order after find_lists only")
        address = library().sph_shim_grid_permutation(ctypes.byref(self._grid))
        memory = self._lists[2]
        order = _part(memory, address, _address(memory), self.n)
        return order.copy() if numpy else array.array("i", order.tolist())

    def examine(self, both_sides: bool = False, samples: int = 100) -> Sequence[str]:
        """sph_cloud_examine: the likely mistakes of a new cloud, in words; an empty list if none is found"""
        cloud, alive = self._struct()
        found = c.sph_findings()
        _answer(
            library().sph_shim_cloud_examine(
                self.kernel,
                self.dim,
                ctypes.byref(cloud),
                int(both_sides),
                _whole("samples", samples),
                ctypes.byref(found),
            )
        )
        texts = []
        for finding in range(c.FINDING_COUNT):
            if found.set >> finding & 1:
                at = found.at[finding]
                texts.append(f"{finding_text(finding)} (particle {at.particle}, neighbour {at.neighbour})")
        return texts

    def csr_size(self) -> int:
        """sph_csr_size: entries of the matrix of the targets, at most"""
        cloud, alive = self._struct()
        return _answer(library().sph_shim_csr_size(ctypes.byref(cloud)))

    def csr_assemble(
        self, row: Array, diagonal: Scalars, drop_zeros: bool = False
    ) -> Tuple[Array, Array, Array]:
        """sph_csr_assemble: start, column and value of the matrix of the targets, as scipy.sparse.csr_matrix
        ((value, column, start)) takes it"""
        cloud, alive = self._struct()
        size = _answer(library().sph_shim_csr_size(ctypes.byref(cloud)))
        start, column, value = _new("i", self.last - self.first + 1), _new("i", size), _new("d", size)
        out = c.sph_csr(_address(start), _address(column), _address(value), size)
        entries = ctypes.c_int64()
        weights, _, keep = self._row(row)
        at, stride, kept = _look("diagonal", diagonal, self.n)
        scalars = c.sph_scalars(at, stride)
        _answer(
            library().sph_shim_csr_assemble(
                ctypes.byref(cloud),
                weights,
                ctypes.byref(scalars),
                int(drop_zeros),
                ctypes.byref(out),
                ctypes.byref(entries),
            )
        )
        return start, column[: entries.value], value[: entries.value]

    def _row(self, row):
        looked = _look("row", row, len(self.index))
        if looked[1] == 1:
            return looked
        if looked[1] == 0:
            raise ValueError(
                f"row: an array of {len(self.index)} numbers is wanted, one for each entry of the lists"
            )
        return _look("row", _packed(looked[2]), len(self.index))

    # ------------------------------------------------------------ every sweep

    def _call(self, name, values):
        """calls a sweep: builds its structs from values, by the names of their members"""
        dims = _ONLY_DIMS.get(name)
        if dims and self.dim not in dims:
            raise ValueError(
                f"{name} is for {' and '.join(f'{dim}D' for dim in dims)}, and this cloud has {self.dim}D"
            )
        arguments = c.FUNCTIONS[name][1]
        call = _Call(self, name, values)
        taken = [call.argument(label, kind) for label, kind in arguments]
        status = call.status
        result = _answer(getattr(library(), "sph_shim_" + name)(*taken))
        self.not_ok = result
        if status is not None:
            self.status = status
        return call.result(result)

    # ------------------------------------------------------------ by shorter names

    def density(self, m: Scalars) -> Array:
        """density_summation"""
        return self.density_summation(m)

    def gradient(self, f: Scalars) -> Array:
        """the corrected gradient, gradient_cspm, alone: of shape (n, dim), or a list, as the positions are"""
        return self.gradient_cspm(f).gradient


def _part(memory, address, begin, n):
    """n numbers of type int32 in the memory, from an address on"""
    if not n or not address:
        return _new("i", n)
    offset = address - begin
    if numpy:
        return memory[offset : offset + 4 * n].view(numpy.int32)
    return memoryview(memory)[offset : offset + 4 * n].cast("i")


# members of results that belong to a dimension
_FROM_DIM = {"gy": 2, "hxy": 2, "hyy": 2, "gz": 3, "hxz": 3, "hyz": 3, "hzz": 3}
_OUTPUTS = "_out", "_report"
_ONLY_DIMS = {
    "second_derivative_bim": (1,),
    "second_derivative_rows_bim": (1,),
    "hexatic_order": (2, 3),
    "gravity_direct": (3,),
    "gravity_zeta": (3,),
    "gravity_correction": (3,),
}


# members of outputs that have a number for each entry of the lists
_PER_ENTRY = {
    c.sph_rows_out: ("row",),
    c.sph_gradient_rows_out: ("x", "y", "z"),
    c.sph_interpolation_rows_out: ("value", "x", "y", "z"),
}


class _Call:
    """the arguments of one call of a sweep, and its results"""

    def __init__(self, cloud, name, values):
        self.cloud, self.name, self.values, self.alive = cloud, name, values, []
        self.status, self.results, self.alone = None, {}, None

    def argument(self, label, kind):
        if label == "kernel":
            return self.cloud.kernel
        if label == "dim":
            return self.cloud.dim
        if isinstance(kind, tuple):
            return self.memory(label, *kind)
        if not issubclass(kind, ctypes.Structure):
            return self.simple(label, kind)
        struct = self.struct(label, kind)
        self.alive.append(struct)
        return ctypes.byref(struct)

    def simple(self, label, kind):
        value = self.values[label]
        return _real(label, value) if kind is ctypes.c_double else _whole(label, value)

    def memory(self, label, kind, const):
        """an array, or the address of a number"""
        cloud = self.cloud
        if const:
            if label == "row":
                address, _, keep = cloud._row(self.values[label])
            else:
                address, _, keep = _look(
                    label, self.values[label], cloud.n, "i" if kind is ctypes.c_int32 else "d"
                )
            self.alive.append(keep)
            return address
        size = self.values["bins"] if label == "g" else 1 if label in ("re", "im") else cloud.n
        out = _new({ctypes.c_double: "d", ctypes.c_int32: "i", ctypes.c_ubyte: "B"}[kind], size)
        self.results[label] = out
        return _address(out)

    def struct(self, label, kind):
        cloud, name = self.cloud, kind.__name__
        if name == "sph_cloud":
            struct, alive = cloud._struct()
            self.alive.append(alive)
            return struct
        if name == "sph_points" and self.values[label] is None:
            return kind()  # not read
        if name == "sph_points":
            struct, dim, alive = _points(label, self.values[label])
            if dim != cloud.dim:
                raise ValueError(f"{label}: {cloud.dim} components are wanted, not {dim}")
            self.alive.append(alive)
            return struct
        if name == "sph_scalars":
            return self.scalars(label, self.values[label])
        if name in ("sph_vectors", "sph_diagonal"):
            return self.vectors(label, kind)
        if name == "sph_matrices":
            return self.matrices(label)
        if name == "sph_matrix_out":
            return self.matrix_out(label)
        if name in ("sph_vec", "sph_sym"):
            return self.tensor(label, kind)
        if name == "sph_vector_out" and label in self.values:
            parts = _components(label, self.values[label], writable=True)
            if len(parts) != cloud.dim:
                raise ValueError(f"{label}: {cloud.dim} components are wanted, not {len(parts)}")
            addresses, stride = _writable(label, parts, cloud.n)
            self.alive.append(parts)
            return kind(*(addresses + [None] * (3 - cloud.dim)), stride)
        if name == "sph_vector_out":
            return self.vector_out(label)
        if name in ("sph_collision_report", "sph_conserved"):
            self.results[label] = kind()
            return self.results[label]
        if name.endswith(_OUTPUTS):
            return self.out(label, kind)
        struct = kind()
        for field, of in kind._fields_:
            own = f"{label}_{field}"  # where another struct has a member of this name
            get = self.struct if issubclass(of, ctypes.Structure) else self.simple
            setattr(struct, field, get(own if own in self.values else field, of))
        if name == "sph_sources" and struct.points.n != cloud.n:
            raise ValueError(f"points: {cloud.n} sources are wanted, as many as targets, not {struct.points.n}")
        return struct

    def scalars(self, label, value):
        address, stride, keep = _look(label, value, self.cloud.n)
        self.alive.append(keep)
        return c.sph_scalars(address, stride)

    def vectors(self, label, kind):
        value, struct = self.values[label], kind()
        if value is None:
            return struct
        if _is_number(value) and kind is c.sph_diagonal:
            parts = [value] * self.cloud.dim
        else:
            parts = _components(label, value)
            if len(parts) < self.cloud.dim:
                raise ValueError(f"{label}: {self.cloud.dim} components are wanted, not {len(parts)}")
        for axis, part in enumerate(parts):
            setattr(struct, _COORDINATES[axis], self.scalars(label, part))
        return struct

    def matrices(self, label):
        """the rows of a matrix for each particle"""
        value, struct, dim = self.values[label], c.sph_matrices(), self.cloud.dim
        if value is None:
            return struct
        whole = numpy and isinstance(value, numpy.ndarray) and value.ndim == 3
        if (value.shape[1:] if whole else (len(value), len(value[0]))) != (dim, dim):
            raise ValueError(f"{label}: matrices of {dim} x {dim} are wanted")
        for row in range(dim):
            vectors = c.sph_vectors()
            for column in range(dim):
                part = value[:, row, column] if whole else value[row][column]
                setattr(vectors, _COORDINATES[column], self.scalars(label, part))
            setattr(struct, _COORDINATES[row], vectors)
        return struct

    def matrix_out(self, label):
        """a new matrix for each particle: of shape (n, dim, dim), or one list of arrays for each row"""
        dim, n, struct = self.cloud.dim, self.cloud.n, c.sph_matrix_out()
        if numpy:
            out = numpy.zeros((n, dim, dim))
            first, stride = _address(out), dim * dim
            at = range(dim) if first else ()
            rows = [[first + 8 * (dim * row + column) for column in at] for row in at]
        else:
            out, stride = [[_new("d", n) for _ in range(dim)] for _ in range(dim)], 1
            rows = [[_address(part) for part in row] for row in out]
        for axis, row in enumerate(rows):
            setattr(struct, _COORDINATES[axis], c.sph_vector_out(*(row + [None] * (3 - dim)), stride))
        self.results[label] = out
        return struct

    def tensor(self, label, kind):
        value = self.values[label]
        names = [field for field, _ in kind._fields_]
        if kind is c.sph_vec:
            names = names[: max(self.cloud.dim, min(len(value), 3))]
        else:
            names = names[: (1, 3, 6)[self.cloud.dim - 1]]
        if len(value) not in (0, len(names)):
            raise ValueError(
                f"{label}: {len(names)} numbers are wanted ({', '.join(names)}), not {len(value)}"
            )
        return kind(**{name: _real(label, number) for name, number in zip(names, value)})

    def vector_out(self, label):
        """a new vector for each particle, in the form that the positions have"""
        dim = self.cloud.dim
        if self.name == "curl_difference":
            dim = 3
        elif self.name == "mhd_rates" and self.values["v"] is not None:
            dim = len(_components("v", self.values["v"]))
        parts, vectors, stride = _new_vectors(self.cloud, dim)
        self.results[label] = vectors
        return c.sph_vector_out(*parts, stride)

    def out(self, label, kind):
        cloud, struct = self.cloud, kind()
        parts = None
        if kind is c.sph_derivatives_out:
            parts, gradient, stride = _new_vectors(cloud, cloud.dim, separate=True)
            self.results["gradient"] = gradient
        for field, of in kind._fields_:
            if field == "status":
                self.status = _new("B", cloud.n)
                struct.status = _address(self.status)
            elif field == "stride":
                struct.stride = 0
            elif of is c.sph_vector_out:
                setattr(struct, field, self.vector_out(field))
            elif of is c.sph_matrix_out:
                setattr(struct, field, self.matrix_out(field))
            else:
                self.member(kind, struct, field, parts)
        if kind is c.sph_scalar_out:
            self.results[label] = self.results.pop("p")
        return struct

    def member(self, kind, struct, field, parts):
        cloud = self.cloud
        alone = self.name in ("gradient_cspm", "gradient_iad")  # a gradient without a Hessian
        if cloud.dim < _FROM_DIM.get(field, 1) or (alone and field[0] in "hl"):
            return
        if (
            kind in (c.sph_gradient_rows_out, c.sph_interpolation_rows_out)
            and field in _COORDINATES
            and _COORDINATES.index(field) >= cloud.dim
        ):
            return
        if kind is c.sph_density_out and field == "h":
            out = _new("d", cloud.n)
            given = self.values["h"]
            for i in range(cloud.n):
                out[i] = given if _is_number(given) else given[i]
        elif parts and field in ("gx", "gy", "gz"):
            setattr(struct, field, parts[("gx", "gy", "gz").index(field)])
            return
        else:
            per_entry = field in _PER_ENTRY.get(kind, ())
            out = _new("d", len(cloud.index) if per_entry else cloud.n)
        self.results[field] = out
        setattr(struct, field, _address(out))

    def result(self, answer):
        """the one result, or all of them as members of one object; without any, the answer of the sweep"""
        if "re" in self.results:
            return complex(self.results["re"][0], self.results["im"][0])
        if not self.results:
            return answer
        if len(self.results) == 1:
            return next(iter(self.results.values()))
        return types.SimpleNamespace(**self.results)


def _new_vectors(cloud, dim, separate=False):
    """addresses of three components, the new array or list of arrays, and the stride"""
    whole = numpy and isinstance(cloud.positions, numpy.ndarray) and cloud.positions.ndim == 2
    if whole and not separate:
        out = numpy.zeros((cloud.n, dim))
        first = _address(out)
        return [first + 8 * axis if first and axis < dim else None for axis in range(3)], out, dim
    if whole:  # the other results of this struct are contiguous, too
        out = numpy.zeros((dim, cloud.n))
        return [_address(out[axis]) if axis < dim else None for axis in range(3)], out.T, 1
    out = [_new("d", cloud.n) for _ in range(dim)]
    return [_address(a) for a in out] + [None] * (3 - dim), out, 1

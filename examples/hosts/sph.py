# SPDX-License-Identifier: MIT
"""sph.py - the operators of sph.h on Python's arrays, through the shim (sph_shim.h). Needs nothing but the
standard library; numpy's arrays if numpy is there.

    cc -O2 -shared -fPIC -I. examples/hosts/sph_shim.c -o libsph_shim.so -lm     (from the repository's root)

    import sph
    sph.load("./libsph_shim.so")
    cloud = sph.Cloud("wendland-c2", [x, y], h=h, V=V)
    cloud.find_lists()
    gx, gy = cloud.gradient(f)

Inputs are numbers (one value for all) or one-dimensional arrays of float64 - numpy arrays, columns and slices
of them, fields of structured arrays, array.array('d') - which are read where they are, never copied; lists
are int32. Another type, layout or length is a TypeError or ValueError that says which argument is wrong.
Arrays may be empty. Outputs are new arrays.
What is computed, and what it is exact for: sph_ops.h, under the C names in the docstrings. A sweep that is
refused raises sph.Error, which names the argument and the first particle at fault; cloud.not_ok is the number
of targets that are not ok after the last sweep, and cloud.status says why (enum sph_status), in words:
status_text(status)."""

import array
import ctypes

try:
    import numpy
except ImportError:
    numpy = None

GATHER, SCATTER, LARGER, MEAN = range(4)  # sph_criterion
_lib = None


class Error(RuntimeError):
    pass


def load(path):
    """Opens the shared library, which must have been compiled in double precision with 32-bit indices."""
    global _lib
    lib = ctypes.CDLL(path)
    if (lib.sph_shim_real_size(), lib.sph_shim_index_size()) != (8, 4):
        raise Error(f"{path} was not compiled with double and int32_t")
    p, size, real, integer = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_double, ctypes.c_int32
    for name, arguments in {
        "refused": [integer, p],
        "kernel_wf": [integer, integer, integer, p, real, p, p],
        "cloud_init": [p, integer, integer, integer, p, p, p, size],
        "cloud_volumes": [p, p, size, p, size],
        "cloud_lists": [p, p, p],
        "cloud_periodic": [p, real, real, real],
        "cloud_range": [p, integer, integer],
        "cloud_check": [p],
        "grid_lists": [p, integer, p, size, p, size, p, p, size, p],
        "density_summation": [p, p, size, p],
        "gradient_cspm": [p, p, size, p, p, p, p],
        "laplacian_brookshaw": [p, p, size, p],
        "derivatives_icspm": [p, p, size, real, integer, p, p],
        "elliptic_rows_msph": [p, p, size, integer, p, p, p],
        "rows_apply": [p, p, p, p, size, p],
        "collision_sequential": [p, real, p, size, real, p, p, p, size],
    }.items():  # without argument types ctypes would cut addresses to 32 bits
        getattr(lib, "sph_shim_" + name).argtypes = arguments
    lib.sph_shim_status_text.restype = lib.sph_shim_refused.restype = ctypes.c_char_p
    lib.sph_shim_kernel_support.restype = real
    lib.sph_shim_cloud_size.restype = size
    lib.sph_shim_grid_workspace.restype = size
    lib.sph_shim_grid_workspace.argtypes = [integer, integer]
    _lib = lib


def _new(kind, n):
    """a new array of n zeros: 'd', 'i' or 'B'"""
    if numpy:
        return numpy.zeros(n, dtype={"d": numpy.float64, "i": numpy.int32, "B": numpy.uint8}[kind])
    return array.array(kind, bytes(n * array.array(kind).itemsize))


def _address(a):
    if len(a) == 0:
        return None
    interface = getattr(a, "__array_interface__", None)
    return interface["data"][0] if interface else ctypes.addressof(ctypes.c_char.from_buffer(a))


def _look(name, a, n, kind="d", writable=False):
    """(address, stride, what must stay alive) of n numbers, in place; a single number has the stride 0"""
    if isinstance(a, (int, float)) and kind == "d" and not writable:
        one = ctypes.c_double(a)
        return ctypes.addressof(one), 0, one
    try:
        view = memoryview(a)
    except TypeError:
        raise TypeError(f"{name}: an array is wanted, not {type(a).__name__}") from None
    if view.format not in {"d": "d", "i": "il"}[kind] or view.itemsize != {"d": 8, "i": 4}[kind]:
        wanted = {"d": "float64", "i": "int32"}[kind]
        raise TypeError(f"{name}: an array of {wanted} is wanted, not one of '{view.format}'")
    if view.ndim != 1:
        raise ValueError(f"{name}: one dimension is wanted, not {view.ndim}; a column a[:, 0] will do")
    if view.shape[0] != n:
        raise ValueError(f"{name}: {n} numbers are wanted, not {view.shape[0]}")
    stride, rest = divmod(view.strides[0], view.itemsize)
    if rest or stride < 1 or (kind == "i" and stride != 1):
        apart = f"elements that are {view.strides[0]} bytes apart"
        raise ValueError(f"{name}: {apart} cannot be read in place: copy the array")
    if writable and view.readonly:
        raise ValueError(f"{name}: is read-only")
    return _address(a), stride, a


def _kernel(kernel):
    number = _lib.sph_shim_kernel_from_name(kernel.encode())
    if number < 0:
        raise ValueError(f"no kernel is called '{kernel}'")
    return number


def _answer(value):
    if value < 0:
        particle = ctypes.c_int32()
        argument = _lib.sph_shim_refused(value, ctypes.byref(particle)).decode()
        where = f", first at particle {particle.value}" if particle.value >= 0 else ""
        raise Error((argument + ": " if argument else "") + status_text(value) + where)
    return value


def status_text(status):
    """an entry of cloud.status in words"""
    return _lib.sph_shim_status_text(int(status)).decode()


def kernel_support(kernel):
    """support radius / h"""
    return _lib.sph_shim_kernel_support(_kernel(kernel))


def kernel_wf(kernel, dim, r, h):
    """W and F = (1/r) dW/dr of the distances r (contiguous)"""
    address, stride, _ = _look("r", r, len(r))
    if stride != 1:
        raise ValueError("r: must be a contiguous array")
    w, f = _new("d", len(r)), _new("d", len(r))
    _answer(_lib.sph_shim_kernel_wf(_kernel(kernel), dim, len(r), address, h, _address(w), _address(f)))
    return w, f


class Cloud:
    """Particles: a kernel's name, one array of positions for each dimension, smoothing length and volumes;
    box: periodic lengths, 0 for an open axis."""

    def __init__(self, kernel, positions, h, V, box=None):
        self.dim, self.n, self.kernel = len(positions), len(positions[0]), kernel
        self._keep = {}
        self._c = (ctypes.c_int64 * ((_lib.sph_shim_cloud_size() + 7) // 8))()
        x = [self._look("xyz"[a], positions[a]) for a in range(self.dim)]
        if any(stride != x[0][1] for _, stride in x):
            raise ValueError("positions: all must have the same stride")
        address = [p for p, _ in x] + [None] * (3 - self.dim)
        _answer(_lib.sph_shim_cloud_init(self._c, _kernel(kernel), self.dim, self.n, *address, x[0][1]))
        _lib.sph_shim_cloud_volumes(self._c, *self._look("h", h), *self._look("V", V))
        self.h = h
        if box:
            _lib.sph_shim_cloud_periodic(self._c, *(list(box) + [0.0] * (3 - self.dim)))
        self.start = self.index = None
        self.status, self.not_ok = _new("B", self.n), 0

    def _look(self, name, a, kind="d", n=None):
        address, stride, alive = _look(name, a, self.n if n is None else n, kind)
        self._keep[name] = alive
        return address, stride

    def range(self, first, last):
        """the targets of the sweeps to come"""
        _lib.sph_shim_cloud_range(self._c, first, last)

    def check(self):
        """scans positions, lists, h and V once, and no more in each sweep until one of them is set anew"""
        _answer(_lib.sph_shim_cloud_check(self._c))

    def use_lists(self, start, index):
        """the host's own: neighbours of i are index[start[i]] ... index[start[i + 1] - 1], without i"""
        rows = self._look("start", start, "i", self.n + 1)
        entries = self._look("index", index, "i", len(index))
        if len(index) < start[self.n]:
            raise ValueError(f"index: {start[self.n]} entries are wanted, not {len(index)}")
        _lib.sph_shim_cloud_lists(self._c, rows[0], entries[0])
        self.start, self.index = start, index

    def find_lists(self, radius=None, criterion=GATHER):
        """sph_grid_lists; the support radius unless one is given (the mean of both supports, which M-SPH
        needs where h varies: criterion=MEAN)"""
        if radius is None and isinstance(self.h, (int, float)):
            radius = self.h * kernel_support(self.kernel)
        elif radius is None and numpy:
            radius = numpy.asarray(self.h) * kernel_support(self.kernel)
        elif radius is None:
            radius = _new("d", self.n)
            for i in range(self.n):
                radius[i] = self.h[i] * kernel_support(self.kernel)
        work = ctypes.create_string_buffer(_lib.sph_shim_grid_workspace(self.dim, self.n))
        R, start, pairs = self._look("radius", radius), _new("i", self.n + 1), ctypes.c_int64()

        def fill(index, room):
            memory = work, len(work), _address(start), index, room, ctypes.byref(pairs)
            _answer(_lib.sph_shim_grid_lists(self._c, criterion, *R, *memory))

        fill(None, 0)  # counts
        index = _new("i", pairs.value)
        if pairs.value:
            fill(_address(index), pairs.value)
        self.use_lists(start, index)

    def _sweep(self, name, *arguments):
        self.not_ok = _answer(getattr(_lib, "sph_shim_" + name)(self._c, *arguments))

    def density(self, m):
        """sph_density_summation"""
        rho = _new("d", self.n)
        self._sweep("density_summation", *self._look("m", m), _address(rho))
        return rho

    def gradient(self, f):
        """sph_gradient_cspm: one array for each dimension"""
        g = [_new("d", self.n) for _ in range(self.dim)]
        to = [_address(a) for a in g] + [None] * (3 - self.dim)
        self._sweep("gradient_cspm", *self._look("f", f), *to, _address(self.status))
        return g

    def laplacian_brookshaw(self, f):
        """sph_laplacian_brookshaw"""
        out = _new("d", self.n)
        self._sweep("laplacian_brookshaw", *self._look("f", f), _address(out))
        return out

    def derivatives(self, f, conditioning_min=0.0, fallback=True):
        """sph_derivatives_icspm: for each particle gx, xx; gx, gy, xx, xy, yy; or gx, gy, gz, xx, xy, yy, xz,
        yz, zz, one after the other"""
        out = _new("d", self.n * (0, 2, 5, 9)[self.dim])
        to = _address(out), _address(self.status)
        self._sweep("derivatives_icspm", *self._look("f", f), conditioning_min, fallback, *to)
        return out

    def rows_msph(self, m, trace=False):
        """sph_elliptic_rows_msph: row (as long as index) and diagonal;
        div(m grad u)_i = diagonal[i] u_i + sum_p row[p] u[index[p]]"""
        row, diagonal = _new("d", len(self.index)), _new("d", self.n)
        to = _address(row), _address(diagonal), _address(self.status)
        self._sweep("elliptic_rows_msph", *self._look("m", m), trace, *to)
        return row, diagonal

    def apply(self, row, diagonal, u):
        """sph_rows_apply"""
        out = _new("d", self.n)
        rows = self._look("row", row, n=len(self.index))[0], self._look("diagonal", diagonal)[0]
        self._sweep("rows_apply", *rows, *self._look("u", u), _address(out))
        return out

    def collide(self, distance, inverse_mass, restitution, velocity):
        """sph_collision_sequential: changes the velocities, one array for each dimension"""
        v = [_look("velocity", a, self.n, writable=True) for a in velocity]
        if any(stride != v[0][1] for _, stride, _ in v):
            raise ValueError("velocity: all must have the same stride")
        inverse, to = self._look("inverse_mass", inverse_mass), [p for p, _, _ in v] + [None] * (3 - self.dim)
        self._sweep("collision_sequential", distance, *inverse, restitution, *to, v[0][1])

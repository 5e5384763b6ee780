// SPDX-License-Identifier: MIT
//
// host.js - JavaScript on the shim as WebAssembly: arrays of the page live in the module's memory, where the
// operators read and write them.
//
//     emcc -O2 -I. examples/hosts/sph_shim.c -o sph_shim.js -sMODULARIZE=1 -sALLOW_MEMORY_GROWTH=1 \
//         -sEXPORTED_FUNCTIONS=_malloc,_free
//     node examples/hosts/host.js ./sph_shim.js       (from the repository's root: it reads tests/known)
//
// Every operator is called as in C: sph._sph_shim_<operator>(kernel, dim, cloud, ...), where structs are
// addresses of what struct() below has put into the memory, and 0 is a struct of zeros: the defaults, or
// nothing.
//
// A corrected gradient of a linear field and a row of the M-SPH Laplacian, both exact on a disordered cloud;
// a density by a sum of the host's own, and by the sweep; and the kernels against the known answers. Exit
// status 0 if all is right.

const fs = require('fs'), path = require('path');
const { structs, SPH_GATHER, SPH_ERROR_CAPACITY } = require('./sph_c.js');

let failures = 0;
function expect(what, value, exact, tolerance) {
    const right = Math.abs(value - exact) <= tolerance;
    const verdict = right ? '' : '  WRONG';
    console.log(`${what.padEnd(52)} ${value.toFixed(12).padStart(18)}  exact ${exact}${verdict}`);
    failures += !right;
}

// Bytes of the types in wasm32, which are also their alignments. An int64_t is written as a number, which is
// exact below 2^53.
const bytes = { pointer: 4, size_t: 4, int: 4, unsigned: 4, sph_index: 4, int64_t: 8, sph_real: 8 };
// where the fields of a struct are, as C lays them out: { at: { name: offset }, size, align }
function layout(name) {
    const at = {};
    let size = 0, align = 1;
    for (const [field, type, count] of structs[name]) {
        const inner = type in bytes ? { size: bytes[type], align: bytes[type] } : layout(type);
        size = Math.ceil(size / inner.align) * inner.align;
        at[field] = size;
        size += count * inner.size;
        align = Math.max(align, inner.align);
    }
    return { at, size: Math.ceil(size / align) * align, align };
}

function main(sph) {
    // Arrays in the module's memory. Its heap may move when it grows, and views of it die then: all memory
    // first, views after.
    const reals = n => sph._malloc(8 * n), integers = n => sph._malloc(4 * n);
    const real = (p, n) => sph.HEAPF64.subarray(p / 8, p / 8 + n);
    const integer = (p, n) => sph.HEAP32.subarray(p / 4, p / 4 + n);
    const text = p => {
        let s = '';
        for (; sph.HEAPU8[p]; p++) s += String.fromCharCode(sph.HEAPU8[p]);
        return s;
    };
    const name = s => {
        const p = sph._malloc(s.length + 1);
        for (let i = 0; i <= s.length; i++) sph.HEAPU8[p + i] = s.charCodeAt(i) || 0;
        return p;
    };
    const answer = value => {
        if (value >= 0) return value;
        const particle = integers(1), argument = text(sph._sph_shim_refused(value, particle));
        const what = text(sph._sph_shim_status_text(value));
        throw new Error(`${argument}: ${what}, particle ${integer(particle, 1)[0]}`);
    };
    // puts values, an object such as { p: address, stride: 1 }, into the struct at the address p; the value
    // of a field that is a struct is an object again, or the address of a struct that is copied
    const put = (p, type, values) => {
        const { at } = layout(type);
        for (const [field, kind] of structs[type]) {
            if (!(field in values)) continue;
            const to = p + at[field], value = values[field];
            if (kind === 'sph_real') sph.HEAPF64[to / 8] = value;
            else if (kind === 'int64_t') integer(to, 2).set([value | 0, Math.floor(value / 2 ** 32)]);
            else if (kind in bytes) sph.HEAP32[to / 4] = value;
            else if (typeof value === 'number') sph.HEAPU8.copyWithin(to, value, value + layout(kind).size);
            else put(to, kind, value);
        }
    };
    // a struct in the memory: zeros, and the values
    const struct = (type, values) => {
        const { size } = layout(type), p = sph._malloc(size);
        sph.HEAPU8.fill(0, p, p + size);
        put(p, type, values);
        return p;
    };
    // as an sph_scalars or an sph_scalar_out
    const array = p => ({ p, stride: 1 }), same = p => ({ p, stride: 0 });
    const agrees = type => sph._sph_shim_struct_size(name(type)) === layout(type).size;
    if (!Object.keys(structs).every(agrees)) throw new Error('the shim and sph_c.js are of other headers');

    const side = 21, n = side * side, middle = n >> 1, dx = 1 / side, mobility = 0.5;
    const kernel = sph._sph_shim_kernel_from_name(name('wendland-c2'));
    const x = reals(n), y = reals(n), f = reals(n), gx = reals(n), gy = reals(n), rho = reals(n);
    const Lu = reals(n), diagonal = reals(n), one = reals(4); // one: h, V, radius, mobility
    for (let i = 0; i < n; i++) {
        real(x, n)[i] = dx * (i % side + 0.5 + 0.2 * Math.sin(37 * i));
        real(y, n)[i] = dx * (Math.floor(i / side) + 0.5 + 0.2 * Math.cos(53 * i));
        real(f, n)[i] = 0.7 + 1.3 * real(x, n)[i] - 0.8 * real(y, n)[i];
    }
    const h = 1.3 * dx;
    real(one, 4).set([h, dx * dx, sph._sph_shim_kernel_support(kernel, h), mobility]);

    // the neighbours, in memory that grows until it is large enough
    const points = struct('sph_points', { n, x, y, stride: 1 }), found = struct('sph_neighbors', {});
    const radius = struct('sph_scalars', same(one + 16));
    let size = 1 << 16, memory, error;
    do {
        sph._free(memory);
        memory = sph._malloc(size *= 2);
        error = sph._sph_shim_search(2, points, radius, SPH_GATHER, memory, size, found);
    } while (error === SPH_ERROR_CAPACITY);
    answer(error);
    const list = found + layout('sph_neighbors').at.list, [start, index] = integer(list, 2);
    const cloud = struct('sph_cloud', { points, list, h: same(one), volume: same(one + 8), last: n });
    answer(sph._sph_shim_cloud_checked(2, cloud));

    const field = struct('sph_scalars', array(f)), gradient = struct('sph_derivatives_out', { gx, gy });
    failures += answer(sph._sph_shim_gradient_cspm(kernel, 2, cloud, field, gradient));
    expect('gradient at a corner, x', real(gx, n)[0], 1.3, 1e-12);
    expect('gradient at a corner, y', real(gy, n)[0], -0.8, 1e-12);
    expect('gradient in the middle, x', real(gx, n)[middle], 1.3, 1e-12);
    expect('gradient in the middle, y', real(gy, n)[middle], -0.8, 1e-12);

    // one row of div(m grad u): with trace exact for a linear u and for |x|^2
    const entries = integer(start, n + 1)[n], row = reals(entries);
    const m = struct('sph_scalars', same(one + 24)), options = struct('sph_elliptic_options', { trace: 1 });
    const rows = struct('sph_rows_out', { row, diagonal });
    sph._sph_shim_cloud_range(cloud, middle, middle + 1);
    failures += answer(sph._sph_shim_elliptic_rows_msph(kernel, 2, cloud, m, options, rows));
    failures += answer(sph._sph_shim_rows_apply(cloud, row, struct('sph_scalars', array(diagonal)), field,
        struct('sph_scalar_out', array(Lu))));
    const X = real(x, n), Y = real(y, n), [first, last] = integer(start + 4 * middle, 2);
    let square = 0, sum = real(diagonal, n)[middle], density = sph._sph_shim_kernel_w(kernel, 2, 0, h);
    for (let p = first; p < last; p++) {
        const j = integer(index, entries)[p], weight = real(row, entries)[p];
        square += weight * (X[j] ** 2 + Y[j] ** 2 - X[middle] ** 2 - Y[middle] ** 2);
        sum += weight;
        const r = Math.hypot(X[j] - X[middle], Y[j] - Y[middle]);
        density += sph._sph_shim_kernel_w(kernel, 2, r, h);
    }
    console.log(`M-SPH row of particle ${middle}: ${last - first} neighbours, ` +
        `diagonal ${real(diagonal, n)[middle].toFixed(6)}`);
    expect('M-SPH, sum of the row', sum, 0, 1e-9);
    expect('M-SPH, div(m grad u) of a linear u', real(Lu, n)[middle], 0, 1e-9);
    expect('M-SPH, div(m grad u) of u = x^2 + y^2', square, 4 * mobility, 1e-9);
    failures += answer(sph._sph_shim_density_summation(kernel, 2, cloud, struct('sph_scalars', same(one + 8)),
        struct('sph_scalar_out', array(rho))));
    expect('density over its sum', real(rho, n)[middle] / (dx * dx * density), 1, 1e-12);

    // W and F of every kernel; what is allowed is relative to the largest of its kernel, dimension and h
    const known = fs.readFileSync('tests/known/kernels.csv', 'utf8').split('\n')
        .filter(l => l && !l.startsWith('#') && !l.startsWith('kernel,')).map(l => l.split(','));
    const largest = new Map(), r = reals(1), w = reals(1), F = reals(1);
    const group = (row, column) => row.slice(0, 3).join() + ',' + column;
    for (const row of known)
        for (const column of [5, 7]) {
            const before = largest.get(group(row, column)) || 0;
            largest.set(group(row, column), Math.max(before, Math.abs(row[column])));
        }
    let off = 0;
    for (const row of known) {
        const k = name(row[0]);
        real(r, 1)[0] = +row[3];
        answer(sph._sph_shim_kernel_wf(sph._sph_shim_kernel_from_name(k), +row[1], 1, r, +row[2], w, F));
        sph._free(k);
        for (const [column, got] of [[5, real(w, 1)[0]], [7, real(F, 1)[0]]])
            off += !(Math.abs(got - row[column]) <= 8 * Number.EPSILON * largest.get(group(row, column)));
    }
    console.log(`known answers: ${known.length} rows, ${off} off`);
    failures += off > 0 || known.length === 0;
    process.exitCode = failures > 0 ? 1 : 0;
}

const shim = require(path.resolve(process.argv[2] || './sph_shim.js'));
shim().then(main).catch(error => { console.error(String(error)); process.exitCode = 1; });

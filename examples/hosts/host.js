// SPDX-License-Identifier: MIT
//
// host.js - JavaScript on the shim as WebAssembly: arrays of the page live in the module's memory, where the operators read and write them.
//
//     emcc -O2 -I. examples/hosts/sph_shim.c -o sph_shim.js -sMODULARIZE=1 -sALLOW_MEMORY_GROWTH=1 -sEXPORTED_FUNCTIONS=_malloc,_free
//     node examples/hosts/host.js ./sph_shim.js                                  (from the repository's root, where tests/known/kernels.csv is)
//
// A corrected gradient of a linear field and a row of the M-SPH Laplacian, both exact on a disordered cloud; and the kernels against the known answers. Exit status 0 if all is right.

const fs = require('fs'), path = require('path');

let failures = 0;
function expect(what, value, exact, tolerance) {
    const right = Math.abs(value - exact) <= tolerance;
    console.log(`${what.padEnd(52)} ${value.toFixed(12).padStart(18)}  exact ${exact}${right ? '' : '  WRONG'}`);
    failures += !right;
}

function main(sph) {
    // Arrays in the module's memory. Its heap may move when it grows, and views of it die then: all memory first, views after.
    const reals = n => sph._malloc(8 * n), integers = n => sph._malloc(4 * n);
    const real = (p, n) => sph.HEAPF64.subarray(p / 8, p / 8 + n), integer = (p, n) => sph.HEAP32.subarray(p / 4, p / 4 + n);
    const text = p => { let s = ''; for (; sph.HEAPU8[p]; p++) s += String.fromCharCode(sph.HEAPU8[p]); return s; };
    const name = s => { const p = sph._malloc(s.length + 1); for (let i = 0; i <= s.length; i++) sph.HEAPU8[p + i] = s.charCodeAt(i) || 0; return p; };
    const answer = value => { if (value < 0) throw new Error(text(sph._sph_shim_status_text(value))); return value; };

    const side = 21, n = side * side, middle = n >> 1, dx = 1 / side, mobility = 0.5;
    const kernel = sph._sph_shim_kernel_from_name(name('wendland-c2'));
    const x = reals(n), y = reals(n), f = reals(n), gx = reals(n), gy = reals(n), Lu = reals(n), diagonal = reals(n), one = reals(4); // one: h, V, radius, mobility
    const workSize = sph._sph_shim_grid_workspace(2, n), work = sph._malloc(workSize), cloud = sph._malloc(sph._sph_shim_cloud_size());
    const start = integers(n + 1), pairs = sph._malloc(8);
    for (let i = 0; i < n; i++) {
        real(x, n)[i] = dx * (i % side + 0.5 + 0.2 * Math.sin(37 * i));
        real(y, n)[i] = dx * (Math.floor(i / side) + 0.5 + 0.2 * Math.cos(53 * i));
        real(f, n)[i] = 0.7 + 1.3 * real(x, n)[i] - 0.8 * real(y, n)[i];
    }
    const h = 1.3 * dx;
    real(one, 4).set([h, dx * dx, h * sph._sph_shim_kernel_support(kernel), mobility]);

    answer(sph._sph_shim_cloud_init(cloud, kernel, 2, n, x, y, 0, 1));
    sph._sph_shim_cloud_volumes(cloud, one, 0, one + 8, 0);
    answer(sph._sph_shim_grid_lists(cloud, 0, one + 16, 0, work, workSize, start, 0, 0, pairs)); // counts
    const entries = integer(pairs, 1)[0], index = integers(entries), row = reals(entries);
    answer(sph._sph_shim_grid_lists(cloud, 0, one + 16, 0, work, workSize, start, index, entries, pairs));
    sph._sph_shim_cloud_lists(cloud, start, index);
    failures += answer(sph._sph_shim_gradient_cspm(cloud, f, 1, gx, gy, 0, 0));
    expect('gradient at a corner, x', real(gx, n)[0], 1.3, 1e-12);
    expect('gradient at a corner, y', real(gy, n)[0], -0.8, 1e-12);
    expect('gradient in the middle, x', real(gx, n)[middle], 1.3, 1e-12);
    expect('gradient in the middle, y', real(gy, n)[middle], -0.8, 1e-12);

    // one row of div(m grad u): with trace exact for a linear u and for |x|^2
    sph._sph_shim_cloud_range(cloud, middle, middle + 1);
    failures += answer(sph._sph_shim_elliptic_rows_msph(cloud, one + 24, 0, 1, row, diagonal, 0));
    failures += answer(sph._sph_shim_rows_apply(cloud, row, diagonal, f, 1, Lu));
    const X = real(x, n), Y = real(y, n), [first, last] = integer(start, n + 1).subarray(middle, middle + 2);
    let square = 0, sum = real(diagonal, n)[middle];
    for (let p = first; p < last; p++) {
        const j = integer(index, entries)[p], weight = real(row, entries)[p];
        square += weight * (X[j] ** 2 + Y[j] ** 2 - X[middle] ** 2 - Y[middle] ** 2);
        sum += weight;
    }
    console.log(`M-SPH row of particle ${middle}: ${last - first} neighbours, diagonal ${real(diagonal, n)[middle].toFixed(6)}`);
    expect('M-SPH, sum of the row', sum, 0, 1e-9);
    expect('M-SPH, div(m grad u) of a linear u', real(Lu, n)[middle], 0, 1e-9);
    expect('M-SPH, div(m grad u) of u = x^2 + y^2', square, 4 * mobility, 1e-9);

    // W and F of every kernel; what is allowed is relative to the largest of its kernel, dimension and h
    const known = fs.readFileSync('tests/known/kernels.csv', 'utf8').split('\n').filter(l => l && !l.startsWith('#') && !l.startsWith('kernel,')).map(l => l.split(','));
    const largest = new Map(), r = reals(1), w = reals(1), F = reals(1);
    const group = (row, column) => row.slice(0, 3).join() + ',' + column;
    for (const row of known)
        for (const column of [5, 7]) largest.set(group(row, column), Math.max(largest.get(group(row, column)) || 0, Math.abs(row[column])));
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

require(path.resolve(process.argv[2] || './sph_shim.js'))().then(main).catch(error => { console.error(String(error)); process.exitCode = 1; });

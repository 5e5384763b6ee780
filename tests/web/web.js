// SPDX-License-Identifier: MIT
//
// web.js - the laboratory in headless Chromium, and its module in node.
//
//     node tests/web/web.js NATIVE SCALAR.wasm SIMD.wasm SCALAR.html SIMD.html FOLDER [without-chromium]
//
// Each scene is 200 steps from its start, in the page and natively: the scalar module agrees bit for bit. That with
// vector instructions adds in another order: after 25 steps it agrees to 1e-12 of the largest number of each kind,
// before a flow makes more of such differences (1e-13 after 200 steps of a dam break, 3e-11 of Orszag-Tang). Prints 'web: N passed, N failed'.
'use strict';
const { Lab } = require('../../examples/web/lab.js'), { open } = require('./chromium.js');
const { execFileSync } = require('child_process'), fs = require('fs'), path = require('path'), zlib = require('zlib');
const [native, scalar, simd, scalarPage, simdPage, folder, without] = process.argv.slice(2);
let passed = 0, failed = 0;
function check(what, right, said = '') {
    if (right) passed++;
    else failed++, console.log(`failed: ${what} ${said}`);
}

// ---- states

// smaller than usual, to take less time; and other ways through a scene, with fewer steps
const small = { dam: { across: 16 }, vortex: { columns: 16 }, drop: { across: 24 }, plate: { across: 25 }, magnet: { across: 24 }, kernels: {}, cloud: {} };
const ways = {
    dam: [{ remedy: 0, kernel: 0 }, { remedy: 1 }, { remedy: 2 }, { remedy: 3, kernel: 9 }, { remedy: 5, right: 3, left: 0.5 }],
    vortex: [{ kernel: 1, alpha_B: 0.5 }],
    drop: [{ form: 1, shape: 1 }],
    plate: [0, 1, 2, 4].map(operator => ({ operator, jitter: 0.3 })),
    kernels: [{ show: 1, dim: 1 }, { show: 1, kernel: 9 }, { show: 1, dim: 3 }, { show: 2, dim: 3, kernel: 0 }],
    cloud: Array.from({ length: 12 }, (_, operator) => ({ operator, volumes: operator % 2, field: operator < 5 ? operator : 4, jitter: 0.2 })),
};
const STEPS = 200, FEW = 25;
function natively(scene, steps, set) {
    const out = execFileSync(native, [scene, String(steps), ...Object.entries(set).map(([k, v]) => `${k}=${v}`)], { maxBuffer: 1 << 28 });
    return new Float64Array(out.buffer.slice(out.byteOffset, out.byteOffset + out.length));
}
function run(lab, scene, steps, set) {
    lab.open(scene);
    for (const [name, value] of Object.entries(set)) lab.set(name, value);
    lab.step(steps);
    return lab.state;
}
const same = (a, b) => Buffer.compare(Buffer.from(a.buffer), Buffer.from(b.buffer)) === 0;
// the largest difference, of what belongs together: x and y, each field, each measure
function apart(lab, got, want) {
    const n = lab.particles, counts = [2 * n, ...lab.fields.map(() => n), ...lab.measures.map(() => 1),
        ...lab.curves.map(c => c.y.length), ...lab.columns.map(c => c.values.length)];
    let at = 0, worst = 0;
    for (const count of counts) {
        let most = 0, off = 0;
        for (let i = at; i < at + count; i++) {
            most = Math.max(most, Math.abs(want[i]));
            off = Math.max(off, Math.abs(got[i] - want[i]));
        }
        if (!(off <= worst * most)) worst = most > 0 ? off / most : Infinity;
        at += count;
    }
    return got.length === want.length ? worst : Infinity;
}

const labs = { scalar: new Lab(fs.readFileSync(scalar)), simd: new Lab(fs.readFileSync(simd)) };
const states = {}; // after 200 steps
for (const { name } of labs.scalar.scenes)
    for (const [k, way] of [{}, {}, ...ways[name] || []].entries()) {
        const set = { ...small[name], ...way }, steps = k ? FEW : STEPS;
        const want = natively(name, steps, set), what = `${name} ${JSON.stringify(set)}, ${steps} steps`;
        if (steps === STEPS) states[name] = want;
        check(`${what}: all numbers are finite`, want.every(Number.isFinite));
        if (steps === FEW || without) {
            const bits = run(labs.scalar, name, steps, set); // else in the page
            check(`${what}: the scalar module agrees with a native program bit for bit`, same(bits, want), `apart: ${apart(labs.scalar, bits, want)}`);
        }
        if (steps === STEPS) continue;
        const off = apart(labs.simd, run(labs.simd, name, steps, set), want);
        check(`${what}: the vector module agrees to 1e-12`, off < 1e-12, String(off));
    }
const refuses = act => { try { act(); } catch (error) { return error.message; } return ''; };
labs.scalar.open('dam');
check('a value out of range is refused', /value/.test(refuses(() => labs.scalar.set('h', 99))));
check('an unknown control is refused, and named', /there is no nonsense/.test(refuses(() => labs.scalar.set('nonsense', 1))));
check('an unknown scene is refused', /there is no nonsense/.test(refuses(() => labs.scalar.open('nonsense'))));

// ---- what the scenes show is so

{
    const lab = labs.simd;
    const measured = (scene, set, steps) => {
        run(lab, scene, steps, set);
        return Object.fromEntries(lab.measures.map(({ name, value }) => [name, value]));
    };
    const sum = i => lab.columns[i].values.reduce((a, b) => a + b, 0);
    let m = measured('cloud', { operator: 'gradient, CSPM', field: 'x', jitter: 0.3 }, 0);
    check('a corrected gradient is exact for x', m['rms error'] < 1e-12, String(m['rms error']));
    check('the weights of its row have the sum 0', Math.abs(sum(2)) < 1e-10 && lab.columns[2].values.some(w => Math.abs(w) > 0.1));
    m = measured('cloud', { operator: 'gradient, difference', field: 'x', jitter: 0.3 }, 0);
    check('the plain one is not', m['rms error'] > 0.1, String(m['rms error']));
    m = measured('cloud', { operator: 'Laplacian, ICSPM', field: 'x^2 + y^2', jitter: 0.1 }, 0);
    check('ICSPM is exact for squares', m['rms error'] < 1e-8, String(m['rms error']));
    lab.point('down', 0.5, 0.5);
    lab.point('move', 0.53, 0.52);
    lab.point('up', 0.53, 0.52);
    check('a particle is dragged', Math.abs(lab.x[lab.chosen] - 0.53) < 1e-12 && Math.abs(lab.y[lab.chosen] - 0.52) < 1e-12);
    check('and its row is that of where it is', lab.columns[0].values[0] === lab.chosen && lab.columns[1].values[0] === 0);
    const least = kernel => measured('kernels', { kernel, dim: 2 }, 0)['least value of the transform / that at 0'];
    check('the transform of the cubic spline is negative somewhere', least('cubic-spline') < -1e-4, String(least('cubic-spline')));
    check('that of Wendland C2 is not', least('wendland-c2') > -1e-6, String(least('wendland-c2')));
    const h_over_dx = lab.controls.find(({ name }) => name === 'h').value;
    check('a kernel brings its h', h_over_dx === measured('kernels', { kernel: 'wendland-c2' }, 0)['recommended h / spacing']);
    const rms = (cleaning, steps) => measured('magnet', { across: 24, cleaning }, steps)['rms of h div B'];
    check('cleaning takes a divergence away', rms('on', 100) < 0.1 * rms('on', 0), `${rms('on', 100)}, ${rms('on', 0)}`);
    check('without cleaning it stays', rms('off', 100) === rms('off', 0));
    m = measured('vortex', { columns: 16 }, 100);
    check('cleaning helps a vortex', m['without / with'] > 1.5, String(m['without / with']));
    m = measured('plate', { across: 25 }, 400);
    check('nothing is hotter than the hot edge, or colder than the cold ones', m.warmest <= 1 && m.coldest >= 0 && m['rows with a wrong sign'] === 0, JSON.stringify(m));
    check('the plate warms', m['mean temperature'] > 0.2 && m['mean temperature'] < 0.25, String(m['mean temperature']));
    const stretch = '<x^2 - y^2> / R^2 over the drop';
    check('a drop becomes round, and passes that', measured('drop', { across: 24 }, 0)[stretch] > 0.2 && measured('drop', { across: 24 }, 350)[stretch] < 0);
    m = measured('dam', { across: 16 }, 900);
    check('water runs, and none is lost', m['front / A'] > 1.2 && m['particles of water'] === 512, JSON.stringify(m));
}

// ---- the page

// the share of pixels that differ from the most frequent colour, of a PNG of 8 bits without interlace
function busy(png) {
    const parts = [];
    let at = 8, width, height, channels;
    while (at < png.length) {
        const size = png.readUInt32BE(at), type = png.toString('latin1', at + 4, at + 8), data = png.subarray(at + 8, at + 8 + size);
        if (type === 'IHDR') width = data.readUInt32BE(0), height = data.readUInt32BE(4), channels = { 2: 3, 6: 4 }[data[9]];
        if (type === 'IDAT') parts.push(data);
        at += size + 12;
    }
    const raw = zlib.inflateSync(Buffer.concat(parts)), line = width * channels, rows = [], counts = new Map();
    for (let y = 0; y < height; y++) {
        const filter = raw[y * (line + 1)], row = Buffer.from(raw.subarray(y * (line + 1) + 1, (y + 1) * (line + 1))), up = rows[y - 1];
        for (let i = 0; i < line; i++) {
            const a = i < channels ? 0 : row[i - channels], b = up ? up[i] : 0, c = up && i >= channels ? up[i - channels] : 0;
            const p = a + b - c, [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
            row[i] += [0, a, b, (a + b) >> 1, pa <= pb && pa <= pc ? a : pb <= pc ? b : c][filter];
        }
        rows.push(row);
        for (let i = 0; i < line; i += channels) {
            const colour = row.readUIntBE(i, 3);
            counts.set(colour, (counts.get(colour) || 0) + 1);
        }
    }
    return 1 - Math.max(...counts.values()) / (width * height);
}
const state = 'Array.from(new Uint8Array(laboratory.lab.state.buffer)).map(b => b.toString(16).padStart(2, "0")).join("")';
const hex = numbers => Buffer.from(numbers.buffer).toString('hex');
const url = file => 'file://' + path.resolve(file);

async function scenes(browser) {
    const page = await browser.page();
    await page.size(1280, 900);
    await page.feature('prefers-reduced-motion', 'reduce'); // scenes stand still until they are told
    for (const file of [scalarPage, simdPage])
        for (const { name, steps } of labs.scalar.scenes) {
            const what = `${path.basename(file)}#${name}`;
            await page.go('about:blank');
            await page.go(`${url(file)}#${name}`);
            check(`${what}: who wants less motion gets none`, await page.run('laboratory.lab.time') === 0);
            if (file === scalarPage) {
                await page.run(`Object.entries(${JSON.stringify(small[name])}).forEach(([control, value]) => laboratory.lab.set(control, value)), laboratory.lab.step(${STEPS}), laboratory.show(), 1`);
                check(`${what}: bit for bit as natively`, await page.run(state) === hex(states[name]));
            } else await page.run('laboratory.lab.step(20), laboratory.show(), 1');
            const picture = await page.run('(() => { const c = document.getElementById("picture"), d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data; let n = 0; for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n / (c.width * c.height); })()');
            check(`${what}: something is drawn`, picture > 0.01, String(picture));
            const shown = busy(await page.picture());
            check(`${what}: a screenshot is not blank`, shown > 0.03, String(shown));
            check(`${what}: every control has a label`, await page.run('[...document.querySelectorAll("input, select")].every(e => e.labels.length === 1 && e.labels[0].textContent.trim())'));
            if (file !== simdPage) continue;
            for (const width of [375, 1920, 700]) {
                await page.size(width, 800);
                await page.run('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))');
                // not beside innerWidth: a phone shows all of what is too wide
                const over = await page.run('document.documentElement.scrollWidth') - width;
                check(`${what}: ${width} pixels are wide enough`, over <= 0, `${over} too many`);
                check(`${what}: the picture follows the window`, await page.run('Math.abs(document.getElementById("picture").width / document.getElementById("picture").clientWidth - 1) < 0.01'));
            }
            await page.size(1280, 900);
            if (steps) { // it runs by its button, and pauses by the keyboard
                await page.run('document.getElementById("run").click(), new Promise(done => setTimeout(done, 400))');
                check(`${what}: it runs`, await page.run('document.getElementById("run").textContent === "Pause" && laboratory.lab.time > 0'));
                await page.run('document.getElementById("run").focus()');
                await page.key(' ');
                check(`${what}: a key pauses it`, await page.run('document.getElementById("run").textContent === "Run"'));
            }
            // every control does what it says
            const wrong = await page.run(`(() => {
                const wrong = [], form = document.getElementById('controls');
                for (const { name, least, most, step, value, choices } of laboratory.lab.controls) {
                    const input = form.elements[name], other = value + step <= most ? value + step : value - step;
                    input.value = other;
                    input.dispatchEvent(new Event('input', { bubbles: true }));
                    const now = laboratory.lab.controls.find(c => c.name === name).value;
                    if (Math.abs(now - other) > 1e-9) wrong.push(name + ': ' + now + ' for ' + other + '; ' + document.getElementById('spoken').textContent);
                    else if (!document.getElementById('spoken').textContent.includes(choices.length ? choices[other] : +other.toPrecision(6))) wrong.push(name + ' is not told');
                    laboratory.lab.step(1);
                }
                laboratory.show();
                return wrong;
            })()`);
            check(`${what}: controls change what they say`, wrong.length === 0, wrong.join('; '));
        }
    check('nothing is complained of in the console', page.errors.length === 0, page.errors.join('; '));
    check('nothing is loaded', page.requests.every(at => at === 'about:blank' || at.startsWith(url(scalarPage)) || at.startsWith(url(simdPage))), page.requests.join());
    await page.close();
}
async function hands(browser) {
    const page = await browser.page();
    await page.size(1280, 900);
    await page.feature('prefers-reduced-motion', 'reduce');
    await page.go(`${url(simdPage)}#dam`);
    const box = await page.run('(({ left, top, width, height }) => ({ left, top, width, height }))(document.getElementById("picture").getBoundingClientRect())');
    const at = ([x, y]) => [box.left + (x + 0.2) / 5.4 * box.width, box.top + box.height * (1 - (y + 0.2) / 3.24)];
    const water = 'laboratory.lab.moving', right = 'laboratory.lab.controls.find(c => c.name === "right").value';
    await page.mouse('mousePressed', ...at([5.02, 1]));
    await page.mouse('mouseMoved', ...at([4.5, 1]));
    await page.mouse('mouseMoved', ...at([4, 1]));
    await page.mouse('mouseReleased', ...at([4, 1]));
    check('a wall is dragged', Math.abs(await page.run(right) - 4) < 0.02, String(await page.run(right)));
    const before = await page.run(water);
    await page.mouse('mousePressed', ...at([2.5, 2]));
    await page.run('laboratory.lab.step(40), 1');
    await page.mouse('mouseReleased', ...at([2.5, 2]));
    const poured = await page.run(water);
    check('water is poured', poured >= before + 7, `${before}, ${poured}`);
    await page.run('laboratory.lab.step(40), 1');
    check('and no more, once the button is let go', await page.run(water) === poured);
    await page.run('document.getElementById("picture").focus()');
    for (const key of ['ArrowRight', 'ArrowUp', 'ArrowUp', ' ']) await page.key(key);
    check('the cross is told', /Pressed at 2\.608, 1\.636/.test(await page.run('document.getElementById("spoken").textContent')), await page.run('document.getElementById("spoken").textContent'));
    await page.run('laboratory.lab.step(40), 1');
    await page.key(' ');
    check('water is poured by keys', await page.run(water) >= poured + 7);
    // from the address bar on, tabs lead to every control
    const reached = await page.run('(() => { document.querySelector("#scenes button").focus(); return [...document.querySelectorAll("button, input, select, canvas")].filter(e => !e.closest("[hidden]") && e.tabIndex < 0).length; })()');
    check('everything is reached by tabs', reached === 0, `${reached} are not`);
    await page.run('laboratory.lab.step = () => { throw new Error("a reason"); }, document.getElementById("one").click()');
    check('an error is told', /Stopped: a reason/.test(await page.run('document.getElementById("spoken").textContent')));
    check('nothing is complained of in the console', page.errors.length === 0, page.errors.join('; '));
    await page.close();
}

(async () => {
    if (!without) {
        const browser = await open(path.resolve(folder));
        try {
            await scenes(browser);
            await hands(browser);
        } finally {
            await browser.close();
        }
    }
    console.log(`web: ${passed} passed, ${failed} failed`);
    process.exitCode = failed ? 1 : 0;
})().catch(error => {
    console.log(`failed: ${error.stack}\nweb: ${passed} passed, ${failed + 1} failed`);
    process.exitCode = 1;
});

// SPDX-License-Identifier: MIT
//
// page.js - the page of the laboratory: makes the controls that a scene asks for, draws its particles or
// curves, and hands on what keys and pointers do. It knows no scene by name.
'use strict';

const byId = id => document.getElementById(id);
const canvas = byId('picture'), status = byId('status'), spoken = byId('spoken');
const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const decoded = byId('module').textContent.replace(/\s/g, '');

function start() {
    const lab = new Lab(Uint8Array.from(atob(decoded), c => c.charCodeAt(0)));
    let running = false, steps = 1, shown = 0; // steps per picture; the field that is the colour
    let cursor = null, pressed = false; // of the keyboard, in the scene's lengths
    let times = [], wanted = 0; // of the last pictures; the picture that has been asked for

    // ---------------------------------------------------------------- colours

    const rgb = text => [1, 3, 5].map(i => parseInt(text.slice(i, i + 2), 16));
    const between = stops => Array.from({ length: 256 }, (_, i) => {
        const at = i / 255 * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(at));
        return `rgb(${stops[k].map((c, n) => Math.round(c + (at - k) * (stops[k + 1][n] - c))).join()})`;
    });
    const rising = between(['#440154', '#3b528b', '#21918c', '#5ec962', '#fde725'].map(rgb));
    let signed, lines;
    function readColours() {
        signed = between([rgb('#2166ac'), rgb('#67a9cf'), rgb(style('--neutral')), rgb('#ef8a62'), rgb('#b2182b')]);
        lines = [style('--accent'), '#d9822b', '#2f9e62', '#b04fc4'];
    }
    function range(field) {
        let { least, most } = field;
        if (least === 0 && most === 0) {
            least = Infinity, most = -Infinity;
            for (let i = 0; i < lab.moving; i++) {
                least = Math.min(least, field.values[i]), most = Math.max(most, field.values[i]);
            }
            if (least < 0) most = Math.max(most, -least), least = -most;
            if (!(most > least)) most = least + 1;
        }
        return { least, most, colours: least < 0 && least === -most ? signed : rising };
    }

    // ---------------------------------------------------------------- pictures

    const short = value => value === 0 ? '0' :
        Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3 ? value.toExponential(2) : String(+value.toPrecision(4));
    function sized() {
        const scale = window.devicePixelRatio || 1, { width, height } = lab.view;
        const ratio = lab.curves.length ? 0.62 : height / width;
        canvas.style.maxWidth = `max(16rem, calc((100vh - 13rem) / ${ratio}))`; // with its buttons in the window
        const w = Math.round(canvas.clientWidth * scale), h = Math.round(w * ratio);
        if (canvas.width !== w || canvas.height !== h) canvas.width = w, canvas.height = h;
        return { w, h, scale };
    }
    function draw() {
        const { w, h, scale } = sized(), c = canvas.getContext('2d');
        c.clearRect(0, 0, w, h);
        c.font = `${13 * scale}px system-ui, sans-serif`;
        if (lab.curves.length) drawCurves(c, w, h, scale);
        else drawParticles(c, w, h, scale);
    }
    function drawParticles(c, w, h, scale) {
        const { left, bottom, width } = lab.view, k = w / width;
        const x = lab.x, y = lab.y, n = lab.particles, moving = lab.moving;
        const field = lab.fields[shown], { least, most, colours } = range(field);
        const size = Math.max(scale, k * lab.size * 0.96), per = 255 / (most - least);
        c.fillStyle = style('--wall');
        for (let i = moving; i < n; i++)
            c.fillRect((x[i] - left) * k - size / 2, h - (y[i] - bottom) * k - size / 2, size, size);
        let last = -1;
        for (let i = 0; i < moving; i++) {
            const colour = Math.max(0, Math.min(255, Math.round((field.values[i] - least) * per)));
            if (colour !== last) c.fillStyle = colours[last = colour];
            c.fillRect((x[i] - left) * k - size / 2, h - (y[i] - bottom) * k - size / 2, size, size);
        }
        c.lineWidth = 2 * scale;
        c.strokeStyle = style('--text');
        const { chosen } = lab;
        if (chosen >= 0) c.strokeRect((x[chosen] - left) * k - size / 2, h - (y[chosen] - bottom) * k - size / 2, size, size);
        if (cursor && document.activeElement === canvas) {
            const px = (cursor.x - left) * k, py = h - (cursor.y - bottom) * k, arm = 9 * scale;
            c.beginPath();
            c.moveTo(px - arm, py), c.lineTo(px + arm, py), c.moveTo(px, py - arm), c.lineTo(px, py + arm);
            if (pressed) c.arc(px, py, arm, 0, 7);
            c.stroke();
        }
        // the key, above on the right
        const wide = Math.min(190 * scale, w / 2.5), high = 9 * scale, from = w - wide - 10 * scale, top = 24 * scale;
        for (let i = 0; i < 64; i++) {
            c.fillStyle = colours[i * 4];
            c.fillRect(from + i * wide / 64, top, wide / 64 + 1, high);
        }
        c.fillStyle = style('--text');
        c.textAlign = 'right';
        c.fillText(field.name, w - 10 * scale, top - 6 * scale);
        c.fillText(short(most), w - 10 * scale, top + high + 14 * scale);
        c.textAlign = 'left';
        c.fillText(short(least), from, top + high + 14 * scale);
    }
    function drawCurves(c, w, h, scale) {
        const curves = lab.curves, pad = 46 * scale, low = 28 * scale, top = (10 + 18 * curves.length) * scale;
        const [first] = curves, farthest = first.x[first.x.length - 1];
        let least = 0, most = 0;
        for (const { y } of curves) for (const value of y) least = Math.min(least, value), most = Math.max(most, value);
        if (!(most > least)) most = least + 1;
        const px = value => pad + (w - pad - 12 * scale) * (value - first.x[0]) / (farthest - first.x[0]);
        const py = value => h - low - (h - low - top) * (value - least) / (most - least);
        c.strokeStyle = style('--line');
        c.fillStyle = style('--soft');
        c.lineWidth = scale;
        const ticks = (from, to, draw) => {
            const raw = (to - from) / 5, power = 10 ** Math.floor(Math.log10(raw));
            const step = power * [1, 2, 5, 10].find(f => f * power >= raw);
            for (let v = Math.ceil(from / step) * step; v <= to + 1e-9 * step; v += step) draw(+v.toPrecision(8));
        };
        const line = (x0, y0, x1, y1) => { c.beginPath(); c.moveTo(x0, y0); c.lineTo(x1, y1); c.stroke(); };
        c.textAlign = 'center';
        ticks(first.x[0], farthest, v => {
            line(px(v), top, px(v), h - low);
            c.fillText(v, px(v), h - low + 16 * scale);
        });
        c.textAlign = 'right';
        ticks(least, most, v => {
            line(pad, py(v), w - 12 * scale, py(v));
            c.fillText(v, pad - 6 * scale, py(v) + 4 * scale);
        });
        c.lineWidth = 2 * scale;
        c.textAlign = 'left';
        curves.forEach(({ name, x, y }, i) => {
            c.strokeStyle = lines[i % lines.length];
            c.setLineDash([[], [8, 4], [3, 3], [10, 3, 2, 3]][i % 4].map(d => d * scale));
            c.beginPath();
            for (let j = 0; j < x.length; j++) c.lineTo(px(x[j]), py(y[j]));
            c.stroke();
            line(pad, (14 + 18 * i) * scale, pad + 34 * scale, (14 + 18 * i) * scale);
            c.fillStyle = style('--text');
            c.fillText(name, pad + 42 * scale, (18 + 18 * i) * scale);
        });
        c.setLineDash([]);
    }

    // ---------------------------------------------------------------- numbers

    function fill(element, items, make) { // as many children as items
        while (element.children.length > items.length) element.lastChild.remove();
        while (element.children.length < items.length) element.append(make());
        items.forEach((item, i) => { if (element.children[i].textContent !== item) element.children[i].textContent = item; });
    }
    function tell() {
        const { measures, columns } = lab, rate = times.length > 1 ? 1000 * (times.length - 1) / (times.at(-1) - times[0]) : 0;
        const list = byId('measures');
        if (list.children.length !== 2 * measures.length)
            list.replaceChildren(...measures.flatMap(() => [document.createElement('dt'), document.createElement('dd')]));
        measures.forEach(({ name, value }, i) => {
            list.children[2 * i].textContent = name;
            list.children[2 * i + 1].textContent = short(value);
        });
        byId('measures-title').parentElement.hidden = measures.length === 0;
        byId('rows').hidden = columns.length === 0;
        if (columns.length) {
            const table = byId('table');
            if (!table.tHead) table.createTHead().insertRow(), table.createTBody();
            fill(table.tHead.rows[0], columns.map(column => column.name), () => Object.assign(document.createElement('th'), { scope: 'col' }));
            const rows = columns[0].values.length;
            while (table.tBodies[0].rows.length > rows) table.tBodies[0].lastChild.remove();
            while (table.tBodies[0].rows.length < rows) table.tBodies[0].insertRow();
            for (let r = 0; r < rows; r++)
                fill(table.tBodies[0].rows[r], columns.map(column => short(column.values[r])), () => document.createElement('td'));
        }
        const parts = lab.curves.length ? [] : [`${lab.particles} particles`];
        if (lab.scene.steps) parts.push(`t = ${lab.time.toFixed(3)}`);
        if (running) parts.push(`${steps} ${steps === 1 ? 'step' : 'steps'} a picture, ${rate.toFixed(0)} pictures a second`);
        status.textContent = parts.join(', ');
    }
    const say = text => { spoken.textContent = text; };
    function stop(error) { // what is refused is told, and the scene stands still
        run(false);
        say(`Stopped: ${error.message}. Start again, or change a control.`);
    }
    function guarded(act) {
        try { act(); } catch (error) { stop(error); }
    }
    function show() {
        readValues();
        draw();
        tell();
    }

    // ---------------------------------------------------------------- time

    function frame(now) {
        wanted = 0;
        guarded(() => {
            const before = performance.now();
            lab.step(steps);
            const cost = performance.now() - before;
            if (cost > 11 && steps > 1) steps--; // a picture of 1/60 s has room for drawing, too
            else if (cost < 8 && steps < 40) steps++;
            times.push(now);
            if (times.length > 60) times.shift();
            show();
        });
        if (running) wanted = requestAnimationFrame(frame);
    }
    function run(on) {
        running = on && lab.scene.steps;
        byId('run').textContent = running ? 'Pause' : 'Run';
        byId('run').setAttribute('aria-pressed', running);
        times = [];
        if (running && !wanted) wanted = requestAnimationFrame(frame);
        if (!running && wanted) cancelAnimationFrame(wanted), wanted = 0;
    }

    // ---------------------------------------------------------------- scenes and controls

    const quiet = window.matchMedia('(prefers-reduced-motion: reduce)');
    function open(name) {
        lab.open(name);
        steps = 1, shown = 0, cursor = null, pressed = false;
        for (const button of byId('scenes').children) button.setAttribute('aria-current', button.value === name);
        byId('title').textContent = lab.scene.title;
        byId('about').textContent = lab.scene.about;
        byId('hint').textContent = lab.scene.hint ?
            `${lab.scene.hint} By keys, in the picture: arrows move a cross, space presses there and lets go.` : '';
        for (const id of ['run', 'one']) byId(id).hidden = !lab.scene.steps;
        byId('again').hidden = lab.curves.length > 0;
        makeControls();
        show();
        say(`${lab.scene.title}.`);
        if (location.hash !== `#${name}`) history.replaceState(null, '', `#${name}`);
        run(!quiet.matches);
    }
    function makeControls() {
        const make = (name, label, choices, more) => {
            const box = document.createElement('div'), text = document.createElement('span');
            const title = Object.assign(document.createElement('label'), { htmlFor: `control-${name}`, textContent: label });
            box.className = 'control';
            text.append(title, document.createElement('output')); // not within the label, which would be the output's
            const input = document.createElement(choices.length ? 'select' : 'input');
            input.id = title.htmlFor;
            choices.forEach((choice, i) => input.add(new Option(choice, i)));
            if (!choices.length) input.type = 'range';
            input.name = name;
            Object.assign(input, more);
            box.append(text, input);
            return box;
        };
        const boxes = lab.controls.map(({ name, label, choices, least, most, step }) =>
            make(name, label, choices, choices.length ? {} : { min: least, max: most, step }));
        if (lab.fields.length > 1) boxes.push(make('colour', 'Colour', lab.fields.map(field => field.name), {}));
        byId('controls').replaceChildren(...boxes);
        readValues();
    }
    function readValues() { // a scene may change a control by itself
        for (const { name, choices, value } of lab.controls) {
            const input = byId('controls').elements[name], text = String(+value.toPrecision(6));
            if (document.activeElement !== input || choices.length) if (input.value !== text) input.value = text;
            if (!choices.length) input.previousSibling.lastChild.textContent = text;
        }
        const colour = byId('controls').elements.colour;
        if (colour) colour.value = shown;
    }
    byId('controls').addEventListener('input', event => {
        const { name, value, selectedOptions } = event.target;
        if (name === 'colour') shown = +value;
        else guarded(() => {
            lab.set(name, +value);
            say(`${event.target.labels[0].textContent}: ${selectedOptions ? selectedOptions[0].text : value}`);
        });
        show();
    });
    byId('controls').addEventListener('submit', event => event.preventDefault());
    byId('run').onclick = () => { run(!running); say(running ? 'It runs.' : 'It stands still.'); tell(); };
    byId('one').onclick = () => { run(false); guarded(() => lab.step(1)); show(); };
    byId('again').onclick = () => { guarded(() => lab.reset()); show(); say('From the start.'); };

    // ---------------------------------------------------------------- pointers and keys

    const place = event => {
        const box = canvas.getBoundingClientRect(), { left, bottom, width, height } = lab.view;
        return [left + (event.clientX - box.left) / box.width * width, bottom + (box.bottom - event.clientY) / box.height * height];
    };
    const point = (phase, x, y) => { guarded(() => lab.point(phase, x, y)); if (!running) show(); };
    canvas.onpointerdown = event => {
        if (lab.curves.length || event.button) return;
        canvas.setPointerCapture(event.pointerId);
        cursor = null;
        point('down', ...place(event));
    };
    canvas.onpointermove = event => { if (canvas.hasPointerCapture(event.pointerId)) point('move', ...place(event)); };
    canvas.onpointerup = canvas.onpointercancel = event => {
        if (canvas.hasPointerCapture(event.pointerId)) canvas.releasePointerCapture(event.pointerId), point('up', ...place(event));
    };
    canvas.onkeydown = event => {
        const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }, way = ways[event.key];
        if (lab.curves.length || (!way && event.key !== ' ') || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        const { left, bottom, width, height } = lab.view, far = width / (event.shiftKey ? 10 : 50);
        cursor ||= { x: left + width / 2, y: bottom + height / 2 };
        if (way) {
            cursor.x = Math.min(left + width, Math.max(left, cursor.x + way[0] * far));
            cursor.y = Math.min(bottom + height, Math.max(bottom, cursor.y + way[1] * far));
            if (pressed) point('move', cursor.x, cursor.y);
        } else {
            pressed = !pressed;
            point(pressed ? 'down' : 'up', cursor.x, cursor.y);
        }
        say(`${pressed ? 'Pressed at' : 'At'} ${short(cursor.x)}, ${short(cursor.y)}`);
        if (!running) draw();
    };
    canvas.onblur = () => {
        if (pressed) pressed = false, point('up', cursor.x, cursor.y);
        if (!running) draw();
    };

    for (const { name, title } of lab.scenes) {
        const button = Object.assign(document.createElement('button'), { type: 'button', value: name, textContent: title });
        button.onclick = () => guarded(() => open(name));
        byId('scenes').append(button);
    }
    new ResizeObserver(() => { if (!running) draw(); }).observe(canvas);
    window.matchMedia('(prefers-color-scheme: dark)').onchange = () => { readColours(); draw(); };
    window.onhashchange = () => { if (`#${lab.scene.name}` !== location.hash) guarded(() => open(location.hash.slice(1))); };
    readColours();
    const asked = location.hash.slice(1);
    open(lab.scenes.some(({ name }) => name === asked) ? asked : lab.scenes[0].name);
    window.laboratory = { lab, run, show }; // for tests, and for who is curious
}
try {
    start();
} catch (error) {
    status.textContent = `Not started: ${error.message}`;
    console.error(error);
}

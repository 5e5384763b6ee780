// SPDX-License-Identifier: MIT
//
// lab.js - the laboratory's module for JavaScript: in the page, and in node by the npm package.
//
//     const lab = new Lab(bytes);              bytes of the module; each Lab has a memory of its own
//     lab.open('dam');
//     lab.set('kernel', 'cubic-spline');       a number, or one of a control's choices
//     lab.step(200);
//     lab.field('speed')                       a Float64Array in the module's memory: good until the next call
//
// What a scene has is in lab.controls, lab.fields, lab.measures, lab.curves and lab.columns, by name. An error
// of the module is thrown, in its words.
'use strict';

class Lab {
    #sph;
    #scene = -1;
    constructor(bytes) {
        this.#sph = new WebAssembly.Instance(new WebAssembly.Module(bytes)).exports;
        const sph = this.#sph;
        this.scenes = this.#each(sph.lab_scenes(), i => ({
            name: this.#text(sph.lab_name(i)),
            title: this.#text(sph.lab_title(i)),
            about: this.#text(sph.lab_about(i)),
            hint: this.#text(sph.lab_hint(i)),
            steps: sph.lab_steps(i) === 1,
        }));
    }
    #each(count, make) { return Array.from({ length: count }, (_, i) => make(i)); }
    #text(at) {
        if (!at) return '';
        const bytes = new Uint8Array(this.#sph.memory.buffer);
        let text = '';
        for (; bytes[at]; at++) text += String.fromCharCode(bytes[at]);
        return text;
    }
    #numbers(at, count) { return new Float64Array(this.#sph.memory.buffer, at, at ? count : 0); }
    #answer(value) {
        if (value < 0) throw new Error(this.#text(this.#sph.lab_status_text(value)));
        return value;
    }
    #named(list, name) {
        const i = list.findIndex(one => one.name === name);
        if (i < 0) throw new RangeError(`there is no ${name}; there are: ${list.map(one => one.name).join(', ')}`);
        return i;
    }

    get scene() { return this.scenes[this.#scene]; }
    open(name) {
        this.#scene = this.#named(this.scenes, name);
        this.#answer(this.#sph.lab_open(this.#scene));
    }
    reset() { this.#answer(this.#sph.lab_reset()); }
    step(count = 1) { this.#answer(this.#sph.lab_step(count)); }
    get time() { return this.#sph.lab_time(); }
    // a pointer in the picture: phase is 'down', 'move' or 'up'
    point(phase, x, y) { this.#answer(this.#sph.lab_point(['down', 'move', 'up'].indexOf(phase), x, y)); }

    get controls() {
        const sph = this.#sph;
        return this.#each(sph.lab_controls(), i => ({
            name: this.#text(sph.lab_control_name(i)),
            label: this.#text(sph.lab_control_label(i)),
            choices: this.#text(sph.lab_control_choices(i)).split('|').filter(choice => choice),
            least: sph.lab_control_least(i),
            most: sph.lab_control_most(i),
            step: sph.lab_control_step(i),
            value: sph.lab_control_value(i),
        }));
    }
    set(name, value) {
        const controls = this.controls, i = this.#named(controls, name), { choices } = controls[i];
        if (typeof value === 'string')
            value = this.#named(choices.map(choice => ({ name: choice })), value);
        this.#answer(this.#sph.lab_set(i, value));
    }

    get particles() { return this.#sph.lab_particles(); }
    get moving() { return this.#sph.lab_moving(); } // those that are no walls come first
    get chosen() { return this.#sph.lab_chosen(); }
    get size() { return this.#sph.lab_size(); }
    get view() {
        const [left, bottom, width, height] = this.#each(4, i => this.#sph.lab_view(i));
        return { left, bottom, width, height };
    }
    get x() { return this.#numbers(this.#sph.lab_x(), this.particles); }
    get y() { return this.#numbers(this.#sph.lab_y(), this.particles); }
    get fields() {
        return this.#each(this.#sph.lab_fields(), i => ({
            name: this.#text(this.#sph.lab_field_name(i)),
            values: this.#numbers(this.#sph.lab_field_values(i), this.particles),
            least: this.#sph.lab_field_least(i),
            most: this.#sph.lab_field_most(i),
        }));
    }
    field(name) {
        const { fields } = this;
        return fields[this.#named(fields, name)].values;
    }
    get measures() {
        return this.#each(this.#sph.lab_measures(), i => ({
            name: this.#text(this.#sph.lab_measure_name(i)),
            value: this.#sph.lab_measure_value(i),
        }));
    }
    get curves() {
        const points = this.#sph.lab_curve_points(), x = this.#numbers(this.#sph.lab_curve_x(), points);
        return this.#each(this.#sph.lab_curves(), i => ({
            name: this.#text(this.#sph.lab_curve_name(i)),
            x,
            y: this.#numbers(this.#sph.lab_curve_y(i), points),
        }));
    }
    get columns() {
        const rows = this.#sph.lab_rows();
        return this.#each(this.#sph.lab_columns(), i => ({
            name: this.#text(this.#sph.lab_column_name(i)),
            values: this.#numbers(this.#sph.lab_column_values(i), rows),
        }));
    }
    // all numbers that there are, for comparisons
    get state() {
        const lists = [this.x, this.y, ...this.fields.map(f => f.values), this.measures.map(m => m.value),
            ...this.curves.map(c => c.y), ...this.columns.map(c => c.values)];
        return Float64Array.from(lists.flatMap(list => Array.from(list)));
    }
}
if (typeof module === 'object') module.exports = { Lab };

// SPDX-License-Identifier: MIT
// types.ts - what the package's types must take, and refuse
import { open, Lab } from 'sph-lab';

const lab: Lab = open('dam');
lab.set('kernel', 'cubic-spline');
lab.step();
const pressures: Float64Array = lab.field('pressure');
const sum: number = pressures.reduce((a, b) => a + b, lab.measures[0].value);
lab.point('down', sum, 0);
// @ts-expect-error
lab.point('click', 0, 0);
// @ts-expect-error
lab.time = 1;

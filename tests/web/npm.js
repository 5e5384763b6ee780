// SPDX-License-Identifier: MIT
//
// npm.js - a program that has installed the package: node npm.js NATIVE. Prints 'npm: N passed, N failed'.
'use strict';
const { open, Lab, bytes } = require('sph-lab');
const { execFileSync } = require('child_process');
let passed = 0, failed = 0;
const check = (what, right) => { right ? passed++ : (failed++, console.log(`failed: ${what}`)); };

const out = execFileSync(process.argv[2], ['dam', '25', 'across=16', 'remedy=5'], { maxBuffer: 1 << 28 });
const want = new Float64Array(out.buffer.slice(out.byteOffset, out.byteOffset + out.length));
const lab = open('dam'), other = open('dam');
lab.set('across', 16);
lab.set('remedy', 'delta-SPH and shifting');
lab.step(25);
const got = lab.state;
check('it has as many numbers as a native program', got.length === want.length);
check('positions are those of a native program', want.subarray(0, 2 * lab.particles).every((value, i) => Math.abs(value - got[i]) < 1e-12));
check('each laboratory has a memory of its own', other.time === 0 && lab.time > 0 && other.particles > lab.particles);
check('fields have names', lab.field('pressure').length === lab.particles);
let reason = '';
try { lab.set('h', 99); } catch (error) { reason = error.message; }
check('what is refused is thrown', reason.includes('value'));
import('sph-lab').then(module => {
    check('import and require have the same', module.Lab === Lab && module.bytes === bytes && module.open('plate').scene.title === 'Heat in a plate');
    console.log(`npm: ${passed} passed, ${failed} failed`);
    process.exitCode = failed ? 1 : 0;
});

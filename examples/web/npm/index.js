// SPDX-License-Identifier: MIT
'use strict';
const { Lab } = require('./lab.js');
const bytes = require('./module.js');

// a laboratory of its own, with its own memory; with a name, that scene is open
function open(name) {
    const lab = new Lab(bytes);
    if (name !== undefined) lab.open(name);
    return lab;
}
module.exports = { Lab, bytes, open };

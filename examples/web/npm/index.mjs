// SPDX-License-Identifier: MIT
import lab from './index.js';

export const { Lab, bytes, open } = lab;

// SPDX-License-Identifier: MIT

export interface Scene {
    readonly name: string;
    readonly title: string;
    readonly about: string;
    /** What a pointer does in the picture; empty: nothing. */
    readonly hint: string;
    /** It moves by itself. */
    readonly steps: boolean;
}
export interface Control {
    readonly name: string;
    readonly label: string;
    /** Empty: a number between least and most. Else the value counts the choices from 0. */
    readonly choices: string[];
    readonly least: number;
    readonly most: number;
    readonly step: number;
    readonly value: number;
}
/** Numbers of all particles, in the module's memory: good until the next call. */
export interface Field {
    readonly name: string;
    readonly values: Float64Array;
    /** The range of colours; where both are 0, that of the values. */
    readonly least: number;
    readonly most: number;
}
export interface Measure {
    readonly name: string;
    readonly value: number;
}
export interface Curve {
    readonly name: string;
    readonly x: Float64Array;
    readonly y: Float64Array;
}
export interface Column {
    readonly name: string;
    readonly values: Float64Array;
}

/** A laboratory with a memory of its own. Errors of the module are thrown, in its words. */
export class Lab {
    constructor(bytes: Uint8Array);
    readonly scenes: readonly Scene[];
    /** The one that is open. */
    readonly scene: Scene | undefined;
    /** Opens a scene with the usual values of its controls. */
    open(name: string): void;
    reset(): void;
    step(count?: number): void;
    readonly time: number;
    point(phase: 'down' | 'move' | 'up', x: number, y: number): void;
    readonly controls: Control[];
    /** A number, or one of the control's choices. */
    set(name: string, value: number | string): void;
    readonly particles: number;
    /** Those that are no walls, which come first. */
    readonly moving: number;
    /** The chosen particle, or -1. */
    readonly chosen: number;
    /** Side of the square that a particle is. */
    readonly size: number;
    readonly view: { left: number; bottom: number; width: number; height: number };
    readonly x: Float64Array;
    readonly y: Float64Array;
    readonly fields: Field[];
    field(name: string): Float64Array;
    readonly measures: Measure[];
    readonly curves: Curve[];
    readonly columns: Column[];
    /** All numbers that there are. */
    readonly state: Float64Array;
}
/** The module. */
export const bytes: Uint8Array;
/** A new laboratory; with a name, that scene is open. */
export function open(name?: string): Lab;

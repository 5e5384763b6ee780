/* SPDX-License-Identifier: MIT
 *
 * lab.h - the laboratory: scenes that run in a web page, in node, or in a native program. What a scene is,
 * what scenes share, and the calls of a host (lab.c), which are the exports of the WebAssembly module.
 *
 *     lab_open(scene); lab_set(control, value); lab_step(4); ... lab_field_values(0) ...
 *
 * A function that may fail answers a negative sph_error: lab_status_text(answer) says it in words. One scene
 * is open at a time; a module that is instantiated twice has two.
 */
#ifndef LAB_H
#define LAB_H

#include "sph.h"

#ifdef __wasm__
#define LAB_EXPORT __attribute__((visibility("default"), used))
#else
#define LAB_EXPORT
#endif
/* hands an error up */
#define LAB_TRY(call) \
    do { \
        const sph_index answer_ = (call); \
        if (answer_ < 0) return (int)answer_; \
    } while (0)
/* The names of all kernels, as choices of a control. */
#define LAB_KERNEL_NAME(unused, id, name, support, h_over_dx) name "|"
#define LAB_KERNEL_NAMES SPH_KERNELS(LAB_KERNEL_NAME, 0)
/* CALL(kernel), where the usual kernels are constants, which fold, and the others are not: all of them folded
   would make the module five times as large. */
#define LAB_SWITCH_KERNEL(k, CALL) \
    switch (k) { \
    case SPH_WENDLAND_C2: \
        CALL(SPH_WENDLAND_C2); \
        break; \
    case SPH_CONVEX: \
        CALL(SPH_CONVEX); \
        break; \
    default: \
        CALL((sph_kernel)(k)); \
        break; \
    }

/* Something to be set: a number between two others, or one of some choices, which are counted from 0. */
typedef struct lab_control {
    const char *name, *label, *choices; /* choices: "none|convex kernel"; null: a number */
    double least, most, step, usual;
    double value;
} lab_control;
/* Numbers of all particles that can be shown as colours. */
typedef struct lab_field {
    const char *name;
    const double *values;
    double least, most; /* the colours' range; where both are 0, that of the values */
} lab_field;
/* A number about the whole, shown below the picture. */
typedef struct lab_measure {
    const char *name;
    double value;
} lab_measure;
/* Points of a curve. All curves of a scene share x. */
typedef struct lab_curve {
    const char *name;
    const double *y;
} lab_curve;
/* A column of a table. */
typedef struct lab_column {
    const char *name;
    const double *values;
} lab_column;

enum { LAB_DOWN, LAB_MOVE, LAB_UP };
typedef struct lab_scene {
    const char *name, *title, *about;
    const char *hint;                              /* what a pointer does in the picture; null: nothing */
    int (*reset)(void);                            /* from the start, by the controls' values */
    int (*step)(void);                             /* null: nothing moves by itself */
    int (*look)(void);                             /* brings fields and measures up to date; null: they are */
    int (*changed)(int control);                   /* a control has another value */
    int (*point)(int phase, double px, double py); /* LAB_DOWN, LAB_MOVE, LAB_UP */
    lab_control *controls;
    lab_field *fields;
    lab_measure *measures;
    lab_curve *curves;
    lab_column *columns;
    int n_controls, n_fields, n_measures, n_curves, n_columns;
    /* what changes: particles, those that are no walls, points of curves, rows of the table, the chosen one */
    int n, n_moving, n_points, n_rows, chosen;
    double time, size,
        view[4]; /* side of a particle's square; left, bottom, width and height of the picture */
    const double *x, *y, *curve_x;
} lab_scene;

/* -------- the scenes: each in a file of its name */
extern lab_scene lab_dam, lab_vortex, lab_drop, lab_plate, lab_magnet, lab_kernels, lab_cloud;

/* -------- what scenes share */

/* Neighbours, in the one memory of the module: those before are gone. */
int lab_neighbours(int dim, sph_points points, sph_scalars radius, int criterion, sph_list *list);
/* A random number between -1/2 and 1/2; lab_seed starts the row of them again. */
void lab_seed(uint32_t seed);
double lab_random(void);

/* -------- calls of a host */

LAB_EXPORT int lab_scenes(void);
LAB_EXPORT const char *lab_name(int scene);
LAB_EXPORT const char *lab_title(int scene);
LAB_EXPORT const char *lab_about(int scene);
LAB_EXPORT const char *lab_hint(int scene);
LAB_EXPORT int lab_steps(int scene); /* 1: it moves by itself */
LAB_EXPORT const char *lab_status_text(int answer);

/* opens a scene with the usual values of its controls */
LAB_EXPORT int lab_open(int scene);
LAB_EXPORT int lab_reset(void);
LAB_EXPORT int lab_step(int count);
LAB_EXPORT double lab_time(void);
LAB_EXPORT int lab_point(int phase, double px, double py);

LAB_EXPORT int lab_controls(void);
LAB_EXPORT const char *lab_control_name(int i);
LAB_EXPORT const char *lab_control_label(int i);
LAB_EXPORT const char *lab_control_choices(int i);
LAB_EXPORT double lab_control_least(int i);
LAB_EXPORT double lab_control_most(int i);
LAB_EXPORT double lab_control_step(int i);
LAB_EXPORT double lab_control_value(int i);
LAB_EXPORT int lab_set(int i, double value); /* outside of its range: SPH_ERROR_VALUE */

LAB_EXPORT int lab_particles(void);
LAB_EXPORT int lab_moving(void);
LAB_EXPORT int lab_chosen(void); /* -1: none */
LAB_EXPORT const double *lab_x(void);
LAB_EXPORT const double *lab_y(void);
LAB_EXPORT double lab_size(void);
LAB_EXPORT double lab_view(int side);
LAB_EXPORT int lab_fields(void);
LAB_EXPORT const char *lab_field_name(int i);
LAB_EXPORT const double *lab_field_values(int i);
LAB_EXPORT double lab_field_least(int i);
LAB_EXPORT double lab_field_most(int i);
LAB_EXPORT int lab_measures(void);
LAB_EXPORT const char *lab_measure_name(int i);
LAB_EXPORT double lab_measure_value(int i);
LAB_EXPORT int lab_curves(void);
LAB_EXPORT int lab_curve_points(void);
LAB_EXPORT const char *lab_curve_name(int i);
LAB_EXPORT const double *lab_curve_x(void);
LAB_EXPORT const double *lab_curve_y(int i);
LAB_EXPORT int lab_columns(void);
LAB_EXPORT int lab_rows(void);
LAB_EXPORT const char *lab_column_name(int i);
LAB_EXPORT const double *lab_column_values(int i);
#endif

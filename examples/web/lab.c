/* SPDX-License-Identifier: MIT
 *
 * lab.c - the calls of a host, and what scenes share.
 */
#include "lab.h"

static lab_scene *const scenes[] = {&lab_dam,    &lab_vortex,  &lab_drop, &lab_plate,
                                    &lab_magnet, &lab_kernels, &lab_cloud};
enum { SCENES = sizeof scenes / sizeof *scenes };
static lab_scene *now; /* the one that is open */

/* ---------------------------------------------------------------- what scenes share */

static uint32_t random_state;
void lab_seed(uint32_t seed) { random_state = seed; }
double lab_random(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return random_state / 4294967296.0 - 0.5;
}
int lab_neighbours(int dim, sph_points points, sph_scalars radius, int criterion, sph_list *list)
{
    static double memory[4 << 20]; /* 32 MB */
    sph_neighbors found;
    const sph_index answer = sph_search(dim, points, radius, criterion, memory, sizeof memory, &found);
    if (answer >= 0) *list = found.list;
    return (int)answer;
}

/* ---------------------------------------------------------------- scenes */

int lab_scenes(void) { return SCENES; }
static int is_scene(int s) { return s >= 0 && s < SCENES; }
const char *lab_name(int s) { return is_scene(s) ? scenes[s]->name : NULL; }
const char *lab_title(int s) { return is_scene(s) ? scenes[s]->title : NULL; }
const char *lab_about(int s) { return is_scene(s) ? scenes[s]->about : NULL; }
const char *lab_hint(int s) { return is_scene(s) ? scenes[s]->hint : NULL; }
int lab_steps(int s) { return is_scene(s) && scenes[s]->step; }
const char *lab_status_text(int answer) { return sph_status_text(answer); }

static int looked(void) { return now->look ? now->look() : 0; }
int lab_reset(void)
{
    if (!now) return SPH_ERROR_NULL;
    LAB_TRY(now->reset());
    return looked();
}
int lab_open(int s)
{
    int i;
    if (!is_scene(s)) return SPH_ERROR_VALUE;
    now = scenes[s];
    for (i = 0; i < now->n_controls; i++) now->controls[i].value = now->controls[i].usual;
    return lab_reset();
}
int lab_step(int count)
{
    if (!now) return SPH_ERROR_NULL;
    for (; count > 0 && now->step; count--) LAB_TRY(now->step());
    return looked();
}
double lab_time(void) { return now ? now->time : 0; }
int lab_point(int phase, double px, double py)
{
    if (!now) return SPH_ERROR_NULL;
    if (!isfinite(px) || !isfinite(py)) return SPH_ERROR_VALUE;
    if (!now->point) return 0;
    LAB_TRY(now->point(phase, px, py));
    return looked();
}

/* ---------------------------------------------------------------- controls */

int lab_controls(void) { return now ? now->n_controls : 0; }
static int is_control(int i) { return i >= 0 && i < lab_controls(); }
const char *lab_control_name(int i) { return is_control(i) ? now->controls[i].name : NULL; }
const char *lab_control_label(int i) { return is_control(i) ? now->controls[i].label : NULL; }
const char *lab_control_choices(int i) { return is_control(i) ? now->controls[i].choices : NULL; }
double lab_control_least(int i) { return is_control(i) ? now->controls[i].least : 0; }
double lab_control_most(int i) { return is_control(i) ? now->controls[i].most : 0; }
double lab_control_step(int i) { return is_control(i) ? now->controls[i].step : 0; }
double lab_control_value(int i) { return is_control(i) ? now->controls[i].value : 0; }
int lab_set(int i, double value)
{
    double before;
    int answer;
    if (!is_control(i) || !(value >= now->controls[i].least && value <= now->controls[i].most))
        return SPH_ERROR_VALUE;
    if (now->controls[i].choices && value != floor(value)) return SPH_ERROR_VALUE;
    before = now->controls[i].value;
    now->controls[i].value = value;
    answer = now->changed(i);
    if (answer < 0) now->controls[i].value = before;
    return answer < 0 ? answer : looked();
}

/* ---------------------------------------------------------------- what there is to see */

int lab_particles(void) { return now ? now->n : 0; }
int lab_moving(void) { return now ? now->n_moving : 0; }
int lab_chosen(void) { return now ? now->chosen : -1; }
const double *lab_x(void) { return now ? now->x : NULL; }
const double *lab_y(void) { return now ? now->y : NULL; }
double lab_size(void) { return now ? now->size : 0; }
double lab_view(int side) { return now && side >= 0 && side < 4 ? now->view[side] : 0; }
int lab_fields(void) { return now ? now->n_fields : 0; }
static int is_field(int i) { return i >= 0 && i < lab_fields(); }
const char *lab_field_name(int i) { return is_field(i) ? now->fields[i].name : NULL; }
const double *lab_field_values(int i) { return is_field(i) ? now->fields[i].values : NULL; }
double lab_field_least(int i) { return is_field(i) ? now->fields[i].least : 0; }
double lab_field_most(int i) { return is_field(i) ? now->fields[i].most : 0; }
int lab_measures(void) { return now ? now->n_measures : 0; }
static int is_measure(int i) { return i >= 0 && i < lab_measures(); }
const char *lab_measure_name(int i) { return is_measure(i) ? now->measures[i].name : NULL; }
double lab_measure_value(int i) { return is_measure(i) ? now->measures[i].value : 0; }
int lab_curves(void) { return now ? now->n_curves : 0; }
static int is_curve(int i) { return i >= 0 && i < lab_curves(); }
int lab_curve_points(void) { return now ? now->n_points : 0; }
const char *lab_curve_name(int i) { return is_curve(i) ? now->curves[i].name : NULL; }
const double *lab_curve_x(void) { return now ? now->curve_x : NULL; }
const double *lab_curve_y(int i) { return is_curve(i) ? now->curves[i].y : NULL; }
int lab_columns(void) { return now ? now->n_columns : 0; }
static int is_column(int i) { return i >= 0 && i < lab_columns(); }
int lab_rows(void) { return now ? now->n_rows : 0; }
const char *lab_column_name(int i) { return is_column(i) ? now->columns[i].name : NULL; }
const double *lab_column_values(int i) { return is_column(i) ? now->columns[i].values : NULL; }

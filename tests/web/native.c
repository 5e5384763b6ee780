/* SPDX-License-Identifier: MIT
 *
 * native.c - runs scenes of examples/web natively, and writes the numbers that a page has after the same calls.
 *
 *     native SCENE STEPS [CONTROL=VALUE ...] > FILE        doubles in this machine's order
 *
 * The order of the numbers is that of `state` in examples/web/lab.js.
 */
#include "examples/web/lab.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void need(int answer)
{
    if (answer < 0) fprintf(stderr, "native: %s\n", lab_status_text(answer)), exit(1);
}
static void put(const double *values, int count)
{
    if (fwrite(values, sizeof *values, (size_t)count, stdout) != (size_t)count) perror("native"), exit(2);
}
int main(int argc, char **argv)
{
    int scene = 0, i, k;
    if (argc < 3) return fprintf(stderr, "native SCENE STEPS [CONTROL=VALUE ...]\n"), 2;
    while (scene < lab_scenes() && strcmp(lab_name(scene), argv[1]) != 0) scene++;
    need(lab_open(scene));
    for (k = 3; k < argc; k++) {
        const char *const value = strchr(argv[k], '=');
        for (i = 0; i < lab_controls(); i++) {
            const size_t length = strlen(lab_control_name(i));
            if (value && length == (size_t)(value - argv[k]) &&
                strncmp(argv[k], lab_control_name(i), length) == 0)
                break;
        }
        need(lab_set(i, value ? atof(value + 1) : 0));
    }
    need(lab_step(atoi(argv[2])));
    put(lab_x(), lab_particles());
    put(lab_y(), lab_particles());
    for (i = 0; i < lab_fields(); i++) put(lab_field_values(i), lab_particles());
    for (i = 0; i < lab_measures(); i++) {
        const double value = lab_measure_value(i);
        put(&value, 1);
    }
    for (i = 0; i < lab_curves(); i++) put(lab_curve_y(i), lab_curve_points());
    for (i = 0; i < lab_columns(); i++) put(lab_column_values(i), lab_rows());
    return fflush(stdout) ? 2 : 0;
}

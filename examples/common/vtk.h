/* SPDX-License-Identifier: MIT
 *
 * vtk.h - particles for ParaView and VisIt: VTK XML files of points (.vtu), and a series of them over time (.pvd).
 *
 *     vtk_series s;
 *     const vtk_field fields[] = {{"velocity", vx, vy, NULL, NULL}, {"density", rho, NULL, NULL, NULL}, {"phase", NULL, NULL, NULL, phase}};
 *     vtk_series_begin(&s, "build/results", "run");            run.pvd, run_0000.vtu, ...
 *     vtk_series_add(&s, t, n, x, y, NULL, fields, 3);         once per picture
 *     vtk_series_end(&s);
 *
 * Numbers have decimal points in every locale. A name of an array is best one word.
 * A file under its final name is whole (part_file.h); the .pvd is complete after each picture, also if the run is cut short.
 * Functions return 0 and leave the cause in errno if a file could not be written, else 1.
 */
#ifndef VTK_H
#define VTK_H

#include "number.h"
#include "part_file.h"

#include <math.h>
#include <stdlib.h>

/* ---- points ---- */

/* One number a particle (x), a vector (x and y; z may be null: 0), or small whole numbers (bytes). */
typedef struct vtk_field {
    const char *name;
    const double *x, *y, *z;
    const unsigned char *bytes;
} vtk_field;

static inline void vtk_number(FILE *to, double value, char after)
{
    char text[NUMBER_TEXT];
    fprintf(to, "%s%c", number_text(text, 9, value), after);
}
static inline void vtk_vectors(FILE *to, int n, const double *x, const double *y, const double *z)
{
    int i;
    for (i = 0; i < n; i++) {
        vtk_number(to, x[i], ' ');
        vtk_number(to, y ? y[i] : 0.0, ' ');
        vtk_number(to, z ? z[i] : 0.0, '\n');
    }
}
/* A name, as XML has it between quotes. */
static inline void vtk_name(FILE *to, const char *name)
{
    for (; *name; name++) {
        if (strchr("&<>\"", *name)) fprintf(to, "&#%d;", *name);
        else putc(*name, to);
    }
}

/* dir/name.vtu; y and z may be null (0) */
static inline int vtk_write_points(const char *dir, const char *name, int n, const double *x, const double *y, const double *z, const vtk_field *fields,
                                   int count)
{
    part_file f;
    int i, k;
    if (!part_file_open(&f, dir, name, "vtu")) return 0;
    fprintf(f.to, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n");
    fprintf(f.to, "<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n", n,
            n);
    vtk_vectors(f.to, n, x, y, z);
    fprintf(f.to, "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n");
    for (i = 0; i < n; i++) fprintf(f.to, "%d\n", i); /* each point is a cell of its own, of type 1 */
    fprintf(f.to, "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n");
    for (i = 0; i < n; i++) fprintf(f.to, "%d\n", i + 1);
    fprintf(f.to, "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
    for (i = 0; i < n; i++) fprintf(f.to, "1\n");
    fprintf(f.to, "</DataArray>\n</Cells>\n<PointData>\n");
    for (k = 0; k < count; k++) {
        const vtk_field *a = &fields[k];
        fprintf(f.to, "<DataArray type=\"%s\" Name=\"", a->bytes ? "UInt8" : "Float64");
        vtk_name(f.to, a->name);
        fprintf(f.to, "\" NumberOfComponents=\"%d\" format=\"ascii\">\n", a->y ? 3 : 1);
        if (a->y) vtk_vectors(f.to, n, a->x, a->y, a->z);
        for (i = 0; i < n && !a->y; i++) {
            if (a->bytes) fprintf(f.to, "%d\n", a->bytes[i]);
            else vtk_number(f.to, a->x[i], '\n');
        }
        fprintf(f.to, "</DataArray>\n");
    }
    fprintf(f.to, "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    return part_file_close(&f);
}

/* ---- a series ---- */

typedef struct vtk_series {
    const char *dir, *name; /* must outlive the series */
    double *time;
    int count;
} vtk_series;

static inline void vtk_series_begin(vtk_series *s, const char *dir, const char *name)
{
    s->dir = dir;
    s->name = name;
    s->time = NULL;
    s->count = 0;
}

/* Makes room for one picture more, of this time; it counts once it is written. */
static inline int vtk_series_room(vtk_series *s, double time)
{
    double *const times = (double *)realloc(s->time, (size_t)(s->count + 1) * sizeof *times);
    if (!times) return 0;
    s->time = times;
    s->time[s->count] = time;
    return 1;
}
/* After vtk_series_begin: a run that goes on from this time keeps what its series has from before. */
static inline void vtk_series_resume(vtk_series *s, double from_time)
{
    static const char before[] = "<DataSet timestep=\"";
    const size_t skip = sizeof before - 1;
    char path[PART_FILE_PATH], line[256];
    const char *end;
    FILE *from;
    double time;
    if (snprintf(path, sizeof path, "%s/%s.pvd", s->dir, s->name) >= (int)sizeof path || !(from = fopen(path, "r"))) return;
    while (fgets(line, sizeof line, from)) {
        if (strncmp(line, before, skip) != 0) continue;
        time = number_of(line + skip, &end);
        if (end > line + skip && *end == '"' && time < from_time - 1e-9 * fabs(from_time)) {
            if (!vtk_series_room(s, time)) break;
            s->count++;
        }
    }
    fclose(from);
}

static inline int vtk_series_add(vtk_series *s, double time, int n, const double *x, const double *y, const double *z, const vtk_field *fields, int count)
{
    char name[PART_FILE_PATH], text[NUMBER_TEXT];
    part_file f;
    int k;
    if (!vtk_series_room(s, time)) return 0;
    errno = ENAMETOOLONG;
    if (snprintf(name, sizeof name, "%s_%04d", s->name, s->count) >= (int)sizeof name) return 0;
    if (!vtk_write_points(s->dir, name, n, x, y, z, fields, count)) return 0;
    s->count++;
    if (!part_file_open(&f, s->dir, s->name, "pvd")) return 0;
    fprintf(f.to, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
    for (k = 0; k < s->count; k++) {
        fprintf(f.to, "<DataSet timestep=\"%s\" file=\"", number_text(text, 12, s->time[k]));
        vtk_name(f.to, s->name);
        fprintf(f.to, "_%04d.vtu\"/>\n", k);
    }
    fprintf(f.to, "</Collection>\n</VTKFile>\n");
    return part_file_close(&f);
}

static inline void vtk_series_end(vtk_series *s)
{
    free(s->time);
    s->time = NULL;
}

#endif

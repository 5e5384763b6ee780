/* SPDX-License-Identifier: MIT
 *
 * mpi_arrays.c - do the arrays that mpi_pictures.py prints lie in their HDF5 file as it says, with numbers that
 * are finite? Arguments: the folder of the file, and that of the list.
 */
#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    char file[256], path[256], kind[16], name[1024];
    FILE *const list = argc == 3 ? fopen(argv[2], "r") : NULL;
    int bytes, arrays = 0;
    long count;
    while (list && fscanf(list, "%255s %255s %15s %d %ld", file, path, kind, &bytes, &count) == 5) {
        hid_t f, data, space, type;
        hsize_t size[2] = {0, 1}, k;
        long width = 1;
        double *values;
        int c = fgetc(list), bad;
        if (c == ' ' && fscanf(list, "%ld", &width) != 1) return 2;
        snprintf(name, sizeof name, "%s/%s", argv[1], file);
        f = H5Fopen(name, H5F_ACC_RDONLY, H5P_DEFAULT);
        data = H5Dopen2(f, path, H5P_DEFAULT);
        space = H5Dget_space(data);
        type = H5Dget_type(data);
        H5Sget_simple_extent_dims(space, size, NULL);
        bad = H5Sget_simple_extent_ndims(space) != (width > 1 ? 2 : 1) || (long)size[0] != count || (long)size[1] != width ||
              (int)H5Tget_size(type) != bytes || H5Tget_class(type) != (kind[0] == 'F' ? H5T_FLOAT : H5T_INTEGER);
        if (bad) return printf("%s is not what the pictures say\n", path), 1;
        values = malloc((size_t)(count * width) * sizeof *values);
        if (!values || H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) return printf("%s cannot be read\n", path), 1;
        for (k = 0; k < size[0] * size[1]; k++)
            if (!isfinite(values[k])) return printf("%s has no number at %lu\n", path, (unsigned long)k), 1;
        free(values);
        H5Dclose(data), H5Sclose(space), H5Tclose(type), H5Fclose(f);
        arrays++;
    }
    printf("%d arrays\n", arrays);
    return arrays < 5;
}

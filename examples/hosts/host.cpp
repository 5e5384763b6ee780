// SPDX-License-Identifier: MIT
//
// host.cpp - a C++ code with its own particles: sph.h works on the members of a std::vector<Particle>, which are not copied. No shim: C++ includes the headers.
//
//     g++ -std=c++11 -O2 -I. examples/hosts/host.cpp -o host && ./host              (from the repository's root)
//
// A corrected gradient of a linear field and a row of the M-SPH Laplacian, both exact on a disordered cloud; and the kernels against the known answers. Exit status 0 if all is right.

#include "sph.h"
#include "known.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace
{

struct Particle {
    double position[2], velocity[2], mass, density, temperature; // whatever the code has
};
static_assert(sizeof(Particle) % sizeof(sph_real) == 0, "strides count sph_real");
const size_t stride = sizeof(Particle) / sizeof(sph_real);

const sph_kernel kernel = SPH_WENDLAND_C2; // constants: everything folds
const int dim = 2, side = 21;

int failures = 0;
void expect(const char *what, double value, double exact, double tolerance)
{
    const bool right = std::fabs(value - exact) <= tolerance;
    std::printf("%-52s %18.12f  exact %g%s\n", what, value, exact, right ? "" : "  WRONG");
    failures += !right;
}

void known_answers(const char *path)
{
    std::vector<known_row> row(KNOWN_MAX);
    const int rows = known_read(path, row.data());
    std::vector<double> w(KNOWN_MAX), f(KNOWN_MAX);
    for (int i = 0; i < rows; i++) {
        const sph_wf v = sph_kernel_wf(sph_kernel(row[i].kernel), row[i].dim, row[i].r, row[i].h);
        w[i] = v.w;
        f[i] = v.f;
    }
    const int bad = rows ? known_compare(rows, row.data(), w.data(), f.data(), 8 * SPH_EPSILON) : 1;
    std::printf("known answers: %d rows, %d off\n", rows, bad);
    failures += bad != 0;
}

} // namespace

int main(int argc, char **argv)
{
    const double dx = 1.0 / side, h = 1.3 * dx, volume = dx * dx, mobility = 0.5;
    std::vector<Particle> particle;
    for (int i = 0; i < side * side; i++) {
        Particle p = {};
        p.position[0] = dx * (i % side + 0.5 + 0.2 * std::sin(37.0 * i));
        p.position[1] = dx * (i / side + 0.5 + 0.2 * std::cos(53.0 * i));
        p.temperature = 0.7 + 1.3 * p.position[0] - 0.8 * p.position[1];
        particle.push_back(p);
    }
    const sph_index n = sph_index(particle.size()), middle = n / 2;

    // views of the members: nothing is copied
    const sph_points points = sph_points_strided(n, &particle[0].position[0], &particle[0].position[1], nullptr, stride);
    const sph_scalars temperature = sph_scalars_strided(&particle[0].temperature, stride);
    const sph_scalars H = sph_scalars_same(&h), V = sph_scalars_same(&volume), m = sph_scalars_same(&mobility);

    const double radius = h * sph_kernel_support(kernel);
    const sph_scalars R = sph_scalars_same(&radius);
    std::vector<char> work(sph_grid_workspace(dim, n));
    std::vector<sph_index> start(n + 1), index(40 * n);
    sph_grid grid;
    int64_t pairs = 0;
    if (sph_grid_build(dim, points, radius, work.data(), work.size(), &grid) != 0 ||
        sph_grid_lists(dim, &grid, points, SPH_GATHER, R, R, 0, start.data(), index.data(), int64_t(index.size()), &pairs) != 0)
        return std::puts("no neighbour lists"), 1;
    const sph_list list = {start.data(), index.data()};

    const sph_cloud cloud = sph_cloud_of(points, list, H, V);

    std::vector<double> gx(n), gy(n);
    sph_derivative_out gradient = {};
    gradient.gx = gx.data();
    gradient.gy = gy.data();
    const sph_index not_ok = sph_gradient_cspm(kernel, dim, cloud, temperature, gradient);
    if (not_ok != 0) return std::puts(sph_status_text(not_ok)), 1;
    expect("gradient at a corner, x", gx[0], 1.3, 1e-12);
    expect("gradient at a corner, y", gy[0], -0.8, 1e-12);
    expect("gradient in the middle, x", gx[middle], 1.3, 1e-12);
    expect("gradient in the middle, y", gy[middle], -0.8, 1e-12);

    // one row of div(m grad u): with options.trace exact for a linear u and for |x|^2
    std::vector<double> row(index.size()), diagonal(n);
    sph_elliptic_options options = sph_elliptic_defaults();
    options.trace = 1;
    sph_row_out out = {};
    out.row = row.data();
    out.diagonal = diagonal.data();
    const sph_cloud one = sph_cloud_range(cloud, middle, middle + 1);
    if (sph_elliptic_rows_msph(kernel, dim, one, m, options, out) != 0) return std::puts("no row"), 1;
    double linear = 0, square = 0, sum = diagonal[middle];
    const Particle &a = particle[middle];
    for (sph_index p = start[middle]; p < start[middle + 1]; p++) {
        const Particle &b = particle[index[p]];
        linear += row[p] * (b.temperature - a.temperature);
        square += row[p] * (b.position[0] * b.position[0] + b.position[1] * b.position[1] - a.position[0] * a.position[0] - a.position[1] * a.position[1]);
        sum += row[p];
    }
    std::printf("M-SPH row of particle %d: %d neighbours, diagonal %.6f\n", int(middle), int(start[middle + 1] - start[middle]), diagonal[middle]);
    expect("M-SPH, sum of the row", sum, 0, 1e-9);
    expect("M-SPH, div(m grad u) of a linear u", linear, 0, 1e-9);
    expect("M-SPH, div(m grad u) of u = x^2 + y^2", square, 4 * mobility, 1e-9);

    known_answers(argc > 1 ? argv[1] : "tests/known/kernels.csv");
    return failures != 0;
}

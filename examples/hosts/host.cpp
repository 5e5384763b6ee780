// SPDX-License-Identifier: MIT
//
// host.cpp - a C++ code with its own particles: sph.h works on the members of a std::vector<Particle>, which
// are not copied. No shim: C++ includes the headers.
//
//     g++ -std=c++11 -O2 -I. examples/hosts/host.cpp -o host && ./host         (from the repository's root)
//
// A corrected gradient of a linear field and a row of the M-SPH Laplacian, both exact on a disordered cloud;
// a density, which goes into the structs, against a loop of the host's own; and the kernels against the known
// answers. Exit status 0 if all is right.

#include <cstdio>

#define EXAMINE 0 // 1: prints what is likely wrong with the cloud
#define SPH_REFUSED(argument, particle, error) \
    std::printf("%s: %s, first at particle %d\n", argument, sph_status_text(error), int(particle))
#include "sph.h"
#include "known.h"

#include <cmath>
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

// the doctor of a new cloud; M-SPH sums over pairs, and asks for both of their
// supports
void examine(sph_cloud cloud)
{
    sph_findings found = {};
    sph_cloud_examine(kernel, dim, cloud, 1, 0, &found); // what is an error is for the sweeps to tell
    for (int i = 0; i < SPH_FINDING_COUNT; i++) {
        const sph_offender &at = found.at[i];
        if (!(found.set >> i & 1)) continue;
        std::printf("particle %d, neighbour %d, ratio %g: %s\n", int(at.particle), int(at.neighbour),
                    at.ratio, sph_finding_text(i));
        failures++;
    }
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
        p.mass = volume;
        p.temperature = 0.7 + 1.3 * p.position[0] - 0.8 * p.position[1];
        particle.push_back(p);
    }
    const sph_index n = sph_index(particle.size()), middle = n / 2;

    // views of the members: nothing is copied
    double *const at = particle[0].position;
    const sph_points points = sph_points_strided(n, at, at + 1, nullptr, stride);
    const sph_scalars temperature = sph_scalars_strided(&particle[0].temperature, stride);
    const sph_scalars H = sph_scalars_same(&h), V = sph_scalars_same(&volume),
                      m = sph_scalars_same(&mobility);

    // the neighbours, in memory that grows until it is large enough; the lists live as long as it does
    const double radius = sph_kernel_support(kernel, h);
    const sph_scalars R = sph_scalars_same(&radius);
    std::vector<char> memory;
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(dim, points, R, SPH_GATHER, memory.data(), memory.size(), &found)) ==
           SPH_ERROR_CAPACITY)
        memory.resize(sph_search_size(dim, n, found.pairs));
    if (answer != 0) return std::puts(sph_status_text(answer)), 1;

    const sph_cloud cloud = sph_cloud_checked(dim, sph_cloud_of(points, found.list, H, V));
    if (EXAMINE) examine(cloud);

    std::vector<double> gx(n), gy(n);
    sph_derivatives_out gradient = {};
    gradient.gx = gx.data();
    gradient.gy = gy.data();
    answer = sph_gradient_cspm(kernel, dim, cloud, temperature, gradient);
    if (answer != 0) return std::puts(sph_status_text(answer)), 1;
    expect("gradient at a corner, x", gx[0], 1.3, 1e-12);
    expect("gradient at a corner, y", gy[0], -0.8, 1e-12);
    expect("gradient in the middle, x", gx[middle], 1.3, 1e-12);
    expect("gradient in the middle, y", gy[middle], -0.8, 1e-12);

    // every other operator is called in the same way; results go into members, too
    answer = sph_density_summation(kernel, dim, cloud, sph_scalars_strided(&particle[0].mass, stride),
                                   sph_scalar_out_strided(&particle[0].density, stride, nullptr));
    if (answer != 0) return std::puts(sph_status_text(answer)), 1;

    // one row of div(m grad u): with options.trace exact for a linear u and for |x|^2
    std::vector<double> row(size_t(found.pairs)), diagonal(n);
    sph_elliptic_options options = {};
    options.trace = 1;
    sph_rows_out out = {};
    out.row = row.data();
    out.diagonal = diagonal.data();
    const sph_cloud one = sph_cloud_range(cloud, middle, middle + 1);
    answer = sph_elliptic_rows_msph(kernel, dim, one, m, options, out);
    if (answer != 0) return std::puts(sph_status_text(answer)), 1;
    double linear = 0, square = 0, sum = diagonal[middle];
    double density = particle[middle].mass * sph_kernel_w(kernel, dim, 0, h);
    const sph_index first = found.list.start[middle], last = found.list.start[middle + 1];
    const auto r2 = [](const Particle &p) {
        return p.position[0] * p.position[0] + p.position[1] * p.position[1];
    };
    for (sph_index p = first; p < last; p++) {
        const Particle &a = particle[middle], &b = particle[found.list.index[p]];
        linear += row[p] * (b.temperature - a.temperature);
        square += row[p] * (r2(b) - r2(a));
        sum += row[p];
        const double r = std::hypot(a.position[0] - b.position[0], a.position[1] - b.position[1]);
        density += b.mass * sph_kernel_w(kernel, dim, r, h);
    }
    std::printf("M-SPH row of particle %d: %d neighbours, diagonal %.6f\n", int(middle), int(last - first),
                diagonal[middle]);
    expect("M-SPH, sum of the row", sum, 0, 1e-9);
    expect("M-SPH, div(m grad u) of a linear u", linear, 0, 1e-9);
    expect("M-SPH, div(m grad u) of u = x^2 + y^2", square, 4 * mobility, 1e-9);

    expect("density over its sum", particle[middle].density / density, 1, 1e-12);

    known_answers(argc > 1 ? argv[1] : "tests/known/kernels.csv");
    return failures != 0;
}

// SPDX-License-Identifier: MIT
//
// nanoflann.cpp - all neighbours of all points by nanoflann (a header-only k-d tree; Debian: libnanoflann-dev), for bench.c to compare with: index built with
// leaf size 10, one unsorted radius search per point into one vector that keeps its memory. The matches are counted, not copied into one list: less work.
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

namespace
{
template <typename real> struct cloud {
    const real *x[3];
    std::size_t n;
    std::size_t kdtree_get_point_count() const { return n; }
    real kdtree_get_pt(std::size_t i, std::size_t axis) const { return x[axis][i]; }
    template <class box> bool kdtree_get_bbox(box &) const { return false; }
};

template <typename real, int dim> long long matches(const cloud<real> &points, real radius)
{
    typedef nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<real, cloud<real>>, cloud<real>, dim, std::uint32_t> tree;
    tree index(dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(10));
#if NANOFLANN_VERSION >= 0x150
    std::vector<nanoflann::ResultItem<std::uint32_t, real>> found;
    nanoflann::SearchParameters parameters;
#else
    std::vector<std::pair<std::uint32_t, real>> found;
    nanoflann::SearchParams parameters;
#if NANOFLANN_VERSION < 0x142
    index.buildIndex(); // later ones build it when constructed
#endif
#endif
    long long sum = 0;
    parameters.sorted = false;
    for (std::size_t i = 0; i < points.n; i++) {
        const real p[3] = {points.x[0][i], points.x[1][i], dim > 2 ? points.x[2][i] : real(0)};
        sum += static_cast<long long>(index.radiusSearch(p, radius * radius, found, parameters));
    }
    return sum;
}
template <typename real> long long matches(int dim, std::size_t n, const real *x, const real *y, const real *z, real radius)
{
    const cloud<real> points = {{x, y, z}, n};
    return dim == 2 ? matches<real, 2>(points, radius) : matches<real, 3>(points, radius);
}
} // namespace

// The number of pairs, each point with itself included; -1 if memory runs out.
extern "C" long long nanoflann_double(int dim, std::size_t n, const double *x, const double *y, const double *z, double radius)
{
    try {
        return matches<double>(dim, n, x, y, z, radius);
    } catch (...) {
        return -1;
    }
}
extern "C" long long nanoflann_float(int dim, std::size_t n, const float *x, const float *y, const float *z, float radius)
{
    try {
        return matches<float>(dim, n, x, y, z, radius);
    } catch (...) {
        return -1;
    }
}

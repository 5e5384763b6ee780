// SPDX-License-Identifier: MIT
//
// nanoflann.cpp - for bench.c: nanoflann, a k-d tree in one header (Debian: libnanoflann-dev). The tree has
// leaves of 10 points and is built in each run. There is one unsorted search per point, into one vector that
// keeps its memory: the neighbours are counted, not copied into one list, which is less work than ours.
#include "peer.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

namespace
{
struct points {
    peer_cloud c;
    std::size_t kdtree_get_point_count() const { return c.n; }
    peer_real kdtree_get_pt(std::size_t i, std::size_t axis) const
    {
        return (axis == 0 ? c.x : axis == 1 ? c.y : c.z)[i];
    }
    template <class box> bool kdtree_get_bbox(box &) const { return false; }
};
typedef nanoflann::L2_Simple_Adaptor<peer_real, points> distance;
typedef nanoflann::KDTreeSingleIndexAdaptor<distance, points, 3, std::uint32_t> tree;

void *make(const peer_cloud *c) { return new points{*c}; }
long long run(void *made)
{
    const points &p = *static_cast<points *>(made);
    tree index(3, p, nanoflann::KDTreeSingleIndexAdaptorParams(10));
#if NANOFLANN_VERSION >= 0x150
    std::vector<nanoflann::ResultItem<std::uint32_t, peer_real>> found;
    nanoflann::SearchParameters parameters;
#else
    std::vector<std::pair<std::uint32_t, peer_real>> found;
    nanoflann::SearchParams parameters;
#if NANOFLANN_VERSION < 0x142
    index.buildIndex(); // later ones build it when constructed
#endif
#endif
    long long sum = 0;
    parameters.sorted = false;
    for (std::size_t i = 0; i < p.c.n; i++) {
        const peer_real x[3] = {p.c.x[i], p.c.y[i], p.c.z[i]}, radius = p.c.radius[p.c.each ? i : 0];
        sum += static_cast<long long>(index.radiusSearch(x, radius * radius, found, parameters));
    }
    return sum - static_cast<long long>(p.c.n); // not itself
}
void end(void *made) { delete static_cast<points *>(made); }
} // namespace

extern "C" const peer peer_nanoflann;
const peer peer_nanoflann = {"nanoflann", make, run, end};

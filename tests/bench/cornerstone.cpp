// SPDX-License-Identifier: MIT
//
// cornerstone.cpp - for bench.c: the octree of cornerstone, on the CPU, in one thread. Each run computes
// keys, sorts the particles along its curve, builds the tree (leaves of 64, as in its tests) and searches for each
// particle. All neighbours are written into the same memory: into no list, which is less work than ours.
//
// Written for the interface published at github.com/sekelle/cornerstone-octree (C++20; commits 9ef2dc3 and
// 244ef7f), and compiled against a copy of these declarations. It has not been run.
#include "peer.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <cstone/findneighbors.hpp>

namespace
{
typedef std::uint64_t key;
enum { MOST = 4096, LEAF = 64 };

void *make(const peer_cloud *c) { return new peer_cloud(*c); }
long long run(void *made)
{
    using namespace cstone;
    const peer_cloud &c = *static_cast<peer_cloud *>(made);
    const auto [x0, x1] = std::minmax_element(c.x, c.x + c.n);
    const auto [y0, y1] = std::minmax_element(c.y, c.y + c.n);
    const auto [z0, z1] = std::minmax_element(c.z, c.z + c.n);
    const Box<peer_real> box(*x0, *x1, *y0, *y1, *z0, *z1);

    std::vector<key> keys(c.n);
    std::vector<LocalIndex> order(c.n);
    computeSfcKeys(c.x, c.y, c.z, sfcKindPointer(keys.data()), c.n, box);
    std::iota(order.begin(), order.end(), LocalIndex(0));
    sort_by_key(keys.begin(), keys.end(), order.begin());
    std::vector<peer_real> x(c.n), y(c.n), z(c.n), h(c.n);
    for (std::size_t k = 0; k < c.n; k++) {
        const LocalIndex i = order[k];
        x[k] = c.x[i], y[k] = c.y[i], z[k] = c.z[i];
        h[k] = c.radius[c.each ? i : 0] / 2; // it searches within 2 h
    }

    const auto [leaves, counts] = computeOctree<key>(std::span<const key>(keys), LEAF);
    OctreeData<key, CpuTag> octree;
    octree.resize(nNodes(leaves));
    updateInternalTree<key>(leaves, octree.data());
    std::vector<LocalIndex> layout(counts.size() + 1, 0);
    std::inclusive_scan(counts.begin(), counts.end(), layout.begin() + 1);
    std::vector<Vec3<peer_real>> centers(octree.numNodes), sizes(octree.numNodes);
    const std::span<const key> nodes(octree.prefixes.data(), octree.numNodes);
    nodeFpCenters<key>(nodes, centers.data(), sizes.data(), box);
    OctreeNsView<peer_real, key> view{};
    view.numLeafNodes = octree.numLeafNodes;
    view.prefixes = octree.prefixes.data();
    view.childOffsets = octree.childOffsets.data();
    view.parents = octree.parents.data();
    view.internalToLeaf = octree.internalToLeaf.data();
    view.levelRange = octree.levelRange.data();
    view.leaves = leaves.data();
    view.layout = layout.data();
    view.centers = centers.data();
    view.sizes = sizes.data();

    std::vector<LocalIndex> found(MOST);
    long long sum = 0;
    const peer_real *const hs = h.data();
    for (LocalIndex i = 0; i < c.n; i++)
        sum += findNeighbors(i, x.data(), y.data(), z.data(), hs, view, box, MOST, found.data());
    return sum;
}
void end(void *made) { delete static_cast<peer_cloud *>(made); }
} // namespace

extern "C" const peer peer_cornerstone;
const peer peer_cornerstone = {"cornerstone", make, run, end};

// SPDX-License-Identifier: MIT
//
// compactnsearch.cpp - for bench.c: CompactNSearch, hashed cells, one radius for all. Its object is kept from
// run to run, as it wants to be: because no particle moves, its cells are filled once only, and what is timed
// is less than a step. In one thread.
//
// Written for the interface published at github.com/InteractiveComputerGraphics/CompactNSearch (commit
// 40baa92), and compiled against a copy of these declarations. It has not been run.
#include "peer.h"

#include <vector>

#include <CompactNSearch.h>
#include <omp.h>

namespace
{
struct state {
    std::vector<CompactNSearch::Real> x;
    CompactNSearch::NeighborhoodSearch search;
    explicit state(peer_real radius) : search(radius) {}
};

void *make(const peer_cloud *c)
{
    if (c->each) return nullptr;
    state *const s = new state(c->radius[0]);
    for (std::size_t i = 0; i < c->n; i++) {
        s->x.push_back(c->x[i]);
        s->x.push_back(c->y[i]);
        s->x.push_back(c->z[i]);
    }
    s->search.add_point_set(s->x.data(), c->n);
    return s;
}
long long run(void *made)
{
    state &s = *static_cast<state *>(made);
    long long sum = 0;
    omp_set_num_threads(1);
    s.search.find_neighbors();
    const CompactNSearch::PointSet &points = s.search.point_set(0);
    for (unsigned i = 0; i < points.n_points(); i++) sum += static_cast<long long>(points.n_neighbors(0, i));
    return sum;
}
void end(void *made) { delete static_cast<state *>(made); }
} // namespace

extern "C" const peer peer_compactnsearch;
const peer peer_compactnsearch = {"CompactNSearch", make, run, end};

// SPDX-License-Identifier: MIT
//
// treensearch.cpp - for bench.c: TreeNSearch, an octree with AVX2, which computes in float. Its object is kept
// from run to run, as it wants to be; each run builds the tree and all lists, in one thread.
//
// Written for the interface published at github.com/InteractiveComputerGraphics/TreeNSearch in 2023 (commit
// 2ca1b89), and compiled against a copy of these declarations. It has not been run.
#include "peer.h"

#include <vector>

#include <TreeNSearch>

namespace
{
struct state {
    std::vector<float> x, radius;
    tns::TreeNSearch search;
};

void *make(const peer_cloud *c)
{
    state *const s = new state;
    const int n = static_cast<int>(c->n);
    for (std::size_t i = 0; i < c->n; i++) {
        s->x.push_back(static_cast<float>(c->x[i]));
        s->x.push_back(static_cast<float>(c->y[i]));
        s->x.push_back(static_cast<float>(c->z[i]));
        s->radius.push_back(static_cast<float>(c->radius[c->each ? i : 0]));
    }
    if (!c->each) s->search.set_search_radius(s->radius[0]);
    const int set = c->each ? s->search.add_point_set(s->x.data(), s->radius.data(), n) : s->search.add_point_set(s->x.data(), n);
    s->search.set_active_search(set, set, true);
    s->search.set_n_threads(1);
    return s;
}
long long run(void *made)
{
    state &s = *static_cast<state *>(made);
    long long sum = 0;
    s.search.run();
    for (int i = 0; i < s.search.get_n_points_in_set(0); i++) sum += s.search.get_neighborlist(0, 0, i).size();
    return sum;
}
void end(void *made) { delete static_cast<state *>(made); }
} // namespace

extern "C" const peer peer_treensearch;
const peer peer_treensearch = {"TreeNSearch", make, run, end};

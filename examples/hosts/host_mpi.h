/* SPDX-License-Identifier: MIT
 *
 * host_mpi.h - particles on many ranks: what a code needs around sph.h beyond one machine, by Zoltan and MPI.
 *
 *     cloud_begin(&c, MPI_COMM_WORLD, parts, moved, fields);
 *     i = cloud_add(&c, number);  c.f[0][i] = ...           each rank adds some particles, no matter which
 *     cloud_balance(&c);                                    new owners: recursive bisection, by weights
 *     cloud_halo(&c, radius, criterion);                    which copies of particles of others each rank needs
 *     cloud_exchange(&c, 3, xyz);                           their values: again after each change
 *     cloud_lists(&c, radius, criterion, CLOUD_SORTED);     rows of own particles; copies are sources only
 *     cloud_prune(&c);                                      without copies that no row names
 *     cloud_inner(&c);                                      rows that name no copy first: to be swept in between
 *     cloud_exchange_start(&c, 3, xyz);                     and
 *     cloud_exchange_finish(&c);
 *     cloud_migrate(&c);                                    later: what has crossed a cut goes to its owner
 *
 * Arrays hold own particles, 0 ... n - 1, and behind them copies of others' particles, n ... n_total - 1: the
 * halo. Sweeps of sph.h take that as it is: n targets, n_total sources. A rank may have no particle at all.
 * Along a periodic axis a copy is sent once, as it is; sph.h finds the image. Which particles to send is
 * sph.h's part (sph_part_of, sph_select_near, sph_list_prune); who owns what, and the messages, are Zoltan's.
 * An error on one rank ends all of them, with a message that says where.
 */
#ifndef HOST_MPI_H
#define HOST_MPI_H

#include <math.h>
#include <mpi.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <zoltan.h>
#include <zoltan_comm.h>

#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { CLOUD_FIELDS = 24, CLOUD_TAG = 1200 };
enum { CLOUD_SORTED = 1, CLOUD_ORDERED = 2 }; /* flags of cloud_lists */

typedef struct cloud {
    MPI_Comm comm;
    int rank, ranks, parts;  /* the first `parts` ranks own particles */
    int moved, fields;       /* f[0 ... moved - 1] go where a particle goes; the others are scratch */
    int n, n_total, room;    /* own particles, with their halo, and what the arrays hold */
    double *f[CLOUD_FIELDS]; /* f[0], f[1], f[2]: the position */
    double period[3];        /* lengths of a periodic box that begins at 0; 0: open */
    double *weight;          /* of own particles, for the balance */
    int64_t *number;         /* of each particle, its own in the whole cloud */
    struct Zoltan_Struct *zoltan;
    ZOLTAN_COMM_OBJ *plan;                /* of the halo */
    int sends, room_sends, *send, *to;    /* own particle and rank of each copy that is sent */
    int criterion;                        /* what the halo was chosen for, -1 if there is none */
    double *reach;                        /* and the radius of each own particle */
    sph_index *start, *index;             /* the lists */
    int64_t pairs, capacity;
    void *work;
    size_t work_size;
    int inner;                            /* the first of own particles, whose rows name own ones only */
    int under_way, coming[CLOUD_FIELDS];  /* how many fields an exchange has sent, and which; 0: there is none */
    double *sent, *received;
    double seconds;                       /* of the processor, by cloud_clock */
    int64_t values, exchanges, left;      /* what was sent, and how many particles have left this rank */
} cloud;

static inline void cloud_stop(const cloud *c, const char *what, const char *why)
{
    fprintf(stderr, "rank %d: %s: %s\n", c->rank, what, why);
    fflush(stderr);
    MPI_Abort(c->comm, 1);
    exit(1);
}
static inline void *cloud_memory(const cloud *c, void *p, size_t count, size_t size)
{
    p = realloc(p, count * size + 1); /* 1: nothing is not null */
    if (!p) cloud_stop(c, "memory", "there is not enough");
    return p;
}
static inline void cloud_zoltan(const cloud *c, int answer, const char *what)
{
    if (answer != ZOLTAN_OK && answer != ZOLTAN_WARN) cloud_stop(c, what, "Zoltan cannot do it");
}
/* what sph.h answers: below 0 an error, above 0 particles that are not ok */
static inline void cloud_need(const cloud *c, sph_index answer, const char *what)
{
    if (answer < 0) cloud_stop(c, what, sph_status_text((int)answer));
    if (answer > 0) cloud_stop(c, what, "there are particles that are not ok");
}

static inline void cloud_exchange_finish(cloud *c);

/* room for n particles */
static inline void cloud_room(cloud *c, int n)
{
    int k;
    if (n <= c->room) return;
    c->room = n + n / 4 + 64;
    for (k = 0; k < c->fields; k++) c->f[k] = cloud_memory(c, c->f[k], (size_t)c->room, sizeof(double));
    c->number = cloud_memory(c, c->number, (size_t)c->room, sizeof *c->number);
    c->weight = cloud_memory(c, c->weight, (size_t)c->room, sizeof *c->weight);
    c->reach = cloud_memory(c, c->reach, (size_t)c->room, sizeof *c->reach);
    c->start = cloud_memory(c, c->start, (size_t)c->room + 1, sizeof *c->start);
}
/* A new own particle, all 0, with the weight 1. Not between cloud_halo and the sweeps. */
static inline int cloud_add(cloud *c, int64_t number)
{
    const int i = c->n++;
    int k;
    cloud_room(c, c->n);
    for (k = 0; k < c->fields; k++) c->f[k][i] = 0;
    c->number[i] = number;
    c->weight[i] = 1;
    c->n_total = c->n;
    c->criterion = -1;
    return i;
}
/* the first n particles as points: own ones, or all */
static inline sph_points cloud_points(const cloud *c, int n)
{
    return sph_points_periodic(sph_points_separate(n, c->f[0], c->f[1], c->f[2]), c->period[0], c->period[1], c->period[2]);
}
/* What the sweeps take: own particles as targets, all as sources. In two parts: the inner ones, of which the
   sources are own particles, too, while copies may be on their way; and then the outer ones. */
static inline sph_cloud cloud_view(const cloud *c, sph_scalars h, sph_scalars volume)
{
    const sph_list list = {c->start, c->index};
    return sph_cloud_range(sph_cloud_of(cloud_points(c, c->n_total), list, h, volume), 0, c->n);
}
static inline sph_cloud cloud_view_inner(const cloud *c, sph_scalars h, sph_scalars volume)
{
    const sph_list list = {c->start, c->index};
    return sph_cloud_range(sph_cloud_of(cloud_points(c, c->n), list, h, volume), 0, c->inner);
}
static inline sph_cloud cloud_view_outer(const cloud *c, sph_scalars h, sph_scalars volume)
{
    return sph_cloud_range(cloud_view(c, h, volume), c->inner, c->n);
}

/* Counts the time of the processor between cloud_clock(c, -1) and cloud_clock(c, 1): without waiting for others. */
static inline void cloud_clock(cloud *c, int sign) { c->seconds += sign * (double)clock() / CLOCKS_PER_SEC; }
/* Prints it, and what a particle costs: on n ranks as much as on one, if nothing is done twice or waited for. */
static inline void cloud_say_seconds(const cloud *c, const char *what, int times)
{
    double sum, most;
    long long all = c->n;
    MPI_Reduce(&c->seconds, &sum, 1, MPI_DOUBLE, MPI_SUM, 0, c->comm);
    MPI_Reduce(&c->seconds, &most, 1, MPI_DOUBLE, MPI_MAX, 0, c->comm);
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_LONG_LONG, MPI_SUM, c->comm);
    if (c->rank == 0 && all > 0 && times > 0)
        printf("%s: processor seconds %.2f of all ranks, %.2f of the busiest; %.0f ns a particle and time\n", what, sum, most, 1e9 * sum / ((double)all * times));
}

/* ---------------------------------------------------------------- who owns what */

/* what Zoltan asks for */
static inline int cloud_ask_count(void *data, int *error)
{
    *error = ZOLTAN_OK;
    return ((cloud *)data)->n;
}
static inline void cloud_ask_list(void *data, int globals, int locals, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int weights,
                                  float *weight, int *error)
{
    const cloud *const c = data;
    int i;
    for (i = 0; i < c->n; i++) {
        global[i * globals] = (ZOLTAN_ID_TYPE)(c->number[i] & 0xffffffff);
        global[i * globals + 1] = (ZOLTAN_ID_TYPE)(c->number[i] >> 32);
        local[i * locals] = (ZOLTAN_ID_TYPE)i;
        if (weights) weight[i] = (float)c->weight[i];
    }
    *error = ZOLTAN_OK;
}
static inline int cloud_ask_dim(void *data, int *error)
{
    (void)data;
    *error = ZOLTAN_OK;
    return 3;
}
static inline void cloud_ask_places(void *data, int globals, int locals, int n, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int dim,
                                    double *x, int *error)
{
    const cloud *const c = data;
    int i, k;
    (void)globals, (void)global;
    for (i = 0; i < n; i++)
        for (k = 0; k < dim; k++) x[i * dim + k] = c->f[k][local[i * locals]];
    *error = ZOLTAN_OK;
}

/* parts: how many ranks may own particles, 0 for all. Too few particles for a rank are more halo than work. */
static inline void cloud_begin(cloud *c, MPI_Comm comm, int parts, int moved, int fields)
{
    float version;
    memset(c, 0, sizeof *c);
    c->comm = comm;
    MPI_Comm_rank(comm, &c->rank);
    MPI_Comm_size(comm, &c->ranks);
    c->parts = parts > 0 && parts < c->ranks ? parts : c->ranks;
    c->moved = moved;
    c->fields = fields;
    c->criterion = -1;
    cloud_room(c, 1);
    cloud_zoltan(c, Zoltan_Initialize(0, NULL, &version), "Zoltan_Initialize");
    c->zoltan = Zoltan_Create(comm);
    if (!c->zoltan) cloud_stop(c, "Zoltan_Create", "Zoltan cannot do it");
    Zoltan_Set_Param(c->zoltan, "DEBUG_LEVEL", "0");
    Zoltan_Set_Param(c->zoltan, "LB_METHOD", "RCB");
    Zoltan_Set_Param(c->zoltan, "KEEP_CUTS", "1"); /* so that it names the owner of any point later */
    Zoltan_Set_Param(c->zoltan, "RCB_REUSE", "1"); /* new cuts near the old ones: few particles move */
    Zoltan_Set_Param(c->zoltan, "NUM_GID_ENTRIES", "2");
    Zoltan_Set_Param(c->zoltan, "NUM_LID_ENTRIES", "1");
    Zoltan_Set_Param(c->zoltan, "OBJ_WEIGHT_DIM", "1");
    Zoltan_Set_Param(c->zoltan, "IMBALANCE_TOL", "1.02");
    Zoltan_Set_Param(c->zoltan, "RETURN_LISTS", "PARTS");
    Zoltan_Set_Num_Obj_Fn(c->zoltan, cloud_ask_count, c);
    Zoltan_Set_Obj_List_Fn(c->zoltan, cloud_ask_list, c);
    Zoltan_Set_Num_Geom_Fn(c->zoltan, cloud_ask_dim, c);
    Zoltan_Set_Geom_Multi_Fn(c->zoltan, cloud_ask_places, c);
}
static inline void cloud_end(cloud *c)
{
    int k;
    cloud_exchange_finish(c);
    if (c->plan) Zoltan_Comm_Destroy(&c->plan);
    Zoltan_Destroy(&c->zoltan);
    for (k = 0; k < c->fields; k++) free(c->f[k]);
    free(c->number), free(c->weight), free(c->reach), free(c->start), free(c->index), free(c->work), free(c->send), free(c->to);
}

/* owner[i]: the new rank of own particle i. There is no halo afterwards. */
static inline void cloud_move(cloud *c, const int *owner)
{
    const size_t record = (size_t)c->moved + 2; /* fields, weight, number */
    int *const to = cloud_memory(c, NULL, (size_t)c->n, sizeof *to);
    double *out, *in, *at;
    ZOLTAN_COMM_OBJ *plan = NULL;
    int i, k, leaving = 0, arriving, kept = 0;
    cloud_exchange_finish(c);
    for (i = 0; i < c->n; i++)
        if (owner[i] != c->rank) to[leaving++] = owner[i];
    out = at = cloud_memory(c, NULL, (size_t)leaving * record, sizeof *out);
    for (i = 0; i < c->n; i++)
        if (owner[i] != c->rank) {
            for (k = 0; k < c->moved; k++) *at++ = c->f[k][i];
            *at++ = c->weight[i];
            memcpy(at++, &c->number[i], sizeof *c->number);
        } else {
            for (k = 0; k < c->moved; k++) c->f[k][kept] = c->f[k][i];
            c->weight[kept] = c->weight[i];
            c->number[kept++] = c->number[i];
        }
    cloud_zoltan(c, Zoltan_Comm_Create(&plan, leaving, to, c->comm, CLOUD_TAG, &arriving), "Zoltan_Comm_Create");
    in = at = cloud_memory(c, NULL, (size_t)arriving * record, sizeof *in);
    cloud_zoltan(c, Zoltan_Comm_Do(plan, CLOUD_TAG + 1, (char *)out, (int)(record * sizeof *out), (char *)in), "Zoltan_Comm_Do");
    Zoltan_Comm_Destroy(&plan);
    c->n = c->n_total = kept + arriving;
    c->left += leaving;
    c->criterion = -1;
    cloud_room(c, c->n);
    for (i = kept; i < c->n; i++) {
        for (k = 0; k < c->moved; k++) c->f[k][i] = *at++;
        c->weight[i] = *at++;
        memcpy(&c->number[i], at++, sizeof *c->number);
    }
    free(to), free(out), free(in);
}
/* the largest weight of a rank by their mean */
static inline double cloud_imbalance(const cloud *c)
{
    double own = 0, most, all;
    int i;
    for (i = 0; i < c->n; i++) own += c->weight[i];
    MPI_Allreduce(&own, &most, 1, MPI_DOUBLE, MPI_MAX, c->comm);
    MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, c->comm);
    return all > 0 ? most * c->parts / all : 1;
}
/* New cuts; particles go to their owners. Along periodic axes they must be in the box, 0 ... period. */
static inline void cloud_balance(cloud *c)
{
    int changed, globals, locals, imports, exports, i;
    int *import_rank = NULL, *import_part = NULL, *rank = NULL, *part = NULL;
    ZOLTAN_ID_PTR import_global = NULL, import_local = NULL, global = NULL, local = NULL;
    int *const owner = cloud_memory(c, NULL, (size_t)c->n, sizeof *owner);
    long long all = c->n;
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_LONG_LONG, MPI_SUM, c->comm);
    if (all < c->parts) c->parts = (int)all; /* Zoltan gives each part something, or fails */
    if (c->parts < c->ranks) Zoltan_Set_Param(c->zoltan, "NUM_LOCAL_PARTS", c->rank < c->parts ? "1" : "0");
    for (i = 0; i < c->n; i++) owner[i] = c->rank;
    if (all == 0) exports = 0;
    else cloud_zoltan(c, Zoltan_LB_Partition(c->zoltan, &changed, &globals, &locals, &imports, &import_global, &import_local, &import_rank,
                                             &import_part, &exports, &global, &local, &rank, &part), "Zoltan_LB_Partition");
    for (i = 0; i < exports; i++) owner[local[i * locals]] = rank[i];
    cloud_move(c, owner);
    Zoltan_LB_Free_Part(&import_global, &import_local, &import_rank, &import_part);
    Zoltan_LB_Free_Part(&global, &local, &rank, &part);
    free(owner);
}
/* The cuts stay; particles that have crossed one go to their new owner. */
static inline void cloud_migrate(cloud *c)
{
    int *const owner = cloud_memory(c, NULL, (size_t)c->n, sizeof *owner), i, part;
    for (i = 0; i < c->n; i++) {
        double x[3] = {c->f[0][i], c->f[1][i], c->f[2][i]};
        cloud_zoltan(c, Zoltan_LB_Point_PP_Assign(c->zoltan, x, &owner[i], &part), "Zoltan_LB_Point_PP_Assign");
    }
    cloud_move(c, owner);
    free(owner);
}

/* ---------------------------------------------------------------- halo */

/* whether no image of low ... high meets from ... to, for certain; low > high if there is nothing */
static inline int cloud_apart(double low, double high, double from, double to, double period)
{
    const double more = 1e-9 * (fabs(low) + fabs(high) + fabs(from) + fabs(to)); /* more than roundings */
    if (low > high || from > to) return 1;
    if (period > 0) return ceil((low - more - to) / period) > floor((high + more - from) / period);
    return low - more > to || high + more < from;
}
static inline int cloud_boxes_apart(const cloud *c, sph_vec low, sph_vec high, sph_vec from, sph_vec to)
{
    return cloud_apart(low.x, high.x, from.x, to.x, c->period[0]) || cloud_apart(low.y, high.y, from.y, to.y, c->period[1]) ||
           cloud_apart(low.z, high.z, from.z, to.z, c->period[2]);
}
static inline void cloud_plan(cloud *c)
{
    int arriving;
    if (c->plan) Zoltan_Comm_Destroy(&c->plan);
    cloud_zoltan(c, Zoltan_Comm_Create(&c->plan, c->sends, c->to, c->comm, CLOUD_TAG + 2, &arriving), "Zoltan_Comm_Create");
    c->n_total = c->n + arriving;
    cloud_room(c, c->n_total);
}
/* Finds which own particles other ranks need for lists of this criterion with these radii of targets, which may
   be smaller then; all of the halo's values, positions too, are yet to be sent. */
static inline void cloud_halo(cloud *c, sph_scalars radius, int criterion)
{
    const sph_points own = cloud_points(c, c->n);
    sph_part mine, *const part = cloud_memory(c, NULL, (size_t)c->ranks, sizeof *part);
    sph_index *const chosen = cloud_memory(c, NULL, (size_t)c->n, sizeof *chosen);
    int64_t count, i;
    int r;
    cloud_need(c, sph_part_of(3, own, radius, &mine), "sph_part_of");
    MPI_Allgather(&mine, (int)sizeof mine, MPI_BYTE, part, (int)sizeof mine, MPI_BYTE, c->comm);
    for (i = 0; i < c->n; i++) c->reach[i] = radius.p[(size_t)i * radius.stride];
    c->criterion = criterion;
    for (c->sends = r = 0; r < c->ranks; r++) {
        if (r == c->rank || (cloud_boxes_apart(c, mine.low, mine.high, part[r].reach_low, part[r].reach_high) &&
                             cloud_boxes_apart(c, mine.reach_low, mine.reach_high, part[r].low, part[r].high)))
            continue;
        cloud_need(c, sph_select_near(3, own, radius, criterion, part[r], chosen, &count), "sph_select_near");
        if (c->sends + count > c->room_sends) {
            c->room_sends = (int)(c->sends + count + count / 2);
            c->send = cloud_memory(c, c->send, (size_t)c->room_sends, sizeof *c->send);
            c->to = cloud_memory(c, c->to, (size_t)c->room_sends, sizeof *c->to);
        }
        for (i = 0; i < count; i++) {
            c->send[c->sends] = (int)chosen[i];
            c->to[c->sends++] = r;
        }
    }
    cloud_plan(c);
    free(part), free(chosen);
}
/* Sends these fields of the particles that others need, and receives those of the halo, in two parts. What was
   sent may change after the first; what comes is there after the second, which does nothing where nothing is
   under way. In between inner rows may be swept (cloud_inner); copies hold no number then, so that it shows if
   they are read. */
static inline void cloud_exchange_start(cloud *c, int count, const int *field)
{
    double *to;
    int i, k;
    cloud_exchange_finish(c);
    c->sent = to = cloud_memory(c, NULL, (size_t)c->sends * (size_t)count, sizeof *c->sent);
    c->received = cloud_memory(c, NULL, (size_t)(c->n_total - c->n) * (size_t)count, sizeof *c->received);
    for (i = 0; i < c->sends; i++)
        for (k = 0; k < count; k++) *to++ = c->f[field[k]][c->send[i]];
    cloud_zoltan(c, Zoltan_Comm_Do_Post(c->plan, CLOUD_TAG + 3, (char *)c->sent, count * (int)sizeof *c->sent, (char *)c->received),
                 "Zoltan_Comm_Do_Post");
    for (k = 0; k < count; k++) {
        c->coming[k] = field[k];
        for (i = c->n; i < c->n_total; i++) c->f[field[k]][i] = NAN;
    }
    c->under_way = count;
    c->values += (int64_t)c->sends * count;
    c->exchanges++;
}
static inline void cloud_exchange_finish(cloud *c)
{
    const double *from;
    int i, k;
    if (!c->under_way) return;
    cloud_zoltan(c, Zoltan_Comm_Do_Wait(c->plan, CLOUD_TAG + 3, (char *)c->sent, c->under_way * (int)sizeof *c->sent, (char *)c->received),
                 "Zoltan_Comm_Do_Wait");
    for (from = c->received, i = c->n; i < c->n_total; i++)
        for (k = 0; k < c->under_way; k++) c->f[c->coming[k]][i] = *from++;
    free(c->sent), free(c->received);
    c->under_way = 0;
}
static inline void cloud_exchange(cloud *c, int count, const int *field)
{
    cloud_exchange_start(c, count, field);
    cloud_exchange_finish(c);
}
/* The same for whole numbers of all particles: c->number, or rows of a matrix. */
static inline void cloud_exchange_numbers(cloud *c, int64_t *number)
{
    int64_t *const out = cloud_memory(c, NULL, (size_t)c->sends, sizeof *out);
    int i;
    for (i = 0; i < c->sends; i++) out[i] = number[c->send[i]];
    cloud_zoltan(c, Zoltan_Comm_Do(c->plan, CLOUD_TAG + 3, (char *)out, (int)sizeof *out, (char *)(number + c->n)), "Zoltan_Comm_Do");
    c->values += c->sends;
    c->exchanges++;
    free(out);
}

/* ---------------------------------------------------------------- lists */

/* Own particle order[i] becomes number i, in all that is kept of it but for the lists; place: room for where each
   of them has gone. */
static inline void cloud_permute(cloud *c, const sph_index *order, sph_index *place)
{
    double *const sorted = cloud_memory(c, NULL, (size_t)c->n, sizeof *sorted);
    int64_t *const numbers = cloud_memory(c, NULL, (size_t)c->n, sizeof *numbers);
    int i, k;
    cloud_need(c, sph_permute_inverse(c->n, order, place), "sph_permute_inverse");
    for (k = 0; k < c->moved + 2; k++) {
        double *const a = k < c->moved ? c->f[k] : k == c->moved ? c->weight : c->reach;
        cloud_need(c, sph_permute(c->n, order, a, 1, sorted), "sph_permute");
        memcpy(a, sorted, (size_t)c->n * sizeof *a);
    }
    for (i = 0; i < c->n; i++) numbers[i] = c->number[order[i]];
    memcpy(c->number, numbers, (size_t)c->n * sizeof *numbers);
    for (i = 0; i < c->sends; i++) c->send[i] = (int)place[c->send[i]];
    free(sorted), free(numbers);
}
/* Own particles into the order of the grid, which makes the sweeps faster; the halo stays as it comes. */
static inline void cloud_order(cloud *c, sph_grid *grid)
{
    sph_index *const order = cloud_memory(c, NULL, (size_t)c->n_total * 2, sizeof *order);
    cloud_need(c, sph_grid_permutation_own(grid, c->n, order), "sph_grid_permutation_own");
    cloud_permute(c, order, order + c->n_total);
    cloud_need(c, sph_grid_renumber_own(grid, c->n), "sph_grid_renumber_own");
    free(order);
}
/* Own particles whose rows name own ones only come first, with their rows: c->inner of them. After cloud_lists. */
static inline void cloud_inner(cloud *c)
{
    sph_index *const order = cloud_memory(c, NULL, (size_t)c->n * 2, sizeof *order), *const place = order + c->n;
    sph_index *const start = cloud_memory(c, NULL, (size_t)c->n + 1, sizeof *start);
    sph_index *const index = cloud_memory(c, NULL, (size_t)c->capacity, sizeof *index), p;
    int i, next = 0, outer;
    for (i = 0; i < c->n; i++) { /* place: whether a row names a copy */
        place[i] = 0;
        for (p = c->start[i]; p < c->start[i + 1]; p++) place[i] |= c->index[p] >= c->n;
    }
    for (outer = 0; outer < 2; outer++) {
        for (i = 0; i < c->n; i++)
            if (place[i] == outer) order[next++] = i;
        if (!outer) c->inner = next;
    }
    cloud_permute(c, order, place);
    for (start[0] = 0, i = 0; i < c->n; i++) {
        start[i + 1] = start[i];
        for (p = c->start[order[i]]; p < c->start[order[i] + 1]; p++) index[start[i + 1]++] = c->index[p] < c->n ? place[c->index[p]] : c->index[p];
    }
    memcpy(c->start, start, ((size_t)c->n + 1) * sizeof *start);
    free(c->index);
    c->index = index;
    free(order), free(start);
}
/* Lists of own particles among all. The positions of the halo must be there, and radii that are its own; so
   must its numbers with CLOUD_SORTED, which gives sums the same roundings on any number of ranks. (For that the
   rows must be the same, too: sph.h adds several pairs abreast, so that even a pair of which W is 0 changes how
   the others are rounded.) CLOUD_ORDERED
   sorts own particles, too. A halo that was chosen for less is refused: rows would lack neighbours. */
static inline void cloud_lists(cloud *c, sph_scalars radius, int criterion, int flags)
{
    sph_points targets;
    sph_grid grid;
    sph_query query;
    sph_index answer;
    int i;
    const size_t size = sph_grid_workspace(3, c->n_total);
    if (criterion != c->criterion) cloud_stop(c, "cloud_lists", "the halo was chosen for another criterion, or before particles moved");
    for (i = 0; i < c->n; i++)
        if (radius.p[(size_t)i * radius.stride] > c->reach[i]) {
            char why[160];
            snprintf(why, sizeof why, "the halo is too small: it was chosen for the radius %g, and the lists ask for %g", c->reach[i],
                     radius.p[(size_t)i * radius.stride]);
            cloud_stop(c, "cloud_lists", why);
        }
    if (size > c->work_size) c->work = cloud_memory(c, c->work, c->work_size = size + size / 4, 1);
    cloud_need(c, sph_grid_build(3, cloud_points(c, c->n_total), radius, c->work, c->work_size, &grid), "sph_grid_build");
    if (flags & CLOUD_ORDERED) cloud_order(c, &grid);
    targets = cloud_points(c, c->n);
    query = sph_query_of(targets, criterion, radius, 0);
    while ((answer = sph_grid_lists(3, &grid, query, c->start, c->index, c->capacity, &c->pairs)) == SPH_ERROR_CAPACITY) {
        c->capacity = c->pairs + c->pairs / 8;
        c->index = cloud_memory(c, c->index, (size_t)c->capacity, sizeof *c->index);
    }
    cloud_need(c, answer, "sph_grid_lists");
    if (c->n == 0) c->start[0] = 0;
    c->inner = 0; /* not known */
    if (flags & CLOUD_SORTED) cloud_need(c, sph_list_sort(c->n, c->n_total, c->start, c->index, c->number), "sph_list_sort");
}
/* Leaves in the halo what the rows name. Where radii differ much, the boxes of sph_select_near send several
   times too much; each rank tells the senders, by their plan reversed, what it uses. */
static inline void cloud_prune(cloud *c)
{
    const int halo = c->n_total - c->n;
    sph_index *const kept = cloud_memory(c, NULL, (size_t)c->n_total, sizeof *kept);
    char *const used = cloud_memory(c, NULL, (size_t)halo, 1), *const wanted = cloud_memory(c, NULL, (size_t)c->sends, 1);
    int64_t count;
    int i, k;
    cloud_need(c, sph_list_prune(c->n, c->n_total, c->start, c->index, kept, &count), "sph_list_prune");
    memset(used, 0, (size_t)halo);
    for (i = c->n; i < count; i++) {
        used[kept[i] - c->n] = 1;
        for (k = 0; k < c->fields; k++) c->f[k][i] = c->f[k][kept[i]];
        c->number[i] = c->number[kept[i]];
    }
    cloud_zoltan(c, Zoltan_Comm_Do_Reverse(c->plan, CLOUD_TAG + 4, used, 1, NULL, wanted), "Zoltan_Comm_Do_Reverse");
    for (i = k = 0; i < c->sends; i++)
        if (wanted[i]) {
            c->send[k] = c->send[i];
            c->to[k++] = c->to[i];
        }
    c->sends = k;
    cloud_plan(c);
    if (c->n_total != count) cloud_stop(c, "cloud_prune", "what is sent is not what is used");
    free(kept), free(used), free(wanted);
}

#endif

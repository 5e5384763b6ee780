/* SPDX-License-Identifier: MIT
 *
 * threads.h - a loop over 0 ... n - 1 in parts, which the threads of the program share. The toolkit starts no
 * threads; this is how a host does it (C99 has none; these are POSIX threads).
 *
 *     static long density(void *data, long first, long last)         a sweep over a range of targets
 *     {
 *         const gas *g = data;
 *         return sph_density_summation(k, 2, sph_cloud_range(g->cloud, first, last), g->m, g->rho);
 *     }
 *     const option_spec specs[] = {..., THREADS_OPTION};              -threads 4 on the command line
 *     expect(threads_each(g->cloud.points.n, density, g));
 *
 * The answer is that of one call over all of them, as sweeps answer: the sum, or the first part's error. What
 * a part writes must depend on no other part; then results do not depend on the number of threads. A part
 * calls threads_each for nothing of its own.
 * With -DTHREADS=1 -pthread; without, one thread does all, which is said once if more are wanted.
 */
#ifndef THREADS_H
#define THREADS_H

#include <stdio.h>

#ifndef THREADS
#define THREADS 0
#endif

typedef long (*threads_part)(void *data, long first, long last);

static int threads_wanted; /* 0: one for each processor */
#define THREADS_OPTION {"threads", THREADS_TEXT, OPTION_INT, &threads_wanted, 0, 1024}
#define THREADS_TEXT "threads that share the work; 0: one for each processor; the results are the same"

#if THREADS
#include <pthread.h>
#include <unistd.h>

enum { THREADS_PARTS = 8 }; /* for each thread: parts do not all take the same time, nor do processors */

typedef struct threads_team {
    pthread_mutex_t lock; /* of all that follows */
    pthread_cond_t begin, end;
    int count, started; /* threads, that of the caller included, 0: not yet known; and those beside it */
    long loop; /* number of the present loop: a thread that sees a new one has work */
    threads_part work;
    void *data;
    long n, parts, next, done; /* parts that were taken, and that are finished */
    long sum, refused;         /* answers; the first part with an error, or `parts` */
} threads_team;
static threads_team threads = {PTHREAD_MUTEX_INITIALIZER,
                               PTHREAD_COND_INITIALIZER,
                               PTHREAD_COND_INITIALIZER,
                               0, 0, 0, NULL, NULL, 0, 0, 0, 0, 0, 0};

/* n part / parts, which may be more than a long holds in between */
static inline long threads_first(const threads_team *t, long part)
{
    return t->n / t->parts * part + t->n % t->parts * part / t->parts;
}
/* Takes parts until there are no more. Called with the lock, which is free while a part runs. */
static inline void threads_work(threads_team *t)
{
    while (t->next < t->parts) {
        const long part = t->next++, first = threads_first(t, part), last = threads_first(t, part + 1);
        long answer;
        pthread_mutex_unlock(&t->lock);
        answer = t->work(t->data, first, last);
        pthread_mutex_lock(&t->lock);
        if (answer > 0) t->sum += answer;
        if (answer < 0 && part < t->refused) t->refused = part;
        if (++t->done == t->parts) pthread_cond_signal(&t->end);
    }
}
static void *threads_run(void *team)
{
    threads_team *const t = (threads_team *)team;
    long seen = 0;
    pthread_mutex_lock(&t->lock);
    for (;;) { /* until the program ends */
        while (t->loop == seen) pthread_cond_wait(&t->begin, &t->lock);
        seen = t->loop;
        threads_work(t);
    }
    return NULL;
}
/* Starts the team; with as many as there can be. */
static inline void threads_start(threads_team *t)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    pthread_t thread;
    t->count = threads_wanted > 0 ? threads_wanted : processors > 0 ? (int)processors : 1;
    while (t->started < t->count - 1 && pthread_create(&thread, NULL, threads_run, t) == 0) {
        pthread_detach(thread);
        t->started++;
    }
    t->count = t->started + 1;
}
/* For what all threads may write: one at a time. */
static inline void threads_lock(void) { pthread_mutex_lock(&threads.lock); }
static inline void threads_unlock(void) { pthread_mutex_unlock(&threads.lock); }

static inline long threads_each(long n, threads_part work, void *data)
{
    threads_team *const t = &threads;
    if (t->count == 0) threads_start(t);
    if (t->count == 1 || n < 2) return work(data, 0, n);
    pthread_mutex_lock(&t->lock);
    t->work = work;
    t->data = data;
    t->n = n;
    t->parts = n < (long)THREADS_PARTS * t->count ? n : (long)THREADS_PARTS * t->count;
    t->refused = t->parts;
    t->next = t->done = t->sum = 0;
    t->loop++;
    pthread_cond_broadcast(&t->begin);
    threads_work(t);
    while (t->done < t->parts) pthread_cond_wait(&t->end, &t->lock);
    pthread_mutex_unlock(&t->lock);
    if (t->refused == t->parts) return t->sum;
    /* that part wrote nothing; again, so that what it notes of the cause is noted last */
    return work(data, threads_first(t, t->refused), threads_first(t, t->refused + 1));
}

#else

static inline void threads_lock(void) {}
static inline void threads_unlock(void) {}

static inline long threads_each(long n, threads_part work, void *data)
{
    if (threads_wanted > 1)
        fprintf(stderr, "one thread, not %d: compiled without -DTHREADS=1 -pthread\n", threads_wanted);
    threads_wanted = 1; /* said once */
    return work(data, 0, n);
}

#endif

#endif

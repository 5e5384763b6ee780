/* SPDX-License-Identifier: MIT */
/*
 * progress.h - one line on stderr for runs of more than a few seconds, written
 * over about once a second, where stderr is a terminal.  C99 cannot ask that:
 * on other systems than these the caller's quiet flag turns the line off.
 */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#if defined(__unix__) || defined(__APPLE__)
#  include <unistd.h>
#  define PROGRESS_SEEN isatty(2)
#else
#  define PROGRESS_SEEN 1
#endif

typedef struct progress {
    const char *label;
    time_t start, shown; /* equal until the line has been printed */
    int quiet;
} progress;

static inline void progress_begin(progress *p, const char *label, int quiet)
{
    p->label = label;
    p->start = p->shown = time(NULL);
    p->quiet = quiet || !PROGRESS_SEEN || getenv("CI"); /* nobody watches a continuous-integration run, and its log keeps every line */
}

/* fraction: the share of the work that is done.  Cheap enough for inner loops
 * of a millisecond or more. */
static inline void progress_update(progress *p, double fraction)
{
    if (p->quiet) return;
    const time_t now = time(NULL);
    const double elapsed = difftime(now, p->start);
    if (elapsed <= 2.0 || difftime(now, p->shown) < 1.0 || !(fraction > 0.0)) return;
    p->shown = now;
    /* The spaces cover what a longer line left behind. */
    fprintf(stderr, "\r%s: %5.1f %%, %.0f s gone, %.0f s left      ", p->label, 100.0 * fraction, elapsed, elapsed * (1.0 - fraction) / fraction);
    fflush(stderr);
}

static inline void progress_end(progress *p)
{
    if (difftime(p->shown, p->start) > 0.0) fprintf(stderr, "\r%s: done in %.0f s                          \n", p->label, difftime(time(NULL), p->start));
    p->shown = p->start;
}

#endif

/* SPDX-License-Identifier: MIT */
/*
 * refusal.h - notes down what the functions say of what they refuse: how often since count was last set to 0,
 * and the last time what. To be included before the headers.
 */
#ifndef REFUSAL_H
#define REFUSAL_H

static struct refusal {
    int count, error;
    long particle;
    const char *argument;
} refusal;
static void refused(const char *argument, long particle, int error)
{
    refusal.count++;
    refusal.argument = argument;
    refusal.particle = particle;
    refusal.error = error;
}
#define SPH_REFUSED(argument, particle, error) refused(argument, (long)(particle), error)

#endif

/* SPDX-License-Identifier: MIT */
/* example.h - what the examples share: stop at the first error, show the progress, print the energy ledger. */
#ifndef PERI_EXAMPLE_H
#define PERI_EXAMPLE_H

#if defined(_MSC_VER) && !defined(_CRT_SECURE_NO_WARNINGS)
#define _CRT_SECURE_NO_WARNINGS /* MSVC: fopen is the C99 way to open a file */
#endif

#include "../peri.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program with the text of an error record. */
static inline void stop(const peri_error *error) {
    char text[256] = "";
    (void)peri_format_error(error, text, (int64_t)sizeof text);
    fprintf(stderr, "\nerror %ld: %s\n", (long)error->code, text);
    exit(EXIT_FAILURE);
}

/* Every call that can fail goes through here: a negative result ends the program, others are handed on (the ids
   and counts of the examples fit 32 bits). */
static inline int32_t must(const peri_body *body, int64_t result) {
    if (result < 0) {
        peri_error error = {0};
        if (body == NULL || peri_get_error(body, &error) < 0 || error.code != (int32_t)result) {
            error.code = (int32_t)result; /* an error without a record of this body, such as that of a picture */
            error.index = -1;
            error.field = "";
            error.text = peri_status_text((int32_t)result);
        }
        stop(&error);
    }
    return (int32_t)result;
}

/* peri_body_create that succeeds or ends the program. */
static inline peri_body *must_create(const peri_body_desc *desc) {
    peri_body *body = NULL;
    peri_error error;
    if (peri_body_create(desc, &body, &error) < 0) stop(&error);
    return body;
}

/* One line that is written over itself whenever a hundredth is done: "label  37 %  step 240  t = 1.608e-05 s". */
static inline void progress(const char *label, const peri_body *body, double duration) {
    static int shown = -1;
    const int done = duration > 0.0 ? (int)(100.0 * peri_time(body) / duration + 1e-6) : 100;
    if (done == shown) return;
    shown = done;
    fprintf(stderr, "\r%s %3d %%  step %ld  t = %.4g s ", label, done, (long)peri_step_count(body), peri_time(body));
    if (done == 100) fputc('\n', stderr);
    (void)fflush(stderr);
}

/* The ledger: what came in = what is still there + what was used up + what the time step left open. */
static inline void print_energy(peri_body *body) {
    peri_energy e;
    (void)must(body, peri_get_energy(body, &e));
    printf("energy [J]   in:   initial %.4e   external %.4e   obstacle %.4e\n", e.initial, e.external, e.obstacle);
    printf("             has:  kinetic %.4e   elastic  %.4e   contact  %.4e\n", e.kinetic, e.elastic, e.contact);
    printf("             used: fracture %.4e  damping  %.4e\n", e.fracture, e.damping);
    printf("             open: %.1e\n", e.error);
}

#endif

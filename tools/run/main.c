/* SPDX-License-Identifier: MIT */
/* peri_run [-q] DECK [DIRECTORY]: runs the scene of a deck and writes its results into DIRECTORY (.). README.md lists the sections. */
#include "run.h"
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
    const int  quiet = argc > 1 && strcmp(argv[1], "-q") == 0;
    run_fault  fault = {""};
    run_scene *scene;
    int        result;
    argv += quiet;
    argc -= quiet;
    if (argc != 2 && argc != 3) {
        (void)fprintf(stderr, "peri_run [-q] DECK [DIRECTORY]\n  -q  no progress line, probes alone\n  see tools/run/README.md\n");
        return 2;
    }
    scene = (run_scene *)malloc(sizeof *scene);
    if (scene == NULL) return EXIT_FAILURE;
    result = run_scene_read(scene, argv[1], argc == 3 ? argv[2] : ".", quiet, &fault);
    if (result < 0) (void)fprintf(stderr, "\n%s\n", fault.text);
    run_scene_free(scene);
    free(scene);
    return result < 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

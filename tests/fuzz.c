/* SPDX-License-Identifier: MIT */
/* fuzz.c - libFuzzer drives the library by random programs (make fuzz). SOURCE OF TRUTH: program.h.
   Compiled with -DFUZZ_REPLAY a program of its own, that tells the calls of the files it is given. */
#include "program_run.h"

static program life;

#ifdef FUZZ_REPLAY
int main(int argc, char **argv) {
    static uint8_t bytes[1 << 16];
    int k, faults = 0;
    for (k = 1; k < argc; ++k) {
        FILE *file = fopen(argv[k], "rb");
        size_t size = file ? fread(bytes, 1, sizeof bytes, file) : 0;
        if (file) (void)fclose(file);
        printf("%s: %d bytes\n", argv[k], (int)size);
        run_program(&life, bytes, size, 1);
        if (life.fault) printf("line %d, in %s: not true: %s\n", life.fault_line, life.fault_call, life.fault);
        faults += life.fault != NULL;
    }
    return faults;
}
#else
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    run_program(&life, bytes, size, 0);
    if (life.fault) {
        fprintf(stderr, "line %d, in %s: not true: %s\n", life.fault_line, life.fault_call, life.fault);
        abort();
    }
    return 0;
}
#endif

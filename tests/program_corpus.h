/* program_corpus.h - programs worth keeping: those that have found what was wrong, and those that reach far, in hex. The tests run them,
   and the fuzzer starts from them. */
#ifndef PROGRAM_CORPUS_H
#define PROGRAM_CORPUS_H

static const char *const corpus[] = {
    "03",
};
#define CORPUS ((int)(sizeof corpus / sizeof *corpus))

#endif

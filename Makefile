# SPDX-License-Identifier: MIT
# make demo      builds and runs the flagship: dynamic crack branching in glass -> out/branching.png, out/branching.vtu
# make test      builds and runs every test, closing with "N passed, N failed"
# make validate  the long tables of the source texts, 50,000 random scenes (WHOLE=1: 200,000), a million steps, sanitizers of all
# make bench     performance tables, about five minutes; build/bench/bench --large: 8 million points
# make tradeoff  error against time and memory over the knobs, about 12 minutes -> out/tradeoff.csv, .md and pictures
# make machines  the extremes and some tests on 32-bit x86, ARM and s390x, emulated, more than an hour
# make examples  builds and runs every example
# make run       build/run/peri_run, which runs the scene of a text file: tools/run/README.md
# make gallery   the experiments and figures of the source texts, some minutes -> docs/gallery.md and its pictures
# make lib       build/libperi.a and build/libperi.so (with WERROR= where a compiler warns of what ours do not)
# make install   header, single file, libraries, pkg-config and CMake files, licence: PREFIX=/usr/local, DESTDIR=, INCLUDEDIR=, LIBDIR=
# make uninstall the same, removed
# make dist      build/dist/peri.h, the single-file header
# make mutants   small mistakes put into the library, one at a time: which do the tests not see? About two hours; NEAR=1 the nearest tests
#                alone, M=17, M=100-150 or M=part_of_a_name, LONG=1 with the long tables, too; needs python3
# make fuzz      random programs by libFuzzer under sanitizers, FUZZ_TIME seconds long (300); needs clang
# make bindings  bindings/api.json, peri.h as data, and what is made of it for other languages; needs python3
# make wasm      build/js, a package for node and browsers: WebAssembly and a typed layer (bindings/js); needs emcc and node
# make web       build/web/index.html, the page where one strikes glass, in one file (web)
# make web-test  the layer under node, the page in headless Chromium; needs npm
# make python    build/python, the Python package of bindings/python with the library of build/; needs python3
# make lessons   the six lessons of docs/lessons -> out/lessons; needs NumPy and matplotlib
# make lint      strict warnings under every compiler found, static analysis, house rules
# make clean     removes build/ and out/

CC ?= cc
CFLAGS ?= -O2
WERROR ?= -Werror
STRICT = -std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef $(WERROR)
OPENMP := $(shell echo 'int main(void){return 0;}' | $(CC) -fopenmp -x c - -o /dev/null 2>/dev/null && echo -fopenmp)
COMPILE = $(CC) $(STRICT) $(CFLAGS) $(OPENMP) -I.
# peri.h states the version; before 1.0 the minor version is the interface
VERSION := $(shell sed -n 's/^.define PERI_VERSION *"\([^"]*\)"$$/\1/p' peri.h)
SONAME = $(if $(filter Darwin,$(shell uname)),,-Wl,-soname,libperi.so.$(basename $(VERSION)))
NATIVE = $(shell for n in -march=native -mcpu=native; do \
    echo 'int main(void){return 0;}' | $(CC) $$n -x c - -o /dev/null 2>/dev/null && echo $$n && break; done)

# threads that wait must not spin where other work shares the machine
export OMP_WAIT_POLICY ?= passive

SOURCES = peri.h peri_impl.c $(wildcard src/*/*)
EXAMPLES = $(basename $(notdir $(wildcard examples/*.c)))
TESTS = $(basename $(notdir $(wildcard tests/test_*.c)))
GALLERY = $(basename $(notdir $(wildcard examples/gallery/*.c)))
EXTREMES = $(basename $(notdir $(wildcard tests/extremes/*.c)))

.PHONY: all demo run programs test validate bench tradeoff machines examples gallery lib install uninstall dist mutants fuzz bindings python lessons lint clean
all: lib

# The library is one unit (peri_impl.c). Here the kernels of each precision and dimension are objects of their own, compiled side by side
# and left alone by edits elsewhere.
KERNELS = d2 d3 m2 m3 f2 f3
KERNEL_TEXT = peri.h $(wildcard src/base/*.h src/laws/*.h src/laws/*.inl src/kernels/*)
KERNEL_d = -DPERI_T_REAL=64 -DPERI_T_BOND=64
KERNEL_m = -DPERI_T_REAL=64 -DPERI_T_BOND=32
KERNEL_f = -DPERI_T_REAL=32 -DPERI_T_BOND=32
OBJECTS = $(KERNELS:%=build/kernels/%.o) build/core.o

build/kernels/%2.o: $(KERNEL_TEXT)
	@mkdir -p $(@D)
	$(COMPILE) -fPIC -DPERI_SPLIT $(KERNEL_$*) -DPERI_T_DIM=2 -c src/kernels/unit.c -o $@

build/kernels/%3.o: $(KERNEL_TEXT)
	@mkdir -p $(@D)
	$(COMPILE) -fPIC -DPERI_SPLIT $(KERNEL_$*) -DPERI_T_DIM=3 -c src/kernels/unit.c -o $@

build/core.o: peri.h peri_impl.c $(filter-out src/kernels/%,$(SOURCES))
	@mkdir -p $(@D)
	$(COMPILE) -fPIC -DPERI_SPLIT -c peri_impl.c -o $@

build/libperi.a: $(OBJECTS)
	rm -f $@
	$(AR) rcs $@ $^

# all that the parts share among themselves is hidden by compiler.h: peri_* alone is left
build/libperi.so: $(OBJECTS)
	$(CC) -shared $(SONAME) $(OPENMP) $(LDFLAGS) $^ -o $@ -lm

lib: build/libperi.a build/libperi.so

PREFIX ?= /usr/local
INCLUDEDIR = $(PREFIX)/include
LIBDIR = $(PREFIX)/lib
DOCDIR = $(PREFIX)/share/doc/peri
INSTALL = CC="$(CC)" OPENMP="$(OPENMP)" VERSION="$(VERSION)" PREFIX="$(PREFIX)" INCLUDEDIR="$(INCLUDEDIR)" LIBDIR="$(LIBDIR)" \
    DOCDIR="$(DOCDIR)" DESTDIR="$(DESTDIR)" sh tools/install.sh

install: lib dist
	@$(INSTALL)

uninstall:
	@$(INSTALL) --remove

# The library as others compile it, for tests/checks.sh: again the kernels apart, so that an edit elsewhere leaves them alone. OTHER of a
# target is its compiler and flags. gcc's -Og takes the least of compiling and running together under sanitizers (clang has none such), and
# a trap half the time of a message: SANITIZE="-g1 -Og -fsanitize=address,undefined" says what was undefined. -ffast-math is tried by make validate with gcc
# where there is one, on the vectors of 16 bytes that other machines have; the core's arithmetic is as written by the same pragma, and what
# it would fold is folded without optimisation, too. OWN_ of a directory: the kernels that are compiled so; the others are those of the
# library. make validate compiles all, and the core as the kernels (tests/run.sh); and with the checks of null pointers, of alignment, of
# sums of pointers and of sizes of objects, which take half of the time, and see little that the address sanitizer does not.
OWN_san = d2 d3
OWN_clang = d3 f2
OWN_fast = f2
SANITIZE ?= -g1 $(if $(findstring clang,$(CC)),-O0,-Og) -fsanitize=address,undefined -fno-sanitize=pointer-overflow,object-size,null,alignment \
    -fsanitize-undefined-trap-on-error
build/san/%.o: OTHER = $(CC) $(STRICT) $(SANITIZE) $(OPENMP)
build/clang/%.o: OTHER = clang $(STRICT) -O1 -DPERI_KERNELS=1 -DPERI_NO_STDIO
build/clang/core.o: OTHER += -O0
build/fast/%.o: OTHER = $(shell command -v gcc || echo $(CC)) $(STRICT) -O1 -ffast-math -DPERI_KERNELS=2
FAST_CORE ?= -O0
build/fast/core.o: OTHER += $(FAST_CORE)
define other
build/$(1)/%2.o: $(KERNEL_TEXT)
	@mkdir -p $$(@D)
	$$(OTHER) -DPERI_SPLIT $$(KERNEL_$$*) -DPERI_T_DIM=2 -I. -c src/kernels/unit.c -o $$@

build/$(1)/%3.o: $(KERNEL_TEXT)
	@mkdir -p $$(@D)
	$$(OTHER) -DPERI_SPLIT $$(KERNEL_$$*) -DPERI_T_DIM=3 -I. -c src/kernels/unit.c -o $$@

build/$(1)/core.o: $(filter-out src/kernels/%,$(SOURCES))
	@mkdir -p $$(@D)
	$$(OTHER) -DPERI_SPLIT -c peri_impl.c -o $$@

build/$(1)/peri.o: $(OWN_$(1):%=build/$(1)/%.o) $(patsubst %,build/kernels/%.o,$(filter-out $(OWN_$(1)),$(KERNELS))) build/$(1)/core.o
	$(LD) -r $$^ -o $$@
endef
$(foreach o,san clang fast,$(eval $(call other,$(o))))

# programs are compiled beside the library, which takes longest
.SECONDARY:
build/examples/%.o: examples/%.c peri.h $(wildcard examples/*.h extras/*.h)
	@mkdir -p $(@D)
	$(COMPILE) $(UNOPTIMISED) -c $< -o $@

# To optimise a program takes longer than it saves, save where the program itself computes much.
build/tests/%.o build/extremes/%.o build/examples/%.o: UNOPTIMISED = -O0
build/examples/bending.o build/examples/branching.o: UNOPTIMISED =
build/tests/test_bending.o build/tests/test_branching.o build/tests/test_fragments.o build/tests/test_search.o: UNOPTIMISED =
build/tests/test_cracks.o build/tests/test_operator.o: UNOPTIMISED = -O1
build/tests/%.o: tests/%.c peri.h $(wildcard tests/*.h)
	@mkdir -p $(@D)
	$(COMPILE) $(UNOPTIMISED) -c $< -o $@

# peri_run; the tests of its parts include them
RUN_PARTS = $(basename $(notdir $(wildcard tools/run/*.c)))
build/run/%.o: tools/run/%.c tools/run/run.h peri.h extras/peri_view.h
	@mkdir -p $(@D)
	$(COMPILE) -c $< -o $@

build/run/peri_run: $(RUN_PARTS:%=build/run/%.o) build/libperi.a
	$(CC) $(OPENMP) $^ -o $@ -lm

run: build/run/peri_run
build/tests/test_run.o build/tests/test_run_meshes.o: $(wildcard tools/run/*.[ch]) extras/peri_view.h

build/gallery/%.o: examples/gallery/%.c peri.h examples/example.h $(wildcard examples/gallery/*.h)
	@mkdir -p $(@D)
	$(COMPILE) -c $< -o $@

build/extremes/%.o: tests/extremes/%.c peri.h tests/peri_test.h $(wildcard tests/extremes/*.h)
	@mkdir -p $(@D)
	$(COMPILE) $(UNOPTIMISED) -c $< -o $@

build/tests/extremes: $(EXTREMES:%=build/extremes/%.o) build/libperi.a
	@mkdir -p $(@D)
	$(CC) $(OPENMP) $^ -o $@ -lm

build/%: build/%.o build/libperi.a
	$(CC) $(OPENMP) $^ -o $@ -lm

# the same library twice in one program: plain -O2 as users compile it, and with all that the compiler has. The second without
# warnings: what gcc 12 -O3 takes for not initialised is
build/bench/cases_plain.o: FLAGS = $(STRICT) -O2
build/bench/cases_native.o: FLAGS = -std=c99 -w -O3 $(NATIVE)
build/bench/cases_%.o: bench/cases.c $(wildcard bench/*.h) $(SOURCES)
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(OPENMP) -I. -DCASES=cases_$* -c $< -o $@

build/bench/textbook.o: FLAGS = -O2 $(NATIVE)
build/bench/limits.o: FLAGS = -O3 $(NATIVE)
build/bench/%.o: bench/%.c $(wildcard bench/*.h bench/*.inl tests/glass.h)
	@mkdir -p $(@D)
	$(CC) $(STRICT) $(or $(FLAGS),-O2) $(OPENMP) -I. -c $< -o $@

BENCH = bench bars cases_native cases_plain cliffs glass limits runs table textbook work
build/bench/bench: $(BENCH:%=build/bench/%.o) build/libperi.a
	$(CC) $(OPENMP) $^ -o $@ -lm

TRADEOFF = tradeoff tradeoff_motion tradeoff_recipes tradeoff_statics tradeoff_table tradeoff_trial
$(TRADEOFF:%=build/bench/%.o): bench/tradeoff.h peri.h
build/bench/tradeoff: $(TRADEOFF:%=build/bench/%.o) build/libperi.a
	$(CC) $(OPENMP) $^ -o $@ -lm

# the demo takes of the library what its scene requires: the plane, in double precision, in motion
build/demo/peri.o: $(SOURCES)
	@mkdir -p $(@D)
	$(COMPILE) -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -DPERI_NO_STATICS -DPERI_NO_ADVICE -c peri_impl.c -o $@

build/demo/branching: build/examples/branching.o build/demo/peri.o
	$(CC) $(OPENMP) $^ -o $@ -lm

demo: build/demo/branching
	@mkdir -p out
	build/demo/branching

examples: $(EXAMPLES:%=build/examples/%)
	@mkdir -p out
	@for e in $(EXAMPLES); do echo "== $$e"; build/examples/$$e || exit 1; done

gallery: $(GALLERY:%=build/gallery/%)
	@mkdir -p out/gallery
	@for g in $(GALLERY); do echo "== $$g"; build/gallery/$$g || exit 1; done
	@for p in python3 /usr/bin/python3; do $$p -c 'import matplotlib' 2> /dev/null && exec $$p tools/gallery.py; done; \
	echo "gallery: no python3 has matplotlib (Debian: python3-matplotlib): out/gallery has the tables, the pictures and the page are as they were"

programs: $(TESTS:%=build/tests/%) build/tests/extremes $(EXAMPLES:%=build/examples/%) build/libperi.so \
    build/tests/binding_scenes build/run/peri_run $(if $(shell command -v python3),python)

test:
	@mkdir -p build
	@$(MAKE) --no-print-directory -j2 programs && times > build/build.times
	@CC="$(CC)" OPENMP="$(OPENMP)" sh tests/run.sh

validate:
	@mkdir -p build
	@$(MAKE) --no-print-directory -j2 programs && times > build/build.times
	@CC="$(CC)" OPENMP="$(OPENMP)" sh tests/run.sh --long

machines:
	@sh tests/machines.sh

# what is known already is not run again: build/mutants/results.txt
mutants:
	@mkdir -p build/mutants
	@if command -v python3 > /dev/null; then \
	    CC="$(CC)" python3 tools/mutants.py run --jobs 2 $(if $(M),--only $(M)) $(if $(NEAR),--near) $(if $(LONG),--long); \
	else echo "mutants: no python3 on this machine, skipped"; fi

bench: build/bench/bench build/bench/statics build/bench/search
	@mkdir -p out
	build/bench/bench
	build/bench/statics
	build/bench/search

# two processes, the longest problems first
LONGEST = branching crack
TRADES = uniform uniform_3d cantilever cantilever_3d hole crack edge_cracks p_wave p_wave_3d branching
tradeoff: build/bench/tradeoff
	@mkdir -p out build/tradeoff
	@$(MAKE) --no-print-directory -j2 $(LONGEST:%=trade-%) $(patsubst %,trade-%,$(filter-out $(LONGEST),$(TRADES)))
	@{ build/bench/tradeoff --header && cat $(TRADES:%=build/tradeoff/%.csv); } > out/tradeoff.csv
	@cat $(TRADES:%=build/tradeoff/%.md) > out/tradeoff.md
	@for p in python3 /usr/bin/python3; do $$p -c 'import matplotlib' 2> /dev/null && exec $$p tools/tradeoff.py; done; \
	echo "tradeoff: no python3 has matplotlib: out/tradeoff.csv and out/tradeoff.md are made, the pictures are not"

trade-%: build/bench/tradeoff
	@build/bench/tradeoff $*

dist: build/dist/peri.h
build/dist/peri.h: $(SOURCES) tools/dist.awk
	@mkdir -p $(@D)
	awk -f tools/dist.awk peri.h > $@.new
	mv $@.new $@

# tests/program.h says what is checked; the kept programs of tests/program_corpus.h are where it starts
FUZZ_TIME ?= 300
FUZZ = clang -std=c99 -g -O1 -I. -fno-sanitize-recover=all -fsanitize=address,undefined,fuzzer
build/fuzz/peri.o: $(SOURCES)
	@mkdir -p $(@D)
	$(FUZZ)-no-link -c peri_impl.c -o $@

build/fuzz/fuzz: tests/fuzz.c $(wildcard tests/program*.h) build/fuzz/peri.o
	$(FUZZ) $< build/fuzz/peri.o -o $@ -lm

build/fuzz/seeds: tests/test_programs.c $(wildcard tests/program*.h tests/peri_test.h) build/fuzz/peri.o
	$(FUZZ)-no-link $< build/fuzz/peri.o -o $@ -lm

fuzz:
	@mkdir -p build/fuzz build/fuzz_corpus
	@if echo 'int LLVMFuzzerTestOneInput(const char *d, long n) { return !d && n; }' | \
	    clang -w -fsanitize=address,undefined,fuzzer -x c - -o build/fuzz/probe 2>/dev/null; then \
	    $(MAKE) --no-print-directory build/fuzz/fuzz build/fuzz/seeds && build/fuzz/seeds --seeds build/fuzz_corpus && \
	    build/fuzz/fuzz -max_total_time=$(FUZZ_TIME) -timeout=20 -max_len=400 -print_final_stats=1 -artifact_prefix=build/fuzz/ \
	        build/fuzz_corpus; \
	else echo "fuzz: no clang with libFuzzer on this machine, skipped"; fi

bindings:
	python3 tools/api.py
	python3 tools/bind.py

# the Python package with the library of build/: PYTHONPATH=build/python. `pip install bindings/python` compiles its own
PYTHON_PACKAGE = $(filter-out %/_generated.py,$(wildcard bindings/python/peri/*.py)) bindings/python/peri/py.typed
python: build/python/peri/_generated.py
build/python/peri/_generated.py: build/libperi.so bindings/python/generate.py tools/api.py $(PYTHON_PACKAGE)
	@mkdir -p $(@D)
	cp $(PYTHON_PACKAGE) build/libperi.so $(@D)
	python3 bindings/python/generate.py . $@

# docs/lessons: each computes, checks what it says and draws into out/lessons. A python3 with NumPy and matplotlib
LESSONS = $(sort $(basename $(notdir $(wildcard docs/lessons/*.py))))
PYTHON ?= $(shell for p in python3 /usr/bin/python3; do $$p -c 'import matplotlib' 2> /dev/null && echo $$p && break; done)
lessons: $(LESSONS:%=lesson-%)
lesson-%: build/python/peri/_generated.py
	@mkdir -p out/lessons
	@if [ -n "$(PYTHON)" ]; then PYTHONPATH=$(CURDIR)/build/python MPLBACKEND=Agg $(PYTHON) docs/lessons/$*.py; \
	else echo "lessons: no python3 has matplotlib (Debian: python3-matplotlib)"; fi

lint:
	@CC="$(CC)" sh tools/lint.sh

clean:
	rm -rf build out

# WebAssembly and the layer of JavaScript above it: build/js is a package of its own (bindings/js/README.md). peri.wasm is the whole library;
# peri2d.wasm the plane in motion and single precision, for pages. The kernels, where the time goes, are optimised for speed, the rest for size.
EMCC ?= emcc
WASM = $(EMCC) -std=c99 -msimd128 -mnontrapping-fptoint -mbulk-memory -msign-ext -DPERI_NO_STDIO -I.
WASM_2D = -DPERI_NO_3D -DPERI_NO_F64 -DPERI_NO_MIXED -DPERI_NO_STATICS -DPERI_NO_ADVICE -DPERI_NO_OUTPUT
WASM_LINK = $(EMCC) -Oz --no-entry -s STANDALONE_WASM=1 -s ALLOW_MEMORY_GROWTH=1 -s MALLOC=emmalloc -Wl,--growable-table,--export-table \
    -s EXPORTED_FUNCTIONS=@build/wasm/$(or $(CALLS),calls).txt

build/wasm/calls.txt: peri.h
	@mkdir -p $(@D)
	sed -n 's/^PERI_API [^(]*[ *]\(peri_[a-z0-9_]*\)(.*/_\1/p' peri.h | \
	    grep -v -x -e _peri_export_vtu -e _peri_export_frame -e _peri_export_history -e _peri_save_state -e _peri_load_state > $@
	printf '_malloc\n_free\n' >> $@

build/wasm/%2.o: $(KERNEL_TEXT)
	@mkdir -p $(@D)
	$(WASM) -O2 -DPERI_SPLIT $(KERNEL_$*) -DPERI_T_DIM=2 -c src/kernels/unit.c -o $@

build/wasm/%3.o: $(KERNEL_TEXT)
	@mkdir -p $(@D)
	$(WASM) -O2 -DPERI_SPLIT $(KERNEL_$*) -DPERI_T_DIM=3 -c src/kernels/unit.c -o $@

build/wasm/core.o: peri.h peri_impl.c $(filter-out src/kernels/%,$(SOURCES))
	@mkdir -p $(@D)
	$(WASM) -Oz -DPERI_SPLIT -c peri_impl.c -o $@

build/wasm/plane.o: $(SOURCES)
	@mkdir -p $(@D)
	$(WASM) $(WASM_2D) -Oz -c peri_impl.c -o $@

build/js/peri.wasm: build/wasm/core.o $(KERNELS:%=build/wasm/%.o) build/wasm/calls.txt
	@mkdir -p $(@D)
	$(WASM_LINK) $(filter %.o,$^) -o $@

# what a page does without: parts of bodies on several processes, worlds, clouds and cells of the caller's, probes, states as bytes, forces
# for solvers of the caller's, copies, contact of points, laws of bonds, cuts through solids, and what the switches leave out
build/wasm/calls_2d.txt: build/wasm/calls.txt Makefile
	grep -v -e part -e ghost -e mean_gradient -e state_ -e evaluate -e clone -e contact -e disc -e triangle -e rectangle -e perturbed \
	    -e set_families -e solve -e implicit -e matrix -e multiply -e plan -e choose -e outline -e _cracks -e export -e pressure \
	    -e apply_traction -e world -e cells -e grid -e field_at -e interpolate -e _bonds -e set_bond_law -e softening -e set_strength \
	    -e obstacle_state -e get_families -e cut_pairs -e cut_if -e interface -e critical_energy -e add_points -e rigid -e record_breaks \
	    -e in_place $< > $@

build/js/peri2d.wasm: CALLS = calls_2d
build/js/peri2d.wasm: build/wasm/plane.o build/wasm/calls_2d.txt
	@mkdir -p $(@D)
	$(WASM_LINK) $(filter %.o,$^) -o $@

# sizes and offsets are what the compiler makes of peri.h for this machine
build/wasm/sizes.json: tools/api.py peri.h
	@mkdir -p $(@D)
	python3 tools/api.py --sizes > build/wasm/sizes.c
	$(EMCC) -I. -s SINGLE_FILE=1 build/wasm/sizes.c -o build/wasm/sizes.js
	node build/wasm/sizes.js > $@.new
	mv $@.new $@

build/js/api.mjs: tools/bind_js.mjs bindings/api.json build/wasm/sizes.json $(wildcard bindings/js/*)
	@mkdir -p $(@D)
	cp bindings/js/* build/js/
	node tools/bind_js.mjs bindings/api.json build/wasm/sizes.json build/js

.PHONY: wasm web web-test
wasm: build/js/peri.wasm build/js/peri2d.wasm build/js/api.mjs
	@for f in build/js/*.wasm; do echo "$$f: $$(gzip -9c $$f | wc -c) bytes by gzip"; done

build/wasm/scenes: tests/binding_scenes.c build/libperi.a
	@mkdir -p $(@D)
	$(COMPILE) -O0 $^ -o $@ -lm

# the page, in one file: build/web/index.html (web/README.md)
build/web/index.html: build/js/peri.wasm build/js/api.mjs docs/accuracy.md $(wildcard web/*.*)
	node web/build.mjs build/js $@

web: build/web/index.html

# the layer under node, and the page in Chromium; what is not on this machine is skipped by name
web-test:
	@EMCC="$(EMCC)" CC="$(CC)" sh tests/web/run.sh

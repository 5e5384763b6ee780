# SPDX-License-Identifier: MIT
#
# sph.h has nothing to build: copy sph.h, sph_ops.h and sph_kernels.h into your code. This file runs what proves them.

# BSD make obeys the next line; GNU make takes it for a rule that nothing needs
.error : this Makefile is for GNU make, which BSD systems call gmake

CC ?= cc
CFLAGS ?= -O2
WARN = -std=c99 -Wall -Wextra -Wpedantic
# the flags $(1), if the compiler can make something of the program $(2) with them; never -o /dev/null, because there
# are compilers (tcc) that first remove what they write
if_compiles = $(shell f=$$(mktemp) && printf '$(2)\n' | $(CC) $(1) -x c -c -o "$$f" - > /dev/null 2>&1 && echo '$(1)'; rm -f "$$f")
# an older gcc vectorises the drivers' sweeps with it alone; compilers that know not the pragma (tcc, which accepts any flag) go without
SIMD := $(call if_compiles,-fopenmp-simd -DSPH_SIMD=1,double f(int n) { double s = 0; int i; _Pragma("omp simd reduction(+ : s)") for (i = 0; i < n; i++) s += i; return s; })
# the drivers' sweeps are shared by threads where there are POSIX threads; else one does all
PTHREADS := $(call if_compiles,-DTHREADS=1 -pthread,\043include <pthread.h>\n\043include <unistd.h>\nlong processors(void) { return sysconf(_SC_NPROCESSORS_ONLN); })
LDLIBS = -lm
BUILD = build
# make cannot name files whose names have spaces: such a BUILD is reached by a link
ifneq ($(words $(BUILD)),1)
override BUILD := $(shell mkdir -p "$(BUILD)" && cd "$(BUILD)" && link="$${TMPDIR:-/tmp}/sph-build-$$(pwd -P | cksum | cut -d ' ' -f 1)" && ln -sfn "$$(pwd -P)" "$$link" && echo "$$link")
endif
ifneq ($(words $(BUILD)),1)
$(error BUILD, a folder to build in, cannot be made, or TMPDIR has a space)
endif
RESULTS = $(BUILD)/results
FIGURES = $(BUILD)/figures
HEADERS = sph.h sph_ops.h sph_kernels.h

# The groups of drivers: the papers, all in examples/papers, and subjects, each in a folder of its name. A driver's
# name starts with its group's, and GROUP.gp beside it draws the group's figures.
PAPERS = icspm elliptic clustering cleaning
SUBJECTS = fluids solids gas atlas
GROUPS = $(PAPERS) $(SUBJECTS)
FOLDERS = $(addprefix examples/,papers $(SUBJECTS))
COMMON = $(wildcard $(addsuffix /*.h,examples/common $(FOLDERS)))
drivers_in = $(notdir $(basename $(wildcard $(addsuffix /$(1)_*.c,$(FOLDERS)))))
DRIVERS = $(foreach g,$(GROUPS),$(call drivers_in,$(g)))
# what takes longest starts first, so that nothing long is left alone at the end
LONG_RUNS = clustering_shaft cleaning_collapse clustering_cavity elliptic_boundary_values cleaning_orszag_tang icspm_random clustering_box cleaning_disc fluids_vortices atlas_operators fluids_dam fluids_tank clustering_dam cleaning_drop gas_evrard gas_crk gas_kh gas_gresho
SHORT_RUNS = fluids_hydrostatic elliptic_operators elliptic_clouds elliptic_uses elliptic_spe10 elliptic_stability elliptic_slit icspm_dimensions cleaning_shocktube gas_noh gas_sedov gas_sod
LONG_COMPILES = atlas_cost elliptic_boundary_values icspm_dimensions cleaning_disc clustering_flows fluids_drop
THREADED := $(notdir $(basename $(shell grep -l -e THREADS_OPTION -e '[A-Z]_OPTIONS' -e gas_begin $(addsuffix /*.c,$(FOLDERS)))))
# those whose long runs leave restarts, and go on from them; and the tables of long runs that are kept
RESTARTED := $(notdir $(basename $(shell grep -l -e '"continue"' $(addsuffix /*.c,$(FOLDERS)))))
KEPT = examples/papers/long

# Tests of the headers are built twice, in double and in float; tests of what the examples share in double only.
TESTS_DOUBLE = atlas common sparse elliptic_reference collapse liquid_flow conservation_cost
TESTS_OPTIONAL = gsl
TESTS = $(filter-out $(TESTS_DOUBLE) $(TESTS_OPTIONAL),$(patsubst tests/test_%.c,%,$(wildcard tests/test_*.c)))
TESTS_FLOAT = $(TESTS)
TEST_PROGRAMS = $(TESTS:%=$(BUILD)/tests/%) $(TESTS_FLOAT:%=$(BUILD)/tests/%-float) $(TESTS_DOUBLE:%=$(BUILD)/tests/%)
TEST_SCRIPTS = tests/index.sh tests/signatures.sh tests/hosts/generated.sh tests/readme.sh tests/docs.sh tests/compile/matrix.sh tests/compile/names.sh tests/compile/options.sh tests/compile/folding.sh tests/compile/sweeps.sh tests/compile/paths.sh tests/examples.sh tests/atlas.sh tests/threads.sh tests/restarts.sh tests/files.sh tests/faults.sh tests/single.sh tests/bare.sh tests/precision.sh tests/known/derivation.sh tests/gsl.sh tests/petsc.sh

help:
	@echo "make reproduce        run the drivers of papers and subjects, published beside measured values, and print a scoreboard;"
	@echo "                      several at a time, on all processors (-j N: N at a time; -j1: one, with threads)"
	@echo "                      (PETSC=2: the 3D systems of elliptic_spe10 also by PETSc on two ranks, where that is installed)"
	@echo "make reproduce-GROUP  those of a paper ($(PAPERS)) or of a subject ($(SUBJECTS))"
	@echo "make reproduce-full   with more realisations and finer clouds, some at the published size: a day, in any number of"
	@echo "                      pieces (Ctrl-C, and again); compared with the tables of $(KEPT)"
	@echo "make atlas            pages that show what each operator does, measured: $(BUILD)/atlas/index.html (OPTIONS=-full: all kernels)"
	@echo "make test             the tests; the last line is 'N passed, N failed'"
	@echo "make test-sanitize    the tests under the address and undefined-behaviour sanitizers"
	@echo "make check-hosts      C++, Fortran, Python, WebAssembly, OpenCL, CUDA: the hosts whose tools are installed"
	@echo "make check-mpi        hosts on several ranks: Poisson's equation with PETSc, a dam break with Zoltan and parallel HDF5"
	@echo "make check-matrix     the headers with every compiler that is installed: standards, levels, precisions, warnings as errors"
	@echo "make check-embedded   the self-check on microcontrollers and other processors, in emulators; code size and memory"
	@echo "make fuzz             FUZZ_SECONDS (60) of libFuzzer for each target of tests/fuzz, after a replay of its corpus under sanitizers"
	@echo "make bench            time the search, beside other codes, and the operators, beside the machine's limits"
	@echo "make bench-flags      what compilers and flags are worth (OPTIONS: sh tests/bench/run.sh -h)"
	@echo "make bench-compile    seconds of compilation and bytes of code"
	@echo "make bench-gpu        sweeps on a GPU beside one core (needs nvcc and a GPU)"
	@echo "make web              a laboratory in one HTML file, $(BUILD)/web/index.html (needs clang and wasm-ld)"
	@echo "make web-npm          the same module as an npm package, $(BUILD)/web/npm/sph-lab-*.tgz (needs npm)"
	@echo "make check-web        the same in a headless Chromium, against native programs"
	@echo "make docs             the manual, the headers' comments and the Markdown files as pages (needs doxygen)"
	@echo "make coverage         lines and branches of the headers that the tests reach (needs gcovr)"
	@echo "make lint             static analysers, valgrind, the sanitizers of memory and threads: some twelve minutes"
	@echo "make mutation         how many broken formulas the tests notice: an hour (OPTIONS='-n 400')"
	@echo "make figures          PNG of the figures from the last run (needs gnuplot)"
	@echo "make gallery          PNG of examples/README.md, into $(BUILD)/gallery (needs gnuplot)"
	@echo "make install          the headers, and files for CMake and pkg-config, below PREFIX=$(PREFIX); make uninstall removes them"
	@echo "make dist             a tarball, and the three headers as one file, sph_all.h"
	@echo "make check-packages   a host built from every kind of package whose tool is installed"
	@echo "make clean            remove $(BUILD)/"
	@echo "There is nothing to build: copy $(HEADERS) into your code."

# ---------------------------------------------------------------- papers and subjects

reproduce: run-quick-all
reproduce-full: run-full-all
reproduce-%: run-quick-%
	@:

drivers_of = $(if $(filter all,$(1)),$(DRIVERS),$(call drivers_in,$(filter $(GROUPS),$(1))))
long_first = $(filter $(2),$(1)) $(filter-out $(1),$(2))

# Without -j as many compilers as processors, and four drivers side by side. Each has its share of the processors
# as threads: programs share a processor better than threads do.
PROCESSORS := $(shell getconf _NPROCESSORS_ONLN 2> /dev/null || getconf NPROCESSORS_ONLN 2> /dev/null || echo 1)
asked_jobs = $(patsubst -j%,%,$(filter -j%,$(MAKEFLAGS)))
AT_A_TIME = $(or $(asked_jobs),$(shell echo $$(($(PROCESSORS) < 4 ? $(PROCESSORS) : 4))))
SIDE_BY_SIDE = $(filter-out 1,$(AT_A_TIME))
SHARE = $(shell echo $$(($(PROCESSORS) > $(AT_A_TIME) ? $(PROCESSORS) / $(AT_A_TIME) : 1)))
jobs = $(if $(filter -j%,$(MAKEFLAGS)),,-j$(1))

# $(1): group or all; $(2): options. All drivers run (side by side, each with its output in one piece; alone, with a line of progress), then the scoreboard tells; the answer is failure if any driver failed.
define run
	@if [ -z "$(strip $(call drivers_of,$(1)))" ]; then echo "no group of drivers is called '$(1)'; there are: $(GROUPS)"; exit 2; fi
	@mkdir -p "$(RESULTS)" "$(FIGURES)"
	+@$(MAKE) --no-print-directory $(call jobs,$(PROCESSORS)) $(addprefix $(BUILD)/examples/,$(call long_first,$(LONG_COMPILES),$(call drivers_of,$(1))) scoreboard)
	+@rm -f $(patsubst %,"$(RESULTS)/%.csv",$(call drivers_of,$(1))); failed=0; \
	$(if $(SIDE_BY_SIDE),BUILD="$(BUILD)" sh examples/common/progress.sh reproduce-$(1)$(2) "$(RESULTS)/*.csv" $(call drivers_of,$(1)) & watcher=$$!;) \
	$(if $(SIDE_BY_SIDE),CI=1) $(MAKE) --no-print-directory --keep-going $(call jobs,$(AT_A_TIME)) $(if $(SIDE_BY_SIDE),--output-sync=target) \
	    OPTIONS=$(2) THREADS=$(SHARE) $(addprefix driver-,$(call long_first,$(LONG_RUNS),$(call drivers_of,$(1)))) || failed=1; \
	$(if $(SIDE_BY_SIDE),kill $$watcher 2> /dev/null; wait $$watcher;) \
	$(MAKE) --no-print-directory figures || failed=1; \
	echo; $(BUILD)/examples/scoreboard -kept $(KEPT) $(if $(2),-compare) $(patsubst %,"$(RESULTS)/%.csv",$(call drivers_of,$(1))) || failed=1; \
	$(if $(2),if [ $$failed -eq 0 ]; then rm -f "$(RESULTS)"/*.restart; fi;) exit $$failed
endef

THREADS = $(PROCESSORS)
driver-%:
	@echo; echo "======== $*"; $(LAUNCH) $(BUILD)/examples/$* -out "$(RESULTS)" -figures "$(FIGURES)" $(if $(filter $*,$(THREADED)),-threads $(THREADS)) $(OPTIONS) $(if $(filter -full,$(OPTIONS)),$(if $(filter $*,$(RESTARTED)),-continue))
run-quick-%:
	$(call run,$*,)
run-full-%:
	$(call run,$*,-full)

figures:
	@if ! command -v gnuplot > /dev/null 2>&1; then \
	    echo "gnuplot is not installed: no PNG; the figures' data are in $(FIGURES)/*.csv"; \
	else $(MAKE) --no-print-directory $(call jobs,$(PROCESSORS)) $(addprefix figures-,$(call long_first,cleaning,$(GROUPS))); fi
figures-%:
	@if ls "$(FIGURES)"/$*_*.csv > /dev/null 2>&1; then gnuplot -c examples/*/$*.gp "$(FIGURES)" && echo "figures: $(FIGURES)/$*_*.png"; fi

$(BUILD)/examples/scoreboard: examples/common/scoreboard.c $(COMMON)
	@mkdir -p $(@D)
	$(CC) $(WARN) $(CFLAGS) -o $@ $< $(LDLIBS)
# the search, which all drivers share and which takes as long to compile as all else of a short one
$(BUILD)/common/host_search.o: examples/common/host_search.c $(COMMON) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(WARN) $(CFLAGS) $(SIMD) $(PTHREADS) -c -o $@ $<
vpath %.c $(FOLDERS)
$(BUILD)/examples/%: %.c $(BUILD)/common/host_search.o $(COMMON) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(WARN) $(CFLAGS) $(SIMD) $(PTHREADS) -DHOST_LINKED=1 -o $@ $< $(BUILD)/common/host_search.o $(LDLIBS)

# These call many operators, and each for a moment only: they would take longer to compile than to run if all were
# inlined, so that the compiler decides.
$(addprefix $(BUILD)/examples/,$(SHORT_RUNS)): private override CFLAGS += -USPH_FN -DSPH_FN='static __attribute__((unused))'

# make reproduce PETSC=N: this one solves by PETSc, too, on N ranks (the program is made anew if it has been made without)
ifdef PETSC
PETSC_PACKAGES = PETSc $(shell pkg-config --exists mpi && echo mpi)
$(BUILD)/examples/elliptic_spe10: private override CFLAGS += -DHAVE_PETSC=1 $(patsubst -I%,-isystem %,$(shell pkg-config --cflags $(PETSC_PACKAGES)))
$(BUILD)/examples/elliptic_spe10: private override LDLIBS += $(shell pkg-config --libs $(PETSC_PACKAGES))
$(BUILD)/examples/elliptic_spe10: $(shell f="$(BUILD)/examples/elliptic_spe10"; [ ! -e "$$f" ] || nm "$$f" 2> /dev/null | grep -q PetscInitialize || rm -f "$$f")
driver-elliptic_spe10: LAUNCH = mpirun -n $(PETSC)
endif
# pages of what each operator does; they need no tool but a browser. What it costs comes first, because the pages tell it
atlas: $(BUILD)/examples/atlas_cost $(BUILD)/examples/atlas_operators
	@mkdir -p "$(BUILD)/atlas"
	$(BUILD)/examples/atlas_cost -out "$(BUILD)/atlas" -figures "$(BUILD)/atlas" $(OPTIONS)
	$(BUILD)/examples/atlas_operators -out "$(BUILD)/atlas" -figures "$(BUILD)/atlas" -pages "$(BUILD)/atlas" $(OPTIONS)
	@echo "atlas: $(BUILD)/atlas/index.html"

# the pictures that are checked in have gone through pngquant, to 64 colours
GALLERY = $(patsubst examples/%.c,%,$(wildcard examples/*.c))
gallery: $(GALLERY:%=$(BUILD)/gallery/%.csv)
	@if command -v gnuplot > /dev/null 2>&1; then gnuplot -c examples/gallery.gp $(BUILD)/gallery && echo "gallery: $(BUILD)/gallery/*.png"; \
	else echo "gnuplot is not installed: no PNG; the data of the gallery are in $(BUILD)/gallery/*.csv"; fi
$(BUILD)/gallery/%.csv: examples/%.c $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(WARN) $(CFLAGS) -I. -o $(@:.csv=) $< $(LDLIBS)
	$(@:.csv=) -o $@

# ---------------------------------------------------------------- tests

test: $(TEST_PROGRAMS) $(DRIVERS:%=$(BUILD)/examples/%) $(BUILD)/examples/scoreboard
	@CC="$(CC)" BUILD="$(BUILD)" JOBS="$(patsubst -j%,%,$(filter -j%,$(MAKEFLAGS)))" sh tests/run.sh $(TEST_PROGRAMS) $(TEST_SCRIPTS)

# not forced inline: what the sanitizers look at does not depend on it, and they take minutes to compile the copies.
# What runs or compiles for long there and calls sweeps that the others call, too, is left out.
test-sanitize:
	$(MAKE) --no-print-directory BUILD=$(BUILD)/sanitize CFLAGS="-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -DSPH_FN='static inline'" TESTS="$(filter-out invariance,$(TESTS))" TESTS_FLOAT= TESTS_DOUBLE="$(filter-out liquid_flow conservation_cost,$(TESTS_DOUBLE))" DRIVERS="icspm_uniform icspm_random elliptic_slit elliptic_spe10" TEST_SCRIPTS=tests/examples.sh test

# These call more operators than they spend time in: one copy of each (tests/one_copy.h), whatever CFLAGS says,
# takes half as long to compile.
ONE_COPY = contract contract_unchecked elliptic_tensor fits gas
$(foreach t,$(ONE_COPY),$(BUILD)/tests/$(t) $(BUILD)/tests/$(t)-float): private override CFLAGS += -USPH_FN
$(BUILD)/tests/%-float: tests/test_%.c $(wildcard tests/*.h) $(COMMON) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(WARN) $(CFLAGS) -DSPH_SINGLE=1 -I. -o $@ $< $(LDLIBS)
$(BUILD)/tests/%: tests/test_%.c $(wildcard tests/*.h) $(COMMON) $(HEADERS)
	@mkdir -p $(@D)
	$(CC) $(WARN) $(CFLAGS) -I. -o $@ $< $(LDLIBS)

fuzz: $(DRIVERS:%=$(BUILD)/examples/%)
	@CC="$(CC)" BUILD="$(BUILD)" FUZZ_SECONDS="$(FUZZ_SECONDS)" sh tests/fuzz/fuzz.sh

check-packages:
	@CC="$(CC)" BUILD="$(BUILD)" sh tests/packages/packages.sh

docs:
	@if ! command -v doxygen > /dev/null 2>&1; then echo "doxygen is not installed: the manual is at the top of each header"; \
	else mkdir -p $(BUILD) && printf '%s\n' "@INCLUDE = docs/Doxyfile" "OUTPUT_DIRECTORY = $(BUILD)/docs" $(DOXYGEN) | doxygen - && echo "$(BUILD)/docs/html/index.html"; fi

check-hosts:
	@CC="$(CC)" BUILD="$(BUILD)" sh tests/hosts/hosts.sh

# one file, which works from a disk: the module is inside
web:
	@if ! command -v clang > /dev/null 2>&1; then echo "clang is not installed: no page"; elif ! command -v wasm-ld > /dev/null 2>&1; then echo "wasm-ld is not installed (Debian: lld): no page"; \
	else mkdir -p $(BUILD)/web && sh examples/web/build.sh $(BUILD)/web/lab.wasm && sh examples/web/page.sh $(BUILD)/web/lab.wasm > $(BUILD)/web/index.html && echo "$(BUILD)/web/index.html"; fi
web-npm: web
	@if ! command -v npm > /dev/null 2>&1; then echo "npm is not installed: no package"; elif [ -e $(BUILD)/web/lab.wasm ]; then \
	rm -rf $(BUILD)/web/npm && sh examples/web/npm.sh $(BUILD)/web/lab.wasm $(BUILD)/web/npm && cd $(BUILD)/web/npm && npm pack --offline --silent; fi
check-web:
	@CC="$(CC)" BUILD="$(BUILD)" sh tests/web/web.sh
check-mpi:
	@CC="$(CC)" BUILD="$(BUILD)" sh tests/hosts/mpi.sh
check-matrix:
	@BUILD="$(BUILD)" JOBS="$(patsubst -j%,%,$(filter -j%,$(MAKEFLAGS)))" sh tests/compile/matrix.sh full
check-embedded:
	@BUILD="$(BUILD)" sh tests/embedded/embedded.sh

# every line and branch of the headers that the tests reach; one copy of each function, so that a branch is a branch of the source
coverage:
	@if ! command -v gcovr > /dev/null 2>&1; then echo "gcovr is not installed"; exit 2; fi
	$(MAKE) --no-print-directory BUILD=$(BUILD)/coverage CC=gcc CFLAGS="-O0 --coverage -DSPH_FN='static __attribute__((noinline, unused))'" TESTS_FLOAT= DRIVERS= TEST_SCRIPTS= test
	gcovr -r . --object-directory $(BUILD)/coverage -f 'sph[a-z_]*[.]h' --exclude-unreachable-branches --exclude-throw-branches --html-details $(BUILD)/coverage/index.html --print-summary
lint:
	@CC="$(CC)" BUILD="$(BUILD)" sh tests/lint/lint.sh
mutation:
	python3 tests/mutation/mutate.py $(OPTIONS)

bench:
	@CC="$(CC)" BUILD="$(BUILD)" sh tests/bench/run.sh speed $(OPTIONS)
bench-flags bench-compile:
	@CC="$(CC)" BUILD="$(BUILD)" sh tests/bench/run.sh $(@:bench-%=%) $(OPTIONS)
bench-gpu:
	@PATH="$$PATH:/usr/local/cuda/bin"; mkdir -p $(BUILD)/bench; \
	if ! command -v nvcc > /dev/null 2>&1; then echo "nvcc is not installed"; exit 2; fi; \
	for single in 0 1; do \
	    nvcc -std=c++17 -O3 -diag-suppress 128 -DSPH_SINGLE=$$single -I. tests/bench/bench_gpu.cu -o $(BUILD)/bench/bench_gpu && $(BUILD)/bench/bench_gpu || exit 1; \
	    nvcc -std=c++17 -O3 -diag-suppress 128 -DSPH_SINGLE=$$single -I. examples/hosts/host_cuda_vortex.cu -o $(BUILD)/bench/vortex && $(BUILD)/bench/vortex 512 10 || exit 1; \
	done

# ---------------------------------------------------------------- packages

PREFIX = /usr/local
VERSION := $(shell awk '/^\#define SPH_VERSION_(MAJOR|MINOR|PATCH)/ { printf "%s%s", dot, $$3; dot = "." }' sph_kernels.h)
DIST = $(BUILD)/dist

version:
	@echo $(VERSION)
# the same files as by CMake and Meson: none holds the prefix, so that it may be moved
GENERATED = pkgconfig/sph.pc cmake/sph/sphConfig.cmake cmake/sph/sphConfigVersion.cmake
install:
	install -d "$(DESTDIR)$(PREFIX)/include" "$(DESTDIR)$(PREFIX)/share/pkgconfig" "$(DESTDIR)$(PREFIX)/share/cmake/sph"
	install -m 644 $(HEADERS) "$(DESTDIR)$(PREFIX)/include"
	for file in $(GENERATED); do \
	    sed 's/@VERSION@/$(VERSION)/' tests/packages/install/$${file##*/}.in > "$(DESTDIR)$(PREFIX)/share/$$file" || exit 1; \
	done
uninstall:
	rm -f $(HEADERS:%="$(DESTDIR)$(PREFIX)/include/%") $(GENERATED:%="$(DESTDIR)$(PREFIX)/share/%")
	rmdir "$(DESTDIR)$(PREFIX)/share/cmake/sph"
dist:
	@mkdir -p "$(DIST)"
	git archive --prefix=sph-$(VERSION)/ -o "$(DIST)/sph-$(VERSION).tar.gz" HEAD
	sh tests/packages/amalgamate.sh > "$(DIST)/sph_all.h"

clean: # what a link leads to as well
	rm -rf $(BUILD)/* $(BUILD)

.PHONY: help reproduce reproduce-full figures atlas web web-npm gallery test test-sanitize fuzz check-matrix check-hosts check-mpi check-embedded check-web version install uninstall dist check-packages docs coverage lint mutation bench bench-flags bench-compile bench-gpu clean

# SPDX-License-Identifier: MIT
#
# make            static and shared library in build/
# make check      build and run the tests (under a minute)
# make demo       render the gallery into build/gallery/
# make gallery    all pictures, large ones too
# make check_glsl shaders against the library, on engines without a GPU
# make bench      measure; writes build/bench/*.csv
# make report     error against run time, stability, costs: a page, build/report/index.html
# make install    PREFIX=/usr/local DESTDIR= LIBDIR= INCLUDEDIR=
#
# Hooks: CC CXX AR, CFLAGS and LDFLAGS (extra flags), B (build folder), RUN (a wrapper around the
# programs that are run), EXE (their ending). What is in KEEP comes after CFLAGS and cannot be
# overridden: equal bits at every width and compiler depend on it.

B ?= build
AR ?= ar
PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
EXE ?=
RUN ?=
CFLAGS ?=
LDFLAGS ?=

WARN = -pedantic-errors -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla \
       -Wdouble-promotion -Wconversion -Werror
LAW = -std=c99 $(WARN) -fvisibility=hidden
KEEP = -ffp-contract=off -fno-math-errno -fexceptions
COMPILE = $(CC) $(LAW) -O3 -MMD -Iinclude
# V=1 shows the commands.
# Two jobs at a time unless more are asked for.
MAKEFLAGS += -j2
ifndef V
Q := @
SAY = @echo '  $(1)'
endif

# ---- What the compiler can build ----------------------------------------------------------------

TARGET := $(shell $(CC) -dumpmachine)
builds = $(shell printf '\043include <immintrin.h>\nint spt_probe;\n' | \
           $(CC) $(1) -fsyntax-only -x c - >/dev/null 2>&1 && echo yes)
ISAS := scalar
# One lane at a time: half-filled vectors divide what is in their other lanes, too.
flags_scalar := -DSPT_LANES=1 -fno-tree-slp-vectorize
ifneq ($(filter x86_64% amd64%,$(TARGET)),)
ISAS += $(if $(call builds,-msse2),sse2)
ISAS += $(if $(call builds,-mssse3),ssse3)
ISAS += $(if $(call builds,-mavx2),avx2)
ISAS += $(if $(call builds,-mavx512f),avx512)
endif
flags_sse2 := -DSPT_LANES=4 -msse2
flags_ssse3 := -DSPT_LANES=4 -mssse3
flags_avx2 := -DSPT_LANES=8 -mavx2
flags_avx512 := -DSPT_LANES=16 -mavx512f
HAVE := $(patsubst %,-DSPTI_HAVE_%,$(shell echo $(filter-out scalar,$(ISAS)) | tr a-z A-Z))

# ---- The library --------------------------------------------------------------------------------

VERSION_OF = $(shell sed -n 's/^.define SPT_VERSION_$(1) //p' include/spheretrace/base.h)
MAJOR := $(call VERSION_OF,MAJOR)
VERSION := $(MAJOR).$(call VERSION_OF,MINOR).$(call VERSION_OF,PATCH)
METHODS := $(shell sed -n 's/^ *X(\([a-z_]*\)).*/\1/p' src/methods/methods.h)
# The byte shuffle of SSSE3 serves the compaction only.
MARCH_ISAS := $(filter-out ssse3,$(ISAS))

# Kernels of a room that are built once for every instruction set, or those of chunk_table.c:
# src/backend/NAME.c.
KERNELS := prepare compact union cone krs distort
compact_isas := $(filter-out sse2,$(ISAS))
prepare_isas := $(filter-out ssse3 $(if $(filter sse2,$(ISAS)),scalar),$(ISAS))
isas_of = $(or $($(1)_isas),$(ISAS))
PLAIN := $(filter-out src/backend/march.c src/backend/method.c $(KERNELS:%=src/backend/%.c),\
           $(wildcard src/*/*.c))
OBJECTS := $(PLAIN:src/%.c=$B/src/%.o) \
           $(foreach kernel,$(KERNELS),\
             $(patsubst %,$B/src/backend/$(kernel)_%.o,$(call isas_of,$(kernel)))) \
           $(METHODS:%=$B/src/methods/%.o) \
           $(foreach method,$(METHODS),$(MARCH_ISAS:%=$B/src/methods/$(method)_%.o))

STATIC := $B/libspheretrace.a
SHARED := $B/libspheretrace.so.$(VERSION)

.PHONY: all check need_cxx demo gallery bench install uninstall clean
.DELETE_ON_ERROR:
.SUFFIXES:
all: $(STATIC) $(SHARED)

# A change of compiler or flags rebuilds. Kernels are not unrolled: that gains them nothing.
KERNEL_SPEED := -O2 -fno-unroll-loops
SETUP := $(CC) $(KERNEL_SPEED) $(LAW) $(CFLAGS) $(KEEP) $(LDFLAGS) $(foreach isa,$(ISAS),$(isa) $(flags_$(isa)))
$B/setup: $(if $(filter-out $(SETUP),$(shell cat $B/setup 2>/dev/null))$(filter-out \
            $(shell cat $B/setup 2>/dev/null),$(SETUP)),FORCE)
	@mkdir -p $(@D) && printf '%s\n' '$(SETUP)' > $@
FORCE:

$(PLAIN:src/%.c=$B/src/%.o): $B/src/%.o: src/%.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(COMPILE) -fPIC $(HAVE) $(CFLAGS) $(KEEP) -c $< -o $@

# $(1) kernel, $(2) instruction set
define kernel_object
$B/src/backend/$(1)_$(2).o: src/backend/$(1).c $B/setup
	@mkdir -p $$(@D)
	$$(call SAY,$$@)
	$$(Q)$$(COMPILE) -fPIC $$(HAVE) $$(flags_$(2)) -DSPTI_ISA=$(2) $$(CFLAGS) $$(KEEP) -c $$< -o $$@
endef
$(foreach kernel,$(KERNELS),$(foreach isa,$(call isas_of,$(kernel)),\
  $(eval $(call kernel_object,$(kernel),$(isa)))))

# $(1) step rule
define method_object
$B/src/methods/$(1).o: src/backend/method.c $B/setup
	@mkdir -p $$(@D)
	$$(call SAY,$$@)
	$$(Q)$$(COMPILE) -fPIC $$(HAVE) -DSPTI_METHOD=$(1) -DSPTI_RULE='"../methods/$(1).h"' \
	  -DSPTI_RULE_GLSL='"../methods/$(1).glsl.h"' $$(CFLAGS) $$(KEEP) -c $$< -o $$@
endef
$(foreach method,$(METHODS),$(eval $(call method_object,$(method))))

# $(1) step rule, $(2) instruction set
define march_object
$B/src/methods/$(1)_$(2).o: src/backend/march.c $B/setup
	@mkdir -p $$(@D)
	$$(call SAY,$$@)
	$$(Q)$$(COMPILE) -fPIC $$(HAVE) $$(flags_$(2)) -DSPTI_RULE='"../methods/$(1).h"' \
	  -DSPTI_MARCH=spti_march_$(1)_$(2) $$(CFLAGS) $$(KEEP) -c $$< -o $$@
endef
$(foreach method,$(METHODS),$(foreach isa,$(MARCH_ISAS),\
  $(eval $(call march_object,$(method),$(isa)))))

# What every program carries is to be small: what runs once a call or once a ray is compiled for
# size.
CHUNK := $(foreach kernel,prepare compact,\
           $(patsubst %,$B/src/backend/$(kernel)_%.o,$(call isas_of,$(kernel))))
MARCH := $(foreach method,$(METHODS),$(MARCH_ISAS:%=$B/src/methods/$(method)_%.o))
SMALL := backend/isa bound/bound_check bound/volume trace/leave trace/narrow trace/special \
         trace/trace
$(MARCH) $(CHUNK) $B/src/trace/chunk.o: COMPILE := $(subst -O3,$(KERNEL_SPEED),$(COMPILE))
$(SMALL:%=$B/src/%.o): COMPILE := $(subst -O3,-Os,$(COMPILE))

$(STATIC): $(OBJECTS)
	@rm -f $@
	$(call SAY,$@)
	$(Q)$(AR) rcsD $@ $^

$B/exports.map: Makefile
	@mkdir -p $(@D)
	@printf 'SPHERETRACE_$(MAJOR) { global: spt_*; local: *; };\n' > $@

$(SHARED): $(OBJECTS) $B/exports.map
	$(call SAY,$@)
	$(Q)$(CC) -shared -Wl,-soname,libspheretrace.so.$(MAJOR) -Wl,--version-script=$B/exports.map \
	  -Wl,--no-undefined $(CFLAGS) $(LDFLAGS) $(OBJECTS) -lm -o $@
	@ln -sf $(@F) $B/libspheretrace.so.$(MAJOR)
	@ln -sf libspheretrace.so.$(MAJOR) $B/libspheretrace.so

# ---- Scenes and examples ------------------------------------------------------------------------

# The scenes show callers what to do: one source, compiled for each instruction set.
SCENE_LANES := 1 $(if $(filter sse2,$(ISAS)),4) $(if $(filter avx2,$(ISAS)),8) \
               $(if $(filter avx512,$(ISAS)),16)
scene_flags_1 := -fno-tree-vectorize
scene_flags_8 := -mavx2
scene_flags_16 := -mavx512f -mprefer-vector-width=512
SCENE_MISSING := $(if $(filter 4,$(SCENE_LANES)),\
                   $(if $(filter 8,$(SCENE_LANES)),,-DSCENE_NO_AVX2) \
                   $(if $(filter 16,$(SCENE_LANES)),,-DSCENE_NO_AVX512),-DSCENE_ONLY_SCALAR)
SCENE_PLAIN := $(filter-out examples/scenes/scenes_lanes.c,$(wildcard examples/scenes/*.c))
SCENES := $B/examples/scenes.a
OWN := $(COMPILE) -Iexamples -Itests

define scene_object
$B/examples/scenes/scenes_lanes_$(1).o: examples/scenes/scenes_lanes.c $B/setup
	@mkdir -p $$(@D)
	$$(call SAY,$$@)
	$$(Q)$$(COMPILE) -DSCENE_LANES=$(1) $$(scene_flags_$(1)) $$(CFLAGS) $$(KEEP) -c $$< -o $$@
endef
$(foreach lanes,$(SCENE_LANES),$(eval $(call scene_object,$(lanes))))

$(SCENES): $(SCENE_PLAIN:%.c=$B/%.o) $(SCENE_LANES:%=$B/examples/scenes/scenes_lanes_%.o)
	@rm -f $@
	$(Q)$(AR) rcsD $@ $^

$B/examples/scenes/%.o: examples/scenes/%.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(COMPILE) $(SCENE_MISSING) $(CFLAGS) $(KEEP) -c $< -o $@

# Programs of one idea each; what they share is linked as far as they need it.
PROGRAMS := one_ray batch_callback one_frame glass_ball mirrored_tree methods_compared progressive \
            shadow_pass occlusion_pass path_tracer whitted figures models shader emit render
# Those that only say whether all is well when run without arguments.
CHECKED := $(filter-out render,$(PROGRAMS))
SHARED_SOURCES := $(filter-out $(PROGRAMS:%=examples/%.c),$(wildcard examples/*.c))
OIIO ?= $(shell pkg-config --exists OpenImageIO 2>/dev/null && \
          command -v $(firstword $(CXX)) >/dev/null 2>&1 && echo 1 || echo 0)
EXAMPLE_LINK := $(CC)
ifeq ($(OIIO),1)
OIIO_FLAGS := -DSPT_EXAMPLES_OIIO
OIIO_OBJECT := $B/examples/image_oiio.o
OIIO_LIBS := $(shell pkg-config --libs OpenImageIO)
EXAMPLE_LINK := $(CXX)
$(OIIO_OBJECT): examples/image_oiio.cc $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(CXX) -std=c++17 -O2 -MMD -Iexamples $(shell pkg-config --cflags OpenImageIO) \
	  $(CFLAGS) -c $< -o $@
endif

$B/examples/%.o: examples/%.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(COMPILE) $(OIIO_FLAGS) $(CFLAGS) $(KEEP) -c $< -o $@

$B/examples/shared.a: $(SHARED_SOURCES:%.c=$B/%.o) $(OIIO_OBJECT)
	@rm -f $@
	$(Q)$(AR) rcsD $@ $^

$(PROGRAMS:%=$B/%$(EXE)): $B/%$(EXE): $B/examples/%.o $B/examples/shared.a $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(EXAMPLE_LINK) $(CFLAGS) $(LDFLAGS) $^ $(OIIO_LIBS) -lm -pthread -o $@

# The pages that emit writes are compiled in: an array of a file's lines, page_NAME_ENDING.
PAGES := $(wildcard examples/pages/*.*)
$B/examples/pages.c: $(PAGES) $B/setup
	@mkdir -p $(@D)
	@for page in $(PAGES); do \
	  name=page_$$(basename $$page | tr . _); \
	  printf 'extern const char *const %s[];\nconst char *const %s[] = {\n' $$name $$name; \
	  sed 's/[\\"?]/\\&/g; s/.*/    "&\\n",/' $$page; \
	  printf '    (void *)0};\n'; \
	done >$@
$B/examples/pages.o: $B/examples/pages.c
	@mkdir -p $(@D)
	$(Q)$(COMPILE) $(CFLAGS) $(KEEP) -c $< -o $@
$B/emit$(EXE): $B/examples/pages.o

demo: $B/render$(EXE) $B/models$(EXE) $B/emit$(EXE)
	@mkdir -p $B/gallery
	$(RUN) $B/models$(EXE) $B/gallery
	$(RUN) $B/emit$(EXE) --page $B/gallery/viewer.html tree
	$(RUN) $B/render$(EXE) --gallery $B/gallery

# LARGE= renders the models of nature small.
LARGE ?= --large
gallery: $(patsubst %,$B/%$(EXE),render progressive shadow_pass occlusion_pass path_tracer whitted \
                  figures models emit)
	@mkdir -p $B/gallery
	$(RUN) $B/emit$(EXE) --page $B/gallery/viewer.html tree
	$(RUN) $B/render$(EXE) --gallery $B/gallery --large
	$(RUN) $B/progressive$(EXE) primitives $B/gallery/progressive_primitives.png
	$(RUN) $B/progressive$(EXE) mandelbulb $B/gallery/progressive_mandelbulb.png
	$(RUN) $B/shadow_pass$(EXE) $B/gallery/shadow_pass.png
	$(RUN) $B/occlusion_pass$(EXE) $B/gallery/occlusion_pass.png
	$(RUN) $B/figures$(EXE) $B/gallery
	$(RUN) $B/path_tracer$(EXE) $B/gallery/path_tracer.png
	$(RUN) $B/whitted$(EXE) $B/gallery
	$(RUN) $B/models$(EXE) $B/gallery $(LARGE)

# ---- Tests --------------------------------------------------------------------------------------

TEST_SOURCES := tests/main.c \
  $(wildcard $(foreach folder,unit parity oracle stress golden fuzz,tests/$(folder)/*.c))
HEADERS := $(wildcard include/spheretrace/*.h)
CXX_HERE := $(shell command -v $(firstword $(CXX)) 2>/dev/null)

# -O1 halves the time to build the tests, and takes none from running them; benches need all.
$B/tests/%.o: tests/%.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(if $(findstring tests/bench/,$<),$(OWN),$(subst -O3,-O1,$(OWN))) $(CFLAGS) $(KEEP) -c $< -o $@

$B/check$(EXE): $(TEST_SOURCES:%.c=$B/%.o) $B/examples/shared.a $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(EXAMPLE_LINK) $(CFLAGS) $(LDFLAGS) $^ $(OIIO_LIBS) -lm -pthread -o $@

# Each public header alone, as C99 and, where there is a C++ compiler, as C++11.
$B/headers.ok: $(HEADERS) $B/setup
	@for header in $(HEADERS); do \
	  printf '\043include "%s"\n' $$header >$B/alone.c; \
	  $(CC) -std=c99 $(WARN) -I. -Iinclude -fsyntax-only $B/alone.c || exit 1; \
	  [ -z "$(CXX_HERE)" ] || $(CXX) -std=c++11 -Wall -Wextra -Wshadow -Werror -I. -Iinclude \
	    -fsyntax-only -x c++ $B/alone.c || exit 1; \
	done
	@touch $@

$B/exceptions$(EXE): tests/stress/test_exceptions.cc $(STATIC)
	$(call SAY,$@)
	$(Q)$(CXX) -std=c++11 -O2 -Wall -Wextra -Werror -Iinclude $(CFLAGS) $(LDFLAGS) $^ -lm -o $@

# Without a C++ compiler the headers are not tried as C++ and exceptions do not pass through.
need_cxx:
	@[ -n "$(CXX_HERE)" ] || { echo 'skipped: no C++ compiler'; [ "$$SPT_REQUIRE" != 1 ]; }

check: need_cxx $B/check$(EXE) $B/headers.ok $(if $(CXX_HERE),$B/exceptions$(EXE)) \
       $(CHECKED:%=$B/%$(EXE)) $B/render$(EXE)
	@for program in $(CHECKED); do \
	  $(RUN) $B/$$program$(EXE) >$B/$$program.log || { cat $B/$$program.log; exit 1; }; \
	done
	@sh tests/readme.sh
	@RUN='$(RUN)' EXE='$(EXE)' sh tests/render.sh $B
	$(if $(CXX_HERE),@$(RUN) $B/exceptions$(EXE))
	@sh tests/halves.sh $(RUN) $B/check$(EXE)

# ---- Shaders ------------------------------------------------------------------------------------

# Tests of emitted GLSL need EGL and OpenGL (Mesa's llvmpipe runs them without a GPU), and use
# Vulkan (lavapipe), Chromium and the validators where they are there.
GLSL_SOURCES := $(filter-out tests/glsl/matrix.c,$(wildcard tests/glsl/*.c))
GLSL_MAIN := -DCHECK_SUITES='"glsl/glsl_suites.h"' -DCHECK_NEEDS=engine_gl_open
has_header = $(shell printf '\043include <$(1)>\n' | $(CC) -fsyntax-only -x c - >/dev/null 2>&1 && \
               echo 1 || echo 0)
links = $(shell printf 'int main(void) {return 0;}\n' | \
          $(CC) $(LDFLAGS) -x c - $(1) -o /dev/null >/dev/null 2>&1 && echo 1 || echo 0)
EGL_HERE = $(call has_header,EGL/egl.h)$(call has_header,GL/gl.h)$(call links,-lEGL -lGL)
EGL ?= $(if $(filter 111,$(EGL_HERE)),1,0)
EGL := $(EGL)
VULKAN ?= $(call has_header,vulkan/vulkan.h)
VULKAN := $(VULKAN)

# Headers of GL and POSIX are no C99.
$(GLSL_SOURCES:%.c=$B/%.o): $B/%.o: %.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(subst -std=c99 -pedantic-errors,-std=gnu99,$(subst -O3,-O1,$(OWN))) -I. \
	  $(if $(filter 1,$(VULKAN)),-DENGINE_VULKAN) $(CFLAGS) $(KEEP) -c $< -o $@

$B/tests/glsl_main.o: tests/main.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(OWN) $(GLSL_MAIN) $(CFLAGS) $(KEEP) -c $< -o $@

$B/check_glsl$(EXE): $(GLSL_SOURCES:%.c=$B/%.o) $B/tests/glsl_main.o $B/examples/shared.a $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(EXAMPLE_LINK) $(CFLAGS) $(LDFLAGS) $^ $(OIIO_LIBS) -lEGL -lGL \
	  $(if $(filter 1,$(VULKAN)),-lvulkan) -lm -pthread -o $@

$B/glsl_matrix$(EXE): $(patsubst %,$B/tests/glsl/%.o,matrix glsl_graph glsl_models glsl_rays \
                        glsl_scenes) $(STATIC)
	$(call SAY,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -lm -o $@

.PHONY: check_glsl need_egl
need_egl:
	@[ "$(EGL)" = 1 ] || { echo 'skipped: check_glsl, no headers of EGL and OpenGL (libegl-dev, libgl-dev)'; \
	  [ "$$SPT_REQUIRE" != 1 ]; }

# The program answers 77 where nothing is there that runs shaders.
check_glsl: need_egl $B/glsl_matrix$(EXE) $(if $(filter 1,$(EGL)),$B/check_glsl$(EXE))
	@sh tests/glsl/validators.sh $B
	$(if $(filter 1,$(EGL)),@sh tests/halves.sh $(RUN) $B/check_glsl$(EXE) || [ $$? = 77 ])

# ---- Benches ------------------------------------------------------------------------------------

BENCH_PLAIN := $(filter-out tests/bench/scalar_loop.c tests/bench/peak_lanes.c,\
                 $(wildcard tests/bench/*.c))
BENCH_OBJECTS := $(BENCH_PLAIN:%.c=$B/%.o) $B/tests/bench/scalar_loop.o \
                 $(SCENE_LANES:%=$B/tests/bench/peak_lanes_%.o)
FRAME_SOURCES := $(wildcard tests/bench/frame/*.c)
KEINERT_SOURCES := $(wildcard tests/bench/keinert/*.c) tests/bench/frame/frame_picture.c \
                   tests/oracle/listings.c
# Each peer is left out where its headers are not there: libembree-dev, libegl-dev and libgl-dev.
PEERS_EMBREE := village check embree triangles user
PEERS_LLVMPIPE := shaders llvmpipe
PEERS_PARTS = bench $(if $(filter 1,$(EMBREE)),$(PEERS_EMBREE)) \
              $(if $(filter 1,$(EGL)),$(PEERS_LLVMPIPE))
PEERS_SOURCES = $(PEERS_PARTS:%=tests/bench/peers/peers_%.c) tests/bench/frame/frame_picture.c
PEERS_FLAGS = $(if $(filter 1,$(EMBREE)),-DPEERS_EMBREE) $(if $(filter 1,$(EGL)),-DPEERS_LLVMPIPE)
PEERS_LIBS = $(if $(filter 1,$(EMBREE)),-lembree3) $(if $(filter 1,$(EGL)),-lEGL -lGL)
KRS_SOURCES := $(wildcard tests/bench/krs/*.c) tests/bench/frame/frame_picture.c
# The scalar loop that the driver is measured against gets all that the machine has, and so do the
# callbacks that Embree calls.
NATIVE ?= $(if $(call builds,-march=native),-march=native)
# Debian's libembree-dev, version 3, if it is there.
EMBREE ?= $(shell printf '\043include <embree3/rtcore.h>\n' | \
            $(CC) -fsyntax-only -x c - >/dev/null 2>&1 && echo 1 || echo 0)

$B/tests/bench/scalar_loop.o $B/tests/bench/peers/peers_user.o: $B/%.o: %.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(OWN) $(NATIVE) $(CFLAGS) $(KEEP) -c $< -o $@

define peak_object
$B/tests/bench/peak_lanes_$(1).o: tests/bench/peak_lanes.c $B/setup
	@mkdir -p $$(@D)
	$$(call SAY,$$@)
	$$(Q)$$(OWN) -DSPT_LANES=$(1) $$(scene_flags_$(1)) $$(CFLAGS) $$(KEEP) -c $$< -o $$@
endef
$(foreach lanes,$(SCENE_LANES),$(eval $(call peak_object,$(lanes))))

$(BENCH_PLAIN:%.c=$B/%.o): $B/%.o: %.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(OWN) $(SCENE_MISSING) $(CFLAGS) $(KEEP) -c $< -o $@

$B/driver_bench$(EXE): $(BENCH_OBJECTS) $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -lm -o $@

$B/frame_bench$(EXE): $(FRAME_SOURCES:%.c=$B/%.o) $B/tests/bench/bench.o \
                      $B/tests/bench/scalar_loop.o $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -lm -pthread -o $@

$B/keinert_bench$(EXE): $(KEINERT_SOURCES:%.c=$B/%.o) $B/tests/bench/bench.o \
                        $B/tests/bench/truth.o $B/examples/shared.a $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(EXAMPLE_LINK) $(CFLAGS) $(LDFLAGS) $^ $(OIIO_LIBS) -lm -pthread -o $@

$B/tests/bench/peers/peers_bench.o: $B/%.o: %.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(OWN) $(PEERS_FLAGS) $(CFLAGS) $(KEEP) -c $< -o $@

$B/peers_bench$(EXE): $(PEERS_SOURCES:%.c=$B/%.o) $B/tests/bench/bench.o $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(PEERS_LIBS) -lm -o $@

$B/krs_bench$(EXE): $(KRS_SOURCES:%.c=$B/%.o) $B/tests/bench/bench.o $(SCENES) $(STATIC)
	$(call SAY,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -lm -o $@

# QUICK=1: smaller pictures and fewer rounds.
BENCHES := driver_bench frame_bench keinert_bench krs_bench peers_bench
bench: $(BENCHES:%=$B/%$(EXE))
	@mkdir -p $B/bench
	@for program in $(BENCHES); do \
	  $(RUN) $B/$$program$(EXE) $(if $(QUICK),--quick) --output $B/bench || exit 1; \
	done

# ---- The report ---------------------------------------------------------------------------------

# Error against run time, stability, what is left out: tables, and a page that is drawn from them.
# REPORT=quick: minutes instead of half an hour. A run that was interrupted goes on.
REPORT ?=
REPORT_MAINS := tests/bench/driver.c $(foreach name,frame/frame keinert/keinert krs/krs peers/peers,\
                  tests/bench/$(name)_bench.c)
REPORT_PEERS := $(if $(filter 1,$(EGL)),$(PEERS_LLVMPIPE:%=tests/bench/peers/peers_%.c))
# What benches and oracles are made of, but for those that are tests or programs.
REPORT_SHARED := $(filter-out tests/oracle/test_%.c $(REPORT_MAINS) tests/bench/peak_lanes.c \
                   tests/bench/peers/%,\
                   $(wildcard tests/oracle/*.c tests/bench/*.c tests/bench/*/*.c)) \
                 $(REPORT_PEERS)
REPORT_BENCH := $(wildcard tests/report/report*.c tests/report/measure/*.c) tests/report/csv.c
REPORT_PAGE := $(wildcard tests/report/page*.c tests/report/plot*.c tests/report/page/*.c) \
               tests/report/csv.c

$B/tests/report/%.o: tests/report/%.c $B/setup
	@mkdir -p $(@D)
	$(call SAY,$@)
	$(Q)$(OWN) -Itests/report $(if $(filter 1,$(EGL)),-DREPORT_LLVMPIPE) $(CFLAGS) $(KEEP) \
	  -c $< -o $@

$B/report_shared.a: $(REPORT_SHARED:%.c=$B/%.o) $(SCENE_LANES:%=$B/tests/bench/peak_lanes_%.o)
	@rm -f $@
	$(Q)$(AR) rcsD $@ $^

$B/report_bench$(EXE): $(REPORT_BENCH:%.c=$B/%.o) $B/report_shared.a $B/examples/shared.a $(SCENES) \
                       $(STATIC)
	$(call SAY,$@)
	$(Q)$(EXAMPLE_LINK) $(CFLAGS) $(LDFLAGS) $^ $(OIIO_LIBS) $(if $(filter 1,$(EGL)),-lEGL -lGL) \
	  -lm -pthread -o $@

$B/report_page$(EXE): $(REPORT_PAGE:%.c=$B/%.o)
	$(call SAY,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -lm -o $@

.PHONY: report
report: $B/report_bench$(EXE) $B/report_page$(EXE) all
	@mkdir -p $B/report
	@$(RUN) $B/report_bench$(EXE) $(if $(filter quick,$(REPORT)),--quick) --output $B/report \
	  --build $B; \
	status=$$?; [ $$status = 0 ] || [ $$status = 3 ] || exit $$status; \
	$(RUN) $B/report_page$(EXE) $B/report && sh tests/report/numbers.sh $B/report && \
	echo 'the report is in $B/report/index.html' && exit $$status

# ---- Installing ---------------------------------------------------------------------------------

install: all
	install -d $(DESTDIR)$(LIBDIR)/pkgconfig $(DESTDIR)$(INCLUDEDIR)/spheretrace
	install -m 644 include/spheretrace/*.h $(DESTDIR)$(INCLUDEDIR)/spheretrace
	install -m 644 $(STATIC) $(SHARED) $(DESTDIR)$(LIBDIR)
	ln -sf libspheretrace.so.$(VERSION) $(DESTDIR)$(LIBDIR)/libspheretrace.so.$(MAJOR)
	ln -sf libspheretrace.so.$(MAJOR) $(DESTDIR)$(LIBDIR)/libspheretrace.so
	sed -e 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR:$(PREFIX)/%=$${prefix}/%)|' \
	  -e 's|@INCLUDEDIR@|$(INCLUDEDIR:$(PREFIX)/%=$${prefix}/%)|' \
	  -e 's|@VERSION@|$(VERSION)|' src/package/spheretrace.pc.in \
	  > $(DESTDIR)$(LIBDIR)/pkgconfig/spheretrace.pc

uninstall:
	rm -rf $(DESTDIR)$(INCLUDEDIR)/spheretrace
	rm -f $(DESTDIR)$(LIBDIR)/libspheretrace.* $(DESTDIR)$(LIBDIR)/pkgconfig/spheretrace.pc

clean:
	rm -rf $B

-include $(shell find $B -name '*.d' 2>/dev/null)

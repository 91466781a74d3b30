# SPDX-License-Identifier: MIT
#
# make            static and shared library in build/
# make check      build and run the tests (under a minute)
# make demo       render the gallery into build/gallery/
# make bench      measure; writes build/bench/*.csv
# make install    PREFIX=/usr/local DESTDIR= LIBDIR= INCLUDEDIR=
#
# Hooks: CC CXX AR, CFLAGS and LDFLAGS (added last), B (build folder), RUN (a wrapper around the
# programs that are run), EXE (their ending). The flags in LAW are not to be overridden: equal bits
# at every width and compiler depend on them.

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
LAW = -std=c99 $(WARN) -ffp-contract=off -fno-math-errno -fexceptions -fvisibility=hidden
COMPILE = $(CC) $(LAW) -O3 -MMD -Iinclude

# ---- What the compiler can build ----------------------------------------------------------------

TARGET := $(shell $(CC) -dumpmachine)
builds = $(shell printf '\043include <immintrin.h>\nint spt_probe;\n' | \
           $(CC) $(1) -fsyntax-only -x c - >/dev/null 2>&1 && echo yes)
ISAS := scalar
flags_scalar := -DSPT_LANES=1
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

PLAIN := $(filter-out src/backend/march.c src/backend/chunk.c src/backend/method.c,\
           $(wildcard src/*/*.c))
OBJECTS := $(PLAIN:src/%.c=$B/src/%.o) $(ISAS:%=$B/src/backend/chunk_%.o) \
           $(METHODS:%=$B/src/methods/%.o) \
           $(foreach method,$(METHODS),$(MARCH_ISAS:%=$B/src/methods/$(method)_%.o))

STATIC := $B/libspheretrace.a
SHARED := $B/libspheretrace.so.$(VERSION)

.PHONY: all check demo bench install uninstall clean
.DELETE_ON_ERROR:
.SUFFIXES:
all: $(STATIC) $(SHARED) $B/spheretrace.pc

# A change of compiler or flags rebuilds.
SETUP := $(CC) $(LAW) $(CFLAGS) $(LDFLAGS) $(ISAS)
$B/setup: $(if $(filter-out $(SETUP),$(shell cat $B/setup 2>/dev/null))$(filter-out \
            $(shell cat $B/setup 2>/dev/null),$(SETUP)),FORCE)
	@mkdir -p $(@D) && printf '%s\n' '$(SETUP)' > $@
FORCE:

$(PLAIN:src/%.c=$B/src/%.o): $B/src/%.o: src/%.c $B/setup
	@mkdir -p $(@D)
	$(COMPILE) -fPIC $(HAVE) $(CFLAGS) -c $< -o $@

# $(1) instruction set
define chunk_object
$B/src/backend/chunk_$(1).o: src/backend/chunk.c $B/setup
	@mkdir -p $$(@D)
	$$(COMPILE) -fPIC $$(HAVE) $$(flags_$(1)) -DSPTI_PREPARE=spti_prepare_$(1) \
	  -DSPTI_COMPACT=spti_compact_$(1) $$(CFLAGS) -c $$< -o $$@
endef
$(foreach isa,$(ISAS),$(eval $(call chunk_object,$(isa))))

# $(1) step rule
define method_object
$B/src/methods/$(1).o: src/backend/method.c $B/setup
	@mkdir -p $$(@D)
	$$(COMPILE) -fPIC $$(HAVE) -DSPTI_METHOD=$(1) -DSPTI_RULE='"../methods/$(1).h"' $$(CFLAGS) \
	  -c $$< -o $$@
endef
$(foreach method,$(METHODS),$(eval $(call method_object,$(method))))

# $(1) step rule, $(2) instruction set
define march_object
$B/src/methods/$(1)_$(2).o: src/backend/march.c $B/setup
	@mkdir -p $$(@D)
	$$(COMPILE) -fPIC $$(HAVE) $$(flags_$(2)) -DSPTI_RULE='"../methods/$(1).h"' \
	  -DSPTI_MARCH=spti_march_$(1)_$(2) $$(CFLAGS) -c $$< -o $$@
endef
$(foreach method,$(METHODS),$(foreach isa,$(MARCH_ISAS),\
  $(eval $(call march_object,$(method),$(isa)))))

$(STATIC): $(OBJECTS)
	@rm -f $@
	$(AR) rcsD $@ $^

$B/exports.map: Makefile
	@mkdir -p $(@D)
	@printf 'SPHERETRACE_$(MAJOR) { global: spt_*; local: *; };\n' > $@

$(SHARED): $(OBJECTS) $B/exports.map
	$(CC) -shared -Wl,-soname,libspheretrace.so.$(MAJOR) -Wl,--version-script=$B/exports.map \
	  -Wl,--no-undefined $(CFLAGS) $(LDFLAGS) $(OBJECTS) -lm -o $@
	@ln -sf $(@F) $B/libspheretrace.so.$(MAJOR)
	@ln -sf libspheretrace.so.$(MAJOR) $B/libspheretrace.so

$B/spheretrace.pc: src/package/spheretrace.pc.in Makefile include/spheretrace/base.h
	@mkdir -p $(@D)
	@sed -e 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR)|; s|@INCLUDEDIR@|$(INCLUDEDIR)|' \
	  -e 's|@VERSION@|$(VERSION)|' $< > $@

install: all
	install -d $(DESTDIR)$(LIBDIR)/pkgconfig $(DESTDIR)$(INCLUDEDIR)/spheretrace
	install -m 644 include/spheretrace/*.h $(DESTDIR)$(INCLUDEDIR)/spheretrace
	install -m 644 $(STATIC) $(SHARED) $(DESTDIR)$(LIBDIR)
	ln -sf libspheretrace.so.$(VERSION) $(DESTDIR)$(LIBDIR)/libspheretrace.so.$(MAJOR)
	ln -sf libspheretrace.so.$(MAJOR) $(DESTDIR)$(LIBDIR)/libspheretrace.so
	sed -e 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR)|; s|@INCLUDEDIR@|$(INCLUDEDIR)|' \
	  -e 's|@VERSION@|$(VERSION)|' src/package/spheretrace.pc.in \
	  > $(DESTDIR)$(LIBDIR)/pkgconfig/spheretrace.pc

uninstall:
	rm -rf $(DESTDIR)$(INCLUDEDIR)/spheretrace
	rm -f $(DESTDIR)$(LIBDIR)/libspheretrace.* $(DESTDIR)$(LIBDIR)/pkgconfig/spheretrace.pc

clean:
	rm -rf $B

-include $(shell find $B -name '*.d' 2>/dev/null)

# Éclairage: builds, tests and installs everything. `make help` lists the targets.
#
# `make` alone only compiles. `make demo` and `make test` first install what is missing; the compiler and
# pkg-config may be among it, so nothing below runs either of them until something is really compiled.
# Everything made lies under $(BUILD).

VERSION := 0.1.0

# A sanitized build has a folder of its own, so that neither build undoes the other.
## BUILD=build: the build folder
BUILD ?= build$(if $(SANITIZE),/$(subst $(comma),-,$(SANITIZE)))
comma := ,

## SANITIZE=address,undefined: build, or test, with these sanitizers, in a build folder of its own
SANITIZE ?=
# Off by default, so that a newer compiler with a new warning still builds the program.
## WERROR=1: make warnings errors, as `make test` does
WERROR ?=
## CC=clang: the compiler; CPPFLAGS, CFLAGS, LDFLAGS and PKG_CONFIG mean what they usually do
## V=1: show the commands
V ?= 0
Q := $(if $(filter 1,$(V)),,@)
say = $(if $(filter 1,$(V)),,@printf '  %-5s %s\n' '$(1)' '$(2)')

# ---------------------------------------------------------------------------------------------------------
# Flags, each with its reason
# ---------------------------------------------------------------------------------------------------------

# -O2: the level both compilers test most. No -march: the program runs on every machine of its architecture.
# -O1 with sanitizers: what they look at is there all the same, and the compiler takes half the time.
OPTIMIZE ?= $(if $(SANITIZE),-O1,-O2)

# -ffp-contract=off: a multiply and an add are never fused, so every machine computes the same last bits.
# -fno-math-errno, -fno-trapping-math: nothing here reads errno or the floating-point flags after arithmetic,
#   so sqrt is one instruction. Neither changes a result. (-ffast-math would, and is never used.)
ARITHMETIC := -ffp-contract=off -fno-math-errno -fno-trapping-math

# -Wshadow, -Wconversion: in numeric code a hidden variable or a silent narrowing is a wrong picture.
# -Wpedantic: ISO C only, so that both compilers agree.
# -Wno-psabi: gcc's remark that old versions passed wide vectors otherwise; ours never leave one file.
# -Wstrict-prototypes, -Wmissing-prototypes: every public function is declared in a header.
WARNINGS := -Wall -Wextra -Wshadow -Wconversion -Wpedantic -Wno-psabi \
	-Wstrict-prototypes -Wmissing-prototypes $(if $(WERROR),-Werror)

# -fno-sanitize-recover: the first finding ends the program, so that no test passes over one.
# -fno-omit-frame-pointer: whole stack traces in the reports.
# ECLAIRAGE_CHECK_TREE: the fast engine looks at each tree that it made.
SANITIZERS := $(if $(SANITIZE),-DECLAIRAGE_CHECK_TREE -fsanitize=$(SANITIZE) -fno-sanitize-recover=all -fno-omit-frame-pointer)

# The paths of the fast engine: `plain` is for every processor of the architecture, `avx2` is chosen when the
# program runs where the processor has it. -O3: the loops over lanes become vector code.
## ARCHITECTURE=x86_64: what the compiler makes programs for, as uname -m says it
ARCHITECTURE ?= $(shell uname -m)
## PORTABLE=1: build the fast engine without anything that knows an instruction set
PORTABLE ?=
LANE_PATHS := plain $(if $(filter x86_64,$(ARCHITECTURE)),$(if $(PORTABLE),,avx2))
LANE_FLAGS_plain :=
LANE_FLAGS_avx2 := -mavx2 -mfma -mtune=znver3
LANE_OPTIMIZE ?= $(if $(SANITIZE),-O1,-O3)
ENGINE_DEFINES := $(if $(filter avx2,$(LANE_PATHS)),-DECLAIRAGE_HAS_AVX2) $(if $(PORTABLE),-DECLAIRAGE_PORTABLE)

# _POSIX_C_SOURCE: -std=c17 hides everything outside ISO C; POSIX threads, files and processes are needed.
# -g: line numbers in a debugger and in sanitizer reports; costs no speed.
ALL_CFLAGS = -std=c17 $(OPTIMIZE) -g $(ARITHMETIC) $(WARNINGS) $(SANITIZERS) \
	-D_POSIX_C_SOURCE=200809L -DECLAIRAGE_VERSION='"$(VERSION)"' $(ENGINE_DEFINES) -Isrc -I. \
	$(PACKAGE_CFLAGS) -pthread $(CPPFLAGS) $(CFLAGS)
COMPILE = $(REQUIRE_BUILD_TOOLS)$(CC) $(ALL_CFLAGS)
LIBRARIES = $(PACKAGE_LIBS) -lm -pthread

# Each of these variables computes itself when it is first used and then keeps its value: one run of
# pkg-config for a whole build, none for `make help`.
PKG_CONFIG ?= pkg-config
PACKAGES := yaml-0.1 libpng zlib
PACKAGE_CFLAGS = $(eval PACKAGE_CFLAGS := $$(shell $(PKG_CONFIG) --cflags $(PACKAGES)))$(PACKAGE_CFLAGS)
PACKAGE_LIBS = $(eval PACKAGE_LIBS := $$(shell $(PKG_CONFIG) --libs $(PACKAGES)))$(PACKAGE_LIBS)
# These expand to nothing, or end make with one line that names what is missing and how to install it.
REQUIRE_BUILD_TOOLS = $(call require,build)$(eval REQUIRE_BUILD_TOOLS :=)
REQUIRE_UNIT_TOOLS = $(call require,unit)$(eval REQUIRE_UNIT_TOOLS :=)
require = $(eval MISSING := $$(shell $(INSTALLER) --missing $(1)))$(if $(MISSING),$(error $(MISSING)))
INSTALLER = CC='$(CC)' PKG_CONFIG='$(PKG_CONFIG)' tools/install-dependencies.sh

# ---------------------------------------------------------------------------------------------------------
# Files
# ---------------------------------------------------------------------------------------------------------

LIBRARY_SOURCES := $(filter-out src/main.c,$(wildcard src/*.c)) \
	$(wildcard src/base/*.c src/engine/*.c src/explain/*.c src/image/*.c src/patterns/*.c src/scene/*.c src/shapes/*.c povray/*.c \
	compare/*.c)
# These are compiled once for each path, that is each instruction set the fast engine can choose from.
LANE_SOURCES := $(wildcard src/engine/lanes/*.c)
PROGRAM_SOURCES := src/main.c $(wildcard src/cli/*.c)
# The headers a user of the library includes, and the ones they bring; the others are its own affair.
PUBLIC_HEADERS := $(wildcard src/*.h src/base/*.h src/patterns/*.h src/shapes/*.h) src/image/image.h \
	src/engine/engine.h src/scene/load.h src/scene/diagnostics.h src/scene/source_text.h povray/export.h povray/pov_habits.h povray/run.h \
	compare/metrics.h compare/difference.h compare/report.h
# Files in tests/unit that are not test programs are helpers, linked into each of them.
UNIT_SOURCES := $(wildcard tests/unit/test_*.c)
UNIT_HELPERS := $(filter-out $(UNIT_SOURCES),$(wildcard tests/unit/*.c))
# The programs in tests/property, and the helpers that each of them is linked with.
PROPERTY_PROGRAMS := crosscheck engines planted stories
PROPERTY_SOURCES := $(wildcard tests/property/*.c)
PROPERTY_HELPERS := $(filter-out $(PROPERTY_PROGRAMS:%=tests/property/%.c),$(PROPERTY_SOURCES)) tests/unit/both_engines.c

objects = $(1:%.c=$(BUILD)/obj/%.o)
LANE_OBJECTS := $(foreach path,$(LANE_PATHS),$(LANE_SOURCES:%.c=$(BUILD)/obj/%.$(path).o))
LIBRARY_OBJECTS := $(call objects,$(LIBRARY_SOURCES)) $(LANE_OBJECTS)
PROGRAM_OBJECTS := $(call objects,$(PROGRAM_SOURCES))
UNIT_OBJECTS := $(call objects,$(UNIT_HELPERS))
PROPERTY_OBJECTS := $(call objects,$(PROPERTY_HELPERS))
UNIT_TESTS := $(UNIT_SOURCES:tests/unit/%.c=$(BUILD)/tests/%)

# ---------------------------------------------------------------------------------------------------------
# Building
# ---------------------------------------------------------------------------------------------------------

## all: build the program and the library, optimised (the default)
all: $(BUILD)/eclairage $(BUILD)/libeclairage.a

$(BUILD)/eclairage: $(PROGRAM_OBJECTS) $(BUILD)/libeclairage.a
	$(call say,LINK,$@)
	$(Q)$(COMPILE) $(LDFLAGS) -o $@ $(PROGRAM_OBJECTS) $(BUILD)/libeclairage.a $(LIBRARIES)

$(BUILD)/libeclairage.a: $(LIBRARY_OBJECTS) $(BUILD)/library-files
	$(call say,AR,$@)
	$(Q)rm -f $@ && $(AR) rcs $@ $(LIBRARY_OBJECTS)

$(BUILD)/obj/%.o: %.c $(BUILD)/flags
	$(call say,CC,$<)
	$(Q)mkdir -p $(@D)
	$(Q)$(COMPILE) -MMD -MP -c -o $@ $<

# One rule for each path: PATH.o of a file in src/engine/lanes.
define lane-rule
$$(BUILD)/obj/src/engine/lanes/%.$(1).o: src/engine/lanes/%.c $$(BUILD)/flags
	$$(call say,CC,$$< ($(1)))
	$$(Q)mkdir -p $$(@D)
	$$(Q)$$(COMPILE) $$(LANE_OPTIMIZE) $$(LANE_FLAGS_$(1)) -DLANE_PATH=$(1) -MMD -MP -c -o $$@ $$<
endef
$(foreach path,$(LANE_PATHS),$(eval $(call lane-rule,$(path))))

# The building of its tree is loops over vectors too.
$(BUILD)/obj/src/engine/bvh_build.o: OPTIMIZE = $(LANE_OPTIMIZE)

# The report's page is assembled into this object, which the compiler's list of dependencies does not say.
$(BUILD)/obj/compare/report_template.o: $(wildcard compare/report*.html compare/report*.css compare/report*.js)
$(BUILD)/obj/src/explain/explain_page.o: $(wildcard src/explain/explain_page.css src/explain/explain_page.js)

$(BUILD)/tests/%: tests/unit/%.c $(UNIT_OBJECTS) $(BUILD)/libeclairage.a
	$(call say,TEST,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(REQUIRE_UNIT_TOOLS)$(COMPILE) $(LDFLAGS) -MMD -MP -MF $@.d -o $@ $< $(UNIT_OBJECTS) \
		$(BUILD)/libeclairage.a -lcmocka $(LIBRARIES)

$(PROPERTY_PROGRAMS:%=$(BUILD)/%): $(BUILD)/%: $(BUILD)/obj/tests/property/%.o $(PROPERTY_OBJECTS) \
		$(BUILD)/libeclairage.a
	$(call say,LINK,$@)
	$(Q)$(COMPILE) $(LDFLAGS) -o $@ $< $(PROPERTY_OBJECTS) $(BUILD)/libeclairage.a $(LIBRARIES)

# A stamp changes only when its text does: other flags or another compiler rebuild everything, a removed
# source leaves the library, and otherwise nothing happens.
quote = '$(subst ','\'',$(1))'
stamp = $(Q)mkdir -p $(@D); text=$(call quote,$(1)); \
	[ "$$text" = "$$(cat $@ 2>/dev/null)" ] || printf '%s\n' "$$text" >$@
$(BUILD)/flags: FORCE
	$(call stamp,$(COMPILE))
$(BUILD)/library-files: FORCE
	$(call stamp,$(LIBRARY_OBJECTS))
FORCE:

-include $(LIBRARY_OBJECTS:.o=.d) $(PROGRAM_OBJECTS:.o=.d) $(UNIT_OBJECTS:.o=.d) $(UNIT_TESTS:=.d) \
	$(patsubst %.c,$(BUILD)/obj/%.d,$(PROPERTY_SOURCES))

# ---------------------------------------------------------------------------------------------------------
# Seeing it work, and testing it
# ---------------------------------------------------------------------------------------------------------

# Inside a recipe: build on all processors, unless the caller of make already said how many.
PARALLEL = $(if $(filter -j%,$(MAKEFLAGS)),,-j$(shell nproc 2>/dev/null || echo 2))

## demo: install what is missing, build, render every scene and compare it with POV-Ray
demo:
	@$(INSTALLER) build demo
	@$(MAKE) --no-print-directory $(PARALLEL) all
	@status=0; \
	$(BUILD)/eclairage compare scenes/course/*.yaml scenes/gallery/*.yaml --out $(BUILD)/report || status=$$?; \
	if [ -f $(BUILD)/report/index.html ]; then echo 'Open $(BUILD)/report/index.html in a browser.'; fi; \
	exit $$status

## test: install what is missing and run all tests; SUITES='unit cli' runs only those
test:
	@$(INSTALLER) build demo unit test
	@MAKE='$(MAKE)' CC='$(CC)' BUILD='$(BUILD)' SANITIZE='$(SANITIZE)' VERSION='$(VERSION)' tools/run-tests.sh

## notes: install what is missing, build, and make the teaching notes, build/notes/index.html, from their chapters
notes:
	@$(INSTALLER) build notes
	@$(MAKE) --no-print-directory $(PARALLEL) all
	@$(MAKE_NOTES) $(BUILD)/notes && echo 'Open $(BUILD)/notes/index.html in a browser.'

## update-notes: make the notes and rewrite the numbers that they are expected to show
update-notes: all
	@$(MAKE_NOTES) --update $(BUILD)/notes
	@git --no-pager diff --stat -- notes/numbers.csv
MAKE_NOTES = CC='$(CC)' PKG_CONFIG='$(PKG_CONFIG)' ECLAIRAGE='$(BUILD)/eclairage' notes/make-notes.sh

## unit: build the unit tests; `CMOCKA_MESSAGE_OUTPUT=TAP build/tests/test_NAME` runs one
unit: $(UNIT_TESTS)

property: $(PROPERTY_PROGRAMS:%=$(BUILD)/%)

## setup: install everything the tests can use, the browser's among it
setup:
	@$(INSTALLER) build demo unit test browser notes

## lint: check the layout of the code, who includes whom, and the shell scripts
lint:
	@tools/check-format.sh
	@tools/check-includes.sh
	@if command -v shellcheck >/dev/null; then shellcheck tools/*.sh .ci/run $(wildcard tests/suites/*.sh) tests/property/build.sh bench/peers.sh notes/make-notes.sh; \
	else echo 'shellcheck is not installed: the shell scripts were not checked.'; fi

## format: lay out all C files with clang-format 14
format:
	@tools/check-format.sh --fix

## fuzz: throw a minute of broken scenes at the loader (needs clang)
fuzz:
	@BUILD='$(BUILD)' tests/fuzz/load.sh

## bench: install the peers that are missing, and run the benchmarks; bench/peers.sh alone compares with the peers
bench:
	@$(INSTALLER) build bench
	@$(MAKE) --no-print-directory $(PARALLEL) all
	@set -e; for script in $(wildcard bench/*.sh); do CC='$(CC)' ECLAIRAGE='$(BUILD)/eclairage' "$$script"; done

## update-results: measure again and rewrite the committed numbers
update-results: all
	@ECLAIRAGE='$(BUILD)/eclairage' tools/update-results.sh

## docs: make the manual page, completion, schema and reference again from the tables
docs: all $(BUILD)/tests/test_load_files
	$(Q)$(BUILD)/eclairage --print-manual-page >man/eclairage.1
	$(Q)$(BUILD)/eclairage --print-bash-completion >completions/eclairage.bash
	$(Q)ECLAIRAGE_UPDATE=1 $(BUILD)/tests/test_load_files

# ---------------------------------------------------------------------------------------------------------
# Installing: the GNU directory variables, each overridable
# ---------------------------------------------------------------------------------------------------------

## PREFIX=/usr/local: where install puts things; DESTDIR=DIR: below DIR instead of /
PREFIX ?= /usr/local
DESTDIR ?=
BINDIR ?= $(PREFIX)/bin
LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
DATADIR ?= $(PREFIX)/share
MANDIR ?= $(DATADIR)/man
COMPLETIONDIR ?= $(DATADIR)/bash-completion/completions
INSTALL ?= install
# In eclairage.pc a folder is written relative to the prefix where it can be, so that the tree can be moved.
underPrefix = $(1:$(PREFIX)/%=$${prefix}/%)

## install: install program, library, headers, man page and completion under PREFIX=/usr/local
install: all
	$(Q)$(INSTALL) -d '$(DESTDIR)$(BINDIR)' '$(DESTDIR)$(LIBDIR)/pkgconfig' '$(DESTDIR)$(MANDIR)/man1' \
		'$(DESTDIR)$(COMPLETIONDIR)' '$(DESTDIR)$(DATADIR)/eclairage'
	$(Q)$(INSTALL) -m 755 $(BUILD)/eclairage '$(DESTDIR)$(BINDIR)/eclairage'
	$(Q)$(INSTALL) -m 644 $(BUILD)/libeclairage.a '$(DESTDIR)$(LIBDIR)/libeclairage.a'
	$(Q)sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIBDIR@|$(call underPrefix,$(LIBDIR))|' \
		-e 's|@INCLUDEDIR@|$(call underPrefix,$(INCLUDEDIR))|' -e 's|@VERSION@|$(VERSION)|' \
		-e 's|@PACKAGES@|$(PACKAGES)|' eclairage.pc.in \
		>'$(DESTDIR)$(LIBDIR)/pkgconfig/eclairage.pc'
	$(Q)chmod 644 '$(DESTDIR)$(LIBDIR)/pkgconfig/eclairage.pc'
	$(Q)set -e; for header in $(PUBLIC_HEADERS); do \
		$(INSTALL) -D -m 644 "$$header" '$(DESTDIR)$(INCLUDEDIR)'/eclairage/"$${header#src/}"; done
	$(Q)$(INSTALL) -m 644 man/eclairage.1 '$(DESTDIR)$(MANDIR)/man1/eclairage.1'
	$(Q)$(INSTALL) -m 644 completions/eclairage.bash '$(DESTDIR)$(COMPLETIONDIR)/eclairage'
	$(Q)$(INSTALL) -m 644 scenes/scene.schema.json '$(DESTDIR)$(DATADIR)/eclairage/scene.schema.json'

## uninstall: remove what install put under PREFIX
uninstall:
	$(Q)rm -f '$(DESTDIR)$(BINDIR)/eclairage' '$(DESTDIR)$(LIBDIR)/libeclairage.a' \
		'$(DESTDIR)$(LIBDIR)/pkgconfig/eclairage.pc' '$(DESTDIR)$(MANDIR)/man1/eclairage.1' \
		'$(DESTDIR)$(COMPLETIONDIR)/eclairage'
	$(Q)rm -rf '$(DESTDIR)$(INCLUDEDIR)/eclairage' '$(DESTDIR)$(DATADIR)/eclairage'

## clean: remove everything built
clean:
	rm -rf build $(BUILD)

help-columns = awk -F: '{ printf "%-30s", $$1; sub(/^[^:]*:/, ""); print }'
## help: list the targets
help:
	@echo 'Targets:'
	@sed -n 's/^## \([a-z-]*\): /  \1:/p' $(firstword $(MAKEFILE_LIST)) | $(help-columns)
	@echo 'Variables:'
	@sed -n 's/^## \([A-Z][^ ]*\): /  \1:/p' $(firstword $(MAKEFILE_LIST)) | $(help-columns)

.DEFAULT_GOAL := all
.PHONY: all demo notes update-notes test unit property setup lint format fuzz bench docs update-results install uninstall clean help FORCE
.DELETE_ON_ERROR:

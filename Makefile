# Éclairage. `make help` lists the targets.

VERSION := 0.1.0
CC ?= cc
BUILD ?= build
SANITIZE ?=
V ?= 0
Q := $(if $(filter 1,$(V)),,@)

# Packages, found by pkg-config; a missing one is named in one line.
PACKAGES := yaml-0.1 libpng
DEBIAN_yaml-0.1 := libyaml-dev
DEBIAN_libpng := libpng-dev
DEBIAN_cmocka := libcmocka-dev

# -ffp-contract=off: same arithmetic on every machine; a fused multiply-add would change last bits.
# -fno-math-errno, -fno-trapping-math: nothing here reads errno or the FP flags after arithmetic.
OPTIMIZE ?= -O2
WARNINGS := -Wall -Wextra -Wshadow -Wconversion -Wpedantic -Wstrict-prototypes -Wmissing-prototypes -Werror
ALL_CFLAGS = -std=c17 $(OPTIMIZE) -g -ffp-contract=off -fno-math-errno -fno-trapping-math $(WARNINGS) \
	-D_POSIX_C_SOURCE=200809L -DECLAIRAGE_VERSION='"$(VERSION)"' -Isrc -I. $(shell pkg-config --cflags $(PACKAGES)) \
	-pthread $(if $(SANITIZE),-fsanitize=$(SANITIZE) -fno-sanitize-recover=all -fno-omit-frame-pointer) $(CFLAGS)
ALL_LIBS = $(shell pkg-config --libs $(PACKAGES)) -lm -pthread $(LDFLAGS)

LIBRARY_SOURCES := $(filter-out src/main.c,$(wildcard src/*.c)) \
	$(wildcard src/base/*.c src/image/*.c src/scene/*.c src/shapes/*.c povray/*.c compare/*.c)
PROGRAM_SOURCES := src/main.c $(wildcard src/cli/*.c)
LIBRARY_OBJECTS := $(LIBRARY_SOURCES:%.c=$(BUILD)/obj/%.o)
PROGRAM_OBJECTS := $(PROGRAM_SOURCES:%.c=$(BUILD)/obj/%.o)
UNIT_TESTS := $(patsubst tests/unit/%.c,$(BUILD)/tests/%,$(wildcard tests/unit/test_*.c))

## all: build the program and the library (the default)
all: $(BUILD)/eclairage $(BUILD)/libeclairage.a

$(BUILD)/eclairage: $(PROGRAM_OBJECTS) $(BUILD)/libeclairage.a
	$(Q)$(CC) $(ALL_CFLAGS) -o $@ $(PROGRAM_OBJECTS) $(BUILD)/libeclairage.a $(ALL_LIBS)

$(BUILD)/libeclairage.a: $(LIBRARY_OBJECTS)
	$(Q)rm -f $@ && ar rcs $@ $^

$(BUILD)/obj/%.o: %.c Makefile
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/tests/%: tests/unit/%.c $(BUILD)/libeclairage.a
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(ALL_CFLAGS) -MMD -MP -MF $@.d -o $@ $< $(BUILD)/libeclairage.a -lcmocka $(ALL_LIBS)

## unit: build the unit tests
unit: $(UNIT_TESTS)

## help: list the targets
help:
	@sed -n 's/^## //p' $(MAKEFILE_LIST)

## clean: remove everything built
clean:
	rm -rf build

-include $(LIBRARY_OBJECTS:.o=.d) $(PROGRAM_OBJECTS:.o=.d) $(UNIT_TESTS:=.d)

.PHONY: all unit help clean
.DELETE_ON_ERROR:

#!/usr/bin/env bash
# `make install` into an empty folder: everything is in its place, a program written against the installed
# library compiles with nothing but pkg-config and runs, and `make uninstall` takes it all away again.

set -u
MAKE=${MAKE:-make}
CC=${CC:-cc}
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix
number=0
failures=0
# Runs a command in a subshell and prints the verdict; what the command printed explains a failure.
test_() { # LABEL COMMAND...
    local label=$1
    shift
    number=$((number + 1))
    if ("$@") >"$folder/output" 2>&1; then
        echo "ok $number - $label"
    else
        echo "not ok $number - $label"
        sed 's/^/# /' "$folder/output"
        failures=$((failures + 1))
    fi
}

filesAreInPlace() {
    local file missing=0
    for file in bin/eclairage lib/libeclairage.a lib/pkgconfig/eclairage.pc include/eclairage/raytracer.h \
        include/eclairage/base/status.h include/eclairage/povray/export.h include/eclairage/compare/metrics.h \
        share/man/man1/eclairage.1 share/bash-completion/completions/eclairage \
        share/eclairage/scene.schema.json; do
        [ -s "$prefix/$file" ] || { echo "missing: $file" && missing=1; }
    done
    return $missing
}

programRuns() {
    "$prefix/bin/eclairage" --version && "$prefix/bin/eclairage" schema | cmp - "$prefix/share/eclairage/scene.schema.json"
}

# The version is written once, in the Makefile.
versionsAgree() {
    local version
    version=$(pkg-config --modversion eclairage) && echo "$version" && "$prefix/bin/eclairage" --version | grep -F "$version"
}

# Each header brings what it needs, whichever one a program starts with.
headersStandAlone() {
    local header bad=0
    cd "$prefix/include/eclairage" || return 1
    while read -r header; do
        # shellcheck disable=SC2046 # pkg-config prints words
        echo "#include \"$header\"" | "$CC" -std=c17 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Werror \
            $(pkg-config --cflags eclairage) -fsyntax-only -x c - || bad=1
    done < <(find . -name '*.h' | sed 's|^\./||' | LC_ALL=C sort)
    return $bad
}

writeProgram() {
    cat >"$folder/program.c" <<'PROGRAM'
/* A red ball in front of the camera, lit from the camera: its middle is red, the corner is background. */
#include "image/image.h"
#include "raytracer.h"

#include <stdio.h>

int main(void)
{
    Scene scene = createScene();
    Color3f red = createColor(0.5f, 0, 0);
    Sphere ball = createSphere(createVector(0, 0, -5), 1.5, createMaterial(red, createColor(0, 0, 0), 0));
    addSphereToScene(&scene, ball);
    addLightToScene(&scene, createLight(createVector(0, 0, 0), createColor(10, 10, 10)));
    Framebuffer *picture = createFramebuffer(33, 25);
    if (picture == NULL)
        return 1;
    lambertRaytracing(scene, picture);
    Color3f middle = picture->pixels[12 * 33 + 16], corner = picture->pixels[0];
    printf("middle %g %g %g, corner %g %g %g\n", (double)middle.r, (double)middle.g, (double)middle.b,
           (double)corner.r, (double)corner.g, (double)corner.b);
    Status status = savePicture(picture, "picture.png");
    freeFramebuffer(picture);
    freeScene(&scene);
    return !(status.code == STATUS_OK && middle.r > 0 && middle.g == 0 && corner.r == 0);
}
PROGRAM
}

# As a user compiles: no path of this project, only what pkg-config says.
userProgramRuns() { # EXTRA_PKG_CONFIG_OPTION...
    cd "$folder" || return 1
    writeProgram
    rm -f picture.png
    # shellcheck disable=SC2046 # pkg-config prints words
    "$CC" -std=c17 -Wall -Wextra -Werror -o program program.c $(pkg-config --cflags --libs "$@" eclairage) &&
        ./program && [ -s picture.png ]
}

stagedTreeIsTheSame() {
    "$MAKE" --no-print-directory install DESTDIR="$folder/a stage" PREFIX=/opt/light || return 1
    diff <(cd "$prefix" && find . -type f | LC_ALL=C sort) <(cd "$folder/a stage/opt/light" && find . -type f | LC_ALL=C sort) &&
        ! grep -rF "$folder" "$folder/a stage/opt/light/lib/pkgconfig" && [ "$(ls "$folder/a stage")" = opt ]
}

uninstallLeavesNothing() { # FOLDER VARIABLE=VALUE...
    local where=$1
    shift
    "$MAKE" --no-print-directory uninstall "$@" || return 1
    ! find "$where" ! -type d -o -name 'eclairage*' | grep .
}

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
echo 1..10
test_ "make install" "$MAKE" --no-print-directory install PREFIX="$prefix"
[ "$failures" = 0 ] || exit 1 # nothing below means anything
test_ "everything is in its place" filesAreInPlace
test_ "the installed program runs and prints the installed schema" programRuns
test_ "the program and pkg-config say the same version" versionsAgree
test_ "every installed header compiles alone" headersStandAlone
test_ "a program compiles with pkg-config and runs" userProgramRuns
test_ "and with pkg-config --static" userProgramRuns --static
test_ "DESTDIR and PREFIX install the same files elsewhere" stagedTreeIsTheSame
test_ "make uninstall leaves nothing" uninstallLeavesNothing "$prefix" PREFIX="$prefix"
test_ "make uninstall DESTDIR leaves nothing" uninstallLeavesNothing "$folder/a stage" DESTDIR="$folder/a stage" PREFIX=/opt/light
[ "$failures" = 0 ]

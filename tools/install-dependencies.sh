#!/bin/sh
# Finds out what is missing on this machine for a purpose, and installs it with apt-get.
#
#   tools/install-dependencies.sh PURPOSE...             install what is missing; prints nothing if nothing is
#   tools/install-dependencies.sh --missing PURPOSE...   only say in one line what is missing, if anything
#
# Purposes: build, demo, unit, test, browser, notes, bench (see the tables below). A thing counts as present when it works,
# wherever it came from, so a compiler or node that apt knows nothing of is left alone. Optional things only
# add tests or benchmarks: without them these are skipped, aloud. CC and PKG_CONFIG name the programs to use.

# The functions of the tables are called by name.
# shellcheck disable=SC2317
set -u
cd "$(dirname "$0")/.." || exit 1

pkgConfig=${PKG_CONFIG:-pkg-config}

has() {
    command -v "$1" >/dev/null 2>&1
}

# The tables: what each purpose needs, as  require|suggest PACKAGES COMMAND..., where COMMAND succeeds when the
# packages are not needed any more.
need_build() {
    # Packages of compilers are named after them: clang, gcc-13. A compiler is of no use without the C
    # library's headers, so ask for both at once.
    compiler=${CC:-cc}
    compiler=${compiler%% *}
    [ "$compiler" != cc ] || compiler=gcc
    require "${compiler##*/} libc6-dev" compilerWorks
    require make has make
    require pkg-config has "$pkgConfig"
    require libyaml-dev "$pkgConfig" --exists yaml-0.1
    require libpng-dev "$pkgConfig" --exists libpng
    require zlib1g-dev "$pkgConfig" --exists zlib
}
need_demo() {
    require povray has povray
}
need_unit() {
    require libcmocka-dev "$pkgConfig" --exists cmocka
    # Real meshes, not ours to hand on.
    suggest glmark2-data test -r /usr/share/glmark2/models/bunny.obj
    suggest assimp-testmodels test -r /usr/share/assimp/models/OBJ/spider.obj
}
need_test() {
    require bats has bats
    require jq has jq
    suggest clang has clang
    suggest clang-format-14 tools/check-format.sh --available
    suggest man-db has man
    suggest locales test -e /usr/share/i18n/locales/de_DE
    suggest "python3-jsonschema python3-yaml" python3 -c 'import jsonschema, yaml'
}
need_browser() {
    suggest chromium chromiumExists
    suggest nodejs has node
    suggest npm has npm
}
need_notes() {
    require pandoc has pandoc
    require jq has jq
    require povray has povray
}

need_bench() {
    # The peers that we are measured against. Where libembree-dev is Embree 4, there is no 3 to install.
    suggest python3 has python3
    suggest povray has povray
    suggest tachyon-bin-nox has tachyon
    suggest libembree-dev embreeExists
    suggest time test -x /usr/bin/time
}

compilerWorks() {
    # CC may be several words, such as `ccache gcc`.
    # shellcheck disable=SC2086
    echo '#include <stdio.h>' | ${CC:-cc} -E - >/dev/null 2>&1
}
embreeExists() {
    # shellcheck disable=SC2086
    echo '#include <embree3/rtcore.h>' | ${CC:-cc} -E - >/dev/null 2>&1 || test -e /usr/include/embree4/rtcore.h
}
chromiumExists() {
    has chromium || has chromium-browser || has google-chrome
}

required=
suggested=
require() {
    packages=$1
    shift
    "$@" >/dev/null 2>&1 || required="$required $packages"
}
suggest() {
    packages=$1
    shift
    "$@" >/dev/null 2>&1 || suggested="$suggested $packages"
}
findMissing() {
    required=
    suggested=
    for purpose in $purposes; do
        "need_$purpose"
    done
    required=${required# }
    suggested=${suggested# }
}

onlySay=false
if [ "${1-}" = --missing ]; then
    onlySay=true
    shift
fi
purposes=$*
for purpose in $purposes; do
    case $purpose in
    build | demo | unit | test | browser | notes | bench) ;;
    *)
        echo "install-dependencies.sh: there is no purpose '$purpose'." >&2
        exit 2
        ;;
    esac
done

# Root installs directly, anyone else through sudo.
asRoot=
[ "$(id -u)" = 0 ] || asRoot='sudo '

findMissing
if $onlySay; then
    if [ -n "$required" ]; then
        if has apt-get; then
            echo "missing: $required; install with: ${asRoot}apt-get install $required"
        else
            echo "missing (names of the Debian packages): $required; install them with your system's packages"
        fi
    fi
    exit 0
fi

log=build/install.log

# Prints what apt-get says on a terminal; elsewhere keeps it in a file, shown only when something fails.
aptGet() {
    set -- apt-get -y -q -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@"
    if [ -n "$asRoot" ]; then
        set -- sudo env DEBIAN_FRONTEND=noninteractive "$@"
    else
        set -- env DEBIAN_FRONTEND=noninteractive "$@"
    fi
    if [ -t 1 ]; then
        "$@"
    else
        mkdir -p build && "$@" >>$log 2>&1 </dev/null
    fi
}

updated=false
updateLists() {
    $updated && return 0
    updated=true
    echo "Updating the list of packages: ${asRoot}apt-get update"
    aptGet update
}

hasCandidate() {
    LC_ALL=C apt-cache policy "$1" 2>/dev/null | grep 'Candidate: [^(]' >/dev/null
}

# Installs packages; lists that are absent or too old to download from are renewed once.
installPackages() {
    for package in "$@"; do
        hasCandidate "$package" || updateLists || return 1
    done
    echo "Installing what is missing: ${asRoot}apt-get install $*"
    aptGet install --no-install-recommends "$@" && return 0
    $updated && return 1
    updateLists && aptGet install --no-install-recommends "$@"
}

canInstall() {
    if ! has apt-get; then
        echo "This machine has no apt-get. Please install these yourself (names of the Debian packages): $*" >&2
        return 1
    fi
    if [ -n "$asRoot" ] && ! has sudo; then
        echo "Installing needs root, and there is no sudo. Please run as root: apt-get install $*" >&2
        return 1
    fi
}

explainFailure() {
    [ -t 1 ] || [ ! -f $log ] || tail -n 20 $log >&2
    echo "$1" >&2
}

if [ -n "$required" ]; then
    # Package names are single words.
    # shellcheck disable=SC2086
    canInstall $required || exit 1
    # shellcheck disable=SC2086
    installPackages $required || {
        explainFailure "apt-get could not install: $required"
        exit 1
    }
    findMissing
    if [ -n "$required" ]; then
        echo "Still missing after installing: $required (is CC='${CC:-cc}' the compiler you meant?)" >&2
        exit 1
    fi
fi

# Optional packages one by one: a machine may have some of them and not others.
if [ -n "$suggested" ]; then
    # shellcheck disable=SC2086
    if canInstall $suggested; then
        for package in $suggested; do
            hasCandidate "$package" || updateLists || true
            if ! hasCandidate "$package"; then
                echo "There is no package $package here: what needs it will be skipped."
            elif ! installPackages "$package"; then
                explainFailure "apt-get could not install $package: what needs it will be skipped."
            fi
        done
    else
        echo "They are optional: what needs them will be skipped." >&2
    fi
fi

# The browser's driver comes from npm, as tests/browser/package-lock.json says.
browserPackages() {
    [ -f tests/browser/package-lock.json ] && has npm || return 0
    installed=tests/browser/node_modules/.package-lock.json
    [ -n "$(find $installed -newer tests/browser/package-lock.json 2>/dev/null)" ] && return 0
    echo "Installing the browser's driver: npm ci in tests/browser"
    mkdir -p build
    (cd tests/browser && npm ci --no-audit --no-fund --loglevel=error) >>$log 2>&1 </dev/null ||
        explainFailure "npm could not install it: the tests in a browser will be skipped."
}
case " $purposes " in
*" browser "*) browserPackages ;;
esac
exit 0

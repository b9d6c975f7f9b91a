#!/usr/bin/env bats
# no command writes over what it reads: its operands, and the files that a scene names

load helpers

# The scene in/s.yaml, which reads in/tiles.png, in/mesh.obj and in/pebbles.txt.
makeSceneWithFiles() {
    mkdir in
    cp "$root/scenes/regress/tiles-16-bit.png" in/tiles.png
    printf 'v 0 0 -5\nv 1 0 -5\nv 0 1 -5\nf 1 2 3\n' >in/mesh.obj
    printf '0 1 -6 0.5\n1 1 -6 0.5\n' >in/pebbles.txt
    cat >in/s.yaml <<'END'
image: {width: 64, height: 48}
lights:
  - point: {position: [-3, 1, 1], color: [20, 20, 20]}
objects:
  - sphere: {center: [0, 0, -5], radius: 1.5, material: {pattern: {image: {file: tiles.png, size: 0.9}}}}
  - mesh: {file: mesh.obj, material: {diffuse: [1, 0, 0]}}
  - spheres: {file: pebbles.txt, material: {diffuse: [0, 1, 0]}}
END
    cp -r in before
}

# A run that would overwrite FILE is refused, with the remedy, and has changed nothing.
refuses() { # FILE REMEDY ARGUMENT...
    local file=$1 remedy=$2
    shift 2
    try 2 "$@"
    hasText "$err" " would overwrite $file, which is read: choose another $remedy"
    isEmpty "$out"
    diff -r before in
}

@test "an input is not written over, whatever it is called" {
    makeSceneWithFiles
    ln in/s.yaml link.png
    refuses in/s.yaml "name with -o" render in/s.yaml -o in/s.yaml
    hasLine "$err" "eclairage: error: writing in/s.yaml would overwrite in/s.yaml, which is read: choose another name with -o"
    refuses in/s.yaml "name with -o" render in/s.yaml -o link.png
    refuses in/s.yaml "name with -o" pov in/s.yaml -o ./in/s.yaml
    refuses in/s.yaml "name with --svg" why in/s.yaml 1 2 --svg in/s.yaml
    try 0 render -q in/s.yaml -o a.png
    try 0 render -q in/s.yaml -o b.png
    cp b.png before.png
    refuses b.png "name with -o" diff a.png b.png -o b.png
    cmp before.png b.png
}

@test "what a scene reads is not written over" {
    makeSceneWithFiles
    for file in tiles.png mesh.obj pebbles.txt; do
        refuses in/$file "name with -o" render in/s.yaml -o in/$file
        refuses in/$file "name with -o" pov in/s.yaml -o in/$file
        refuses in/$file "name with --svg" why in/s.yaml 1 2 --svg in/$file
    done
    ln in/tiles.png a-depth.png
    refuses in/tiles.png "name with -o" render in/s.yaml -o a.png --aov depth

    # A name that nobody gave.
    mv in/s.yaml in/tiles.yaml
    rm -r before
    cp -r in before
    refuses in/tiles.png "name with -o" render in/tiles.yaml
}

@test "a report of compare is not written over what is read" {
    needs povray
    makeSceneWithFiles
    for name in s-ours.png s-povray.png s-difference.png s.pov; do
        mkdir r
        ln in/mesh.obj r/$name
        try 2 compare in/s.yaml --out r
        hasText "$err" "in/s.yaml: writing r/$name would overwrite in/mesh.obj, which is read: choose another folder with --out"
        diff -r before in
        rm -r r
    done
    mkdir r
    ln in/s.yaml r/results.json
    refuses in/s.yaml "folder with --out" compare in/s.yaml --out r
    mv r/results.json r/index.html
    refuses in/s.yaml "folder with --out" compare in/s.yaml --out r

    # One scene's files and another scene.
    rm -r r
    makeScene other.yaml
    mkdir r
    ln in/s.yaml r/other.pov
    try 2 compare in/s.yaml other.yaml --out r
    hasText "$err" "other.yaml: writing r/other.pov would overwrite in/s.yaml"
    diff -r before in
}

@test "a report of explain is not written over what is read" {
    makeSceneWithFiles
    try 0 render -q in/s.yaml -o in/mine.png
    cp in/mine.png before/
    for name in index.html results.json; do
        for file in s.yaml mine.png tiles.png mesh.obj pebbles.txt; do
            mkdir r
            ln in/$file r/$name
            refuses in/$file "folder with --out" explain in/s.yaml in/mine.png --out r
            [ "$(ls r)" = $name ]
            rm -r r
        done
        mkdir r
        ln in/mine.png r/$name
        refuses in/mine.png "folder with --out" explain in/mine.png in/tiles.png --out r/
        rm -r r
    done
}

@test "nor is one of the habits of POV-Ray" {
    needs povray
    makeSceneWithFiles
    for name in index.html results.json ours.png native.png matched.pov native-difference.png left-handed.png area-light-difference.png; do
        for file in s.yaml tiles.png; do
            mkdir r
            ln in/$file r/$name
            refuses in/$file "folder with --out" explain in/s.yaml --out r
            [ "$(ls r)" = $name ]
            rm -r r
        done
    done
}

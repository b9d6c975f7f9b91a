#!/usr/bin/env bats
# eclairage render --aov

load helpers

allNames='normal depth id albedo ambient emission diffuse specular background reflection transmission shadow'

@test "pictures of other quantities lie beside the picture" {
    makeScene s.yaml
    try 0 render s.yaml -o ball.png --aov normal,depth,diffuse
    isEmpty "$out"
    hasLine "$err" "eclairage: wrote ball-normal.png"
    hasLine "$err" "eclairage: wrote ball-diffuse.png"
    hasText "$err" "eclairage: wrote ball-depth.png (white is at the distance "
    folderHolds ball-depth.png ball-diffuse.png ball-normal.png ball.png s.yaml
    for name in ball ball-normal ball-depth ball-diffuse; do
        isPng $name.png
    done
}

@test "the picture is the same with and without them, and by either engine" {
    makeScene s.yaml
    try 0 render s.yaml -o plain.png
    try 0 render s.yaml -o with.png --aov all --quiet
    isEmpty "$err"
    cmp plain.png with.png
    try 0 render s.yaml -o reference.png --aov all --engine reference
    try 0 render s.yaml -o one.png --aov all --threads 1
    for name in $allNames; do
        cmp with-$name.png reference-$name.png
        cmp with-$name.png one-$name.png
    done
}

@test "without -o they are named by the scene; another ending of -o stays" {
    makeScene s.yaml
    try 0 render s.yaml --aov id
    try 0 render s.yaml -o picture.of.mine --aov id,id
    folderHolds picture.of.mine picture.of.mine-id.png s-id.png s.png s.yaml
}

@test "all is every one, and JSON lists them" {
    makeScene s.yaml
    try 0 render s.yaml -o a.png --aov all --json
    json --arg names "$allNames" '[.aov[].name] == ($names | split(" "))'
    json 'all(.aov[]; .file == "a-\(.name).png")'
    json '.aov[] | select(.name == "depth") | .farthest | . > 3.1 and . < 5.3'
    json '.aov[] | select(.name == "id") | .objects | length == 2 and all(.kind == "sphere" and .pixels > 0)
        and ([.[].line] == [5, 6]) and all(.color | test("^#[0-9a-f]{6}$"))'
    for name in $allNames; do
        isPng a-$name.png
    done
    try 0 render s.yaml -o a.png --json
    json 'has("aov") == false'
}

# The bit depth and the chunks behind the size: pngHead FILE
pngHead() {
    head -c 25 "$1" | tail -c 1 | od -An -tu1 | tr -d ' '
    grep -aoE 'sRGB|gAMA' "$1" | sort | tail -1
}

@test "data are linear, colours as the picture" {
    makeScene s.yaml
    try 0 render s.yaml -o a.png --aov normal,depth,id,albedo
    [ "$(pngHead a-normal.png | xargs)" = "8 gAMA" ]
    [ "$(pngHead a-depth.png | xargs)" = "16 gAMA" ]
    [ "$(pngHead a-id.png | xargs)" = "8 sRGB" ]
    [ "$(pngHead a-albedo.png | xargs)" = "8 sRGB" ]
    try 0 render s.yaml -o a.png --aov normal,id,albedo --bit-depth 16 --encoding linear
    [ "$(pngHead a-normal.png | xargs)" = "16 gAMA" ]
    [ "$(pngHead a-id.png | xargs)" = "8 sRGB" ]
    [ "$(pngHead a-albedo.png | xargs)" = "16 gAMA" ]
}

@test "a term that the scene does not have is black" {
    makeScene s.yaml
    try 0 render s.yaml -o a.png --aov emission,background,specular
    cmp a-emission.png a-background.png
    not cmp -s a-emission.png a-specular.png
    # Without highlights the diffuse term is the whole picture.
    try 0 render s.yaml -o b.png --aov diffuse --model lambert
    cmp b.png b-diffuse.png
}

@test "a name that there is not" {
    makeScene s.yaml
    try 2 render s.yaml --aov normal,dept
    sameAs "$err" <<'END'
eclairage: error: --aov has no 'dept'; did you mean 'depth'? There are normal, depth, id, albedo, ambient, emission, diffuse, specular, background, reflection, transmission, shadow and all
Try: eclairage render --help
END
    try 2 render s.yaml --aov velocity
    hasText "$err" "--aov has no 'velocity'; there are normal, depth"
    for list in '' , normal, ,normal normal,,depth; do
        try 2 render s.yaml --aov "$list"
        hasText "$err" "--aov needs names with one comma between them, not '$list'"
    done
    try 2 render s.yaml --aov
    try 2 compare s.yaml --aov normal
    hasText "$err" "'compare' does not take --aov, which is an option of render"
    folderHolds s.yaml
}

@test "standard output has no name to make theirs from" {
    makeScene s.yaml
    try 2 render s.yaml -o - --aov normal
    hasText "$err" "--aov writes its pictures beside that of -o, and -o - has no name"
    isEmpty "$out"
    try 0 render - -o made.png --aov normal <s.yaml
    folderHolds made-normal.png made.png s.yaml
}

@test "the scene is not overwritten, and nothing is drawn that could not be written" {
    makeScene a-normal.png
    try 2 render a-normal.png -o a.png --aov depth,normal
    hasText "$err" "writing a-normal.png would overwrite a-normal.png, which is read"
    makeScene s.yaml
    mkdir b-depth.png
    try 4 render s.yaml -o b.png --aov normal,depth
    hasText "$err" "b-depth.png"
    folderHolds a-normal.png b-depth.png s.yaml
}

@test "pixels that are not finite are warned of, by name" {
    makeScene s.yaml
    sed -i 's/color: .*}/color: [3e38, 3e38, 3e38], falloff: none}/; s/diffuse: \[1, 0, 0\]/diffuse: [9, 0, 0]/' s.yaml
    try 0 render s.yaml -o a.png --aov diffuse,normal
    hasText "$err" "warning: s.yaml: in a-diffuse.png "
    hasNoText "$err" "in a-normal.png"
}

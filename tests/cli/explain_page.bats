#!/usr/bin/env bats
# eclairage explain --out with a picture: the page that says what is wrong with it

load helpers

# The scene s.yaml, right.png of it, and mine.png without its shadows.
makePictures() {
    makeScene s.yaml 'render: {shadows: true}'
    makeScene lit.yaml 'render: {shadows: false}'
    try 0 render s.yaml -o right.png
    try 0 render lit.yaml -o mine.png
    rm lit.yaml
}

# Nothing on the page comes from elsewhere; it is closed, and each picture has words.
standsAlone() { # PAGE
    not grep -qE '(src|href)="[^"#d.]|(src|href)="(https?:)?//|url\(|@import' "$1"
    hasText "$1" "default-src 'none'"
    [ "$(tail -1 "$1")" = "</html>" ]
    [ "$(grep -o '<img [^>]*alt="[^"]' "$1" | wc -l)" = 3 ]
    [ "$(grep -o '<img ' "$1" | wc -l)" = 3 ]
    not grep -qiw 'nan\|inf' <(grep -v base64 "$1")
}

@test "a scene and a picture: the cause, the pair, the waterfall, and the JSON beside it" {
    makePictures
    try 0 explain s.yaml mine.png --json --quiet
    cp "$out" alone.json
    try 0 explain s.yaml mine.png --json --out new/folder
    cmp "$out" new/folder/results.json
    cmp alone.json new/folder/results.json
    hasLine "$err" "eclairage: the report is new/folder/index.html"
    [ "$(find new -type f | sort | xargs)" = "new/folder/index.html new/folder/results.json" ]
    rm alone.json
    folderHolds s.yaml right.png mine.png new

    page=new/folder/index.html
    standsAlone $page
    hasText $page '<title>What is wrong with mine.png'
    hasText $page 'The difference has one cause: shadows that are missing or too many.'
    hasText $page 'explain s.yaml mine.png --json --out new/folder'
    hasText $page 'alt="The picture mine.png"'
    hasText $page 'alt="The scene s.yaml as Éclairage draws it"'
    hasText $page '<title id="chart-title">'
    hasText $page 'after 1. shadow'
    hasText $page "$(jq -r '.causes[0].text' "$out" | cut -c2- | sed "s/'/\&#39;/g")"
    hasText $page 'Look at: s.yaml:'
    # The chart and the table begin with what `diff` measures, and end with what is left.
    rmse=$(printf %.5f "$("$ECLAIRAGE" diff mine.png right.png --json | jq .rmse)")
    left=$(printf %.5f "$(jq '.causes[0].residual' "$out")")
    [ "$rmse" != "$left" ]
    hasText $page "<b>$rmse</b>, of the samples"
    hasText $page ">before</text><text class=\"number\" x=\"480\" y=\"17\" text-anchor=\"end\">$rmse</text>"
    hasText $page "<tr><th scope=\"row\">before</th><td>$rmse</td>"
    hasText $page "left after this <b>$left</b>"
    [ "$(grep -o '<section class="panel habit"' $page | wc -l)" = 1 ]
}

@test "two pictures: in words the same with --out as without, and the page names both" {
    [ -z "$ECLAIRAGE_SANITIZED" ] || skip "the search is slow here, and the same in the others"
    makePictures
    try 0 explain mine.png right.png --quiet
    cp "$out" words
    try 0 explain mine.png right.png --out r --quiet
    cmp "$out" words
    isEmpty "$err"
    standsAlone r/index.html
    hasText r/index.html 'alt="The picture mine.png"'
    hasText r/index.html 'alt="The picture right.png"'
    try 0 explain mine.png right.png --json
    cmp "$out" r/results.json
}

@test "what agrees and what is not known is said, without a waterfall" {
    makePictures
    try 0 explain s.yaml right.png --out r
    standsAlone r/index.html
    hasText r/index.html '<p class="sum">The pictures agree: no sample differs by more than rounding.</p>'
    hasText r/index.html 'is <b>0.00000</b>'
    hasNoText r/index.html 'id="chart-title"'
    hasNoText r/index.html '<section class="panel'
    try 0 explain s.yaml right.png --json
    json '.causes == []'
    cmp "$out" r/results.json

    # Another scene altogether.
    cat >other.yaml <<'END_OF_SCENE'
image: {width: 64, height: 48}
background: [0.2, 0.5, 0.1]
lights: [{point: {position: [0, 5, 0], color: 30}}]
objects:
  - box: {min: [-2, -1, -6], max: [-0.5, 1, -5]}
  - plane: {point: [0, -1, 0], normal: [0, 1, 0], material: {diffuse: [0.2, 0.2, 1]}}
END_OF_SCENE
    try 0 render other.yaml -o other.png
    try 0 explain s.yaml other.png --out r --json
    json '[.causes[].cause] == ["unknown"]'
    standsAlone r/index.html
    hasText r/index.html 'None of the mistakes that are known here explains the difference.'
    hasText r/index.html 'not explained <b>'
    hasNoText r/index.html 'id="chart-title"'
}

@test "another depth or encoding: the right picture is shown as mine is stored" {
    [ -z "$ECLAIRAGE_SANITIZED" ] || skip "the search is slow here, and the same in the others"
    makePictures
    try 0 render s.yaml --bit-depth 16 --encoding linear -o right16.png
    try 0 explain mine.png right16.png --out r
    standsAlone r/index.html
    hasText r/index.html ' has 16 bits a sample, linear; here it is shown, and held against mine, as mine is stored: in 8 bits, sRGB.'
    # Then it is the picture in 8 bits, but for what was rounded twice.
    grep -o 'base64,[^"]*' r/index.html | cut -c8- >pictures
    sed -n 1p pictures | base64 -d >left.png
    sed -n 2p pictures | base64 -d >shown.png
    try 0 diff left.png mine.png --hard-fail 0
    try 0 diff shown.png right.png --hard-fail 0.004
    try 0 explain mine.png right.png --out r
    hasNoText r/index.html 'as mine is stored'
    # The other way round, and from a scene, which is drawn as mine is stored.
    try 0 explain right16.png mine.png --out r
    hasText r/index.html 'as mine is stored: in 16 bits, linear.'
    try 0 explain s.yaml right16.png --out r
    hasNoText r/index.html 'as mine is stored'
}

@test "names are no markup" {
    makePictures
    cp mine.png '<b>&".png'
    try 0 explain s.yaml '<b>&".png' --out r --quiet
    hasText r/index.html '&lt;b&gt;&amp;&quot;.png'
    hasNoText r/index.html '<b>&'
    standsAlone r/index.html
    try 0 explain - mine.png --out r --quiet <s.yaml
    hasText r/index.html '&lt;stdin&gt;'
    try 0 explain mine.png - --out r --quiet <right.png
    hasText r/index.html 'alt="The picture &lt;stdin&gt;"'
}

@test "what goes wrong: nothing half-written stays" {
    makePictures
    # Where nothing can be explained no folder is made.
    try 4 explain s.yaml missing.png --out r
    try 2 explain mine.png right.png --model phong --out r
    try 0 render s.yaml --width 20 --height 20 -o small.png
    code=0
    "$ECLAIRAGE" explain small.png right.png --out r2 >"$out" 2>"$err" || code=$?
    [ "$code" != 0 ]
    isEmpty "$out"
    [ ! -e r ]
    touch file
    try 4 explain s.yaml mine.png --out file/r
    hasText "$err" "file"
    isEmpty "$out"
    mkdir -p full/index.html
    try 4 explain s.yaml mine.png --out full
    hasText "$err" "full/index.html"
    [ "$(find full -type f | wc -l)" = 0 ]
    nothingTemporary
}

/* test_report.c - results as JSON, as words and as a page: exact texts, and what hostile input becomes. */
#include "base/cancel.h"
#include "base/files.h"
#include "compare/html.h"
#include "compare/report.h"
#include "compare/report_metrics.h"
#include "compare/words.h"
#include "image/image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const Tolerance strict = {
    .fail = 3.1e-5, .failPercent = 0, .hardFail = 1, .rmse = NAN, .ssim = NAN, .flip = NAN};

/* A scene that agrees but for the last bit. */
static SceneResult makeAgreeing(void)
{
    SceneResult result = {.scene = "scenes/a.yaml",
                          .status = statusOk(),
                          .tolerance = strict,
                          .verdict = {.pass = true},
                          .renderSeconds = 0.0212345678,
                          .povraySeconds = 0.75,
                          .compareSeconds = 0.5,
                          .oursFile = "a-ours.png",
                          .povrayFile = "a-povray.png",
                          .differenceFile = "a-difference.png",
                          .povFile = "a.pov",
                          .command = "eclairage compare scenes/a.yaml"};
    result.metrics = (Metrics){.width = 640,
                               .height = 480,
                               .pixels = 307200,
                               .identicalPixels = 307100,
                               .maxDifference = 1.0 / 65535,
                               .worst = {12, 40, 1, 0.5, 0.25},
                               .mae = 1e-9,
                               .rmse = 2.5e-8,
                               .psnr = 152.25,
                               .ssim = 1.0,
                               .flip = 0.0};
    result.metrics.worst = (WorstPixel){12, 40, 1, 1000.0 / 65535, 999.0 / 65535};
    return result;
}

static SceneResult makeDiffering(void)
{
    SceneResult result = makeAgreeing();
    result.scene = "scenes/longer.yaml";
    result.metrics.differingPixels = 1234;
    result.metrics.differingPercent = 0.40169270833333331;
    result.metrics.maxDifference = 4660.0 / 65535;
    result.metrics.psnr = NAN;
    result.metrics.ssim = NAN;
    result.verdict = (Verdict){.pass = false, .reasonCount = 2, .reasons = {"too \"many\"", "too far"}};
    return result;
}

static SceneResult makeFailed(void)
{
    return (SceneResult){.scene = "b.yaml",
                         .status = statusError(STATUS_SCENE, "b.yaml:3:5: unknown key 'postion'"),
                         .command = "eclairage compare b.yaml"};
}

static void testJson(void **state)
{
    (void)state;
    SceneResult results[] = {makeAgreeing(), makeDiffering(), makeFailed()};
    /* Powers of two, so that the decimals are known without arithmetic. */
    results[0].metrics.maxDifference = 0.5;
    results[0].metrics.worst = (WorstPixel){12, 40, 1, 0.75, 0.25};
    results[1].metrics.maxDifference = 0.125;
    results[1].metrics.worst = (WorstPixel){0, 7, 2, 0.0, 0.125};
    results[1].metrics.differingPercent = 12.5;
    results[1].povFile = NULL;
    Text text = {0};
    writeResultsJson(results, 3, &text);
    assert_string_equal(
        textString(&text),
        "{\n"
        "  \"pass\": false,\n"
        "  \"scenes\": [\n"
        "    {\n"
        "      \"scene\": \"scenes/a.yaml\",\n"
        "      \"pass\": true,\n"
        "      \"width\": 640,\n"
        "      \"height\": 480,\n"
        "      \"pixels\": 307200,\n"
        "      \"identical_pixels\": 307100,\n"
        "      \"differing_pixels\": 0,\n"
        "      \"differing_percent\": 0,\n"
        "      \"max_difference\": 0.5,\n"
        "      \"worst_pixel\": {\"x\": 12, \"y\": 40, \"channel\": 1, \"a\": 0.75, \"b\": 0.25},\n"
        "      \"mae\": 1e-09,\n"
        "      \"rmse\": 2.5e-08,\n"
        "      \"psnr\": 152.25,\n"
        "      \"ssim\": 1,\n"
        "      \"flip\": 0,\n"
        "      \"reasons\": [],\n"
        "      \"seconds\": {\"render\": 0.021235, \"povray\": 0.75, \"compare\": 0.5},\n"
        "      \"files\": {\n"
        "        \"ours\": \"a-ours.png\",\n"
        "        \"povray\": \"a-povray.png\",\n"
        "        \"difference\": \"a-difference.png\",\n"
        "        \"pov\": \"a.pov\"\n"
        "      }\n"
        "    },\n"
        "    {\n"
        "      \"scene\": \"scenes/longer.yaml\",\n"
        "      \"pass\": false,\n"
        "      \"width\": 640,\n"
        "      \"height\": 480,\n"
        "      \"pixels\": 307200,\n"
        "      \"identical_pixels\": 307100,\n"
        "      \"differing_pixels\": 1234,\n"
        "      \"differing_percent\": 12.5,\n"
        "      \"max_difference\": 0.125,\n"
        "      \"worst_pixel\": {\"x\": 0, \"y\": 7, \"channel\": 2, \"a\": 0, \"b\": 0.125},\n"
        "      \"mae\": 1e-09,\n"
        "      \"rmse\": 2.5e-08,\n"
        "      \"psnr\": null,\n"
        "      \"ssim\": null,\n"
        "      \"flip\": 0,\n"
        "      \"reasons\": [\n"
        "        \"too \\\"many\\\"\",\n"
        "        \"too far\"\n"
        "      ],\n"
        "      \"seconds\": {\"render\": 0.021235, \"povray\": 0.75, \"compare\": 0.5},\n"
        "      \"files\": {\n"
        "        \"ours\": \"a-ours.png\",\n"
        "        \"povray\": \"a-povray.png\",\n"
        "        \"difference\": \"a-difference.png\",\n"
        "        \"pov\": null\n"
        "      }\n"
        "    },\n"
        "    {\n"
        "      \"scene\": \"b.yaml\",\n"
        "      \"pass\": false,\n"
        "      \"error\": {\n"
        "        \"code\": 3,\n"
        "        \"message\": \"b.yaml:3:5: unknown key 'postion'\"\n"
        "      }\n"
        "    }\n"
        "  ]\n"
        "}\n");
    textFree(&text);
}

static void testHtml(void **state)
{
    (void)state;
    static const struct {
        const char *text, *html;
    } cases[] = {
        {"plain é 漢 🌞", "plain é 漢 🌞"},
        {"<script>alert(1)</script>", "&lt;script&gt;alert(1)&lt;/script&gt;"},
        {"a\"b'c&d", "a&quot;b&#39;c&amp;d"},
        {"&amp;", "&amp;amp;"},
        {"tab\tline\n", "tab\tline\n"},
        {"\x1B[31m\x07\x7F", "\xEF\xBF\xBD[31m\xEF\xBF\xBD\xEF\xBF\xBD"},
        {"\xC2\x9B", "\xEF\xBF\xBD"},                             /* U+009B, a control character */
        {"\xFF\xC0\xAF", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"}, /* never UTF-8; overlong '/' */
        {"\xED\xA0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"}, /* a surrogate */
        {"\xF4\x90\x80\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"}, /* above U+10FFFF */
        {"cut \xE6\xBC", "cut \xEF\xBF\xBD\xEF\xBF\xBD"},
        {"a\xE2\x80\xAE"
         "b\xE2\x81\xA6",
         "a\xEF\xBF\xBD"
         "b\xEF\xBF\xBD"}, /* U+202E, U+2066 turn the direction */
        {"\xE2\x80\xA6", "\xE2\x80\xA6"},
        {NULL, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Text html = {0};
        textAppendHtml(&html, cases[i].text);
        assert_string_equal(textString(&html), cases[i].html);
        textFree(&html);
    }
}

static void testFileAddress(void **state)
{
    (void)state;
    static const struct {
        const char *name, *address;
    } cases[] = {{"a-ours.png", "./a-ours.png"},
                 {"javascript:alert(1)", "./javascript%3Aalert%281%29"},
                 {"//host/x", ".///host/x"},
                 {"50% é#?\".png", "./50%25%20%C3%A9%23%3F%22.png"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Text address = {0};
        textAppendFileAddress(&address, cases[i].name);
        assert_string_equal(textString(&address), cases[i].address);
        textFree(&address);
    }
}

static void testPlain(void **state)
{
    (void)state;
    Text plain = {0};
    /* An escape sequence, a new line, a direction override (U+202E) and a broken byte. */
    size_t characters = textAppendPlain(&plain, "é\x1B[2J\nx\xE2\x80\xAE\xFF");
    assert_string_equal(textString(&plain), "é\xEF\xBF\xBD[2J\xEF\xBF\xBDx\xEF\xBF\xBD\xEF\xBF\xBD");
    assert_int_equal(characters, 9);
    textFree(&plain);
}

/* What writeBase64 writes. */
static char *encodeBase64(const void *data, size_t length)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    writeBase64(stream, data, length);
    fclose(stream);
    return text;
}

static void testBase64(void **state)
{
    (void)state;
    /* RFC 4648, section 10. */
    static const char *const cases[][2] = {{"", ""},
                                           {"f", "Zg=="},
                                           {"fo", "Zm8="},
                                           {"foo", "Zm9v"},
                                           {"foob", "Zm9vYg=="},
                                           {"fooba", "Zm9vYmE="},
                                           {"foobar", "Zm9vYmFy"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = encodeBase64(cases[i][0], strlen(cases[i][0]));
        assert_string_equal(text, cases[i][1]);
        free(text);
    }

    /* Decode lengths around the writer's block of 3072 bytes, with all byte values. */
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char data[6200];
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (unsigned char)(i * 167 + i / 256);
    for (size_t length = 3068; length <= sizeof data; length += length < 3080 ? 1 : 1039) {
        char *text = encodeBase64(data, length);
        assert_int_equal(strlen(text), (length + 2) / 3 * 4);
        for (size_t i = 0; i < length; i++) {
            size_t digit = i / 3 * 4 + i % 3;
            unsigned high = (unsigned)(strchr(digits, text[digit]) - digits);
            unsigned low = (unsigned)(strchr(digits, text[digit + 1]) - digits);
            unsigned shift = 2 * (unsigned)(i % 3);
            assert_int_equal(((high << (2 + shift)) | (low >> (4 - shift))) & 255, data[i]);
        }
        free(text);
    }
}

static void testRunVerdict(void **state)
{
    (void)state;
    static const struct {
        const char *outcomes, *sentence; /* a: agrees, d: differs, f: failed */
    } cases[] = {
        {"", "No scene was compared."},
        {"a", "The scene agrees with POV-Ray."},
        {"d", "The scene differs from POV-Ray."},
        {"f", "The scene could not be compared."},
        {"aa", "Both scenes agree with POV-Ray."},
        {"aaa", "All 3 scenes agree with POV-Ray."},
        {"dd", "Both scenes differ from POV-Ray."},
        {"fff", "None of the 3 scenes could be compared."},
        {"aad", "1 of 3 scenes differs from POV-Ray."},
        {"dad", "2 of 3 scenes differ from POV-Ray."},
        {"af", "1 of 2 scenes could not be compared, the other agrees with POV-Ray."},
        {"aaf", "1 of 3 scenes could not be compared, the others agree with POV-Ray."},
        {"adff", "1 of 4 scenes differs from POV-Ray, 2 could not be compared."},
        {"df", "1 of 2 scenes differs from POV-Ray, 1 could not be compared."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        SceneResult results[4];
        size_t count = strlen(cases[i].outcomes);
        for (size_t j = 0; j < count; j++)
            results[j] = cases[i].outcomes[j] == 'a'   ? makeAgreeing()
                         : cases[i].outcomes[j] == 'd' ? makeDiffering()
                                                       : makeFailed();
        Text text = {0};
        textAppendRunVerdict(&text, results, count);
        assert_string_equal(textString(&text), cases[i].sentence);
        textFree(&text);
    }
}

static void testResultsText(void **state)
{
    (void)state;
    SceneResult results[] = {makeAgreeing(), makeDiffering(), makeFailed(), makeAgreeing()};
    results[3].scene = "\x1B[2Jé.yaml";
    results[3].metrics.maxDifference = 0;
    results[3].metrics.pixels = 64;
    Text text = {0};
    writeResultsText(results, 4, false, &text);
    assert_string_equal(
        textString(&text),
        "agree   scenes/a.yaml           0 of 307200 pixels differ, largest 1/65535\n"
        "differ  scenes/longer.yaml   1234 of 307200 pixels differ, largest 4660/65535 at (12, 40)\n"
        "failed  b.yaml               b.yaml:3:5: unknown key 'postion'\n"
        "agree   \xEF\xBF\xBD[2Jé.yaml              0 of     64 pixels differ, all identical\n"
        "1 of 4 scenes differs from POV-Ray, 1 could not be compared.\n");
    textFree(&text);
    writeResultsText(results, 1, true, &text);
    assert_string_equal(textString(&text),
                        "\033[32magree\033[0m   scenes/a.yaml   0 of 307200 pixels differ, largest 1/65535\n"
                        "The scene agrees with POV-Ray.\n");
    textFree(&text);
}

/* Both pictures agree as wholes, the diffuse term too, and the specular one does not. */
static void addTerms(SceneResult *result, TermResult terms[2])
{
    SceneResult agreeing = makeAgreeing(), differing = makeDiffering();
    terms[0] = (TermResult){.term = "diffuse",
                            .metrics = agreeing.metrics,
                            .verdict = agreeing.verdict,
                            .oursFile = "a-ours.png",
                            .povrayFile = "a-povray.png",
                            .differenceFile = "a-difference.png",
                            .povFile = "a-diffuse.pov"};
    terms[1] = terms[0];
    terms[1].term = "specular";
    terms[1].metrics = differing.metrics;
    terms[1].verdict = differing.verdict;
    result->terms = terms;
    result->termCount = 2;
    result->perTerm = true;
}

static void testTermsInWords(void **state)
{
    (void)state;
    SceneResult result = makeAgreeing();
    TermResult terms[2];
    addTerms(&result, terms);
    Text text = {0};
    writeResultsText(&result, 1, false, &text);
    assert_string_equal(
        textString(&text),
        "differ  scenes/a.yaml   0 of 307200 pixels differ, largest 1/65535 at (12, 40)\n"
        "        the specular term disagrees: 1234 of 307200 pixels differ, largest 4660/65535 at (12, 40)\n"
        "The scene differs from POV-Ray.\n");
    textFree(&text);

    /* All agree. */
    terms[1].verdict = terms[0].verdict;
    writeResultsText(&result, 1, false, &text);
    assert_string_equal(textString(&text),
                        "agree   scenes/a.yaml   0 of 307200 pixels differ, largest 1/65535\n"
                        "        each term agrees: diffuse, specular\n"
                        "The scene agrees with POV-Ray.\n");
    textFree(&text);

    /* There is none; and none was asked for. */
    result.termCount = 0;
    writeResultsText(&result, 1, false, &text);
    assert_non_null(strstr(textString(&text), "        no term: the scene is black\n"));
    textFree(&text);
    result.perTerm = false;
    writeResultsText(&result, 1, false, &text);
    assert_null(strstr(textString(&text), "term"));
    textFree(&text);
}

static void testTermsInJson(void **state)
{
    (void)state;
    SceneResult result = makeAgreeing();
    TermResult terms[2];
    addTerms(&result, terms);
    Text text = {0};
    writeResultsJson(&result, 1, &text);
    const char *array = strstr(textString(&text), "\"terms\": [");
    assert_non_null(array);
    assert_non_null(strstr(textString(&text), "\"pass\": false,\n  \"scenes\""));
    const char *diffuse = strstr(array, "\"term\": \"diffuse\",\n          \"pass\": true,");
    const char *specular = strstr(array, "\"term\": \"specular\",\n          \"pass\": false,");
    assert_true(diffuse != NULL && specular != NULL && diffuse < specular);
    assert_non_null(strstr(specular, "\"differing_pixels\": 1234,"));
    assert_non_null(strstr(specular, "\"too far\""));
    assert_non_null(strstr(specular, "\"pov\": \"a-diffuse.pov\""));
    textFree(&text);
    result.perTerm = false;
    writeResultsJson(&result, 1, &text);
    assert_null(strstr(textString(&text), "\"terms\""));
    textFree(&text);
}

static void testMetricsText(void **state)
{
    (void)state;
    SceneResult result = makeDiffering();
    result.metrics.width = 8;
    result.metrics.height = 8;
    result.metrics.maxDifference = 51.0 / 255;
    result.metrics.worst = (WorstPixel){3, 7, 2, 255.0 / 255, 204.0 / 255};
    Text text = {0};
    writeMetricsText(&result.metrics, &result.verdict, false, &text);
    assert_string_equal(textString(&text), "differ  1234 of 307200 pixels differ, largest 51/255\n"
                                           "  because too \"many\"\n"
                                           "  because too far\n"
                                           "\n"
                                           "  size                8 x 8\n"
                                           "  identical pixels    307100 of 307200\n"
                                           "  differing pixels    0.401693 %\n"
                                           "  worst pixel         (3, 7) in b: 255/255 against 204/255\n"
                                           "  mean abs. error     1e-09\n"
                                           "  RMSE                2.5e-08\n"
                                           "  PSNR                none, the pictures are equal\n"
                                           "  SSIM                none, it needs 11 x 11 pixels\n"
                                           "  FLIP                0\n");
    textFree(&text);
}

static void testReadable(void **state)
{
    (void)state;
    static const struct {
        double value;
        int digits;
        const char *text;
    } cases[] = {{0, 3, "0"},
                 {1.0 / 3, 3, "0.333"},
                 {123456, 2, "120000"},
                 {-0.0001234, 2, "-0.00012"},
                 {4.17e-7, 2, "4.2 × 10⁻⁷"},
                 {1.0 / 65535, 3, "1.53 × 10⁻⁵"},
                 {5e-324, 3, "4.94065645841247 × 10⁻³²⁴"},
                 {INFINITY, 3, "inf"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Text text = {0};
        textAppendReadable(&text, cases[i].value, cases[i].digits);
        assert_string_equal(textString(&text), cases[i].text);
        textFree(&text);
    }
}

/* Each limit, broken alone, marks exactly its own row; the table passes as a whole when the verdict does. */
static void testMetricRows(void **state)
{
    (void)state;
    static const struct {
        Tolerance tolerance;
        const char *row;
    } cases[] = {{{1e-6, 0.1, NAN, NAN, NAN, NAN}, "Differing pixels"},
                 {{1e-6, 100, 0.01, 1, 0, 1}, "Largest difference"},
                 {{1e-6, 100, 1, 1e-9, 0, 1}, "RMSE"},
                 {{1e-6, 100, 1, 1, 0.99, 1}, "SSIM"},
                 {{1e-6, 100, 1, 1, 0, 0.001}, "FLIP"},
                 {{1e-6, 100, 1, 1, 0, 1}, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        SceneResult result = makeDiffering();
        result.metrics.ssim = 0.9;
        result.metrics.flip = 0.02;
        result.tolerance = cases[i].tolerance;
        assert_int_equal(judgeMetrics(&result.metrics, &result.tolerance).pass, cases[i].row == NULL);
        for (int number = 0; number < METRIC_ROW_COUNT; number++) {
            MetricRow row = makeMetricRow(&result, number);
            bool broken = cases[i].row != NULL && strcmp(cases[i].row, row.name) == 0;
            assert_int_equal(row.pass, !broken);
            assert_true(row.judged || !broken);
            assert_true(strlen(row.meaning) > 20 && row.value.length > 0);
            assert_int_equal(row.judged, row.limit.length > 0);
            freeMetricRow(&row);
        }
    }
}

/* --- The page --- */

typedef struct Folder {
    char *path;
    SceneResult results[3];
} Folder;

static char *joinPath(const char *folder, const char *name)
{
    Text path = {0};
    textAppendFormat(&path, "%s/%s", folder, name);
    char *copy = strdup(textString(&path));
    textFree(&path);
    return copy;
}

static char *readPage(const Folder *folder)
{
    char *path = joinPath(folder->path, "index.html"), *page = NULL;
    size_t length;
    Status status = readWholeFile(path, 1 << 26, &page, &length);
    free(path);
    assert_true(statusIsOk(&status));
    assert_int_equal(strlen(page), length);
    return page;
}

static size_t countIn(const char *text, const char *wanted)
{
    size_t count = 0;
    for (const char *found = strstr(text, wanted); found != NULL; found = strstr(found + 1, wanted))
        count++;
    return count;
}

static int setUp(void **state)
{
    Folder *folder = calloc(1, sizeof *folder);
    Status status = makeTemporaryFolder(&folder->path);
    assert_true(statusIsOk(&status));
    static const char *const names[] = {"a-ours.png", "a-povray.png", "a-difference.png"};
    for (size_t i = 0; i < 3; i++) {
        Image image;
        status = createImage(3, 2, 16, ENCODING_LINEAR, &image);
        assert_true(statusIsOk(&status));
        image.samples[0] = (uint16_t)(1000 + i);
        char *path = joinPath(folder->path, names[i]);
        status = writePng(path, &image, 1);
        assert_true(statusIsOk(&status));
        free(path);
        freeImage(&image);
    }
    folder->results[0] = makeAgreeing();
    folder->results[1] = makeDiffering();
    folder->results[2] = makeFailed();
    *state = folder;
    return 0;
}

static int tearDown(void **state)
{
    Folder *folder = *state;
    removeFolder(folder->path);
    free(folder->path);
    free(folder);
    return 0;
}

static void testPage(void **state)
{
    Folder *folder = *state;
    static const char hostile[] =
        "</script><script>x()</script>\"'><img src=x onerror=x()>{{run-command}}{{#scenes}}";
    folder->results[1].scene = hostile;
    folder->results[1].command = hostile;
    strcpy(folder->results[1].verdict.reasons[0], "</li><script>x()</script>");
    folder->results[2].status = statusError(STATUS_POVRAY, "%s", hostile);
    Status status = writeReport(folder->path, folder->results, 3, "run & <again>");
    assert_true(statusIsOk(&status));
    char *page = readPage(folder);
    assert_int_equal(countIn(page, "<script>"), 2);
    assert_int_equal(countIn(page, "<img src=x"), 0);
    assert_int_equal(countIn(page, "<section class=\"scene "), 3);
    assert_int_equal(countIn(page, "data:image/png;base64,iVBORw0KGgo"), 6);
    assert_int_equal(countIn(page, "run &amp; &lt;again&gt;"), 1);
    assert_true(countIn(page, "{{#scenes}}") > 0); /* the name, as text */
    assert_int_equal(countIn(page, "{{"), 2 * countIn(page, "{{#scenes}}"));
    assert_int_equal(countIn(page, "http://") + countIn(page, "https://"), 0);
    assert_int_equal(countIn(page, "✗ beyond"), 1);
    free(page);
}

/* A page that cannot be completed leaves the old one. */
static void testPageKeepsTheOldOne(void **state)
{
    Folder *folder = *state;
    Status status = writeReport(folder->path, folder->results, 1, "the-old-page");
    assert_true(statusIsOk(&status));
    folder->results[1].povrayFile = "missing.png";
    status = writeReport(folder->path, folder->results, 2, "second");
    assert_int_equal(status.code, STATUS_IO);
    assert_non_null(strstr(status.message, "missing.png"));
    char *page = readPage(folder);
    assert_int_equal(countIn(page, "the-old-page"), 1);
    free(page);
    status = writeReport("/nowhere/at/all", folder->results, 1, "third");
    assert_int_equal(status.code, STATUS_IO);
}

/* Pictures that a browser could not load as part of the page are linked. */
static void testPageOfLargePictures(void **state)
{
    Folder *folder = *state;
    char *path = joinPath(folder->path, "a-ours.png");
    assert_int_equal(truncate(path, 193L * 1024 * 1024), 0);
    free(path);
    Status status = writeReport(folder->path, folder->results, 1, "run");
    assert_true(statusIsOk(&status));
    char *page = readPage(folder);
    assert_int_equal(countIn(page, "data:image/png"), 0);
    assert_int_equal(countIn(page, "too large to be part of the page"), 1);
    free(page);
}

/* The last test: what is asked for here is never taken back. */
static void testInterrupted(void **state)
{
    Folder *folder = *state;
    requestCancel();
    Status status = writeReport(folder->path, folder->results, 1, "run");
    assert_int_equal(status.code, STATUS_INTERRUPTED);
    char *path = joinPath(folder->path, "index.html");
    assert_int_not_equal(access(path, F_OK), 0);
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testJson),
        cmocka_unit_test(testHtml),
        cmocka_unit_test(testFileAddress),
        cmocka_unit_test(testPlain),
        cmocka_unit_test(testBase64),
        cmocka_unit_test(testRunVerdict),
        cmocka_unit_test(testResultsText),
        cmocka_unit_test(testTermsInWords),
        cmocka_unit_test(testTermsInJson),
        cmocka_unit_test(testMetricsText),
        cmocka_unit_test(testReadable),
        cmocka_unit_test(testMetricRows),
        cmocka_unit_test_setup_teardown(testPage, setUp, tearDown),
        cmocka_unit_test_setup_teardown(testPageKeepsTheOldOne, setUp, tearDown),
        cmocka_unit_test_setup_teardown(testPageOfLargePictures, setUp, tearDown),
        cmocka_unit_test_setup_teardown(testInterrupted, setUp, tearDown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* png_bands.c - the rows of a PNG compressed in bands, side by side; see png_bands.h.
 *
 * A zlib stream (RFC 1950) is two bytes of header, deflate blocks and the Adler-32 sum of what was
 * compressed. Deflate blocks (RFC 1951) of different makers may follow each other as long as each ends at
 * a whole byte and does not refer back into another's: deflate's Z_SYNC_FLUSH ends at a byte with an empty
 * stored block, and every band begins with an empty history. adler32_combine makes the whole sum of the
 * bands' sums. pigz (M. Adler) compresses in parallel in the same way.
 */
#include "image/png_bands.h"

#include "base/threads.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    BAND_BYTES = 256 * 1024, /* a band's rows, filtered, unless one row is longer: a few ms of work */
    LONGEST_ROW = 1 << 30,   /* bytes, so that zlib's and PNG's lengths of 32 bits suffice */
    HEADER_BYTES = 2,        /* before the first band's blocks */
    SUM_BYTES = 4,           /* after the last band's */
    FLUSH_BYTES = 16,        /* more than Z_SYNC_FLUSH adds to deflateBound */
    FILTER_UP = 2            /* PNG specification, 9.2 */
};

/* Deflate (32 kB of history) and the check bits that make the header a multiple of 31. */
static const unsigned char zlibHeader[HEADER_BYTES] = {0x78, 0x01};

/* What a thread works in, made once for many bands: fresh memory costs more than the work. */
typedef struct Workspace {
    struct Workspace *next;
    z_stream stream;
    unsigned char *filtered;   /* the rows of a band; owned */
    unsigned char *compressed; /* owned */
    size_t capacity;           /* of compressed */
} Workspace;

typedef struct Compression {
    const Image *image;
    size_t rowSamples, rowBytes; /* rowBytes with the filter's byte in front */
    size_t rowsPerBand;
    const uint16_t *blackRow; /* what filters find above the first row */
    PngBands result;
    uint32_t *sums; /* each band's Adler-32 */

    /* Under the lock: the workspaces that no thread is using, and whether memory ran out. */
    pthread_mutex_t lock;
    Workspace *idle;
    bool failed;
} Compression;

/* Filter one row: each byte less the byte above it. A 16-bit sample has its high byte first. */
static void filterRow(const uint16_t *restrict row, const uint16_t *restrict above, size_t count,
                      int bitDepth, unsigned char *restrict filtered)
{
    *filtered++ = FILTER_UP;
    if (bitDepth == 8) {
        for (size_t i = 0; i < count; i++)
            filtered[i] = (unsigned char)(row[i] - above[i]);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        filtered[2 * i] = (unsigned char)((row[i] >> 8) - (above[i] >> 8));
        filtered[2 * i + 1] = (unsigned char)(row[i] - above[i]);
    }
}

static void freeWorkspace(Workspace *workspace)
{
    deflateEnd(&workspace->stream);
    free(workspace->filtered);
    free(workspace->compressed);
    free(workspace);
}

/* NULL when memory runs out. */
static Workspace *createWorkspace(const Compression *compression)
{
    /* Above each other the bytes of 8-bit samples are nearly all equal, and a search for runs of one byte
     * (Z_RLE) makes the most of that in the least time. The low bytes of 16-bit samples are seldom equal,
     * and there the search for any repetition, at its fastest, is worth its time (bench/NOTES.md). */
    int strategy = compression->image->bitDepth == 8 ? Z_RLE : Z_DEFAULT_STRATEGY;
    size_t length = compression->rowsPerBand * compression->rowBytes;
    Workspace *workspace = calloc(1, sizeof *workspace);
    if (workspace == NULL)
        return NULL;
    if (deflateInit2(&workspace->stream, Z_BEST_SPEED, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, strategy) !=
        Z_OK) {
        free(workspace);
        return NULL;
    }
    workspace->capacity = deflateBound(&workspace->stream, (uLong)length) + FLUSH_BYTES;
    workspace->filtered = malloc(length);
    workspace->compressed = malloc(workspace->capacity);
    if (workspace->filtered == NULL || workspace->compressed == NULL) {
        freeWorkspace(workspace);
        return NULL;
    }
    return workspace;
}

/* Take an idle workspace or make one. NULL when memory runs out, now or before. */
static Workspace *takeWorkspace(Compression *compression)
{
    pthread_mutex_lock(&compression->lock);
    Workspace *workspace = compression->idle;
    if (workspace != NULL)
        compression->idle = workspace->next;
    bool failed = compression->failed;
    pthread_mutex_unlock(&compression->lock);
    return workspace == NULL && !failed ? createWorkspace(compression) : workspace;
}

static void returnWorkspace(Compression *compression, Workspace *workspace, bool failed)
{
    pthread_mutex_lock(&compression->lock);
    if (workspace != NULL) {
        workspace->next = compression->idle;
        compression->idle = workspace;
    }
    compression->failed = compression->failed || failed;
    pthread_mutex_unlock(&compression->lock);
}

/* The bytes of a band before compression. */
static size_t bandLength(const Compression *compression, size_t number)
{
    size_t left = (size_t)compression->image->height - number * compression->rowsPerBand;
    return (left < compression->rowsPerBand ? left : compression->rowsPerBand) * compression->rowBytes;
}

static void filterBand(const Compression *compression, size_t number, unsigned char *filtered)
{
    size_t y = number * compression->rowsPerBand;
    size_t length = bandLength(compression, number);
    for (size_t at = 0; at < length; at += compression->rowBytes, y++) {
        const uint16_t *row = compression->image->samples + y * compression->rowSamples;
        filterRow(row, y > 0 ? row - compression->rowSamples : compression->blackRow, compression->rowSamples,
                  compression->image->bitDepth, filtered + at);
    }
}

/* Compress the workspace's filtered rows. False when memory runs out. */
static bool deflateBand(Compression *compression, size_t number, Workspace *workspace)
{
    size_t length = bandLength(compression, number);
    bool isFirst = number == 0;
    bool isLast = number + 1 == compression->result.count;
    z_stream *stream = &workspace->stream;
    deflateReset(stream);
    stream->next_in = workspace->filtered;
    stream->avail_in = (uInt)length;
    stream->next_out = workspace->compressed;
    stream->avail_out = (uInt)workspace->capacity;
    deflate(stream, isLast ? Z_FINISH : Z_SYNC_FLUSH);
    compression->sums[number] = (uint32_t)adler32(adler32(0, NULL, 0), workspace->filtered, (uInt)length);

    /* Keep as much as there is; the ends of the stream come with the first band and the last. */
    size_t compressed = workspace->capacity - stream->avail_out;
    size_t start = isFirst ? HEADER_BYTES : 0;
    unsigned char *data = malloc(start + compressed + (isLast ? SUM_BYTES : 0));
    if (data == NULL)
        return false;
    memcpy(data, zlibHeader, start);
    memcpy(data + start, workspace->compressed, compressed);
    compression->result.bands[number] = (PngBand){data, start + compressed};
    return true;
}

/* A task: filter and compress one band. */
static void compressBand(void *context, size_t number)
{
    Compression *compression = context;
    Workspace *workspace = takeWorkspace(compression);
    bool done = workspace != NULL;
    if (done) {
        filterBand(compression, number, workspace->filtered);
        done = deflateBand(compression, number, workspace);
    }
    returnWorkspace(compression, workspace, !done);
}

/* End the stream: behind the last band put the sum of all, high byte first. */
static void appendSum(Compression *compression)
{
    uLong sum = adler32(0, NULL, 0);
    for (size_t i = 0; i < compression->result.count; i++)
        sum = adler32_combine(sum, compression->sums[i], (z_off_t)bandLength(compression, i));
    PngBand *last = &compression->result.bands[compression->result.count - 1];
    for (int shift = 24; shift >= 0; shift -= 8)
        last->data[last->length++] = (unsigned char)(sum >> shift & 0xFF);
}

Status compressPngBands(const Image *image, int threads, PngBands *bands)
{
    /* Cut the rows into bands. */
    Compression compression = {.image = image, .lock = PTHREAD_MUTEX_INITIALIZER};
    compression.rowSamples = 3 * (size_t)image->width;
    compression.rowBytes = 1 + compression.rowSamples * (image->bitDepth == 16 ? 2 : 1);
    if (compression.rowBytes > LONGEST_ROW)
        return statusError(STATUS_IO, "a PNG cannot hold %d pixels in a row here; make the picture narrower",
                           image->width);
    size_t rows = compression.rowBytes < BAND_BYTES ? BAND_BYTES / compression.rowBytes : 1;
    compression.rowsPerBand = rows < (size_t)image->height ? rows : (size_t)image->height;
    compression.result.count = ((size_t)image->height - 1) / compression.rowsPerBand + 1;

    /* Compress them side by side. */
    uint16_t *blackRow = calloc(compression.rowSamples, sizeof *blackRow);
    compression.blackRow = blackRow;
    compression.sums = calloc(compression.result.count, sizeof *compression.sums);
    compression.result.bands = calloc(compression.result.count, sizeof *compression.result.bands);
    Status status = statusOutOfMemory();
    if (blackRow != NULL && compression.sums != NULL && compression.result.bands != NULL)
        status = runTasks(compression.result.count, threads, compressBand, &compression);
    if (statusIsOk(&status) && compression.failed)
        status = statusOutOfMemory();
    while (compression.idle != NULL) {
        Workspace *workspace = compression.idle;
        compression.idle = workspace->next;
        freeWorkspace(workspace);
    }

    /* Make one stream of them. */
    if (statusIsOk(&status)) {
        appendSum(&compression);
        *bands = compression.result;
    } else {
        freePngBands(&compression.result);
    }
    free(blackRow);
    free(compression.sums);
    return status;
}

void freePngBands(PngBands *bands)
{
    for (size_t i = 0; i < bands->count && bands->bands != NULL; i++)
        free(bands->bands[i].data);
    free(bands->bands);
    *bands = (PngBands){0};
}

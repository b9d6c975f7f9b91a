/* scene_files.c - the files that a scene names; see scene_files.h. */
#include "scene/scene_files.h"

#include "base/cancel.h"
#include "image/image.h"
#include "scene/reader.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void freeSceneFiles(SceneFiles *files)
{
    for (size_t i = 0; i < files->names.count; i++) {
        free(files->files[i].problem);
        free(files->files[i].spheres);
    }
    free(files->files);
    freeNameTable(&files->names);
}

/* Append the path of a file that the scene names. */
static void appendPath(Text *path, const SceneFiles *files, const char *file)
{
    const char *slash = files->scenePath != NULL ? strrchr(files->scenePath, '/') : NULL;
    if (*file != '/' && slash != NULL)
        textAppendBytes(path, files->scenePath, (size_t)(slash + 1 - files->scenePath));
    else if (strcmp(file, "-") == 0)
        textAppend(path, "./"); /* not standard input */
    textAppend(path, file);
}

/* ---- The three kinds ---- */

static Status readMeshFile(SceneReader *reader, const char *path, bool smooth, SceneFile *read)
{
    MeshData *mesh;
    Status status = readObjMesh(path, smooth, &mesh);
    if (!statusIsOk(&status))
        return status;
    if (!keepMeshInScene(reader->scene, mesh)) {
        freeMesh(mesh);
        return statusOutOfMemory();
    }
    read->mesh = mesh;
    return statusOk();
}

/* The linear value of every sample that a file can hold. Files of 8 bits are sRGB whatever they say. */
static float *tabulateSamples(const Image *image, bool isLinear)
{
    unsigned most = imageMaxSample(image);
    float *table = malloc((most + 1) * sizeof *table);
    for (unsigned i = 0; table != NULL && i <= most; i++) {
        float value = (float)i / (float)most;
        table[i] = isLinear ? value : srgbToLinear(value);
    }
    return table;
}

static Status decodeTexels(Scene *scene, const Image *image, Pattern *pattern)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    Color3f *texels = allocateInScene(scene, count * sizeof *texels);
    pattern->isLinear = image->bitDepth == 16 && image->encoding == ENCODING_LINEAR;
    pattern->hasAlpha = image->hadAlpha;
    float *table = texels != NULL ? tabulateSamples(image, pattern->isLinear) : NULL;
    if (table == NULL)
        return statusOutOfMemory();
    for (size_t i = 0; i < count; i++)
        texels[i] = createColor(table[image->samples[3 * i]], table[image->samples[3 * i + 1]],
                                table[image->samples[3 * i + 2]]);
    free(table);
    pattern->texels = texels;
    pattern->width = image->width;
    pattern->height = image->height;
    return statusOk();
}

/* The path from the root, which belongs to the scene; NULL when memory runs out. */
static const char *absolutePath(Scene *scene, const char *path)
{
    Text absolute = {0};
    char *folder = NULL;
    if (*path != '/') {
        for (size_t size = 256; folder == NULL; size *= 2) {
            folder = malloc(size);
            if (folder == NULL)
                return NULL;
            if (getcwd(folder, size) != NULL)
                break;
            free(folder);
            folder = NULL;
            if (errno != ERANGE)
                break; /* the working folder has no path: leave it relative */
        }
        if (folder != NULL)
            textAppendFormat(&absolute, "%s/", folder);
        free(folder);
    }
    textAppend(&absolute, path);
    char *kept = absolute.failed ? NULL : allocateInScene(scene, absolute.length + 1);
    if (kept != NULL)
        memcpy(kept, absolute.data, absolute.length + 1);
    textFree(&absolute);
    return kept;
}

static Status readImageFile(SceneReader *reader, const char *path, SceneFile *read)
{
    Image image;
    Status status = readPng(path, &image);
    if (!statusIsOk(&status))
        return status;
    if ((size_t)image.width * (size_t)image.height > TEXEL_LIMIT) {
        status = statusError(STATUS_SCENE, "%s has %d x %d pixels; a pattern's picture has at most %d", path,
                             image.width, image.height, TEXEL_LIMIT);
    } else {
        status = decodeTexels(reader->scene, &image, &read->image);
        read->image.path = absolutePath(reader->scene, path);
        if (statusIsOk(&status) && read->image.path == NULL)
            status = statusOutOfMemory();
    }
    freeImage(&image);
    return status;
}

/* ---- Each file once ---- */

typedef enum FileKind {
    FILE_SMOOTH_MESH = 's',
    FILE_FLAT_MESH = 'f',
    FILE_IMAGE = 'i',
    FILE_SPHERES = 'l'
} FileKind;

/* Read the file; a problem that is the file's becomes part of what is kept. */
static Status readOnce(SceneReader *reader, FileKind kind, const char *path, SceneFile *read)
{
    struct stat info;
    bool exists = stat(path, &info) == 0;
    read->isMissing = !exists && errno == ENOENT;
    if (exists && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))
        return statusError(STATUS_IO, "cannot read '%s': it is not an ordinary file; give the name of a file",
                           path);
    switch (kind) {
    case FILE_SMOOTH_MESH:
    case FILE_FLAT_MESH:
        return readMeshFile(reader, path, kind == FILE_SMOOTH_MESH, read);
    case FILE_IMAGE:
        return readImageFile(reader, path, read);
    default:
        return readSphereList(path, &read->spheres, &read->sphereCount);
    }
}

/* Let the scene know that the file was read; false when memory runs out. */
static bool noteFile(Scene *scene, const char *path)
{
    size_t size = strlen(path) + 1;
    SceneFileName *name = allocateInScene(scene, sizeof *name + size);
    if (name == NULL)
        return false;
    memcpy(name->path, path, size);
    name->next = scene->files;
    scene->files = name;
    return true;
}

/* What is said of a file that could not be read; NULL when memory runs out. */
static char *describeProblem(const char *path, const Status *status)
{
    Text text = {0};
    if (status->line > 0)
        textAppendFormat(&text, "%s:%d:%d: ", path, status->line, status->column);
    else if (strstr(status->message, path) == NULL)
        textAppendFormat(&text, "%s: ", path);
    textAppend(&text, status->message);
    if (text.failed)
        textFree(&text);
    return text.data;
}

/* Find what was read of the file, or read it; NULL when it cannot be used, which is reported or noted. */
static const SceneFile *findFile(SceneReader *reader, Place place, FileKind kind, const char *file)
{
    SceneFiles *files = reader->files;
    Text name = {0};
    textAppendFormat(&name, "%c", kind);
    appendPath(&name, files, file);
    SceneFile *known =
        makeReaderRoom(reader, files->files, files->names.count, &files->capacity, sizeof *known);
    if (known != NULL)
        files->files = known;
    size_t before = files->names.count;
    size_t number =
        known != NULL && !name.failed ? addName(&files->names, name.data, name.length) : NAME_NONE;
    textFree(&name);
    if (number == NAME_NONE) {
        reader->outOfMemory = true;
        return NULL;
    }
    SceneFile *read = &files->files[number];
    if (number == before) {
        *read = (SceneFile){0};
        const char *path = files->names.names[number].text + 1;
        Status status = readOnce(reader, kind, path, read);
        Status noMemory = statusOutOfMemory();
        if (statusIsOk(&status) && !noteFile(reader->scene, path))
            status = statusOutOfMemory();
        if (status.code == STATUS_INTERRUPTED)
            reader->interrupted = true;
        else if (strcmp(status.message, noMemory.message) == 0)
            reader->outOfMemory = true;
        else if (!statusIsOk(&status) && (read->problem = describeProblem(path, &status)) == NULL)
            reader->outOfMemory = true;
    }
    if (reader->interrupted || reader->outOfMemory)
        return NULL;
    if (read->problem != NULL)
        reportError(reader, place,
                    read->isMissing ? "its path is relative to the folder of the scene file" : NULL, "%s",
                    read->problem);
    return read->problem == NULL ? read : NULL;
}

const MeshData *loadMesh(SceneReader *reader, Place place, const char *file, bool smooth)
{
    const SceneFile *read = findFile(reader, place, smooth ? FILE_SMOOTH_MESH : FILE_FLAT_MESH, file);
    return read != NULL ? read->mesh : NULL;
}

bool loadImage(SceneReader *reader, Place place, const char *file, Pattern *pattern)
{
    const SceneFile *read = findFile(reader, place, FILE_IMAGE, file);
    if (read == NULL)
        return false;
    pattern->width = read->image.width;
    pattern->height = read->image.height;
    pattern->texels = read->image.texels;
    pattern->path = read->image.path;
    pattern->isLinear = read->image.isLinear;
    pattern->hasAlpha = read->image.hasAlpha;
    return true;
}

const ListedSphere *loadSpheres(SceneReader *reader, Place place, const char *file, size_t *count)
{
    const SceneFile *read = findFile(reader, place, FILE_SPHERES, file);
    if (read == NULL)
        return NULL;
    *count = read->sphereCount;
    return read->spheres;
}

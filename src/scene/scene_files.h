/* scene_files.h - the files that a scene names: pictures, meshes and lists of spheres.
 *
 * Paths are relative to the folder of the scene file. Each file is read once, however many objects name it;
 * what went wrong is reported at every place that names it. Only ordinary files are read, so that no pipe or
 * device can stop the loader.
 */
#ifndef ECLAIRAGE_SCENE_SCENE_FILES_H
#define ECLAIRAGE_SCENE_SCENE_FILES_H

#include "patterns/pattern.h"
#include "scene/name_table.h"
#include "scene/source_text.h"
#include "shapes/mesh.h"
#include "shapes/sphere_list.h"

#include <stdbool.h>
#include <stddef.h>

struct SceneReader;

enum {
    TEXEL_LIMIT = 1 << 26 /* of a picture: 67 million */
};

/* What was read of one file, or why it could not be. */
typedef struct SceneFile {
    char *problem; /* NULL: none; owned */
    bool isMissing;
    const MeshData *mesh; /* owned by the scene */
    Pattern image;        /* the part of a pattern that is the picture */
    ListedSphere *spheres;
    size_t sphereCount;
} SceneFile;

typedef struct SceneFiles {
    const char *scenePath; /* not owned; NULL: paths are relative to the working folder */
    NameTable names;       /* kind and path */
    SceneFile *files;      /* by number of the name */
    size_t capacity;
} SceneFiles;

void freeSceneFiles(SceneFiles *files);

/* Each reads the file, or finds that it was read; NULL or false when that failed, which is reported at place
 * or noted in the reader. */
const MeshData *loadMesh(struct SceneReader *reader, Place place, const char *file, bool smooth);
bool loadImage(struct SceneReader *reader, Place place, const char *file, Pattern *pattern);
const ListedSphere *loadSpheres(struct SceneReader *reader, Place place, const char *file, size_t *count);

#endif

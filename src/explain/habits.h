/* habits.h - how much each of POV-Ray's habits changes the picture of a scene.
 *
 * The scene is drawn by POV-Ray in its matched form, with each habit alone, with all of them ("native"), and
 * with all but the largest, the two largest, and so on down to the matched form again. So the difference of
 * the native picture is accounted for step by step, and what is left in the end is what the habits do not
 * explain.
 */
#ifndef ECLAIRAGE_EXPLAIN_HABITS_H
#define ECLAIRAGE_EXPLAIN_HABITS_H

#include "base/status.h"
#include "base/text.h"
#include "compare/metrics.h"
#include "explain/explanation.h"
#include "image/image.h"
#include "povray/pov_habits.h"
#include "raytracer.h"

#include <stdbool.h>

/* The scene as POV-Ray draws it with some habits. */
typedef struct HabitPicture {
    unsigned habits; /* PovHabits */
    Text pov;
    Image image;     /* of no size unless it was to be kept */
    Metrics metrics; /* of our picture against it */
} HabitPicture;

enum {
    /* None, each alone, and for each further step of the sequence one. */
    MAX_HABIT_PICTURES = 2 * POV_HABIT_COUNT
};

typedef struct HabitStudy {
    PovHabit order[POV_HABIT_COUNT]; /* those that apply, the one that alone changes most first */
    int count;                       /* of them, at least 2 */
    HabitPicture pictures[MAX_HABIT_PICTURES];
    int pictureCount;
} HabitStudy;

typedef struct HabitStudySettings {
    int threads;                                  /* at least 1 */
    double timeoutSeconds;                        /* for one run of POV-Ray */
    bool keepPictures;                            /* of each habit alone, matched and native */
    void (*progress)(void *context, double done); /* NULL, or called from any thread; done in 0..1 */
} HabitStudySettings;

/* What counts as a difference, of samples in 0..1: more than two steps of 16 bits. */
#define HABIT_STEP (2.0 / 65535)

/* Draw and measure. scene: of 16 bits, linear; ours: our picture of it. On success the caller frees *study
 * with freeHabitStudy; on failure it is untouched. STATUS_INEXPRESSIBLE for a scene that cannot be exported,
 * STATUS_POVRAY when POV-Ray fails, STATUS_INTERRUPTED when cancelled. */
Status studyHabits(const Scene *scene, const Image *ours, const HabitStudySettings *settings,
                   HabitStudy *study);
void freeHabitStudy(HabitStudy *study);

/* The picture with exactly these habits, which must be one of those above. */
const HabitPicture *habitPicture(const HabitStudy *study, unsigned habits);

/* The picture with one habit; number in order. */
const HabitPicture *pictureWithHabit(const HabitStudy *study, int number);

/* The picture when so many habits were taken back: 0 is the native one, count the matched one. */
const HabitPicture *pictureAfterHabits(const HabitStudy *study, int taken);

/* Whether that habit can be seen at all, alone or at its step. */
bool isHabitSeen(const HabitStudy *study, int number);

/* What the habit is in plain words, and what to write for POV-Ray instead; code stands in backquotes. */
void appendHabitText(const HabitStudy *study, const Scene *scene, int number, Text *text);
void appendHabitRemedy(const HabitStudy *study, const Scene *scene, int number, Text *text);

/* The habits that are seen as causes, in order; the residual is what is left when a habit and those before it
 * are taken back. CAUSE_UNKNOWN at the end when more is left than rounding. Freed with freeExplanations;
 * STATUS_IO when memory runs out, and then there is nothing to free. */
Status explainHabits(const HabitStudy *study, const Scene *scene, Explanations *explanations);

/* Append all of it in words for a terminal. name: how the scene is called. */
void writeHabitsText(const HabitStudy *study, const Scene *scene, const char *name, bool color, Text *text);

/* The last line of the words: "explained 0.19421 of 0.19421, left 0". */
void appendHabitSum(const HabitStudy *study, Text *text);

#endif

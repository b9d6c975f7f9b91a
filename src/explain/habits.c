/* habits.c - the pictures of a study of habits; see habits.h.
 *
 * A POV-Ray process sleeps for most of its 0.7 s, so several are under way at once; one picture at a time is
 * measured, on all the threads there are.
 */
#include "explain/habits.h"

#include "base/threads.h"
#include "povray/export.h"
#include "povray/run.h"

#include <math.h>
#include <pthread.h>

enum {
    MOST_AT_ONCE = 8 /* POV-Rays under way */
};

/* The run of some of a study's pictures. */
typedef struct HabitRun {
    const Scene *scene;
    const Image *ours;
    const HabitStudySettings *settings;
    HabitStudy *study;
    int first;       /* picture of this run */
    int total, done; /* pictures of the whole study */
    int povrayThreads;
    pthread_mutex_t turn; /* held by the picture that is measured; guards status and done */
    Status status;        /* the first failure */
} HabitRun;

/* ---- The study ---- */

const HabitPicture *habitPicture(const HabitStudy *study, unsigned habits)
{
    for (int i = 0; i < study->pictureCount; i++)
        if (study->pictures[i].habits == habits)
            return &study->pictures[i];
    return NULL;
}

const HabitPicture *pictureWithHabit(const HabitStudy *study, int number)
{
    return habitPicture(study, study->order[number]);
}

static unsigned habitsAfter(const HabitStudy *study, int taken)
{
    unsigned habits = 0;
    for (int i = taken; i < study->count; i++)
        habits |= study->order[i];
    return habits;
}

const HabitPicture *pictureAfterHabits(const HabitStudy *study, int taken)
{
    return habitPicture(study, habitsAfter(study, taken));
}

bool isHabitSeen(const HabitStudy *study, int number)
{
    const Metrics *matched = &habitPicture(study, 0)->metrics;
    const Metrics *alone = &pictureWithHabit(study, number)->metrics;
    const Metrics *before = &pictureAfterHabits(study, number)->metrics;
    const Metrics *after = &pictureAfterHabits(study, number + 1)->metrics;
    return alone->differingPixels > matched->differingPixels || fabs(before->rmse - after->rmse) > HABIT_STEP;
}

void freeHabitStudy(HabitStudy *study)
{
    for (int i = 0; i < study->pictureCount; i++) {
        textFree(&study->pictures[i].pov);
        freeImage(&study->pictures[i].image);
    }
    study->pictureCount = 0;
}

/* ---- Drawing and measuring ---- */

/* Whether the picture is shown: with one habit, or none, or all. */
static bool isShown(const HabitStudy *study, unsigned habits)
{
    return (habits & (habits - 1)) == 0 || habits == habitsAfter(study, 0);
}

static Status drawPicture(const HabitRun *run, HabitPicture *picture)
{
    PovraySettings settings = createPovraySettings(run->scene, run->povrayThreads);
    settings.timeoutSeconds = run->settings->timeoutSeconds;
    if ((picture->habits & POV_HABIT_GAMMA) != 0)
        settings.gamma = POV_HABIT_ASSUMED_GAMMA;
    return runPovray(textString(&picture->pov), &settings, &picture->image);
}

static void drawAndMeasure(void *context, size_t number)
{
    HabitRun *run = context;
    HabitPicture *picture = &run->study->pictures[run->first + (int)number];
    pthread_mutex_lock(&run->turn);
    Status status = run->status;
    pthread_mutex_unlock(&run->turn);
    if (!statusIsOk(&status))
        return;

    status = drawPicture(run, picture);
    pthread_mutex_lock(&run->turn);
    if (statusIsOk(&status))
        status = checkComparable(run->ours, "our picture", &picture->image, "POV-Ray's picture");
    if (statusIsOk(&status))
        status =
            measureImages(run->ours, &picture->image, HABIT_STEP, run->settings->threads, &picture->metrics);
    if (!run->settings->keepPictures || !isShown(run->study, picture->habits))
        freeImage(&picture->image);
    if (statusIsOk(&run->status))
        run->status = status;
    run->done++;
    if (run->settings->progress != NULL)
        run->settings->progress(NULL, (double)run->done / run->total);
    pthread_mutex_unlock(&run->turn);
}

/* Add the picture with these habits to those to be drawn. */
static Status addPicture(HabitRun *run, unsigned habits)
{
    HabitPicture *picture = &run->study->pictures[run->study->pictureCount++];
    *picture = (HabitPicture){.habits = habits};
    Text name = {0};
    if (habits == 0)
        textAppend(&name, "matched.pov");
    else if (habits == habitsAfter(run->study, 0))
        textAppend(&name, "native.pov");
    else
        textAppendFormat(&name, "%s.pov", povHabitName((PovHabit)habits));
    Status status = exportPovWithHabits(run->scene, textString(&name), habits, &picture->pov);
    textFree(&name);
    return status;
}

/* Draw and measure the pictures from run->first on. */
static Status drawPictures(HabitRun *run)
{
    int count = run->study->pictureCount - run->first;
    int atOnce = count < MOST_AT_ONCE ? count : MOST_AT_ONCE;
    run->povrayThreads = run->settings->threads > atOnce ? run->settings->threads / atOnce : 1;
    Status status = runTasks((size_t)count, atOnce, drawAndMeasure, run);
    return statusIsOk(&status) ? run->status : status;
}

/* Put the habit that alone changes most first. */
static void sortHabits(HabitStudy *study)
{
    for (int i = 1; i < study->count; i++) {
        PovHabit habit = study->order[i];
        double rmse = habitPicture(study, habit)->metrics.rmse;
        int j = i;
        for (; j > 0 && habitPicture(study, study->order[j - 1])->metrics.rmse < rmse; j--)
            study->order[j] = study->order[j - 1];
        study->order[j] = habit;
    }
}

/* Draw what can be drawn before the order is known, sort, and draw the steps of the sequence. */
static Status drawAll(HabitRun *run)
{
    HabitStudy *study = run->study;
    Status status = addPicture(run, 0);
    for (int i = 0; i < study->count && statusIsOk(&status); i++)
        status = addPicture(run, study->order[i]);
    if (statusIsOk(&status))
        status = addPicture(run, habitsAfter(study, 0));
    if (statusIsOk(&status))
        status = drawPictures(run);
    if (!statusIsOk(&status))
        return status;

    sortHabits(study);
    run->first = study->pictureCount;
    for (int taken = 1; taken < study->count - 1 && statusIsOk(&status); taken++)
        status = addPicture(run, habitsAfter(study, taken));
    if (statusIsOk(&status) && study->pictureCount > run->first)
        status = drawPictures(run);
    return status;
}

Status studyHabits(const Scene *scene, const Image *ours, const HabitStudySettings *settings,
                   HabitStudy *study)
{
    HabitStudy made = {.count = 0};
    unsigned habits = applicablePovHabits(scene);
    for (int i = 0; i < POV_HABIT_COUNT; i++)
        if ((habits & 1u << i) != 0)
            made.order[made.count++] = (PovHabit)(1 << i);
    HabitRun run = {.scene = scene,
                    .ours = ours,
                    .settings = settings,
                    .study = &made,
                    .total = 2 * made.count,
                    .status = statusOk()};
    pthread_mutex_init(&run.turn, NULL);
    Status status = drawAll(&run);
    pthread_mutex_destroy(&run.turn);
    if (statusIsOk(&status))
        *study = made;
    else
        freeHabitStudy(&made);
    return status;
}

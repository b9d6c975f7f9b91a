/* pov_habits.h - how a POV-Ray scene is usually written, where that gives another picture than ours.
 *
 * A matched export says everything as our scene means it. Whoever writes for POV-Ray by hand writes
 * `fade_distance 1`, leaves the default finish as it is, and so on: each of these is a habit, one bit of a
 * set. Any set of them can be exported, so that a difference can be told apart into its habits.
 */
#ifndef ECLAIRAGE_POVRAY_POV_HABITS_H
#define ECLAIRAGE_POVRAY_POV_HABITS_H

#include "raytracer.h"

typedef enum PovHabit {
    POV_HABIT_FALLOFF = 1 << 0,         /* fade_distance 1 fade_power 2: light 2/(1 + d^2), not 1/d^2 */
    POV_HABIT_AMBIENT = 1 << 1,         /* ambient 0.1 of the diffuse colour, and none of the scene's own */
    POV_HABIT_DIFFUSE = 1 << 2,         /* diffuse 0.6 */
    POV_HABIT_HIGHLIGHT = 1 << 3,       /* specular for Phong's highlight, phong for Blinn's */
    POV_HABIT_HIGHLIGHT_COLOR = 1 << 4, /* the highlight's colour is one number, the mean of its three */
    POV_HABIT_GAMMA = 1 << 5,           /* assumed_gamma 2.2 */
    POV_HABIT_LEFT_HANDED = 1 << 6,     /* right x*aspect: the picture mirrored */
    POV_HABIT_ANGLE = 1 << 7,      /* the vertical angle of view written as `angle`, the horizontal one */
    POV_HABIT_AREA_LIGHT = 1 << 8, /* area_light in place of a grid of lights */
    ALL_POV_HABITS = (1 << 9) - 1
} PovHabit;

enum {
    POV_HABIT_COUNT = 9
};

/* What assumed_gamma is by habit. */
#define POV_HABIT_ASSUMED_GAMMA 2.2

/* A short name of letters and hyphens: "falloff", "left-handed". */
const char *povHabitName(PovHabit habit);

/* The habits that can change the picture of this scene: without highlights there is nothing to say of their
 * colour. In a scene of the simple model, which is not POV-Ray's light at all, they are those of the camera
 * and gamma. */
unsigned applicablePovHabits(const Scene *scene);

#endif

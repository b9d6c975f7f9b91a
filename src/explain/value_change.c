/* value_change.c - see value_change.h. */
#include "explain/value_change.h"

#include <math.h>

ValueChange neutralValueChange(void)
{
    return (ValueChange){
        .scale = 1, .linearPower = 1, .storedPower = 1, .storedScale = 1, .channels = {0, 1, 2}};
}

/* NaN becomes 0. */
static float clampSample(float v)
{
    return v > 0 ? (v < 1 ? v : 1) : 0;
}

static float placedOffset(const ValueChange *change, const ValuePlace *place, int channel)
{
    if (change->offset == 0)
        return 0;
    const float diffuse[3] = {place->diffuse.r, place->diffuse.g, place->diffuse.b};
    switch (change->offsetPlace) {
    case OFFSET_ON_SURFACES:
        return place->isSurface ? change->offset : 0;
    case OFFSET_ON_DIFFUSE:
        return place->isSurface ? change->offset * diffuse[channel] : 0;
    default:
        return change->offset;
    }
}

static float toLevel(float v, float highest, bool truncated)
{
    /* Not negative, so the conversion rounds down. */
    return (float)(int)(v * highest + (truncated ? 0 : 0.5f)) / highest;
}

void storedSamples(const ValueChange *change, StoredFormat format, const ValuePlace *place,
                   const float linear[3], float stored[restrict 3])
{
    const float fileHighest = format.bitDepth == 16 ? 65535 : 255;
    const float offset = change->storedOnSurfaces && !place->isSurface ? 0 : change->storedOffset;
    /* The encoding: as often as the file says, and once more or once less. */
    const int times = (format.encoding == ENCODING_SRGB) + (change->encoding == ENCODED_TWICE) -
                      (change->encoding == NOT_ENCODED);
    float samples[3];
    for (int i = 0; i < 3; i++) {
        /* Light. */
        float v = linear[i] * change->scale + placedOffset(change, place, i);
        if (change->linearPower != 1)
            v = powf(clampSample(v), change->linearPower);
        v = clampSample(v);
        if (change->levels > 1 && change->levelsLinear)
            v = toLevel(v, (float)(change->levels - 1), change->truncated);

        for (int k = 0; k < times; k++)
            v = change->curvePower > 0 ? powf(v, change->curvePower) : linearToSrgb(v);
        if (times < 0)
            v = srgbToLinear(v);
        if (change->storedPower != 1)
            v = powf(v, change->storedPower);
        samples[i] = clampSample(v * change->storedScale + offset);
        if (change->levels > 1 && !change->levelsLinear)
            samples[i] = toLevel(samples[i], (float)(change->levels - 1), change->truncated);
    }
    for (int i = 0; i < 3; i++) {
        stored[i] = toLevel(samples[change->channels[i]], fileHighest, false);
        if (change->droppedBits > 0) {
            unsigned mask = ~0u << change->droppedBits;
            stored[i] = (float)((unsigned)(stored[i] * fileHighest + 0.5f) & mask) / fileHighest;
        }
    }
}

#include "explain/story_writers.h"
void writeStorySvg(const PixelStory *story, const char *name, Text *text)
{
    (void)story;
    (void)name;
    (void)text;
}

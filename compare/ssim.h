/* ssim.h - structural similarity of two pictures (METRICS.md). */
#ifndef ECLAIRAGE_COMPARE_SSIM_H
#define ECLAIRAGE_COMPARE_SSIM_H

#include "base/status.h"
#include "image/image.h"

/* The mean SSIM over all whole 11 x 11 windows of two comparable pictures, of the luma of their sRGB
 * encodings: -1..1, 1 for equal pictures, higher is better. NAN when there is no whole window. The same
 * bits for any number of threads. STATUS_IO when memory runs out, STATUS_INTERRUPTED when cancelled. */
Status measureSsim(const Image *a, const Image *b, int threads, double *ssim);

#endif

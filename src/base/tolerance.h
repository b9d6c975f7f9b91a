/* tolerance.h - how far two pictures may lie apart: what an author writes under `compare`, and what
 * the verdict is reached by. Here because both a Scene and a comparison carry it and neither may see
 * the other. */
#ifndef ECLAIRAGE_BASE_TOLERANCE_H
#define ECLAIRAGE_BASE_TOLERANCE_H

/* A limit that is NAN is not judged. */
typedef struct Tolerance {
    double fail;        /* a pixel differs when one of its channels differs by more; 0..1 */
    double failPercent; /* share of differing pixels allowed, in percent, 0..100 */
    double hardFail;    /* no pixel may differ by more; 0..1 */
    double rmse;        /* at most; NAN: no limit */
    double ssim;        /* at least; NAN: no limit */
    double flip;        /* mean at most; NAN: no limit */
} Tolerance;

/* The defaults of the scene format: fail 0.004, failPercent 0.1, hardFail 1, no further limits. */
#define TOLERANCE_DEFAULT                                                                                    \
    ((Tolerance){.fail = 0.004,                                                                              \
                 .failPercent = 0.1,                                                                         \
                 .hardFail = 1.0,                                                                            \
                 .rmse = __builtin_nan(""),                                                                  \
                 .ssim = __builtin_nan(""),                                                                  \
                 .flip = __builtin_nan("")})

#endif

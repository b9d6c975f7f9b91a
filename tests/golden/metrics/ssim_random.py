#!/usr/bin/python3
"""Print ssim_random.csv: SSIM of pseudo-random pictures by scikit-image (Debian: python3-skimage).

The pictures are those of randomPair in tests/unit/test_metrics.c: one generator, samples in file order,
first of a, then of b; each sample of b is that of a plus noise, kept within the range.
"""
import numpy
from skimage.metrics import structural_similarity

CASES = [  # width, height, bit depth, linear, noise, seed
    (11, 11, 8, False, 40, 1),
    (12, 11, 8, False, 255, 2),
    (37, 23, 8, False, 3, 3),
    (150, 90, 8, False, 60, 4),
    (150, 90, 16, False, 20000, 5),
    (140, 76, 16, True, 9000, 6),
    (33, 17, 8, True, 1, 7),
]


def random_pair(width, height, depth, noise, seed):
    largest = 2**depth - 1
    state = seed

    def draw(count):
        nonlocal state
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (state >> 33) % count

    count = width * height * 3
    a = [draw(largest + 1) for _ in range(count)]
    b = [min(largest, max(0, value + draw(2 * noise + 1) - noise)) for value in a]
    return (numpy.array(picture).reshape(height, width, 3) / largest for picture in (a, b))


def luma(picture, linear):
    if linear:
        low = 12.92 * picture
        picture = numpy.where(picture <= 0.0031308, low, 1.055 * picture ** (1 / 2.4) - 0.055)
    return picture @ [0.299, 0.587, 0.114]


print("width,height,depth,linear,noise,seed,ssim")
for width, height, depth, linear, noise, seed in CASES:
    a, b = (luma(picture, linear) for picture in random_pair(width, height, depth, noise, seed))
    value = structural_similarity(a, b, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
                                  data_range=1)
    print(f"{width},{height},{depth},{int(linear)},{noise},{seed},{value:.15g}")

"""Errors of renders against each other, ratios with intervals, and whether means agree.

A candidate's renders i = 1..N of a scene differ in their seeds. With M_i the mean of the
others, e_i = (x_i - M_i)^2 (N - 1) / N has the variance of one render as its expectation,
and the mean of e_i over i is the sample variance; so each render has an error of its own,
and its worst pixels can be left out. Errors are relative: over m^2 + 0.01, with m an image
that is the same for all candidates.
"""
import math
import random
import statistics

EPSILON = 0.01  # in relative errors, as in `lanelight compare`
TRIM = 0.01  # the share of a render's pixels that the trimmed error leaves out
BLOCK = 16  # side of the blocks of pixels


def block_of(width, height):
    """The block of each pixel, line by line, and the number of blocks."""
    across = (width + BLOCK - 1) // BLOCK
    of = [y // BLOCK * across + x // BLOCK for y in range(height) for x in range(width)]
    return of, max(of) + 1


def mean_image(images, weights):
    """Each image counts by its weight."""
    total, mean = sum(weights), [0.0] * len(images[0])
    for image, weight in zip(images, weights):
        mean = [m + weight / total * x for m, x in zip(mean, image)]
    return mean


def box_means(image, width, height, side):
    """The image's means over squares of so many pixels (what of them lies within), and its
    new width and height: errors that an eye, or a filter, does not average away."""
    across, down = -(-width // side), -(-height // side)
    sums, counts = [0.0] * (across * down * 3), [0] * (across * down)
    for y in range(height):
        for x in range(width):
            box, pixel = y // side * across + x // side, 3 * (y * width + x)
            counts[box] += 1
            for c in range(3):
                sums[3 * box + c] += image[pixel + c]
    return [s / counts[k // 3] for k, s in enumerate(sums)], across, down


def pixel_errors(image, total, count, mean):
    """Of each pixel of a render: e_i / (m^2 + 0.01), mean of R, G, B. `total` is the sum of
    the candidate's `count` renders, `mean` what errors are relative to."""
    scale = count / (count - 1) / 3
    e = [(x - t / count) ** 2 * scale / (m * m + EPSILON)
         for x, t, m in zip(image, total, mean)]
    return [e[k] + e[k + 1] + e[k + 2] for k in range(0, len(e), 3)]


def without_worst(errors):
    """The errors with the worst 1 % of the pixels set to 0."""
    count = math.ceil(TRIM * len(errors))
    out = list(errors)
    for k in sorted(range(len(out)), key=out.__getitem__)[len(out) - count:]:
        out[k] = 0
    return out


def block_sums(values, of, blocks):
    sums = [0.0] * blocks
    for b, v in zip(of, values):
        sums[b] += v
    return sums


def beta_fraction(a, b, x):
    """Continued fraction of the incomplete beta function, by Lentz's method (1976)."""
    tiny = 1e-300
    c, d = 1.0, 1 / ((1 - (a + b) * x / (a + 1)) or tiny)
    h = d
    for m in range(1, 500):
        for top in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                    -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1 / ((1 + top * d) or tiny)
            c = (1 + top / c) or tiny
            h *= c * d
        if abs(c * d - 1) < 1e-13:
            break
    return h


def t_tail(t, df):
    """P(|T| > t) of Student's distribution with df degrees of freedom, any df > 0."""
    a, b, x = df / 2, 0.5, df / (df + t * t)
    if x >= 1:
        return 1.0
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)
                     + a * math.log(x) + b * math.log1p(-x))
    if x < (a + 1) / (a + b + 2):
        return front * beta_fraction(a, b, x) / a
    return 1 - front * beta_fraction(b, a, 1 - x) / b


def t_quantile(tail, df):
    """t with P(|T| > t) = tail."""
    low, high = 0.0, 1.0
    while t_tail(high, df) > tail:
        high *= 2
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if t_tail(middle, df) > tail else (low, middle)
    return high


def welch(a, b):
    """p-value for equal means of two samples (Welch 1947); 1 if neither varies and they
    are equal, 0 if they differ then."""
    va, vb = statistics.variance(a) / len(a), statistics.variance(b) / len(b)
    difference = abs(statistics.fmean(a) - statistics.fmean(b))
    if va + vb == 0:
        return float(difference == 0)
    df = (va + vb) ** 2 / (va * va / (len(a) - 1) + vb * vb / (len(b) - 1))
    return t_tail(difference / math.sqrt(va + vb), df)


def means_differ(ours, theirs):
    """p-value, for two candidates' renders as lists of block means, that what they converge
    to is the same: the whole image, and the most suspicious block (Bonferroni)."""
    whole = welch([sum(x) for x in ours], [sum(x) for x in theirs])
    columns = list(zip(zip(*ours), zip(*theirs)))
    blocks = min(1.0, len(columns) * min(welch(a, b) for a, b in columns))
    return min(1.0, 2 * min(whole, blocks))


def log_ratio(base, other):
    """log of the base's mean error over the other's; each a list of numbers."""
    return math.log(statistics.fmean(base) / statistics.fmean(other))


def jackknife_half_width(base, other):
    """Of a 95 % interval of log_ratio, rounds being the observations: what all blocks of
    a render share (a bad pilot, a slow minute) shows only between rounds."""
    n = len(base)
    whole = log_ratio(base, other)
    pseudo = [n * whole - (n - 1) * log_ratio(base[:i] + base[i + 1:],
                                              other[:i] + other[i + 1:])
              for i in range(n)]
    return t_quantile(0.05, n - 1) * statistics.stdev(pseudo) / math.sqrt(n)


def bootstrap_interval(base, other, samples, rng):
    """Percentiles of log_ratio: in each block of pixels, on its own, rounds are drawn anew
    (Efron 1979, stratified). base[i][b] is the error of block b in round i."""
    n, blocks = len(base), list(zip(zip(*base), zip(*other)))
    logs = []
    for _ in range(samples):
        top = bottom = 0.0
        for ours, theirs in blocks:
            for i in rng.choices(range(n), k=n):
                top += ours[i]
                bottom += theirs[i]
        logs.append(math.log(top / bottom))
    logs.sort()
    return logs[int(0.025 * samples)], logs[math.ceil(0.975 * samples) - 1]


def efficiency(base, other, samples=400, seed=1):
    """(ratio, low, high) of the base's error over the other's, errors being of equal time:
    above 1 the other is better. The wider of both intervals on either side, at 95 %."""
    sums = [[sum(blocks) for blocks in rounds] for rounds in (base, other)]
    if not all(map(all, sums)):  # a render without error, as of a constant image
        return math.nan, math.nan, math.nan
    middle = log_ratio(*sums)
    half = jackknife_half_width(*sums)
    low, high = bootstrap_interval(base, other, samples, random.Random(seed))
    return tuple(math.exp(x) for x in (middle, min(low, middle - half),
                                       max(high, middle + half)))

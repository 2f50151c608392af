"""Tests of efficiency_statistics.py: run by ctest as bench/efficiency.

False alarms: the seeds are fixed; were they not, each check of a share would fail by chance
less than once in 1000, by the binomial distribution.
"""
import argparse
import math
import random
import unittest

import efficiency
import efficiency_statistics as statistics

TRIALS, ROUNDS, BLOCKS = 200, 6, 30


def errors(rng, scale=1.0, shared=0.0):
    """Errors by round and block: heavy-tailed (log-normal), and what a round shares."""
    rounds = []
    for _ in range(ROUNDS):
        common = scale * math.exp(rng.gauss(0, shared))
        rounds.append([common * math.exp(rng.gauss(0, 1)) for _ in range(BLOCKS)])
    return rounds


def share_that_holds(ratio, shared):
    rng, held = random.Random(5), 0
    for _ in range(TRIALS):
        _, low, high = statistics.efficiency(errors(rng, ratio, shared),
                                             errors(rng, 1, shared), samples=80)
        held += low <= ratio <= high
    return held / TRIALS


class StatisticsTest(unittest.TestCase):
    def test_errors_of_renders_average_to_the_sample_variance(self):
        rng = random.Random(1)
        images = [[rng.gauss(2, 1) for _ in range(12)] for _ in range(5)]
        total, mean = [sum(v) for v in zip(*images)], [2.0] * 12
        found = [0.0] * 4
        for image in images:
            for p, e in enumerate(statistics.pixel_errors(image, total, 5, mean)):
                found[p] += e / 5
        for p in range(4):
            variances = [sum((x - sum(v) / 5) ** 2 for x in v) / 4
                         for v in list(zip(*images))[3 * p:3 * p + 3]]
            self.assertAlmostEqual(found[p], sum(variances) / 3 / 4.01, places=12)

    def test_images_count_by_their_weights(self):
        self.assertEqual(statistics.mean_image([[1.0, 4.0], [5.0, 4.0]], [3, 1]), [2, 4])

    def test_trimming_leaves_out_the_worst_pixels_only(self):
        self.assertEqual(statistics.without_worst([1.0, 5, 2] + [1.0] * 97),
                         [1.0, 0, 2] + [1.0] * 97)
        self.assertEqual(sum(statistics.without_worst([7.0] * 250)), 7 * 247)

    def test_blocks_have_16_pixels_a_side(self):
        of, blocks = statistics.block_of(33, 17)
        self.assertEqual(blocks, 6)
        self.assertEqual([of[0], of[15], of[16], of[32], of[33 * 16]], [0, 0, 1, 2, 3])

    def test_squares_have_the_means_of_their_pixels(self):
        # 3 x 2 pixels in squares of 2: the second one has a column of pixels only.
        image = [float(v) for k in range(6) for v in (k, 10 * k, 1)]
        means, width, height = statistics.box_means(image, 3, 2, 2)
        self.assertEqual((width, height), (2, 1))
        self.assertEqual(means, [2, 20, 1, 3.5, 35, 1])

    def test_shared_errors_of_neighbours_do_not_average_away(self):
        # Both have errors of one variance; those of the second one are alike in squares.
        rng, size = random.Random(11), (32, 32)
        def render(side):
            boxes = [rng.gauss(1, 0.3) for _ in range(32 * 32)]
            return [boxes[(y // side) * 32 + x // side] for y in range(32)
                    for x in range(32) for _ in range(3)], 1.0
        runs = [[render(side) for _ in range(8)] for side in (1, 4)]
        gain, low, high = efficiency.filtered_gains(runs, [1.0] * 3072, size, 4)[0]
        self.assertLess(low, 1 / 16)
        self.assertGreater(high, 1 / 16)
        self.assertLess(high, 0.5)

    def test_student(self):
        # df = 1 is Cauchy's, df = 2 has a closed form; 2.2281 is tabulated for df = 10.
        for t in (0.1, 1.0, 3.0, 50.0):
            self.assertAlmostEqual(statistics.t_tail(t, 1), 1 - 2 / math.pi * math.atan(t))
            self.assertAlmostEqual(statistics.t_tail(t, 2), 1 - t / math.sqrt(2 + t * t))
        self.assertAlmostEqual(statistics.t_quantile(0.05, 10), 2.2281, places=4)

    def test_intervals_of_equal_candidates_hold_one(self):
        self.assertGreaterEqual(share_that_holds(1, 0), 0.89)

    def test_intervals_hold_the_ratio_of_unequal_ones(self):
        self.assertGreaterEqual(share_that_holds(1.7, 0), 0.89)

    def test_intervals_know_what_a_whole_round_shares(self):
        self.assertGreaterEqual(share_that_holds(1, 0.7), 0.89)

    def test_intervals_are_not_useless(self):
        # The log of a ratio of two means of 180 such errors has a standard deviation of
        # sqrt(2 (e - 1) / 180) = 0.14; 2.57 of them (Student, 5 degrees) are 0.36.
        rng = random.Random(3)
        widths = [statistics.efficiency(errors(rng), errors(rng), samples=80)
                  for _ in range(40)]
        mean = sum(math.log(high / low) / 2 for _, low, high in widths) / len(widths)
        self.assertLess(mean, 0.5)

    def test_a_biased_candidate_is_found_and_an_equal_one_is_not(self):
        rng, alarms = random.Random(7), 0
        def levels(bias, block_bias=0.0):
            return [[rng.gauss(1 + bias + (block_bias if b == 4 else 0), 0.05)
                     for b in range(BLOCKS)] for _ in range(ROUNDS)]
        for _ in range(TRIALS):
            alarms += statistics.means_differ(levels(0), levels(0)) < 0.1
        self.assertLessEqual(alarms, 40)  # of 200, 20 or fewer being expected
        self.assertLess(statistics.means_differ(levels(0), levels(0.05)), 0.001)
        self.assertLess(statistics.means_differ(levels(0), levels(0, 0.6)), 0.001)


    def test_a_noisier_candidate_is_not_called_biased(self):
        # Both have mean 1; the second one's rare bright pixels carry most of it.
        rng, alarms, who = random.Random(9), 0, [("calm", "", ""), ("bright", "", "")]
        options = argparse.Namespace(reference_time=None)
        def run(rare, bright):
            rest = (1 - rare * bright) / (1 - rare)
            return [([bright if rng.random() < rare else rest for _ in range(3 * 1024)], 1)
                    for _ in range(ROUNDS)]
        for _ in range(20):
            runs = [run(0.5, 1.2), run(0.02, 30)]
            mean = efficiency.reference(options, "", who, [runs])
            rows = efficiency.compare(runs, mean, (32, 32), who)
            self.assertLess(rows[0]["worst"], 0.05)
            self.assertGreater(rows[1]["worst"], 0.1)
            alarms += rows[1]["means"] < efficiency.FALSE_ALARM
        self.assertLessEqual(alarms, 1)


if __name__ == "__main__":
    unittest.main()

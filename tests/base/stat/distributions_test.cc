// Distribution functions against closed forms and their own identities.
#include "src/base/stat/distributions.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/base/stat/chi2.h"
#include "tests/base/stat/kolmogorov.h"

namespace lanelight::stat {

TEST_CASE("the incomplete beta function of whole a, b is a binomial sum", "[stat]") {
  for (int a : {1, 3, 20, 150}) {
    for (int b : {1, 2, 17, 150}) {
      for (double x : {0.02, 0.3, 0.5, 0.77, 0.99}) {
        // I_x(a, b) = P(at least a successes in a + b - 1 trials)
        const int n = a + b - 1;
        double sum = 0;
        for (int k = a; k <= n; ++k) {
          sum +=
              std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) +
                       k * std::log(x) + (n - k) * std::log1p(-x));
        }
        INFO("a = " << a << ", b = " << b << ", x = " << x);
        CHECK(BetaI(a, b, x) == Approx(sum).epsilon(1e-11).margin(1e-300));
      }
    }
  }
  CHECK(BetaI(0.5, 0.5, 0.25) == Approx(1.0 / 3).epsilon(1e-12));  // arcsine law
}

TEST_CASE("normal quantiles invert the distribution function", "[stat]") {
  for (double p : {1e-12, 1e-6, 0.025, 0.3, 0.5, 0.9, 0.999}) {
    CHECK(NormalCdf(NormalQuantile(p)) == Approx(p).epsilon(1e-12));
  }
  CHECK(NormalQuantile(0.975) == Approx(1.959963984540054).epsilon(1e-13));
}

TEST_CASE("Student's t has its closed forms for one and two degrees", "[stat]") {
  for (double t : {0.0, 1e-3, 0.5, 1.0, 3.0, 50.0, 1e4}) {
    CHECK(StudentTwoSided(t, 1) ==
          Approx(2 / std::numbers::pi * std::atan2(1.0, t)).epsilon(1e-11));
    const double s = std::sqrt(2 + t * t);
    CHECK(StudentTwoSided(t, 2) == Approx(2 / (s * (s + t))).epsilon(1e-11));
  }
  CHECK(StudentTwoSided(1.7, 1e9) == Approx(2 * NormalCdf(-1.7)).epsilon(1e-7));
  // The normal distribution is the limit; infinitely many degrees are allowed.
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(StudentTwoSided(1.7, infinite) == 2 * NormalCdf(-1.7));
  CHECK(StudentTwoSidedQuantile(0.05, infinite) == Approx(-NormalQuantile(0.025)));
  CHECK(StudentTwoSided(2.5, 7.3) == StudentTwoSided(-2.5, 7.3));
  for (double p : {0.9, 0.05, 1e-8}) {
    CHECK(StudentTwoSided(StudentTwoSidedQuantile(p, 4.5), 4.5) ==
          Approx(p).epsilon(1e-9));
  }
}

TEST_CASE("chi-square survival has its closed forms for two and four degrees", "[stat]") {
  for (double x : {0.1, 1.0, 10.0, 200.0}) {
    CHECK(ChiSquareSurvival(x, 2) == Approx(std::exp(-x / 2)).epsilon(1e-12));
    CHECK(ChiSquareSurvival(x, 4) ==
          Approx(std::exp(-x / 2) * (1 + x / 2)).epsilon(1e-12));
  }
  CHECK(ChiSquareSurvival(-1, 3) == 1);
}

TEST_CASE("chi-square quantiles invert the distribution function", "[stat]") {
  for (double nu : {0.1, 1.0, 2.0, 7.5, 300.0, 1e4}) {
    for (double p : {1e-6, 0.025, 0.5, 0.975, 1 - 1e-6}) {
      INFO("nu = " << nu << ", p = " << p);
      const double x = ChiSquareQuantile(p, nu);
      if (p < 0.5) CHECK(1 - ChiSquareSurvival(x, nu) == Approx(p).epsilon(1e-8));
      if (p >= 0.5) CHECK(ChiSquareSurvival(x, nu) == Approx(1 - p).epsilon(1e-8));
    }
  }
  // Tables: 3.841459 (A&S 26.8). Wilson and Hilferty's (1931) cube for many degrees.
  CHECK(ChiSquareQuantile(0.95, 1) == Approx(3.841458820694124).epsilon(1e-10));
  for (double nu : {1e4, 1e6, 1e8}) {
    for (double p : {1e-9, 0.05, 0.999}) {
      const double v = 2 / (9 * nu);
      const double cube = std::pow(1 - v + NormalQuantile(p) * std::sqrt(v), 3);
      CHECK(ChiSquareQuantile(p, nu) / nu == Approx(cube).epsilon(1e-5));
    }
  }
}

TEST_CASE("F quantiles have their closed forms", "[stat]") {
  for (double p : {1e-9, 0.001, 0.05, 0.5, 0.9, 0.999, 1 - 1e-9}) {
    INFO("p = " << p);
    // Two and two: P(F <= f) = f / (1 + f). One and nu: the square of Student's t.
    CHECK(FQuantile(p, 2, 2) == Approx(p / (1 - p)).epsilon(1e-7));
    for (double nu : {1.0, 2.5, 30.0, 5000.0}) {
      const double t = StudentTwoSidedQuantile(1 - p, nu);
      CHECK(FQuantile(p, 1, nu) == Approx(t * t).epsilon(1e-6));
    }
    // Two and d: f = d/2 ((1 - p)^(-2/d) - 1).
    for (double d : {0.1, 3.0, 1e3, 1e7, 1e9}) {
      const double f = d / 2 * std::expm1(-2 / d * std::log1p(-p));
      if (std::isfinite(f)) CHECK(FQuantile(p, 2, d) == Approx(f).epsilon(1e-7));
      if (std::isfinite(f)) CHECK(1 / FQuantile(1 - p, d, 2) == Approx(f).epsilon(1e-6));
    }
    // Infinitely many below: chi-square.
    for (double d : {0.1, 4.0, 100.0}) {
      CHECK(FQuantile(p, d, 1e9) ==
            Approx(ChiSquareQuantile(p, d) / d).epsilon(1e-6).margin(1e-300));
    }
  }
}

TEST_CASE("F quantiles are accurate from 0.1 to 1e9 degrees of freedom", "[stat]") {
  // Exchanging the degrees inverts; large degrees tend to exp(2 z sqrt(1/2d1 + 1/2d2)).
  for (double d1 : {0.1, 1.0, 40.0, 1e5, 1e9}) {
    for (double d2 : {0.1, 7.0, 2e4, 1e9}) {
      for (double p : {0.025, 0.999}) {
        INFO("d1 = " << d1 << ", d2 = " << d2 << ", p = " << p);
        const double f = FQuantile(p, d1, d2);
        CHECK(f * FQuantile(1 - p, d2, d1) == Approx(1).epsilon(1e-6));
        if (d1 < 1e5 || d2 < 2e4) continue;
        const double z = NormalQuantile(p);
        const double fisher = 2 * z * std::sqrt(0.5 / d1 + 0.5 / d2);
        CHECK(std::log(f) == Approx(fisher).epsilon(0.02));
      }
    }
  }
  CHECK(FQuantile(0.95, 5, 10) == Approx(3.3258345).epsilon(1e-7));  // A&S table 26.9
}

TEST_CASE("Kolmogorov's distribution agrees with tabulated critical values", "[stat]") {
  // Exact values: n = 1: P(D >= d) = 2 (1 - d) for d >= 1/2; critical values at n = 20
  // and 100 (Miller 1956), and the asymptotic 1.3581 and 1.6276.
  CHECK(KolmogorovSurvival(0.29408, 20) == Approx(0.05).margin(0.003));
  CHECK(KolmogorovSurvival(0.35241, 20) == Approx(0.01).margin(0.001));
  CHECK(KolmogorovSurvival(0.13403, 100) == Approx(0.05).margin(0.001));
  CHECK(KolmogorovSurvival(1.3581e-3, 1000000) == Approx(0.05).margin(1e-4));
  CHECK(KolmogorovSurvival(1.6276e-3, 1000000) == Approx(0.01).margin(1e-4));
  CHECK(KolmogorovSurvival(0.001, 10) == 1);
}

}  // namespace lanelight::stat

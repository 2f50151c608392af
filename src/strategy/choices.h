// Every choice of every axis of a strategy, one line each: enumerator, name on the
// command line, arguments, meaning, formula, source. The enumerations, the parser,
// `lanelight strategies`, the tests over all combinations and the bench rows derive from
// these lists. Notation: f integrand, p density, u uniform numbers, N samples, beta
// throughput.
#pragma once

#include <cstdint>

namespace lanelight {

// clang-format off
#define LANELIGHT_DIRECTIONS(X)                                                           \
  X(kUniform, "uniform", "", "scattered directions uniform over the hemisphere",          \
    "f / p, p = 1 / (2 pi); specular lobes are followed as they are", "paper 3.5.1")      \
  X(kBsdf, "bsdf", "", "scattered directions distributed like the material (importance)", \
    "f / p, p ~ BSDF cos; GGX by visible normals", "paper 3.5.2; Heitz 2018")             \
  X(kLight, "light", "", "light reaches a surface by points sampled on the lights only",  \
    "f(x, y) V(x, y) Le / p(y)", "Shirley, Wang and Zimmerman 1996")                      \
  X(kMis, "mis", "[:power|:balance]", "both, weighted by the power or balance heuristic (default)", \
    "sum_i w_i f / p_i, w_i = p_i^e / sum_j p_j^e, e = 2 or 1", "Veach and Guibas 1995")

#define LANELIGHT_POINTS(X)                                                               \
  X(kIndependent, "independent", "", "independent uniform numbers",                       \
    "variance sigma^2 / N", "Jarzynski and Olano 2020 (hash)")                            \
  X(kStratified, "stratified", "", "one jittered sample in each of a x b strata per pair of dimensions", \
    "u = ((i mod a + xi) / a, (i div a + eta) / b)", "paper 3.5.3; Cook 1986")            \
  X(kCmj, "cmj", "", "correlated multi-jittered: strata in two dimensions and in each of them", \
    "u0 = (i mod a + (s(i div a) + xi) / b) / a, u1 likewise", "Kensler 2013")            \
  X(kPmj02, "pmj02", "", "progressive multi-jittered (0,2) sequence",                     \
    "one sample in every elementary interval of base 2", "Christensen, Kensler and Kilpatrick 2018") \
  X(kSobol, "sobol", "", "Owen-scrambled Sobol' points, padded pairs (default)",          \
    "variance up to N^-3 for smooth f", "Owen 1997; Burley 2020")                         \
  X(kHalton, "halton", "", "Owen-scrambled Halton points in bases 2 and 3, padded pairs", \
    "u = (radical inverse of i in base 2, in base 3)", "Halton 1964; Owen 2017")          \
  X(kLattice, "lattice", "", "rank-1 lattice with a random shift, padded pairs",          \
    "u = frac(i (1, z) / N + shift)", "Cranley and Patterson 1976; Sloan and Joe 1994")

#define LANELIGHT_PAIRS(X)                                                                \
  X(kNone, "none", "", "samples are drawn one by one (default)", "1/N sum f(u)", "")      \
  X(kAntithetic, "antithetic", "[:all|:pixel|:light|:bsdf|:first-bounce]",                \
    "samples 2k and 2k+1 share their numbers, the second reflected",                      \
    "1/(2N) sum (f(u) + f(1 - u)); azimuths u + 1/2", "paper eq. 6; Hammersley and Morton 1956")

#define LANELIGHT_CONTROLS(X)                                                             \
  X(kNone, "none", "", "no control variate (default)", "1/N sum f", "")                   \
  X(kAnalytic, "analytic", "", "h = unshadowed direct light of the area lights on diffuse surfaces", \
    "1/N sum (f - c (h - E[h])), E[h] by the irradiance of polygons, spheres, disks", "paper eq. 7; Lambert 1760") \
  X(kAmbient, "ambient", "", "h = unoccluded environment on diffuse surfaces",            \
    "1/N sum (f - c (h - E[h])), E[h] by spherical harmonics", "paper eq. 7; Ramamoorthi and Hanrahan 2001") \
  X(kRegression, "regression", "", "h = quadratic polynomial in the numbers of the first bounce, fitted to earlier samples nearby", \
    "1/N sum (f - c sum_j b_j P_j(u)), E[P_j] = 0", "paper eq. 7; Salaun et al. 2022")

#define LANELIGHT_ROULETTES(X)                                                            \
  X(kNone, "none", "", "paths end at the maximum depth only", "f", "")                    \
  X(kConstant, "constant", "[:Q[:FIRST]]", "ends with probability q = 0.25 at every event from the FIRST = 1st on", \
    "f / (1 - q) or 0", "paper eq. 8; Arvo and Kirk 1990")                                \
  X(kThroughput, "throughput", "[:FLOOR[:FIRST]]", "survives with the largest component of the throughput (default)", \
    "f / s or 0, s = min(1, max(FLOOR = 0, max beta)), from the FIRST = 2nd event on", "Arvo and Kirk 1990") \
  X(kLuminance, "luminance", "[:FLOOR[:FIRST]]", "survives with the luminance of the throughput", \
    "f / s or 0, s = min(1, max(FLOOR = 0.05, Y(beta))), from the FIRST = 2nd event on", "Arvo and Kirk 1990") \
  X(kAdjoint, "adjoint", "", "weight window around the expected contribution, by roulette and splitting; pilot pass", \
    "n copies of weight 1/n outside the window [1/3, 5/3], n = beta Psi / I over its edge", "Vorba and Krivanek 2016") \
  X(kEfficiency, "efficiency", "", "roulette and splitting factors that maximise efficiency; pilot passes", \
    "n copies of weight 1/n, n = beta / I sqrt(V / C / (V_I / C_I))", "Rath et al. 2022")

#define LANELIGHT_LIGHT_SELECTIONS(X)                                                     \
  X(kUniform, "uniform", "", "every light alike", "p = 1 / n", "")                        \
  X(kPower, "power", "", "lights in proportion to their power (default)",                 \
    "p ~ power, by an alias table", "Walker 1977; Vose 1991")                             \
  X(kTree, "tree", "", "descends a tree of lights by power, distance and orientation",    \
    "p = product over levels of importance / sum of importances", "Conty Estevez and Kulla 2018")
// clang-format on

// Dimensions that an antithetic pair shares and reflects: X(enumerator, name, meaning)
#define LANELIGHT_PAIRED(X)                                   \
  X(kAll, "all", "every number of the path (default)")        \
  X(kPixel, "pixel", "position in the pixel and on the lens") \
  X(kLight, "light", "choice of light and point on it")       \
  X(kBsdf, "bsdf", "scattered direction and lobe")            \
  X(kFirstBounce, "first-bounce", "light and direction at the first event")

#define LANELIGHT_ENUM(Name, LIST) enum class Name : std::uint8_t { LIST }
#define X(enumerator, ...) enumerator,
LANELIGHT_ENUM(Directions, LANELIGHT_DIRECTIONS(X));
LANELIGHT_ENUM(Points, LANELIGHT_POINTS(X));
LANELIGHT_ENUM(Pairs, LANELIGHT_PAIRS(X));
LANELIGHT_ENUM(Control, LANELIGHT_CONTROLS(X));
LANELIGHT_ENUM(Roulette, LANELIGHT_ROULETTES(X));
LANELIGHT_ENUM(LightSelection, LANELIGHT_LIGHT_SELECTIONS(X));
LANELIGHT_ENUM(Paired, LANELIGHT_PAIRED(X));
#undef X
#undef LANELIGHT_ENUM

}  // namespace lanelight

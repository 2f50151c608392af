// Every choice of every axis of a strategy, one line each: name, whether it has a stage
// or kernel of its own (STAGE: then it has a feature, the name followed by the axis),
// other features that it turns on (src/vocabulary/path/features.h), name on the command
// line, arguments, meaning, formula, source. The enumerations, the features, the plan,
// the parser, `lanelight strategies`, the tests over all combinations and the bench rows
// derive from these lists. Their parameters T and K are the type and the key of the axis.
// Notation: f integrand, p density, u uniform numbers, N samples, beta throughput.
#pragma once

#include <cstdint>

namespace lanelight {

/// Probability of ending of roulette=constant, unless another is given.
#define LANELIGHT_CONSTANT_TERMINATION 0.25
inline constexpr double kConstantTermination = LANELIGHT_CONSTANT_TERMINATION;
/// Camera rays per path of seen-lights=apart.
#define LANELIGHT_VISIBLE_LIGHT_RAYS 16
inline constexpr int kVisibleLightRays = LANELIGHT_VISIBLE_LIGHT_RAYS;
/// Light samples of which light-candidates=resampled keeps one, unless told otherwise.
#define LANELIGHT_LIGHT_CANDIDATES 4
inline constexpr std::uint32_t kDefaultLightCandidates = LANELIGHT_LIGHT_CANDIDATES;
/// Paths that share their second vertices with reuse=block, unless told otherwise.
#define LANELIGHT_REUSED_PATHS 64
inline constexpr std::uint32_t kDefaultReusedPaths = LANELIGHT_REUSED_PATHS;
/// Camera samples per light subpath, unless told otherwise.
#define LANELIGHT_LIGHT_PATH_SAMPLES 4
inline constexpr std::uint32_t kDefaultLightPathSamples = LANELIGHT_LIGHT_PATH_SAMPLES;
#define LANELIGHT_TEXT(value) LANELIGHT_TEXT_OF(value)
#define LANELIGHT_TEXT_OF(value) #value

// clang-format off
#define LANELIGHT_DIRECTIONS(X, T, K)                                                           \
  X(T, K, Uniform, STAGE, ({}), "uniform", "", "scattered directions uniform over the hemisphere", \
    "f / p, p = 1 / (2 pi); specular lobes are followed as they are", "paper 3.5.1")      \
  X(T, K, Bsdf, PLAIN, ({}), "bsdf", "", "scattered directions distributed like the material (importance)", \
    "f / p, p ~ BSDF cos; GGX by visible normals", "paper 3.5.2; Heitz 2018")             \
  X(T, K, Light, PLAIN, ({kSampledHittableLights}), "light", "", "light sampling only", \
    "f(x, y) V(x, y) Le / p(y)", "Shirley, Wang and Zimmerman 1996")                      \
  X(T, K, Mis, PLAIN, ({kSampledHittableLights}), "mis", "[:power|:balance]", "both, weighted by the power or balance heuristic (default)", \
    "sum_i w_i f / p_i, w_i = p_i^e / sum_j p_j^e, e = 2 or 1", "Veach and Guibas 1995")

#define LANELIGHT_SAMPLE_SEQUENCES(X, T, K)                                                               \
  X(T, K, Independent, STAGE, ({}), "independent", "", "independent uniform numbers", \
    "variance sigma^2 / N", "Jarzynski and Olano 2020 (hash)")                            \
  X(T, K, Stratified, STAGE, ({}), "stratified", "", "one jittered sample in each of a x b strata per pair of dimensions", \
    "u = ((i mod a + xi) / a, (i div a + eta) / b)", "paper 3.5.3; Cook 1986")            \
  X(T, K, Sobol, STAGE, ({}), "sobol", "", "Owen-scrambled Sobol' points, padded pairs (default)", \
    "variance up to N^-3 for smooth f", "Owen 1997; Burley 2020")                         \
  X(T, K, Halton, STAGE, ({}), "halton", "", "Owen-scrambled Halton points in bases 2 and 3, padded pairs", \
    "u = (radical inverse of i in base 2, in base 3)", "Halton 1964; Owen 2017")

#define LANELIGHT_PAIRS(X, T, K)                                                                \
  X(T, K, None, PLAIN, ({}), "none", "", "no antithetic samples (default)", "1/N sum f(u)", "") \
  X(T, K, Antithetic, STAGE, ({}), "antithetic", "", \
    "samples 2k and 2k+1 share their numbers, the second reflected",                      \
    "1/(2N) sum (f(u) + f(1 - u)); azimuths u + 1/2", "paper eq. 6; Hammersley and Morton 1956")

#define LANELIGHT_CONTROLS(X, T, K)                                                             \
  X(T, K, None, PLAIN, ({}), "none", "", "no control variate (default)", "1/N sum f", "") \
  X(T, K, Regression, STAGE, ({}), "regression", "", "h = polynomial in the first random numbers of a path (quadratic in the direction, linear in the choice of lobe), fitted to the other half of the samples", \
    "1/N sum (f - c sum_j b_j phi_j(u)), E[phi_j] = 0, b_j = Cov(f, phi_j) / Var(phi_j)", "paper eq. 7; Salaun et al. 2022")

#define LANELIGHT_ROULETTES(X, T, K)                                                            \
  X(T, K, None, PLAIN, ({}), "none", "", "paths end at the maximum depth only", "f", "") \
  X(T, K, Constant, STAGE, ({kRoulette}), "constant", "[:Q[:FIRST]]", "ends with probability q = " LANELIGHT_TEXT(LANELIGHT_CONSTANT_TERMINATION) " at every event from the FIRST = 1st on", \
    "f / (1 - q) or 0", "paper eq. 8; Arvo and Kirk 1990")                                \
  X(T, K, Throughput, STAGE, ({kRoulette}), "throughput", "[:FLOOR[:FIRST[:SCALE]]]", "survives with the largest component of the throughput (default)", \
    "f / s or 0, s = min(1, max(FLOOR = 0, SCALE max beta)), SCALE = 1, from the FIRST = 2nd event on", "Arvo and Kirk 1990") \
  X(T, K, Adjoint, STAGE, ({kSplitting}), "adjoint", "", "weight window around the expected contribution, by roulette and splitting; training pass", \
    "n copies of weight 1/n outside the window [1/3, 5/3], n = beta Psi / I over its edge", "Vorba and Krivanek 2016")

#define LANELIGHT_LIGHT_SELECTIONS(X, T, K)                                                     \
  X(T, K, Uniform, PLAIN, ({kLightTable}), "uniform", "", "every light with the same probability", "p = 1 / n", "") \
  X(T, K, Power, PLAIN, ({kLightTable}), "power", "", "lights in proportion to their power (default)", \
    "p ~ power, by an alias table", "Walker 1977; Vose 1991")                             \
  X(T, K, Tree, PLAIN, ({kLightTree}), "tree", "", "descends a tree of lights by power, distance and orientation", \
    "p = product over levels of importance / sum of importances", "Conty Estevez and Kulla 2018") \
  X(T, K, Learned, PLAIN, ({kLearnedLights}), "learned", "", "in proportion to what lights bring to a cell of the scene, shadows included; training pass", \
    "p ~ sqrt(E[f^2]) by cells of space and normal, and a fifth by power", "Vevoda, Kondapaneni and Krivanek 2018")

#define LANELIGHT_VISIBLE_LIGHTS(X, T, K)                                                          \
  X(T, K, Paths, PLAIN, ({}), "paths", "", "directly visible lights by the camera rays of the paths", \
    "1/N sum Le(x_i)", "")                                                                \
  X(T, K, Apart, PLAIN, ({}), "apart", "", "the same, but by " LANELIGHT_TEXT(LANELIGHT_VISIBLE_LIGHT_RAYS) " further camera rays per path in pixels at edges of lights (default)", \
    "1/N sum (f_i - Le(x_i)) + 1/(M N) sum Le(y_j), M = " LANELIGHT_TEXT(LANELIGHT_VISIBLE_LIGHT_RAYS), "splitting: Arvo and Kirk 1990")

#define LANELIGHT_LIGHT_POINTS(X, T, K)                                                         \
  X(T, K, Area, PLAIN, ({}), "area", "", "points on emitting triangles and rectangles uniform over the area (default)", \
    "Le / p, p = pmf d^2 / (A |cos|)", "Shirley, Wang and Zimmerman 1996")                \
  X(T, K, SolidAngle, PLAIN, ({kSolidAngleLights}), "solid-angle", "", "uniform over the solid angle that they fill", \
    "Le / p, p = pmf / omega", "Arvo 1995; Urena, Fajardo and King 2013") \
  X(T, K, Projected, PLAIN, ({kProjectedLights}), "projected", "", "the same, warped by the cosine at the surface", \
    "Le / p, p = pmf b(u) / omega, b bilinear in the cosines at the corners", "Hart et al. 2020")

#define LANELIGHT_LIGHT_CANDIDATE_CHOICES(X, T, K)                                              \
  X(T, K, Single, PLAIN, ({}), "single", "", "every light sample is used (default)", "f / p", "") \
  X(T, K, Resampled, PLAIN, ({kLightCandidates}), "resampled", "[:M]", "one of M = " LANELIGHT_TEXT(LANELIGHT_LIGHT_CANDIDATES) " light samples, by its unshadowed contribution", \
    "f(y) / h(y) 1/M sum h(x_i) / p(x_i), h = f without visibility", "Talbot, Cline and Egbert 2005")

#define LANELIGHT_ENVIRONMENT_CHOICES(X, T, K)                                                  \
  X(T, K, Plain, PLAIN, ({}), "plain", "", "environment images sampled in proportion to their radiance (default)", \
    "p ~ L", "")                                                                          \
  X(T, K, Compensated, PLAIN, ({}), "compensated", "", "in proportion to radiance minus its mean; BSDF sampling covers the dim parts (needs directions=mis)", \
    "p ~ max(0, L - mean L)", "Karlik et al. 2019")

#define LANELIGHT_DISTANCES(X, T, K)                                                            \
  X(T, K, Exponential, PLAIN, ({}), "exponential", "", "points in media in proportion to the transmittance (default)", \
    "f / p, p = sigma_t T(d)", "Raab, Seibert and Keller 2008")                           \
  X(T, K, Equiangular, STAGE, ({}), "equiangular", "", "points in homogeneous media also uniform in the angle around a light", \
    "f / p, p = (sigma_t T(d) + (1 - T(t)) p_angle(d)) / 2, p_angle = D / (theta (D^2 + (d - d_0)^2))", "Kulla and Fajardo 2012")

#define LANELIGHT_PIXEL_SAMPLES(X, T, K)                                                        \
  X(T, K, Own, PLAIN, ({}), "own", "", "a pixel has the samples that are drawn for it, by its filter (default)", \
    "1/N sum f(x_i), x_i ~ g_p", "Ernst, Stamminger and Greiner 2006")                    \
  X(T, K, Shared, STAGE, ({}), "shared", "", "the samples of a tile count for all its pixels whose filters they lie under", \
    "1/N sum_q sum_i f(x_qi) g_p(x_qi) / sum_r g_r(x_qi), x_qi ~ g_q", "balance heuristic: Veach and Guibas 1995")

#define LANELIGHT_REUSES(X, T, K)                                                               \
  X(T, K, None, PLAIN, ({}), "none", "", "no path reuse (default)", "f L / p", "") \
  X(T, K, Block, PLAIN, ({kReuse}), "block", "[:N[:random|:compact]]", "the second vertices of N = " LANELIGHT_TEXT(LANELIGHT_REUSED_PATHS) " paths of a tile are shared by all their first vertices", \
    "sum_j f_i(x_j) V L_j / sum_k p_k(x_j) V", "Bekaert, Sbert and Halton 2002")

#define LANELIGHT_LIGHT_PATH_CHOICES(X, T, K)                                                   \
  X(T, K, None, PLAIN, ({}), "none", "", "no light subpaths (default)", "f / p", "")          \
  X(T, K, Splats, PLAIN, ({kLightPaths}), "splats", "[:N]", "one light subpath for N = " LANELIGHT_TEXT(LANELIGHT_LIGHT_PATH_SAMPLES) " camera samples; its vertices connect to the camera", \
    "sum_s w_s f_s / p_s, balance heuristic", "Veach 1997, chapter 10")

#define LANELIGHT_DECISIONS(X, T, K)                                                            \
  X(T, K, None, PLAIN, ({}), "none", "", "the strategy is used as given (default for short renders, and if a strategy is named)", "one strategy", "")       \
  X(T, K, Pilot, PLAIN, ({kDecides}), "pilot", "", "a short trial run before the image chooses another roulette, path reuse or light subpaths if that is clearly more efficient (default of `render`, `plan` and `profile` from 4 s or 8 million samples, if no strategy is named)", \
    "argmin over strategies of variance times cost", "")
// clang-format on

// The layouts of reuse=block: X(name, text, meaning)
#define LANELIGHT_BLOCK_LAYOUTS(X)                                               \
  X(Random, "random", "at random from the tile, anew for each sample (default)") \
  X(Compact, "compact", "a rectangle at another position in the tile for each sample")

// Every axis, as in a strategy's text: X(type, member of Strategy, key, choices).
#define LANELIGHT_AXES(X)                                                           \
  X(Directions, directions, "directions", LANELIGHT_DIRECTIONS)                     \
  X(SampleSequence, sampler, "points", LANELIGHT_SAMPLE_SEQUENCES)                  \
  X(Pairs, pairs, "pairs", LANELIGHT_PAIRS)                                         \
  X(Control, control, "control", LANELIGHT_CONTROLS)                                \
  X(Roulette, roulette, "roulette", LANELIGHT_ROULETTES)                            \
  X(LightSelection, light_selection, "light-selection", LANELIGHT_LIGHT_SELECTIONS) \
  X(VisibleLights, visible_lights, "seen-lights", LANELIGHT_VISIBLE_LIGHTS)         \
  X(LightPoints, light_points, "light-points", LANELIGHT_LIGHT_POINTS)              \
  X(LightCandidates, light_candidates, "light-candidates",                          \
    LANELIGHT_LIGHT_CANDIDATE_CHOICES)                                              \
  X(EnvironmentPoints, environment, "environment", LANELIGHT_ENVIRONMENT_CHOICES)   \
  X(Distances, distances, "distances", LANELIGHT_DISTANCES)                         \
  X(PixelSamples, pixel_samples, "pixel-samples", LANELIGHT_PIXEL_SAMPLES)          \
  X(Reuse, reuse, "reuse", LANELIGHT_REUSES)                                        \
  X(LightPaths, light_paths, "light-paths", LANELIGHT_LIGHT_PATH_CHOICES)           \
  X(Decide, decide, "decide", LANELIGHT_DECISIONS)

#define X(Type, key, name, ...) k##name,
#define LANELIGHT_AXIS(Type, member, key, CHOICES) \
  enum class Type : std::uint8_t { CHOICES(X, Type, key) };
LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
#undef X
#define X(name, ...) k##name,
enum class BlockLayout : std::uint8_t { LANELIGHT_BLOCK_LAYOUTS(X) };
#undef X

// Counts the choices of an axis.
#define X(...) +1
inline constexpr int kNumSampleSequences =
    LANELIGHT_SAMPLE_SEQUENCES(X, SampleSequence, "points");
#undef X

// The texts of the choices, in the order of their enumerators: kDirectionsNames, ...
#define X(Type, key, name, own, also, text, ...) text,
#define LANELIGHT_AXIS(Type, member, key, CHOICES) \
  inline constexpr const char* k##Type##Names[] = {CHOICES(X, Type, key)};
LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
#undef X
#define X(name, text, meaning) text,
inline constexpr const char* kBlockLayoutNames[] = {LANELIGHT_BLOCK_LAYOUTS(X)};
#undef X

}  // namespace lanelight

// Sums, filters and lenses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {
namespace {

constexpr std::uint32_t kBlock = 4096;

// A film of one pixel after `count` samples, of values by their number.
template <class Value>
FilmAccumulator Sum(std::uint64_t count, const SampleGroups& groups, Value value) {
  FilmAccumulator film(0, 0, 1, 1, groups, Auxiliary::kNone);
  std::vector<float> block(kBlock);
  const float* planes[3] = {block.data(), block.data(), block.data()};
  for (std::uint64_t i = 0; i < count; i += kBlock) {
    const auto n = static_cast<std::uint32_t>(std::min<std::uint64_t>(kBlock, count - i));
    for (std::uint32_t j = 0; j < n; ++j) block[j] = value(i + j);
    film.AddSamples(0, 0, planes, n);
  }
  return film;
}

Point OfFilm(const std::string& series, double expected, double measured,
             double tolerance, double count) {
  Point point;
  point.series = series;
  point.expected = expected;
  point.measured = measured;
  point.tolerance = tolerance;
  point.samples = static_cast<std::uint64_t>(count);
  return point;
}

// What a sum in double precision may lose of itself.
double Rounding(double samples) { return 1e-15 + 0x1p-53 * samples; }

// Values whose exact mean is known: a constant that has no short binary form, and a
// bright sample now and then.
std::vector<Point> ByCount(double samples, const Effort&) {
  const auto count = static_cast<std::uint64_t>(samples);
  std::vector<Point> points;
  const float third = 1.0f / 3;
  constexpr std::uint64_t kRare = 1000;
  const double bright = std::floor(double(count + kRare - 1) / kRare);
  const double mixed = (bright * 1e6 + (samples - bright) * double(third)) / samples;
  for (const bool replicates : {false, true}) {
    const SampleGroups groups = {1, replicates};
    const std::string how = replicates ? "in turns" : "one by one";
    const auto even = Sum(count, groups, [third](std::uint64_t) { return third; });
    points.push_back(OfFilm("even, " + how, double(third), even.Mean(0, 0).x,
                            Rounding(samples) * double(third), samples));
    const auto rare = Sum(count, groups, [third](std::uint64_t i) {
      return i % kRare == 0 ? 1e6f : third;
    });
    points.push_back(OfFilm("fireflies, " + how, mixed, rare.Mean(0, 0).x,
                            Rounding(samples) * mixed, samples));
  }
  return points;
}

// Samples of +1 and -1 around a large mean: what is left of the scatter.
std::vector<Point> ByOffset(double offset, const Effort&) {
  constexpr std::uint64_t kCount = 4096;
  std::vector<Point> points;
  for (const bool replicates : {false, true}) {
    const SampleGroups groups = {1, replicates};
    // Blocks of four samples share a sign, so that turns and single samples scatter.
    const auto film = Sum(kCount, groups, [&](std::uint64_t i) {
      const bool up = replicates ? i % 2 == 0 : i / 4 % 2 == 0;
      return static_cast<float>(offset + (up ? 1 : -1));
    });
    const double n = replicates ? 4 : double(kCount);
    points.push_back(OfFilm(replicates ? "in turns" : "one by one", 1 / (n - 1),
                            film.Variance(0, 0).x, 1e-3 / (n - 1), double(kCount)));
  }
  return points;
}

// Something that is not in view.
std::string Aside() { return Sphere({50, 0, 0}, 1, Diffuse(0)); }

std::vector<Point> BySamples(double spp, const Effort& effort) {
  SceneText scene = Setup(ViewOfPlane() + Sky(1.0 / 3) + Aside(), {1, 1, 1, 2}, effort);
  scene.settings.spp = static_cast<std::uint64_t>(spp);
  Point point = Expect(1.0 / 3, scene);
  point.tolerance = 1e-7;
  point.standard_error = 0;  // all samples are equal; a single one shows no scatter
  return {point};
}

std::vector<Point> ByFilterRadius(double radius, const Effort& effort) {
  std::vector<Point> points;
  for (const char* kind : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    std::string text = ViewOfPlane() + Sky(1) + Aside();
    const std::string filter = fmt::format(
        "PixelFilter \"{}\" \"float xradius\" {:.17g} \"float yradius\" {:.17g}", kind,
        radius, radius);
    const std::string box = "PixelFilter \"box\"";
    text.replace(text.find(box), box.size(), filter);
    points.push_back(Named(kind, Expect(1, text, {256, 16384, 1, 4}, effort)));
  }
  return points;
}

// The edge of a lamp through the middle of the image: half of what any round lens sees.
Point HalfPlane(const std::string& series, double lens, double focus,
                const Effort& effort) {
  // Rays meet the lamp's plane up to the radius times |1 - 1 / focus| aside.
  const double wide = 2 * (1 + lens * std::abs(1 - 1 / focus));
  const std::string text =
      fmt::format(
          "LookAt 0 0 0  0 0 1  0 1 0\nCamera \"perspective\" \"float fov\" 40 "
          "\"float lensradius\" {:.17g} \"float focaldistance\" {:.17g}\n",
          lens, focus) +
      "PixelFilter \"box\"\nWorldBegin\n" + Glow(1, true) +
      Rectangle({0, -wide, 1}, {wide, wide, 1});
  return Named(series, Expect(0.5, text, {64, 4096, 1}, effort));
}

std::vector<Point> ByLens(double lens, const Effort& effort) {
  return {HalfPlane("in focus", lens, 1, effort),
          HalfPlane("focus at 1e6", lens, 1e6, effort),
          HalfPlane("focus at 1e-3", lens, 1e-3, effort)};
}

std::vector<Point> ByFocus(double focus, const Effort& effort) {
  return {HalfPlane("lens 0.1", 0.1, focus, effort),
          HalfPlane("lens 10", 10, focus, effort)};
}

}  // namespace

void AddFilmCases(std::vector<Case>& cases) {
  const CaseAdder twins{cases, "film", Truth::kTwin};
  const CaseAdder closed{cases, "film", Truth::kClosedForm};
  twins({"film-sum", "1 to 1e7 samples of a pixel",
         "their mean, to 1.1e-16 of itself per sample",
         LogAxis("samples", "", {1, 1e10}, Decades(0, 6), Decades(0, 8)), ByCount});
  closed({"film-variance", "samples that scatter by 1 around 1 to 1e7", "their variance",
          LogAxis("mean over scatter", "", {1, 1e6}, Decades(0, 7)), ByOffset});
  closed({"samples-per-pixel", "1 to 1e6 samples of a sky per pixel",
          "its radiance, to a rounding",
          LogAxis("samples", "", {1, 1e12}, Decades(0, 5), Decades(0, 7)), BySamples});
  closed({"filter-radius", "radius of every pixel filter, from 1e-3 to 100 pixels",
          "a furnace shows 1",
          LogAxis("radius", "pixels", {1e-3, 100}, {1e-3, 0.5, 2, 10, 100},
                  Decades(-3, 2, 0.5)),
          ByFilterRadius});
  closed({"lens-radius", "a lens of radius 1e-6 to 1000",
          "the edge of a lamp in the middle is half of it",
          LogAxis("lens radius", "", {1e-6, 1e3}, Decades(-6, 3, 3), Decades(-6, 3)),
          ByLens});
  closed({"focal-distance", "a focal distance of 1e-6 to 1e9",
          "the edge of a lamp in the middle is half of it",
          LogAxis("focal distance", "", {1e-6, 1e9}, Decades(-6, 9, 3), Decades(-6, 9)),
          ByFocus});
}

}  // namespace lanelight::stress

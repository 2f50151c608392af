// Light of any strength: radiance over 60 decades, and many decades in one image.
#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "src/base/core/pi.h"
#include "src/base/image/exr.h"
#include "src/base/image/octahedral.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

const Quality kLitOnce = {.depth = 1};

std::string Light(const std::string& kind, const std::string& color, double value) {
  return "LightSource \"" + kind + "\"" + Grey(color, value);
}

std::vector<Point> ByRadiance(double radiance, const Effort& effort) {
  const std::string view = ViewOfPlane() + Plane(Diffuse(0.5));
  const std::string down = " \"point3 from\" [0 0 2] \"point3 to\" [0 0 0]\n";
  const double delta = 0.5 / kPi * radiance;
  const auto lit = [&](const char* series, double expected, const std::string& light) {
    return Named(series, Expect(expected, view + light, kLitOnce, effort));
  };
  return {lit("sky", 0.5 * radiance, Sky(radiance)),
          lit("sphere", 0.4 * radiance * 0.25, SphereLight({0.6, 0, 0.8}, 0.5, radiance)),
          lit("point", delta / 4,
              Light("point", "I", radiance) + " \"point3 from\" [0 0 2]\n"),
          lit("spot", delta / 4, Light("spot", "I", radiance) + down),
          lit("distant", delta, Light("distant", "L", radiance) + down)};
}

// Standard error of a noisy image, of the radiance.
std::vector<Point> NoiseByRadiance(double radiance, const Effort& effort) {
  const auto relative_error = [&](double l) {
    Point point = Expect(
        0, ViewOfPlane() + Plane(Diffuse(0.5)) + SphereLight({0.6, 0, 0.8}, 0.5, l),
        kLitOnce, effort);
    point.measured = point.standard_error / l;
    point.standard_error = 0;
    return point;
  };
  Point point = relative_error(radiance);
  point.expected = relative_error(1).measured;
  point.tolerance = 1e-3 * point.expected;
  return {point};
}

// Two lamps that fill half of the image each: neither light reaches the other half.
std::vector<Point> InOneImage(double ratio, const Effort& effort) {
  const auto lamp = [](double x0, double x1, double radiance) {
    return Block(AreaLightText(radiance) + Rectangle({x0, -1, 0}, {x1, 1, 0}));
  };
  const JobRun image = RenderText(
      Setup(ViewOfPlane(1, 1) + lamp(-1, 0, 1) + lamp(0, 1, ratio), kLitOnce, effort));
  Point whole = MeanOf(image);
  // Which half is on the left is the camera's business.
  const double left = image.film.Mean(1, 4).y, right = image.film.Mean(6, 4).y;
  Point dark = whole, bright = whole;
  dark.series = "darker half";
  dark.measured = std::min(left, right);
  dark.expected = std::min(1.0, ratio);
  bright.series = "brighter half";
  bright.measured = std::max(left, right);
  bright.expected = std::max(1.0, ratio);
  for (Point* p : {&dark, &bright}) {
    p->standard_error = 0;
    p->tolerance = 1e-6 * p->expected;
  }
  return {dark, bright};
}

// An environment of one bright texel among others of radiance 1; gone with the object.
class TexelSky {
 public:
  static constexpr int kSize = 16;
  TexelSky(int column, int row, double bright) {
    path_ = std::filesystem::temp_directory_path() /
            fmt::format("lanelight-stress-{}-{}-{}.exr", ::getpid(), column, row);
    std::vector<float> texels(kSize * kSize, 1);
    texels[static_cast<std::size_t>(row * kSize + column)] = static_cast<float>(bright);
    WriteExr(path_.string(), kSize, kSize, {{"R", texels}, {"G", texels}, {"B", texels}});
  }
  ~TexelSky() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TexelSky(const TexelSky&) = delete;
  TexelSky& operator=(const TexelSky&) = delete;

  std::string Text() const {
    return fmt::format("LightSource \"infinite\" \"string filename\" \"{}\"\n",
                       path_.string());
  }

 private:
  std::filesystem::path path_;
};

// Share of a plane's irradiance pi that a texel of radiance 1 gives.
double TexelFraction(int column, int row) {
  constexpr int kSub = 64, kSize = TexelSky::kSize;
  double sum = 0;
  for (int i = 0; i < kSub * kSub; ++i) {
    const double u = (column + (i % kSub + 0.5) / kSub) / kSize;
    const double v = (row + (i / kSub + 0.5) / kSub) / kSize;
    sum += std::max(0.0, OctahedralToDirection(u, v).z);
  }
  return sum / (double(kSub) * kSub) * 4 / (double(kSize) * kSize);
}

std::vector<Point> BrightTexel(double bright, const Effort& effort) {
  std::vector<Point> points;
  const struct {
    const char* name;
    int column, row;
  } texels[] = {{"high", 8, 9}, {"at the horizon", 12, 12}, {"below", 15, 15}};
  for (const auto& [name, column, row] : texels) {
    const TexelSky sky(column, row, bright);
    const double fraction = TexelFraction(column, row);
    Point point =
        Expect(0.5 * (1 + (bright - 1) * fraction),
               ViewOfPlane() + Plane(Diffuse(0.5)) + sky.Text(), kLitOnce, effort);
    // A light sample that picks another texel misses nearly all of the light.
    const double others = TexelSky::kSize * TexelSky::kSize - 1;
    if (fraction > 0)
      point = AllowForRareSamples(point, others / (others + bright), point.expected);
    points.push_back(Named(name, point));
  }
  return points;
}

}  // namespace

void AddRadianceCases(std::vector<Case>& cases) {
  const CaseAdder closed_lights{cases, "lights", Truth::kClosedForm};
  const CaseAdder invariant{cases, "lights", Truth::kInvariance};
  const CaseAdder closed_film{cases, "film", Truth::kClosedForm};
  const CaseAdder twins{cases, "lights", Truth::kTwin};
  closed_lights(
      {"radiance", "radiance of every kind of light, from 1e-30 to 1e30",
       "the image is proportional to it",
       LogAxis("radiance", "", {1e-30, 1e30}, Decades(-30, 30, 15), Decades(-30, 30, 3)),
       ByRadiance});
  invariant(
      {"noise-of-radiance", "noise of an image of radiance 1e-30 to 1e30",
       "the standard error is proportional to it",
       LogAxis("radiance", "", {1e-30, 1e30}, Decades(-30, 30, 15), Decades(-30, 30, 3)),
       NoiseByRadiance});
  closed_film({"decades-in-one-image",
               "two lamps in one image, 1e-12 to 1e12 times as bright", "each is exact",
               LogAxis("ratio", "", {1e-12, 1e12}, Decades(-12, 12, 3)), InOneImage});
  twins({"bright-texel", "one texel of the sky 1 to 1e12 times as bright as the rest",
         "the radiance of the plane equals the sum over the texels",
         LogAxis("times as bright", "", {1, 1e12}, Decades(0, 12, 2), Decades(0, 12)),
         BrightTexel});
}

}  // namespace lanelight::stress

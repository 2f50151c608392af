// What the cases on materials, lights and transport share: cameras, skies and surfaces as
// text, and renders of it held against an expected value.
#pragma once

#include <string>
#include <vector>

#include "src/stress/scene_point.h"
#include "src/stress/stress_case.h"

namespace lanelight::stress {

/// What means of images may be off by besides noise, of themselves (docs/numbers.md).
inline constexpr double kFloatError = 1e-5;

/// 10^first, 10^(first + step), ..., up to 10^last.
std::vector<double> Decades(double first, double last, double step = 1);

/// Up to "WorldBegin": an orthographic camera above the plane z = 0 that sees the square
/// |x|, |y| <= half around the origin under an angle of this cosine. At slant angles the
/// square is made smaller, so that it stays in front of the plane.
std::string ViewOfPlane(double cosine = 1, double half = 1e-3);
/// Up to "WorldBegin": a perspective camera at `eye` that looks at the origin.
std::string ViewFrom(Vec3d eye, double fov);

std::string Sky(double radiance);
/// The plane z = 0 with a material: the words after `Material`.
std::string Plane(const std::string& material);
std::string Diffuse(double albedo);
/// A sphere that emits and reflects nothing.
std::string SphereLight(Vec3d center, double radius, double radiance);
/// A sphere of a material.
std::string Sphere(Vec3d center, double radius, const std::string& material);

/// How a text is rendered.
struct Quality {
  std::uint64_t quick = 64, full = 4096;  // samples per pixel
  int depth = 5;
  int size = 8;  // pixels per side
  std::string strategy = {};
};

SceneText Setup(const std::string& text, const Quality& quality, const Effort& effort);

/// Renders and expects this mean, within kFloatError of it.
Point Expect(double expected, const SceneText& scene);
Point Expect(double expected, const std::string& text, const Quality& quality,
             const Effort& effort);
/// The same, as a point of a series.
Point Named(const std::string& series, Point point);
/// A point of a series that is not measured, and why.
Point NotMeasured(const std::string& series, const std::string& why);
/// The point of a mean of two outcomes `difference` apart, the rarer with probability
/// `rare`: the scatter of the samples alone says nothing where the rare one did not come.
/// A few of them by chance are tolerated.
Point WithRare(Point point, double rare, double difference);
/// Failures among trials, of which none is promised.
Point NoFailures(std::uint64_t failures, std::uint64_t trials);

/// A case on an axis whose values are the same for quick and full, or not.
Axis LogAxis(const std::string& name, const std::string& unit, double promised_low,
             double promised_high, std::vector<double> quick,
             std::vector<double> full = {});

}  // namespace lanelight::stress

// Shape "curve": control points of any basis to cubic Bezier curves.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

using PointList = std::vector<Vec3d>;
enum class Basis { kBezier, kBspline };

using Segment = std::array<Vec3d, 4>;

Segment Elevated(Vec3d a, Vec3d b, Vec3d c) {
  return {a, (a + 2.0 * b) / 3, (2.0 * b + c) / 3, c};
}

// The curve from point `at` on. Uniform B-splines pass between their points.
Segment SegmentOf(const PointList& p, std::size_t at, Basis basis, int degree) {
  const Vec3d a = p[at], b = p[at + 1], c = p[at + 2];
  if (degree == 2) {
    return basis == Basis::kBezier ? Elevated(a, b, c)
                                   : Elevated((a + b) / 2, b, (b + c) / 2);
  }
  const Vec3d d = p[at + 3];
  if (basis == Basis::kBezier) return {a, b, c, d};
  return {(a + 4.0 * b + c) / 6, (2.0 * b + c) / 3, (b + 2.0 * c) / 3,
          (b + 4.0 * c + d) / 6};
}

std::size_t CountSegments(ParamSet& params, std::size_t points, Basis basis, int degree) {
  const auto n = static_cast<std::size_t>(degree);
  const bool bezier = basis == Basis::kBezier;
  if (points <= n || (bezier && (points - 1) % n != 0)) {
    params.Fail(params.Need("P", ParamType::kPoint3),
                "{} points; a {} of degree {} takes {}", points,
                bezier ? "Bezier curve" : "B-spline", degree,
                bezier ? fmt::format("{} and {} for each further part", n + 1, n)
                       : fmt::format("{} or more", n + 1));
  }
  return bezier ? (points - 1) / n : points - n;
}

PointList NormalsOf(ParamSet& params, CurveType type, std::size_t segments) {
  if (type != CurveType::kRibbon) {
    params.Ignore("N", "only curves of type \"ribbon\" have normals");
    return {};
  }
  const Param& param = params.Need("N", ParamType::kNormal);
  PointList normals = Triples(param);
  if (normals.size() != segments + 1) {
    params.Fail(param, "{} normals; a ribbon of {} parts takes {}", normals.size(),
                segments, segments + 1);
  }
  for (Vec3d& n : normals) {
    if (Length(n) == 0) params.Fail(param, "a normal is zero");
    n = Normalize(n);
  }
  for (std::size_t i = 0; i < segments; ++i) {
    if (Length(normals[i] + normals[i + 1]) < 1e-3) {
      params.Fail(param,
                  "normals of neighbouring ends are opposite, so that the ribbon between "
                  "them could turn either way");
    }
  }
  return normals;
}

bool HasLength(const Curve& curve) {
  return std::any_of(curve.p + 1, curve.p + 4, [&](Vec3d p) { return p != curve.p[0]; });
}

}  // namespace

std::vector<Curve> InterpretCurve(ParseState& state, ParamSet& params) {
  const Basis basis = params.Choice<Basis>(
      "basis", {{"bezier", Basis::kBezier}, {"bspline", Basis::kBspline}});
  const int degree = params.Integer("degree", 3, {2, 3});
  const CurveType type = params.Choice<CurveType>("type",
                                                  {{"flat", CurveType::kFlat},
                                                   {"cylinder", CurveType::kCylinder},
                                                   {"ribbon", CurveType::kRibbon}},
                                                  "cylinder");
  params.Integer("splitdepth", 3, {0, 30});  // checked; the shape decides on pieces
  const PointList points = Triples(params.Need("P", ParamType::kPoint3));
  const std::size_t n = CountSegments(params, points.size(), basis, degree);
  const PointList normals = NormalsOf(params, type, n);
  const double width = params.Float("width", 1, kNotNegative);
  const double first = params.Float("width0", width, kNotNegative);
  const double last = params.Float("width1", width, kNotNegative);
  if (first == 0 && last == 0) {
    state.AddNote(params.where(), "left out shape \"curve\": its width is 0");
    return {};
  }
  std::vector<Curve> curves;
  std::size_t left_out = 0;
  const std::size_t step = basis == Basis::kBezier ? static_cast<std::size_t>(degree) : 1;
  for (std::size_t i = 0; i < n; ++i) {
    Curve curve;
    const Segment p = SegmentOf(points, i * step, basis, degree);
    std::copy(p.begin(), p.end(), curve.p);
    for (std::size_t end = 0; end < 2; ++end) {
      const double fraction = static_cast<double>(i + end) / static_cast<double>(n);
      curve.width[end] = (1 - fraction) * first + fraction * last;
      if (!normals.empty()) curve.normal[end] = normals[i + end];
    }
    curve.type = type;
    if (HasLength(curve)) {
      curves.push_back(curve);
    } else {
      ++left_out;
    }
  }
  if (left_out > 0) {
    state.AddNote(params.where(),
                  "left out {} of {} parts of shape \"curve\": without length", left_out,
                  n);
  }
  return curves;
}

}  // namespace lanelight

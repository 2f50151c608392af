#include "src/scene/accel/curve_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

// Halvings at most: where a curve bends, until the points of a piece lie within
// 1 / kStraight of its length of even spacing on its chord; where it is long, until a
// piece is kLong times as long as wide, but into four, as each takes some 75 bytes.
constexpr int kMaxBendHalvings = 6, kMaxLengthHalvings = 2;
constexpr double kStraight = 8, kLong = 8;
constexpr std::size_t kCurveGrain = 1024;

Vec3d PointOf(const CurveRecord& curve, int k) {
  return {curve.p[k][0], curve.p[k][1], curve.p[k][2]};
}

// Returns the curve in the space of its intersection test, up to a translation.
CurveRecord InOwnSpace(const Geometry& g, std::size_t index) {
  CurveRecord curve = g.curves[index];
  if (g.curve_spaces.empty()) return curve;
  const float* m = g.curve_spaces[index].object_from_scene;
  for (auto& p : curve.p) {
    const float x = p[0], y = p[1], z = p[2];
    for (int a = 0; a < 3; ++a) p[a] = m[3 * a] * x + m[3 * a + 1] * y + m[3 * a + 2] * z;
  }
  return curve;
}

// Sets half the extent, along the scene's axes, of a ball around a point of the piece.
void SetReach(const Geometry& g, std::size_t index, CurvePiece& piece) {
  const float radius = std::max(piece.radius[0], piece.radius[1]);
  for (int a = 0; a < 3; ++a) {
    piece.reach[a] = radius;
    if (g.curve_spaces.empty()) continue;
    const float* row = &g.curve_spaces[index].scene_from_object[3 * a];
    piece.reach[a] *= std::hypot(row[0], row[1], row[2]) * (1 + 1e-6f);
  }
}

// Returns the base-2 logarithm of the number of pieces.
int HalvingsOf(const CurveRecord& curve) {
  double length = 0, bend = 0;
  for (int k = 0; k < 3; ++k) length += Length(PointOf(curve, k + 1) - PointOf(curve, k));
  for (int k = 0; k < 2; ++k) {
    const Vec3d second =
        PointOf(curve, k) - 2.0 * PointOf(curve, k + 1) + PointOf(curve, k + 2);
    bend = std::max(bend, Length(second));
  }
  const double width = std::max({curve.width[0], curve.width[1], 1e-30f});
  const auto halvings = [](double pieces, int maximum) {
    return pieces > 1
               ? std::clamp(static_cast<int>(std::ceil(std::log2(pieces))), 0, maximum)
               : 0;
  };
  const double pieces = length / (kLong * width);
  return std::max(halvings(kStraight * bend / std::max(length, 1e-30), kMaxBendHalvings),
                  halvings(std::min(pieces, 0x1p10), kMaxLengthHalvings));
}

struct PointAndSlope {
  Vec3d p, slope;
};

PointAndSlope AtOf(const CurveRecord& curve, double u) {
  Vec3d p[4];
  for (int k = 0; k < 4; ++k) p[k] = PointOf(curve, k);
  for (int n = 3; n > 1; --n) {
    for (int k = 0; k < n; ++k) p[k] = (1 - u) * p[k] + u * p[k + 1];
  }
  return {(1 - u) * p[0] + u * p[1], 3.0 * (p[1] - p[0])};
}

void StorePoint(Vec3d p, float out[3]) {
  for (int a = 0; a < 3; ++a) out[a] = static_cast<float>(p[a]);
}

// Adjacent pieces share their common point bit for bit.
CurvePiece PieceOf(const CurveRecord& curve, std::uint32_t k, int halvings) {
  const double pieces = 1u << halvings, u[2] = {k / pieces, (k + 1) / pieces};
  CurvePiece piece;
  for (int end = 0; end < 2; ++end) {
    const PointAndSlope at = AtOf(curve, u[end]);
    const double step = (end == 0 ? 1 : -1) / (3 * pieces);
    StorePoint(at.p, piece.p[3 * end]);
    StorePoint(at.p + at.slope * step, piece.p[1 + end]);
    piece.radius[end] = static_cast<float>(
        0.5 * ((1 - u[end]) * curve.width[0] + u[end] * curve.width[1]));
  }
  piece.part = static_cast<std::uint32_t>(halvings) << 24 | k;
  return piece;
}

bool HasNumbers(const CurveRecord& curve) {
  const auto finite = [](float v) { return std::isfinite(v); };
  return std::all_of(&curve.p[0][0], &curve.p[0][0] + 12, finite) &&
         std::all_of(curve.width, curve.width + 2, finite);
}

}  // namespace

std::vector<CurvePiece> PiecesOf(const Geometry& geometry, std::uint32_t first_id) {
  const AlignedVector<CurveRecord>& curves = geometry.curves;
  std::vector<std::uint32_t> begin(curves.size() + 1, 0);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const bool there = HasNumbers(curves[i]);
    begin[i + 1] = begin[i] + (there ? 1u << HalvingsOf(InOwnSpace(geometry, i)) : 0);
  }
  std::vector<CurvePiece> pieces(begin.back());
  ParallelForRange(curves.size(), kCurveGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t count = begin[i + 1] - begin[i];
      const int halvings = count == 0 ? 0 : static_cast<int>(std::log2(count));
      for (std::uint32_t k = 0; k < count; ++k) {
        CurvePiece& piece = pieces[begin[i] + k];
        piece = PieceOf(curves[i], k, halvings);
        SetReach(geometry, i, piece);
        piece.prim = first_id + static_cast<std::uint32_t>(i);
      }
    }
  });
  return pieces;
}

AccelBox BoxOf(const CurvePiece& piece) {
  AccelBox box;
  for (const auto& p : piece.p) {
    for (int a = 0; a < 3; ++a) {
      box.lo[a] = std::min(box.lo[a], std::nextafter(p[a] - piece.reach[a], -INFINITY));
      box.hi[a] = std::max(box.hi[a], std::nextafter(p[a] + piece.reach[a], INFINITY));
    }
  }
  return box;
}

void SetLane(CurveBlock& block, std::uint32_t lane, const CurvePiece& piece) {
  for (int k = 0; k < 4; ++k) {
    for (int a = 0; a < 3; ++a) block.p[k][a][lane] = piece.p[k][a];
  }
  for (int end = 0; end < 2; ++end) block.radius[end][lane] = piece.radius[end];
  block.part[lane] = piece.part;
  block.prim[lane] = piece.prim;
}

void ClearLane(CurveBlock& block, std::uint32_t lane) {
  for (auto& point : block.p) {
    for (auto& axis : point) axis[lane] = std::numeric_limits<float>::quiet_NaN();
  }
  for (auto& end : block.radius) end[lane] = 0;
  block.part[lane] = 0;
}

}  // namespace lanelight

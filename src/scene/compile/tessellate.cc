#include "src/scene/compile/tessellate.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/pi.h"

namespace lanelight {
namespace {

// Largest aspect of a triangle on a cylinder; longer ones have loose boxes.
constexpr double kLongest = 64;
constexpr double kMaxRows = 256;
// Fewest columns around poles and centres, where u is off by half a triangle's width.
constexpr int kMinColumns = 64;
// Relative tolerance for hand-written matrices.
constexpr double kRoundTolerance = 1e-5;

bool IsCircle(const Transform& t) {
  const Vec3d x = t.Vector({1, 0, 0}), y = t.Vector({0, 1, 0});
  const double s = Length(x);
  return std::abs(Length(y) - s) <= kRoundTolerance * s &&
         std::abs(Dot(x, y)) <= kRoundTolerance * s * s;
}

// Steps along an arc of that angle whose chords leave a circle of radius 1 by at most
// `sag`.
int StepsOf(double angle, double sag) {
  return std::max(1, static_cast<int>(std::ceil(angle / (2 * std::acos(1 - sag)))));
}

// The grid of all round shapes: columns around z, rows across. A row whose ends coincide
// is a point; each triangle there has its own vertex, in the middle of its column's u.
class Grid {
 public:
  Grid(const Shape& shape, int columns, int rows)
      : columns_(columns), rows_(rows), phi_max_(shape.phi_max / 180 * kPi) {
    is_closed_ = shape.phi_max >= 360;
    side_ = shape.world_from_object.SwapsHandedness() ? -1 : 1;
  }

  struct Row {
    double radius, z;                // of the circle
    double normal_radius, normal_z;  // of the unit normal: along the radius, along z
  };

  /// `row_at(v)` describes the circle at v in [0, 1].
  template <typename RowAt>
  TriangleMesh Make(const RowAt& row_at) {
    std::vector<std::uint32_t> first(static_cast<std::size_t>(rows_) + 1);
    std::vector<bool> is_point(first.size());
    for (int j = 0; j <= rows_; ++j) {
      const double v = static_cast<double>(j) / rows_;
      const Row row = row_at(v);
      first[j] = static_cast<std::uint32_t>(mesh_.positions.size());
      is_point[j] = row.radius <= 0;
      const int n = is_point[j] ? columns_ : columns_ + 1;
      for (int i = 0; i < n; ++i) AddVertex(row, is_point[j] ? i + 0.5 : i, v);
    }
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        const std::uint32_t low = first[j] + i, high = first[j + 1] + i;
        if (!is_point[j]) Add(low, low + 1, is_point[j + 1] ? high : high + 1);
        if (!is_point[j + 1]) Add(low, high + 1, high);
      }
    }
    return std::move(mesh_);
  }

 private:
  void AddVertex(const Row& row, double column, double v) {
    const double u = column / columns_;
    const double phi = is_closed_ && column == columns_ ? 0 : u * phi_max_;
    const double x = std::cos(phi), y = std::sin(phi);
    mesh_.positions.push_back({row.radius * x, row.radius * y, row.z});
    mesh_.normals.push_back(
        side_ * Vec3d{row.normal_radius * x, row.normal_radius * y, row.normal_z});
    mesh_.uvs.push_back({u, v});
  }

  void Add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  int columns_, rows_;
  double phi_max_, side_;
  bool is_closed_;
  TriangleMesh mesh_;
};

TriangleMesh TessellateCylinder(const Shape& shape, double tolerance) {
  const double phi_max = shape.phi_max / 180 * kPi;
  const int columns = StepsOf(phi_max, tolerance);
  const double width = shape.radius * phi_max / columns;
  const double height = shape.z_max - shape.z_min;
  LL_CHECK(std::isfinite(height));
  const double wanted = width > 0 ? std::ceil(height / (kLongest * width)) : 1;
  const int rows = static_cast<int>(std::clamp(wanted, 1.0, kMaxRows));
  return Grid(shape, columns, rows).Make([&](double v) {
    const double z = v == 1 ? shape.z_max : shape.z_min + v * height;
    return Grid::Row{shape.radius, z, 1, 0};
  });
}

TriangleMesh TessellateSphere(const Shape& shape, double tolerance) {
  const double r = shape.radius;
  const double first = std::acos(std::clamp(shape.z_min / r, -1.0, 1.0));
  const double last = std::acos(std::clamp(shape.z_max / r, -1.0, 1.0));
  // A triangle's distance adds up from both directions.
  const int columns =
      std::max(kMinColumns, StepsOf(shape.phi_max / 180 * kPi, tolerance / 2));
  const int rows = StepsOf(first - last, tolerance / 2);
  return Grid(shape, columns, rows).Make([&](double v) {
    const double theta = v == 1 ? last : first + v * (last - first);
    const bool is_pole = theta == 0 || theta == kPi;
    const double across = is_pole ? 0 : std::sin(theta), along = std::cos(theta);
    return Grid::Row{r * across, r * along, across, along};
  });
}

TriangleMesh TessellateDisk(const Shape& shape, double tolerance) {
  const int columns =
      std::max(kMinColumns, StepsOf(shape.phi_max / 180 * kPi, tolerance));
  return Grid(shape, columns, 1).Make([&](double v) {
    return Grid::Row{v == 0 ? shape.radius : shape.inner_radius, shape.height, 0, 1};
  });
}

}  // namespace

bool IsTessellated(const Shape& shape, const Transform& transform) {
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return shape.z_min > -shape.radius || shape.z_max < shape.radius ||
             shape.phi_max < 360 || !(transform.UniformScale() > 0);
    case ShapeKind::kDisk:
      return shape.phi_max < 360 || !IsCircle(transform);
    case ShapeKind::kCylinder:
      return true;
    case ShapeKind::kMesh:
    case ShapeKind::kPlane:
    case ShapeKind::kCurves:
      break;
  }
  return false;
}

TriangleMesh Tessellate(const Shape& shape, double tolerance) {
  LL_CHECK_GT(shape.radius, 0);
  if (shape.kind == ShapeKind::kSphere) return TessellateSphere(shape, tolerance);
  if (shape.kind == ShapeKind::kDisk) return TessellateDisk(shape, tolerance);
  LL_CHECK(shape.kind == ShapeKind::kCylinder);
  return TessellateCylinder(shape, tolerance);
}

}  // namespace lanelight

#include "src/scene/accel/cut_plan.h"

#include <cmath>

#include "src/scene/accel/wide_box.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {
namespace {

// Triangles to sample, and the waste above which spatial splits are efficient everywhere.
// Scans and interiors have a waste of 0 to 5, a dining room with a blind 11, 400 k
// separate triangles 14, 200 k sticks 115.
constexpr std::size_t kSamples = 16384;
constexpr float kWaste = 30;

// Returns how much the half areas of boxes exceed those of the triangles in them, in
// units of the half area of the whole: the number of boxes that a ray enters in vain. It
// is measured on a sample of triangles.
float Waste(const std::vector<BuildItem>& items, const TriangleRecord* triangles) {
  WideBox all;
  for (const BuildItem& item : items) all.Extend(LowOf(item), HighOf(item));
  double waste = 0, count = 0;
  for (std::size_t i = 0; i < items.size(); i += items.size() / kSamples + 1) {
    const auto& p = triangles[items[i].id].p;
    const Vec3f a{p[0][0], p[0][1], p[0][2]};
    const Vec3f n =
        Cross(Vec3f{p[1][0], p[1][1], p[1][2]} - a, Vec3f{p[2][0], p[2][1], p[2][2]} - a);
    waste +=
        items[i].box.HalfArea() - 0.5f * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    ++count;
  }
  const float area = all.HalfArea();
  const double sum = waste / count * static_cast<double>(items.size());
  return area > 0 ? static_cast<float>(sum / area) : 0.0f;
}

}  // namespace

CutPlan PlanCuts(const std::vector<BuildItem>& items, const TriangleRecord* triangles) {
  const auto count = static_cast<std::uint32_t>(items.size());
  // Without overlap the levels below gain, too, so that a plane may cost more at first.
  if (Waste(items, triangles) > kWaste) {
    return {.room = count / 4 * 3, .least = CutPlan::kLargeRange, .gain = 1.1f};
  }
  // Elsewhere most such cuts lose: they come early, and halve what is better left whole.
  return {.room = count / 4, .least = 32, .gain = 0.9f, .small_gain = 0.8f};
}

}  // namespace lanelight

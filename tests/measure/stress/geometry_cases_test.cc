// The stress cases of geometry hold where they promise to, with quick effort.
#include <catch2/catch.hpp>

#include <cmath>
#include <set>

#include "src/base/core/error.h"
#include "src/measure/stress/cases/cases.h"

namespace lanelight::stress {
namespace {

// Five standard errors: with fewer than 1000 points measured in closed form, a false
// alarm in fewer than 1 of 1000 runs if errors are normal; the seed is fixed.
bool Holds(const Case& c, const Point& p) {
  if (p.invalid > 0) return false;
  if (c.truth == Truth::kRate) {
    const double allowed = p.expected * double(p.trials);
    return p.trials > 0 && double(p.failures) <= allowed + 4 * std::sqrt(allowed);
  }
  if (c.truth == Truth::kBound) return p.measured <= p.expected;
  return std::abs(p.measured - p.expected) <= p.tolerance + 5 * p.standard_error;
}

void CheckAll(void (*add)(std::vector<Case>&)) {
  std::vector<Case> cases;
  add(cases);
  for (const Case& c : cases) {
    std::vector<double> values = c.axis.quick;
    if (values.empty()) values = {std::nan("")};
    for (const double value : values) {
      if (!c.axis.name.empty() && !c.axis.Promised(value)) continue;
      for (const Point& p : c.measure(value, {})) {
        CAPTURE(c.name, value, p.series, p.expected, p.measured, p.standard_error,
                p.tolerance, p.failures, p.trials, p.invalid);
        CHECK(Holds(c, p));
      }
    }
  }
}

}  // namespace

TEST_CASE("stress: triangles", "[stress]") { CheckAll(AddTriangleCases); }
TEST_CASE("stress: surfaces that are left and met", "[stress]") {
  CheckAll(AddSurfaceCases);
}
TEST_CASE("stress: spheres", "[stress]") { CheckAll(AddSphereCases); }
TEST_CASE("stress: ground spheres", "[stress]") { CheckAll(AddGroundSphereCases); }
TEST_CASE("stress: planes and disks", "[stress]") { CheckAll(AddPlaneAndDiskCases); }
TEST_CASE("stress: meshes", "[stress]") { CheckAll(AddMeshCases); }
TEST_CASE("stress: scenes of one size and another", "[stress]") {
  CheckAll(AddSizeCases);
}
TEST_CASE("stress: instances", "[stress]") { CheckAll(AddInstanceCases); }
TEST_CASE("stress: cameras", "[stress]") { CheckAll(AddCameraCases); }

TEST_CASE("stress: cases of geometry are told apart", "[stress]") {
  std::set<std::string> names;
  for (const Case& c : AllCases()) {
    CAPTURE(c.name);
    CHECK(names.insert(c.name).second);
    CHECK_FALSE(c.extreme.empty());
    CHECK_FALSE(c.must.empty());
    CHECK(c.axis.name.empty() == c.axis.quick.empty());
  }
}

}  // namespace lanelight::stress

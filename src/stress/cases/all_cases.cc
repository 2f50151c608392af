#include "src/stress/cases/cases.h"

namespace lanelight::stress {

std::vector<Case> AllCases() {
  std::vector<Case> cases;
  AddUnitCases(cases);
  AddTriangleCases(cases);
  AddSurfaceCases(cases);
  AddSphereCases(cases);
  AddGroundSphereCases(cases);
  AddPlaneAndDiskCases(cases);
  AddMeshCases(cases);
  AddSizeCases(cases);
  AddInstanceCases(cases);
  AddCameraCases(cases);
  return cases;
}

}  // namespace lanelight::stress

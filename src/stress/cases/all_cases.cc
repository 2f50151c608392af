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
  AddRoughnessCases(cases);
  AddFresnelCases(cases);
  AddGlassCases(cases);
  AddCoatCases(cases);
  AddScatteringCases(cases);
  AddLightSizeCases(cases);
  AddManyLightCases(cases);
  AddRadianceCases(cases);
  AddTransportCases(cases);
  AddReuseCases(cases);
  AddMediaCases(cases);
  AddFilmCases(cases);
  AddSampleCases(cases);
  AddBsdfEndCases(cases);
  AddVarianceCases(cases);
  AddStrategyCases(cases);
  return cases;
}

}  // namespace lanelight::stress

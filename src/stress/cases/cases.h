// The cases of the stress suite, one function per file.
#pragma once

#include <vector>

#include "src/stress/stress_case.h"

namespace lanelight::stress {

/// All of them, in the order of the report.
std::vector<Case> AllCases();

void AddUnitCases(std::vector<Case>& cases);  // units.cc: length, radiance, distance
// Geometry.
void AddTriangleCases(std::vector<Case>& cases);
void AddSurfaceCases(std::vector<Case>& cases);
void AddSphereCases(std::vector<Case>& cases);
void AddGroundSphereCases(std::vector<Case>& cases);
void AddPlaneAndDiskCases(std::vector<Case>& cases);
void AddMeshCases(std::vector<Case>& cases);
void AddSizeCases(std::vector<Case>& cases);
void AddInstanceCases(std::vector<Case>& cases);
void AddCameraCases(std::vector<Case>& cases);

}  // namespace lanelight::stress

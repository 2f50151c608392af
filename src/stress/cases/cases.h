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
void AddRoughnessCases(
    std::vector<Case>& cases);  // roughness.cc: microfacets, grazing angles
void AddFresnelCases(std::vector<Case>& cases);  // fresnel.cc: Fresnel terms alone
void AddGlassCases(std::vector<Case>& cases);  // glass.cc: indices, layers, nested glass
void AddCoatCases(std::vector<Case>& cases);   // coats.cc: plastic and lacquer
void AddScatteringCases(
    std::vector<Case>& cases);  // scattering.cc: mixes, cut-outs, textures
void AddLightSizeCases(
    std::vector<Case>& cases);  // light_size.cc: sizes and places of lights
void AddManyLightCases(std::vector<Case>& cases);  // many_lights.cc: very many lights
void AddRadianceCases(std::vector<Case>& cases);   // radiance.cc: strength of light
void AddTransportCases(std::vector<Case>& cases);  // transport.cc: long paths
void AddReuseCases(std::vector<Case>& cases);      // reuse.cc: reuse=block
void AddMediaCases(std::vector<Case>& cases);      // media.cc: media
void AddFilmCases(std::vector<Case>& cases);       // film.cc: sums, filters, lenses
void AddSampleCases(std::vector<Case>& cases);     // samples.cc: sample points, warps
void AddBsdfEndCases(std::vector<Case>& cases);    // bsdf_ends.cc: materials at the ends
void AddVarianceCases(std::vector<Case>& cases);   // variance.cc: exact strategies
void AddStrategyCases(
    std::vector<Case>& cases);  // strategies.cc: every choice of a strategy

}  // namespace lanelight::stress

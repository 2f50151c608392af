#include "src/scene/compile/features.h"

#include <algorithm>

#include "src/scene/compile/shape_records.h"

namespace lanelight {
namespace {

void AddRoughness(const MaterialTable& m, std::size_t i, FeatureSet& features) {
  const bool textured = m.alpha_x_texture[i] >= 0 || m.alpha_y_texture[i] >= 0;
  if (textured) {
    features.Add({Feature::kTextures, Feature::kTexturedRoughness, Feature::kUv});
  }
  const bool anisotropic = m.alpha_x_texture[i] != m.alpha_y_texture[i] ||
                           (m.alpha_x_texture[i] < 0 && m.alpha_x[i] != m.alpha_y[i]) ||
                           m.alpha2_x_texture[i] != m.alpha2_y_texture[i] ||
                           (m.alpha2_x_texture[i] < 0 && m.alpha2_x[i] != m.alpha2_y[i]);
  if (anisotropic) features.Add(Feature::kTangents);
}

void AddCoat(const MaterialTable& m, std::size_t i, FeatureSet& features) {
  const bool varies = m.coat_alphas[i] > 1 || m.thickness_texture[i] >= 0 ||
                      m.alpha2_x_texture[i] >= 0 || m.alpha2_y_texture[i] >= 0;
  if (varies) {
    features.Add({Feature::kTextures, Feature::kTexturedCoat, Feature::kUv});
  }
  if (m.coat_albedo_texture[i] >= 0 || m.coat_g_texture[i] >= 0) {
    features.Add({Feature::kTextures, Feature::kTexturedCoatMedium, Feature::kUv});
  }
}

void AddMaterial(const MaterialTable& m, std::size_t i, FeatureSet& features) {
  const auto kind = static_cast<ShadeKind>(m.kind[i]);
  features.Add(ShadeFeature(kind));
  if (HasTrait(kind, kRefracting)) features.Add(Feature::kRefraction);
  if (HasTrait(kind, kFibre)) features.Add({Feature::kTangents, Feature::kUv});
  if (HasTrait(kind, kMicrofacets)) AddRoughness(m, i, features);
  if (m.coat[i] >= 0) AddCoat(m, i, features);
  if (kind == ShadeKind::kMeasured) {
    const auto record = static_cast<std::size_t>(m.measured.of_material[i]);
    if (m.measured.records[record].is_anisotropic != 0) features.Add(Feature::kTangents);
  }
  if (m.color0_texture[i] >= 0 || m.color1_texture[i] >= 0) {
    features.Add({Feature::kTextures, Feature::kUv});
  }
  if (m.color1_texture[i] >= 0) features.Add(Feature::kTexturedColor1);
  if (!m.displacement_texture.empty()) {
    features.Add({Feature::kBumps, Feature::kTextureFootprints, Feature::kUv});
  }
  if (!m.normal_map_texture.empty()) {
    features.Add({Feature::kNormalMaps, Feature::kUv});
  }
  // A mix weight is looked up by the mix stage itself.
  if (kind == ShadeKind::kMix && m.alpha_x_texture[i] >= 0) features.Add(Feature::kUv);
}

void AddLights(const CompiledScene& scene, FeatureSet& features) {
  const LightTable& lights = scene.lights;
  for (const LightRecord& light : lights.lights) {
    features.Add(LightFeature(static_cast<LightShape>(light.shape)));
    // Point lights with an image have no area.
    if (light.image != 0 && light.area > 0) features.Add(Feature::kEmissionImages);
    if (IsCut(scene, light)) features.Add(Feature::kEmissionCuts);
    if (IsUnseen(scene, light)) features.Add(Feature::kUnseenLights);
  }
  if (!lights.lights.empty()) features.Add(Feature::kLights);
  if (lights.lights.size() > 1) features.Add(Feature::kManyLights);
  if (!lights.infinite.empty()) features.Add(Feature::kInfiniteLights);
  if (features.HasAny(LightsWith(kEmittingShape))) features.Add(Feature::kAreaLights);
}

bool FiltersTextures(const TextureTable& textures) {
  return std::ranges::any_of(textures.nodes, [](const TextureNode& node) {
    return node.filter >= ImageFilter::kTrilinear;
  });
}

// Features by CameraKind.
constexpr Feature kCameraFeature[] = {Feature::kPerspective, Feature::kOrthographic,
                                      Feature::kSphericalCamera,
                                      Feature::kRealisticCamera};

void AddSpectra(const CompiledScene& scene, FeatureSet& features) {
  const MaterialTable& m = scene.materials;
  features.Add(Feature::kSpectral);
  for (std::size_t i = 0; i < m.size(); ++i) {
    const auto kind = static_cast<ShadeKind>(m.kind[i]);
    if (HasTrait(kind, kMetallic) || kind == ShadeKind::kDiffuseTransmission) {
      features.Add(Feature::kSpectralColor1);
    }
    if (m.eta_spectrum[i] >= 0) features.Add(Feature::kDispersion);
    const bool grey = m.coat_albedo_r[i] == m.coat_albedo_g[i] &&
                      m.coat_albedo_g[i] == m.coat_albedo_b[i];
    // The texture stage hands on what else there is of the medium in a coat.
    if (m.coat[i] >= 0 && !grey) {
      features.Add({Feature::kTextures, Feature::kTexturedCoatMedium, Feature::kUv});
    }
  }
  if (!features.Has(Feature::kTextures)) features.Add(Feature::kPlainSpectra);
}

void AddMedia(const MediumTable& table, FeatureSet& features) {
  if (!table.media.empty()) features.Add(Feature::kMedia);
  if (!table.primitives.empty()) features.Add(Feature::kMediumChanges);
  if (!table.grids.empty()) features.Add(Feature::kMediumGrids);
  if (!table.albedos.empty()) features.Add(Feature::kSubsurfaceTextures);
  for (const MediumRecord& medium : table.media) {
    if (medium.inside != 0) features.Add(Feature::kSubsurface);
    const float* e = medium.emission;
    if (e[0] > 0 || e[1] > 0 || e[2] > 0) features.Add(Feature::kMediumEmission);
  }
}

bool HasNonSpecular(const MaterialTable& materials) {
  return std::ranges::any_of(materials.kind, [](std::uint32_t k) {
    const auto kind = static_cast<ShadeKind>(k);
    return IsShaded(kind) && !HasTrait(kind, kSpecularOnly);
  });
}

// Replaces the kinds of all surfaces by one, whose colour varies by path.
void ForceDiffuse(const MaterialTable& materials, FeatureSet& features) {
  for (int k = 0; k < kNumShadeKinds; ++k) {
    const auto kind = static_cast<ShadeKind>(k);
    if (!HasTrait(kind, kInMedium)) features.Remove(ShadeFeature(kind));
  }
  features.Remove(Feature::kRefraction);
  const auto kind = static_cast<ShadeKind>(materials.kind[materials.forced]);
  features.Add(
      {Feature::kForcedDiffuse, Feature::kTextures, Feature::kUv, ShadeFeature(kind)});
}

bool HasNegative(const AlignedVector<float>& signs) {
  return std::ranges::any_of(signs, [](float s) { return s < 0; });
}

}  // namespace

FeatureSet MaterialFeatures(const MaterialTable& materials, const Placement& placement) {
  FeatureSet features;
  for (std::size_t i = 0; i < materials.size(); ++i) AddMaterial(materials, i, features);
  ForEachPlaced(placement, [&](const PlacedShape& shape) {
    if (!IsAlphaTested(shape)) return;
    features.Add(Feature::kAlpha);
    if (shape.alpha.texture != kNone) features.Add(Feature::kUv);
  });
  return features;
}

FeatureSet SceneFeatures(const CompiledScene& scene) {
  FeatureSet features = scene.features;
  const Geometry& g = scene.geometry;
  if (!g.triangles.empty()) features.Add(Feature::kTriangles);
  if (!g.spheres.empty()) features.Add(Feature::kSpheres);
  if (!g.disks.empty()) features.Add(Feature::kDisks);
  if (!g.planes.empty()) features.Add(Feature::kPlanes);
  if (!g.large_spheres.empty()) features.Add(Feature::kLargeSpheres);
  if (!g.curves.empty()) features.Add(Feature::kCurves);
  if (!g.instances.empty()) features.Add(Feature::kInstances);
  if (!g.motions.empty()) features.Add(Feature::kMovingInstances);
  if (scene.view.camera.moves) features.Add(Feature::kMovingCamera);
  if (features.HasAny({Feature::kMovingInstances, Feature::kMovingCamera})) {
    features.Add(Feature::kMotion);
  }
  if (!g.normals.empty()) features.Add(Feature::kVertexNormals);
  if (scene.integrator.force_diffuse) ForceDiffuse(scene.materials, features);
  if (!scene.materials.regular.empty()) features.Add(Feature::kRegularizes);
  AddMedia(scene.media, features);
  if (scene.integrator.transport == Transport::kSpectral) AddSpectra(scene, features);
  // Cut-outs and weights of mixes are looked up unfiltered.
  if (features.Has(Feature::kTextures) && FiltersTextures(scene.textures)) {
    features.Add(Feature::kTextureFootprints);
  }
  AddLights(scene, features);
  if (features.HasAny({Feature::kAreaLights, Feature::kInfiniteLights}) &&
      HasNonSpecular(scene.materials)) {
    features.Add(Feature::kMis);
  }
  if (scene.view.camera.lens_radius > 0 ||
      scene.view.camera.kind == CameraKind::kRealistic) {
    features.Add(Feature::kLens);
  }
  features.Add(kCameraFeature[static_cast<int>(scene.view.camera.kind)]);
  if (!scene.filter.is_box) features.Add(Feature::kFiltered);
  if (HasNegative(scene.filter.x_sign) || HasNegative(scene.filter.y_sign)) {
    features.Add(Feature::kSignedFilter);
  }
  return features;
}

}  // namespace lanelight

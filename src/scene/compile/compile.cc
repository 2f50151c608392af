#include "src/scene/compile/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/scene/accel/build.h"
#include "src/scene/compile/camera.h"
#include "src/scene/compile/features.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compile/geometry.h"
#include "src/scene/compile/lights.h"
#include "src/scene/compile/materials.h"
#include "src/scene/compile/media.h"
#include "src/scene/compile/placement.h"
#include "src/scene/compile/shape_records.h"
#include "src/scene/compile/spectrum_rows.h"
#include "src/scene/compile/texture_programs.h"
#include "src/scene/compile/textures.h"
#include "src/scene/geometry/accel.h"

namespace lanelight {
namespace {

std::vector<Index> UsedMaterials(const Placement& placement) {
  std::vector<Index> used;
  ForEachPlaced(placement, [&](const PlacedShape& placed) {
    used.push_back(placed.shape->material);
  });
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

std::vector<Index> UsedTextures(const CompiledMaterials& materials,
                                const Placement& placement) {
  std::vector<Index> used = materials.textures;
  ForEachPlaced(placement, [&](const PlacedShape& placed) {
    if (placed.alpha.texture != kNone) used.push_back(placed.alpha.texture);
  });
  return used;
}

void MakeAlpha(const Placement& placement, const CompiledGeometry& compiled,
               CompiledScene& scene) {
  if (!scene.features.Has(Feature::kAlpha)) return;
  scene.alpha.texture.assign(compiled.geometry.ranges.end, -1);
  scene.alpha.constant.assign(compiled.geometry.ranges.end, 1.0f);
  ForEachCompiled(placement, compiled,
                  [&](const PlacedShape& placed, std::uint32_t begin, std::uint32_t end) {
                    const FloatValue& alpha = placed.alpha;
                    for (std::uint32_t i = begin; i < end; ++i) {
                      scene.alpha.texture[i] = alpha.texture;
                      if (alpha.texture != kNone) continue;
                      scene.alpha.constant[i] = static_cast<float>(alpha.constant);
                    }
                  });
}

// Cut-outs are looked up during intersection, which knows a point of an instance in the
// space of its object alone.
void RequireUvAlpha(const SceneDescription& description, const Placement& placement,
                    const TextureTable& textures) {
  for (const PlacedObject& object : placement.objects) {
    for (const PlacedShape& placed : object.meshes) {
      const Index alpha = placed.alpha.texture;
      if (alpha == kNone || !textures.programs[alpha].uses_place) continue;
      throw InputError(
          placed.shape->where,
          fmt::format("the \"alpha\" of a shape of an instance uses texture \"{}\", "
                      "which depends on the position in space; use a texture of surface "
                      "coordinates (\"mapping\" \"uv\")",
                      description.textures[alpha].name));
    }
  }
}

void NoteDropped(const std::vector<PlacedShape>& shapes,
                 const std::vector<MeshRange>& ranges, std::vector<Note>& notes) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const MeshRange& range = ranges[i];
    if (range.dropped == 0) continue;
    std::string message =
        fmt::format("left out {} degenerate triangles of {}", range.dropped,
                    range.dropped + range.end - range.begin);
    if (shapes[i].area_light != kNone && range.begin == range.end) {
      message += "; this area light has no area left and emits nothing";
    }
    notes.push_back({shapes[i].shape->where, message});
  }
}

bool HasEmissionImages(const SceneDescription& description) {
  return std::ranges::any_of(description.area_lights, [](const AreaLight& light) {
    return !light.image_path.empty();
  });
}

// A render of nothing is a black image, or one of the environment, but seldom what was
// meant.
void NoteNothingToHit(const SceneDescription& description, CompiledScene& scene) {
  if (scene.geometry.ranges.end > 0) return;
  const bool lit = scene.features.Has(Feature::kInfiniteLights);
  scene.notes.push_back(
      {{std::make_shared<const std::string>(description.path), 0, 0},
       std::string("the scene has no shape that rays can hit: ") +
           (lit ? "the image shows the environment alone" : "the image is black")});
}

// Light samples do not go through smooth glass, and no ray finds lights without a size.
void NoteUnlitInsides(const SceneDescription& description,
                      const std::vector<std::int32_t>& rows, CompiledScene& scene) {
  if (!scene.features.HasAny(LightsWith(kDeltaLight))) return;
  const auto smooth = static_cast<std::uint32_t>(ShadeKind::kDielectricSmooth);
  for (std::size_t i = 0; i < description.materials.size(); ++i) {
    const Material& m = description.materials[i];
    if (m.inside == kNone || rows[i] < 0) continue;
    if (scene.materials.kind[static_cast<std::size_t>(rows[i])] != smooth) continue;
    scene.notes.push_back({m.where,
                           "point, spot and distant lights do not light a smooth "
                           "\"subsurface\" material; set its \"roughness\" to 0.1",
                           true});
  }
}

void FindBvhs(const CompileOptions& options, CompiledScene& scene) {
  const AccelOptions accel = {.quality = options.build,
                              .leaf_triangles = options.leaf_triangles};
  ReusedBvh tree = FindBvh(scene.geometry, accel, options.cached_bvh);
  scene.accel = std::move(tree.accel);
  if (options.bvh_report != nullptr) *options.bvh_report = tree.report;
}

}  // namespace

std::shared_ptr<const CachedBvh> CachedBvhOf(const CompiledScene& scene) {
  const AccelOptions options = {.quality = scene.accel.quality,
                                .leaf_triangles = scene.accel.leaf_triangles};
  return std::make_shared<const CachedBvh>(
      CachedBvh{KeyOf(scene.geometry, options), scene.accel});
}

CompiledScene CompileScene(const SceneDescription& description,
                           const CompileOptions& options) {
  CompiledScene scene;
  CompiledView& view = scene.view;
  view.film = description.film;
  scene.integrator = description.integrator;
  scene.filter = CompileFilter(description.filter);

  Placement placement = PlaceShapes(description, options.copied_triangles);
  DropTooSmallShapes(placement, scene.notes);
  scene.center = placement.frame.center;
  scene.scale = placement.frame.scale;
  view.camera = CompileCamera(description.camera, description.film, placement.frame);
  view.footprint = CompileFootprint(view.camera, description.camera, description.film,
                                    description.sampler.spp);
  view.gbuffer =
      CompileGbufferSpace(description.film, description.camera, placement.frame);

  std::optional<SpectrumRows> rows;
  if (description.integrator.transport == Transport::kSpectral) {
    rows.emplace();
  } else {
    NoteDispersion(description, UsedMaterials(placement), scene.notes);
  }
  SpectrumRows* const spectra = rows ? &*rows : nullptr;
  CompiledMaterials materials =
      CompileMaterials(description, UsedMaterials(placement), options, spectra);
  scene.media = CompileMedia(description, placement, materials, scene.notes);
  scene.features = MaterialFeatures(materials.table, placement);
  const bool keep_uvs =
      (scene.features.HasAny({Feature::kUv, Feature::kTangents}) ||
       HasEmissionImages(description) || description.film.gbuffer != Gbuffer::kNone ||
       description.integrator.force_diffuse);

  CompiledGeometry compiled;
  ParallelInvoke(
      [&] {
        std::vector<Texture> textures = description.textures;
        textures.insert(textures.end(), materials.derived.begin(),
                        materials.derived.end());
        scene.textures = CompileTextures(
            KeepUsedTextures(textures, UsedTextures(materials, placement)),
            Transform::Translate(scene.center) *
                Transform::Scale(Vec3d{1, 1, 1} / scene.scale),
            &scene.notes);
      },
      [&] { compiled = CompileGeometry(placement, materials.index, keep_uvs); });

  const auto& programs = scene.textures.programs;
  if (std::ranges::any_of(programs,
                          [](const TextureProgram& p) { return p.uses_place; })) {
    scene.features.Add(Feature::kTexturePlaces);
    RequireUvAlpha(description, placement, scene.textures);
  }
  scene.lights = CompileLights(description, placement, compiled, scene.notes, spectra);
  if (spectra != nullptr) scene.spectra = spectra->Finish();
  MakeAlpha(placement, compiled, scene);
  PlaceMedia(placement, compiled, scene.media);
  NoteLargeEmitters(placement, scene.notes);
  NoteDropped(placement.meshes, compiled.meshes, scene.notes);
  for (std::size_t o = 0; o < placement.objects.size(); ++o) {
    NoteDropped(placement.objects[o].meshes, compiled.object_meshes[o], scene.notes);
  }
  scene.materials = std::move(materials.table);
  scene.geometry = std::move(compiled.geometry);
  scene.features = SceneFeatures(scene);
  NoteNothingToHit(description, scene);
  NoteUnlitInsides(description, materials.index, scene);
  FindBvhs(options, scene);
  return scene;
}

}  // namespace lanelight

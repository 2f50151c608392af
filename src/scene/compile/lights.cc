#include "src/scene/compile/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/pi.h"
#include "src/scene/compile/environment.h"
#include "src/scene/compile/light_texels.h"

namespace lanelight {
namespace {

// No light is picked more rarely than this (or a hundredth of the uniform probability, if
// there are very many): a light of little power may still be all that a corner sees.
constexpr double kMinPmf = 1e-6;

// Returns zero for zero. Scales first, since squares of a very long vector could
// overflow.
Vec3d UnitOf(Vec3d v) {
  const Vec3d a = Max(v, -v);
  const double largest = std::max({a.x, a.y, a.z});
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  return Normalize(v * std::ldexp(1.0, -std::ilogb(largest)));
}

bool IsBlack(Rgb c) { return !(c.x > 0 || c.y > 0 || c.z > 0); }

bool IsStretched(const Light& light) {
  return !(light.world_from_light.UniformScale() > 0);
}

// Intensity is power per solid angle; irradiance falls with the square of the distance,
// and distances are scaled.
Rgb SceneIntensity(const Light& light, const WorldFrame& frame) {
  return light.emission * frame.scale * frame.scale;
}

// Compiles the lights that are not shapes.
class LightCompiler {
 public:
  LightCompiler(const Placement& placement, LightList& lights, LightImageTable& images,
                std::vector<Note>& notes)
      : frame_(placement.frame),
        radius_(placement.bounds.HalfDiagonal() * placement.frame.scale),
        lights_(lights),
        images_(images),
        notes_(notes) {}

  /// All spots, if one of them is stretched: a kernel takes all or none.
  void UseStretchedSpots() { stretched_spots_ = lights_.table.stretched_spots = true; }

  void Add(const Light& light) {
    const bool image = light.kind == LightKind::kInfinite && !light.image_path.empty();
    if (!image && IsBlack(light.emission)) return;
    const Rgb l = light.emission;
    if (std::max({l.x, l.y, l.z}) > std::numeric_limits<float>::max()) {
      ThrowTooBright(light.where);
    }
    switch (light.kind) {
      case LightKind::kPoint:
        return Point(light);
      case LightKind::kSpot:
        return Spot(light);
      case LightKind::kDistant:
        return Distant(light);
      case LightKind::kInfinite:
        return Infinite(light);
      case LightKind::kGoniometric:
        return AddGoniometric(light, frame_, images_, lights_);
      case LightKind::kProjection:
        return AddProjection(light, frame_, images_, lights_);
    }
  }

 private:
  void Point(const Light& light) {
    LightRecord record = EmptyRecord(LightShape::kPoint);
    const Rgb intensity = SceneIntensity(light, frame_);
    Store(intensity, record.radiance);
    Store(PositionOf(light, frame_), record.position);
    lights_.Push(record, 4 * kPi * Luminance(intensity), light);
  }

  void Spot(const Light& light) {
    const Vec3d own_axis = UnitOf(light.to - light.from);
    const Vec3d axis = UnitOf(light.world_from_light.Vector(own_axis));
    if (axis == Vec3d{}) {
      throw InputError(light.where,
                       "a spot light whose \"from\" and \"to\" are the same");
    }
    // 1 - cos, which for a narrow cone is nothing beside 1.
    const auto versine = [](double degrees) {
      const double sine = std::sin(degrees * (kPi / 360));
      return 2 * sine * sine;
    };
    const double total = versine(light.cone_angle);
    const double falloff = versine(light.cone_angle - light.cone_delta);
    LightRecord record = EmptyRecord(LightShape::kSpot);
    const Rgb intensity = SceneIntensity(light, frame_);
    Store(intensity, record.radiance);
    Store(PositionOf(light, frame_), record.position);
    Store(axis, record.direction);
    record.versine_total = static_cast<float>(total);
    record.versine_falloff = static_cast<float>(falloff);
    record.size[0] = record.versine_total;
    if (stretched_spots_) {
      const Vec3d x = Normalize(
          Cross(own_axis, std::abs(own_axis.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
      LightImage axes{};
      StoreAxes(light, {x, Cross(own_axis, x), own_axis}, axes);
      record.image = images_.Add(axes);
      if (IsStretched(light)) {
        record.size[0] =
            static_cast<float>(StretchedCone(light, own_axis, light.cone_angle).versine);
      }
    }
    // The smooth step between the two angles has a mean of 1/2.
    lights_.Push(record, 2 * kPi * Luminance(intensity) * ((falloff + total) / 2), light);
  }

  void Distant(const Light& light) {
    const Vec3d toward = UnitOf(light.world_from_light.Vector(light.from - light.to));
    if (toward == Vec3d{}) {
      throw InputError(light.where,
                       "a distant light whose \"from\" and \"to\" are the same");
    }
    LightRecord record = EmptyRecord(LightShape::kDistant);
    Store(light.emission, record.radiance);
    Store(toward, record.direction);
    lights_.Push(record, SceneDisk() * Luminance(light.emission), light);
  }

  void Infinite(const Light& light) {
    if (!light.portal.empty()) return AddPortalLight(light, frame_, notes_, lights_);
    const bool image = !light.image_path.empty();
    LightRecord record =
        EmptyRecord(image ? LightShape::kInfiniteImage : LightShape::kInfiniteConstant);
    Rgb mean = light.emission;
    if (image) {
      Environment environment = CompileEnvironment(light, &notes_);
      mean = MeanRadiance(environment);
      if (environment.table->probability.empty()) return;  // black
      record.environment = static_cast<std::int32_t>(lights_.table.environments.size());
      lights_.table.environments.push_back(std::move(environment));
    } else if (light.illuminance > 0) {
      // pi times the radiance reaches a plane under a constant sky.
      mean *= light.illuminance / (kPi * Luminance(mean));
    }
    Store(image ? Rgb{1, 1, 1} : mean, record.radiance);
    const std::int32_t index =
        lights_.Push(record, SceneDisk() * kPi * Luminance(mean), light);
    lights_.table.infinite.push_back(static_cast<std::uint32_t>(index));
  }

  // The power of a distant light and of an environment is what falls on the scene.
  double SceneDisk() const { return radius_ > 0 ? kPi * radius_ * radius_ : kPi; }

  const WorldFrame& frame_;
  const double radius_;
  LightList& lights_;
  LightImageTable& images_;
  std::vector<Note>& notes_;
  bool stretched_spots_ = false;
};

// Weights are raised to the smallest probability; that changes their sum by so little
// that no second pass is needed.
void ApplyFloor(std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double minimum = std::min(kMinPmf, 0.01 / static_cast<double>(weights.size()));
  // If the sum underflows, all lights get the same weight.
  for (double& w : weights) w = sum > 0 ? std::max(w, 1.02 * minimum * sum) : 1;
}

// Stores the sphere around all finite shapes, with room for rounded coordinates.
void StoreSphere(const Placement& placement, LightTable& table) {
  const WorldFrame& frame = placement.frame;
  Store(frame.Point(placement.bounds.Center()), table.center);
  const double radius = placement.bounds.HalfDiagonal() * frame.scale;
  table.radius = static_cast<float>(radius * 1.0001);
}

// Returns whether each direction or point has a colour of its own. Goniometric images are
// grey.
bool HasColors(const LightRecord& light) {
  const auto shape = static_cast<LightShape>(light.shape);
  return light.environment >= 0 || shape == LightShape::kPortal ||
         (light.image != 0 && shape != LightShape::kGoniometric &&
          shape != LightShape::kSpot);
}

void AddSpectra(LightList& lights, SpectrumRows& spectra) {
  for (std::size_t i = 0; i < lights.table.lights.size(); ++i) {
    const LightRecord& light = lights.table.lights[i];
    if (HasColors(light)) {
      spectra.AddSigmoidTables();
      lights.table.spectrum.push_back(-1);
      continue;
    }
    const Rgb color = {light.radiance[0], light.radiance[1], light.radiance[2]};
    lights.table.spectrum.push_back(IsBlack(color)
                                        ? spectra.Of({color}, ColorBound::kUnbounded)
                                        : spectra.OfLight(color, lights.spectra[i]));
  }
}

}  // namespace

LightTable CompileLights(const SceneDescription& description, const Placement& placement,
                         CompiledGeometry& geometry, std::vector<Note>& notes,
                         SpectrumRows* spectra) {
  LightList lights;
  LightImageTable images(lights.table, notes);
  CompileAreaLights(description, placement, geometry, images, lights);
  LightCompiler compiler(placement, lights, images, notes);
  if (std::ranges::any_of(description.lights, [](const Light& light) {
        return light.kind == LightKind::kSpot && IsStretched(light);
      })) {
    compiler.UseStretchedSpots();
  }
  for (const Light& light : description.lights) compiler.Add(light);
  if (!lights.table.lights.empty()) ApplyFloor(lights.power);
  lights.table.power = std::move(lights.power);
  StoreSphere(placement, lights.table);
  if (spectra != nullptr) AddSpectra(lights, *spectra);
  return std::move(lights.table);
}

}  // namespace lanelight

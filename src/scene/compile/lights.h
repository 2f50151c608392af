// Lights: one record per emitting primitive and per light of the file.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/vec.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compile/geometry.h"
#include "src/scene/compile/light_texels.h"
#include "src/scene/compile/placement.h"
#include "src/scene/compile/spectrum_rows.h"
#include "src/scene/compile/world_frame.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

[[noreturn]] inline void ThrowTooBright(const SourceLocation& where) {
  throw InputError(where, "this light emits more than float32 holds (3.4e38)");
}

struct LightList {
  LightTable table;
  std::vector<double> power;         // of each light
  std::vector<OwnSpectrum> spectra;  // of each, where it is not by an image

  /// Returns the index of the light. Throws InputError if its power is no number. `of`:
  /// the Light or AreaLight that it is.
  template <class Described>
  std::int32_t Push(const LightRecord& record, double its_power, const Described& of) {
    if (!std::isfinite(its_power)) ThrowTooBright(of.where);
    table.lights.push_back(record);
    power.push_back(its_power);
    spectra.push_back(of.spectrum);
    return static_cast<std::int32_t>(table.lights.size()) - 1;
  }
};

/// Returns a light's position in scene coordinates. Throws InputError if it is out of
/// their range.
inline Vec3d PositionOf(const Light& light, const WorldFrame& frame) {
  const Vec3d position = frame.Point(light.world_from_light.Point(light.from));
  RequireInScene(position, light.where, "light");
  return position;
}

/// Returns a record without primitive or environment, otherwise 0.
inline LightRecord EmptyRecord(LightShape shape) {
  LightRecord record{};
  record.shape = static_cast<std::uint32_t>(shape);
  record.primitive = 0xffffffffu;
  record.environment = -1;
  return record;
}

/// Returns the linear map from the scene to the light. Throws InputError at the light if
/// float32 cannot represent it.
Transform LightFromScene(const Light& light);

/// Sets axes of `image` so that dot(x_axis, w) is dot(x, LightFromScene(w)), and so on.
struct LightAxes {
  Vec3d x, y, z;
};
void StoreAxes(const Light& light, const LightAxes& axes, LightImage& image);

/// A cone in the scene that holds directions of the light.
struct LightCone {
  Vec3d axis;          // unit
  double versine = 0;  // 1 - cos of its angle
};

/// Returns the cone about the image of `axis` that contains the images of `edge`, rays
/// along the edge of a convex cone.
LightCone ConeAround(const Light& light, Vec3d axis, const std::vector<Vec3d>& edge);

/// Returns the cone about the image of the unit vector `axis` that contains the images of
/// all directions within `degrees` of it.
LightCone StretchedCone(const Light& light, Vec3d axis, double degrees);

/// Adds a light for each emitting triangle, rectangle of two triangles, sphere and disk,
/// and sets the `light` of its records in `geometry`. Throws InputError at the light for
/// images that cannot be used.
void CompileAreaLights(const SceneDescription& description, const Placement& placement,
                       CompiledGeometry& geometry, LightImageTable& images,
                       LightList& lights);

/// Adds a goniometric light, unless its image is black. Throws InputError at the light:
/// an image that cannot be used or is not square, a transform that is not rotation,
/// translation, mirroring and uniform scale.
void AddGoniometric(const Light& light, const WorldFrame& frame, LightImageTable& images,
                    LightList& lights);

/// The same for a projection light, whose image may have any aspect.
void AddProjection(const Light& light, const WorldFrame& frame, LightImageTable& images,
                   LightList& lights);

/// Adds an infinite light, of an image or constant, that enters through its portal,
/// unless what it shows there is black. Throws InputError at the light: a portal that is
/// no rectangle, an image that CompileEnvironment cannot use.
void AddPortalLight(const Light& light, const WorldFrame& frame, std::vector<Note>& notes,
                    LightList& lights);

/// Returns the portal of a light with four corners, with as many texels as the map: each
/// is the map of `environment`, interpolated bilinearly at the texel's centre.
Portal CompilePortal(const Light& light, const WorldFrame& frame,
                     const Environment& environment);

/// Sets the `light` of emitting records in `geometry` too. Lights without power get no
/// record. Probabilities are left to MakeLightChances. Throws
/// InputError at the directive for images and transforms that cannot be used; what is not
/// used of an image goes to `notes`. `spectra`: of paths that carry wavelengths; else
/// null.
LightTable CompileLights(const SceneDescription& description, const Placement& placement,
                         CompiledGeometry& geometry, std::vector<Note>& notes,
                         SpectrumRows* spectra = nullptr);

struct Rectangle {
  std::uint32_t first = 0, second = 0;  // indices into the mesh; first < second
  Vec3d corner;
  Vec3d x_side, y_side;  // from the corner; cross(x, y) is the triangles' normal
};

/// Finds the rectangles of one mesh, by `first`. Two right-angled triangles make one if
/// they share their longest side, lie in one plane, face the same way, and their corners
/// are those of an exact rectangle. The tolerance is float rounding of the coordinates (a
/// few ulp, at most 1e-4 of the shorter side) or 2e-5 of the shorter side. A triangle
/// belongs to at most one rectangle.
std::vector<Rectangle> FindRectangles(std::span<const TriangleRecord> mesh);

}  // namespace lanelight

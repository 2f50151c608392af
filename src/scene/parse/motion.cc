#include "src/scene/parse/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/motion.h"

namespace lanelight {
namespace {

// Largest relative difference of transforms that count as equal.
constexpr double kSame = 1e-6;

bool AreSame(const Transform& a, const Transform& b) {
  double linear = 0, move = 0, linear_off = 0, move_off = 0;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      linear = std::max(linear, std::abs(a(r, c)));
      linear_off = std::max(linear_off, std::abs(a(r, c) - b(r, c)));
    }
    move = std::max(move, std::abs(a(r, 3)));
    move_off = std::max(move_off, std::abs(a(r, 3) - b(r, 3)));
  }
  return linear_off <= kSame * linear && move_off <= kSame * std::max(linear, move);
}

const Transform& EndTransformOf(const Instance& instance) {
  return instance.end ? *instance.end : instance.world_from_object;
}

// Places a shape that moves in an object. Two successive motions are seldom a motion of
// translation, rotation and stretching again.
Instance Together(const Instance& outer, const Instance& inner) {
  const Transform start = outer.world_from_object * inner.world_from_object;
  const Transform end = EndTransformOf(outer) * EndTransformOf(inner);
  const Motion both(start, end), first(inner.world_from_object, EndTransformOf(inner)),
      then(outer.world_from_object, EndTransformOf(outer));
  for (const double s : {0.25, 0.5, 0.75}) {
    if (AreSame(then.At(s) * first.At(s), both.At(s))) continue;
    throw InputError(outer.where,
                     "a shape moves in this object ({}), and as it is placed here the "
                     "two transforms together are no motion of translation, rotation and "
                     "scale; take the shape out of the object",
                     inner.where.ToString());
  }
  return {inner.object, start, outer.where, EndOf(start, end, outer.where)};
}

// Replaces both ends of a motion by places on the way between them.
void Fit(double from, double to, Transform* start, EndTransform* end) {
  if (*end == nullptr) return;
  const Motion motion(*start, **end);
  *start = motion.At(from);
  *end = from < to ? std::make_shared<const Transform>(motion.At(to)) : nullptr;
}

}  // namespace

const char* MotionProblem(ShapeKind kind) {
  if (kind == ShapeKind::kCurves) {
    return "a curve cannot move: rays meet curves in the world, where they have no "
           "instances";
  }
  if (kind == ShapeKind::kPlane) return "an infinite plane cannot move: it has no bounds";
  return nullptr;
}

void NoteIgnoredMotion(ParseState& state, const SourceLocation& where,
                       std::string_view kind) {
  if (!state.graphics.Moves()) return;
  state.AddImageNote(
      where,
      fmt::format("this {} does not move: it stays where it is at the start", kind));
}

EndTransform EndOf(const Transform& start, const Transform& end,
                   const SourceLocation& where) {
  if (start == end) return nullptr;
  if (!HaveMotion(start, end)) {
    throw InputError(where,
                     "one of the transforms at the start and at the end mirrors, the "
                     "other does not: a transform in between flattens space");
  }
  return std::make_shared<const Transform>(end);
}

void AddMovingShape(ParseState& state, const SourceLocation& where,
                    const std::function<void()>& add) {
  const GraphicsState& graphics = state.graphics;
  const Index outer = state.open_object;
  const auto own = static_cast<Index>(state.scene.objects.size());
  const EndTransform end = EndOf(graphics.ctm, graphics.ctm_end, where);
  state.scene.objects.emplace_back();
  state.open_object = own;
  add();
  state.open_object = outer;
  if (state.scene.objects.back().shapes.empty()) return state.scene.objects.pop_back();
  auto& instances = outer == kNone ? state.scene.instances : state.moving_shapes[outer];
  instances.push_back({own, graphics.ctm, where, end});
}

void PlaceObject(ParseState& state, Index object, const SourceLocation& where) {
  const GraphicsState& graphics = state.graphics;
  state.scene.instances.push_back(
      {object, graphics.ctm, where, EndOf(graphics.ctm, graphics.ctm_end, where)});
}

void PlaceMovingShapes(ParseState& state) {
  std::vector<Instance>& instances = state.scene.instances;
  for (std::size_t i = 0, placed = instances.size(); i < placed; ++i) {
    const Instance instance = instances[i];
    if (instance.end) {
      for (const Shape& shape : state.scene.objects[instance.object].shapes) {
        const char* why = MotionProblem(shape.kind);
        if (why != nullptr) state.Unsupported(instance.where, why);
      }
    }
    const auto moving = state.moving_shapes.find(instance.object);
    if (moving == state.moving_shapes.end()) continue;
    for (const Instance& inner : moving->second) {
      instances.push_back(Together(instance, inner));
    }
  }
}

void FitMotionsToShutter(ParseState& state) {
  const double all = state.end_time - state.start_time;
  const double first = (state.shutter_open - state.start_time) / all;
  const double rate = (state.shutter_close - state.shutter_open) / all;
  const double from = std::clamp(first, 0.0, 1.0),
               to = std::clamp(first + rate, 0.0, 1.0);
  if (from == 0 && to == 1 && rate == 1) return;
  Camera& camera = state.scene.camera;
  Fit(from, to, &camera.world_from_camera, &camera.end);
  for (Instance& instance : state.scene.instances) {
    Fit(from, to, &instance.world_from_object, &instance.end);
  }
  if (!(from < to)) return;
  camera.time_first = (first - from) / (to - from);
  camera.time_rate = rate / (to - from);
}

}  // namespace lanelight

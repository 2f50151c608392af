#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "src/base/core/suggest.h"
#include "src/scene/parse/directives.h"

namespace lanelight {
namespace {

// A matrix is singular if the volume of its columns relative to the product of their
// lengths is below this, because the file has rounded numbers.
constexpr double kSingular = 1e-12;

// Unit vector without overflow or underflow of the squared length; zero stays zero.
Vec3d SafeNormalize(Vec3d v) {
  const double m = LargestComponent(v);
  return m > 0 ? Normalize(v / m) : v;
}

bool IsSingular(const Transform& t) {
  const Vec3d c0 = SafeNormalize(t.Vector({1, 0, 0}));
  const Vec3d c1 = SafeNormalize(t.Vector({0, 1, 0}));
  const Vec3d c2 = SafeNormalize(t.Vector({0, 0, 1}));
  return !(std::abs(Dot(c0, Cross(c1, c2))) > kSingular) || !t.IsInvertible();
}

bool IsFinite(const Transform& t) {
  for (const auto& row : t.matrix()) {
    for (double value : row) {
      if (!std::isfinite(value)) return false;
    }
  }
  return true;
}

// Returns a new transform, or throws InputError if it overflows or is singular.
const Transform& Checked(const Statement& statement, const Transform& ctm) {
  if (!IsFinite(ctm)) {
    throw InputError(statement.where(), "the transform overflows with this {}",
                     statement.token.text);
  }
  if (IsSingular(ctm)) {
    throw InputError(
        statement.where(),
        "this {} makes the transform singular: it flattens space and cannot be inverted",
        statement.token.text);
  }
  return ctm;
}

// Sets the active ones of the two current transforms, which are mostly the same.
void Set(ParseState& state, const Statement& statement, const Transform& start,
         const Transform& end) {
  GraphicsState& graphics = state.graphics;
  if (graphics.start_active) graphics.ctm = Checked(statement, start);
  if (!graphics.end_active) return;
  const bool same = graphics.start_active && start == end;
  graphics.ctm_end = same ? start : Checked(statement, end);
}

void Concat(ParseState& state, const Statement& statement, const Transform& t) {
  const GraphicsState& graphics = state.graphics;
  const Transform start = graphics.ctm * t;
  Set(state, statement, start, graphics.Moves() ? graphics.ctm_end * t : start);
}

Transform ReadMatrix(Statement& statement) {
  std::array<double, 16> values;
  const std::vector<double> numbers = statement.Numbers(16);
  std::copy(numbers.begin(), numbers.end(), values.begin());
  const Transform t = Transform::FromPbrt(values);
  if (t(3, 0) != 0 || t(3, 1) != 0 || t(3, 2) != 0 || t(3, 3) != 1) {
    throw InputError(statement.where(),
                     "{} needs an affine matrix: numbers 4, 8, 12, 16 must be 0, 0, 0, "
                     "1; found {}, {}, {}, {}",
                     statement.token.text, t(3, 0), t(3, 1), t(3, 2), t(3, 3));
  }
  return t;
}

}  // namespace

void RunIdentity(ParseState& state, Statement& statement) {
  Set(state, statement, Transform(), Transform());
}

void RunTranslate(ParseState& state, Statement& statement) {
  const std::vector<double> n = statement.Numbers(3);
  Concat(state, statement, Transform::Translate({n[0], n[1], n[2]}));
}

void RunScale(ParseState& state, Statement& statement) {
  const std::vector<double> n = statement.Numbers(3);
  Concat(state, statement, Transform::Scale({n[0], n[1], n[2]}));
}

void RunRotate(ParseState& state, Statement& statement) {
  const std::vector<double> n = statement.Numbers(4);
  const Vec3d axis = SafeNormalize({n[1], n[2], n[3]});
  if (axis == Vec3d{}) {
    throw InputError(statement.where(),
                     "Rotate has the axis 0 0 0, which is no direction");
  }
  // Removes whole turns: the sine of a huge angle has no correct digits.
  Concat(state, statement, Transform::Rotate(std::remainder(n[0], 360.0), axis));
}

void RunLookAt(ParseState& state, Statement& statement) {
  const std::vector<double> n = statement.Numbers(9);
  const Vec3d eye{n[0], n[1], n[2]}, look{n[3], n[4], n[5]};
  const Vec3d forward = SafeNormalize(look - eye);
  const Vec3d up = SafeNormalize({n[6], n[7], n[8]});
  if (!(LargestComponent(forward) > 0)) {
    throw InputError(statement.where(), "LookAt has the same eye and look-at point");
  }
  if (!(Length(Cross(up, forward)) > 1e-9)) {
    throw InputError(statement.where(),
                     "LookAt has an up vector along the view direction");
  }
  const Transform world_to_axes = Transform::LookAt({}, forward, up);
  Concat(state, statement, world_to_axes * Transform::Translate(-eye));
}

void RunTransform(ParseState& state, Statement& statement) {
  const Transform t = ReadMatrix(statement);
  Set(state, statement, t, t);
}

void RunConcatTransform(ParseState& state, Statement& statement) {
  Concat(state, statement, ReadMatrix(statement));
}

void RunCoordinateSystem(ParseState& state, Statement& statement) {
  state.coordinate_systems[statement.Name().text] = {state.graphics.ctm,
                                                     state.graphics.ctm_end};
}

void RunCoordSysTransform(ParseState& state, Statement& statement) {
  const auto [name, where] = statement.Name();
  const auto found = state.coordinate_systems.find(name);
  if (found == state.coordinate_systems.end()) {
    const std::string nearest = NearestName(name, Names(state.coordinate_systems));
    return state.AddWarning(
        where, "unknown coordinate system {} is ignored{}", Quoted(name),
        nearest.empty() ? "" : fmt::format("; did you mean {}?", Quoted(nearest)));
  }
  // Sets both, whichever is active, as pbrt-v4.
  std::tie(state.graphics.ctm, state.graphics.ctm_end) = found->second;
}

void RunActiveTransform(ParseState& state, Statement& statement) {
  const Token which = statement.lexer.Next();
  if (which.text != "StartTime" && which.text != "EndTime" && which.text != "All") {
    ThrowUnknown(statement.lexer.Where(which), "operand of ActiveTransform:", which.text,
                 {"StartTime", "EndTime", "All"});
  }
  state.graphics.start_active = which.text != "EndTime";
  state.graphics.end_active = which.text != "StartTime";
}

void RunTransformTimes(ParseState& state, Statement& statement) {
  const std::vector<double> n = statement.Numbers(2);
  if (!(n[0] < n[1]) || !std::isfinite(n[1] - n[0])) {
    throw InputError(statement.where(),
                     "TransformTimes {} {}: the end must come after the start", n[0],
                     n[1]);
  }
  state.start_time = n[0];
  state.end_time = n[1];
}

}  // namespace lanelight

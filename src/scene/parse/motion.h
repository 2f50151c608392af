// Motion: the second of the two current transforms (ActiveTransform), their times
// (TransformTimes), and the shutter.
#pragma once

#include <functional>
#include <string_view>

#include "src/scene/parse/parse_state.h"

namespace lanelight {

/// Why shapes of a kind stay where they are at the start, or null: they can move.
const char* MotionProblem(ShapeKind kind);

/// A note that a thing of this kind stays at the start, if the current transforms differ.
void NoteIgnoredMotion(ParseState& state, const SourceLocation& where,
                       std::string_view kind);

/// Returns the end of a motion that begins at `start`; null if it is the same. Throws
/// InputError at `where` if no motion leads from one to the other.
EndTransform EndOf(const Transform& start, const Transform& end,
                   const SourceLocation& where);

/// Makes the shape that add() adds an object of its own, in its own coordinates, and
/// places it by the current transforms.
void AddMovingShape(ParseState& state, const SourceLocation& where,
                    const std::function<void()>& add);

/// Adds an instance of the object by the current transforms.
void PlaceObject(ParseState& state, Index object, const SourceLocation& where);

/// After the last directive: adds instances of the shapes that move in objects.
void PlaceMovingShapes(ParseState& state);

/// From the times of TransformTimes to those of the shutter: ends of motions are where
/// things are when it opens and closes.
void FitMotionsToShutter(ParseState& state);

}  // namespace lanelight

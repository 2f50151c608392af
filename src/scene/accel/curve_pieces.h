// Curves cut into pieces that are nearly straight and not much longer than wide, as far
// as that pays: they are what a tree sorts, and what rays are tested against.
#pragma once

#include <cstdint>
#include <vector>

#include "src/scene/accel/builder.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// A piece of a curve; `part` as in CurveBlock.
struct CurvePiece {
  float p[4][3];
  float radius[2];
  float reach[3];  // half the widest width along the axes of the scene
  std::uint32_t part, prim;
};

/// Pieces of curve i have prim first_id + i. Curves with numbers that are not finite are
/// left out.
std::vector<CurvePiece> PiecesOf(const Geometry& geometry, std::uint32_t first_id);

/// Returns the box of the points, widened on all sides and rounded outwards.
AccelBox BoxOf(const CurvePiece& piece);

/// Functions for RoundBlocks, which has set `prim` to the index of the piece.
void SetLane(CurveBlock& block, std::uint32_t lane, const CurvePiece& piece);
void ClearLane(CurveBlock& block, std::uint32_t lane);

}  // namespace lanelight

// Encodes a film for a page: half floats, in squares, only those that have changed.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/measure/live/pass_renderer.h"

namespace lanelight::live {

/// The overlay of a picture.
enum class Layer { kNone, kError, kRelative, kRays, kSegments };
/// X(enumerator, name in messages, meaning with its unit)
#define LANELIGHT_LIVE_LAYERS(X)                                           \
  X(None, "colour", "the picture itself")                                  \
  X(Error, "error", "standard error of the pixel, mean of the channels")   \
  X(Relative, "relative", "standard error over sqrt(brightness^2 + 0.01)") \
  X(Rays, "rays", "rays per sample, of squares of 16 pixels")              \
  X(Segments, "depth", "segments of a path, mean of squares of 16 pixels")

/// Throws InputError that lists the names.
Layer LayerNamed(const std::string& name);
/// [{"name", "meaning"}, ...].
nlohmann::json LayersJson();

/// The state of one renderer that a page has received.
struct SentPicture {
  std::uint64_t view = 0;  // which one: a number of its own
  Layer layer = Layer::kNone;
  std::vector<std::uint64_t> samples;  // of the pixels of each square together
};

inline constexpr int kSquare = 64;  // pixels of a side

/// Returns the head of a binary message: four bytes with the length n, low byte first,
/// then n bytes of JSON. Spaces at its end let the rest begin at a multiple of 8.
std::string BinaryHead(const nlohmann::json& head);

/// A binary message; behind its head, of each square that "squares" names ([x, y, width,
/// height] in the picture), four half floats per pixel (linear sRGB, and samples, at most
/// 65504; 0: none yet), and, with a layer, one half float per pixel of it. `head` is what
/// the JSON says besides. Empty if nothing has changed since `sent`, which is brought up
/// to date.
std::string EncodePicture(const PassRenderer& renderer, nlohmann::json head,
                          SentPicture& sent);

/// Returns the numbers of one pixel of the whole image: "value", "error" (standard
/// errors, null if there are fewer than two observations), "samples".
nlohmann::json PixelJson(const PassRenderer& renderer, int x, int y);

}  // namespace lanelight::live

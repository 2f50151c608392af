// Textures of a description to the programs that kernels run.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "src/base/image/image.h"
#include "src/scene/compiled/texture_table.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Compiles the textures of a description; indices stay. Loads each image file once, in
/// parallel. Semantics are those of pbrt-v4: scale before invert, negative results cut at
/// 0. A float texture reads alpha if any is below 1, else the mean of the colour. Only
/// level 0 is sampled. `world_from_scene` maps the positions at which kernels look
/// textures up. Throws InputError with the texture's location and the file. Files with
/// non-finite values leave a note.
TextureTable CompileTextures(const std::vector<Texture>& textures,
                             const Transform& world_from_scene = {},
                             std::vector<Note>* notes = nullptr);

/// Decoded value of byte `b` (0..255) for an encoding.
double DecodeByte(int b, Encoding encoding, double gamma);

/// The key of a table of texels.
struct ImageKey {
  std::string path;
  Encoding encoding;
  double gamma;
  bool is_float;
  friend bool operator<(const ImageKey& a, const ImageKey& b) {
    return std::tie(a.path, a.encoding, a.gamma, a.is_float) <
           std::tie(b.path, b.encoding, b.gamma, b.is_float);
  }
};

/// The files and tables of texels that a list of textures needs, each once.
class TextureImageLoader {
 public:
  explicit TextureImageLoader(const std::vector<Texture>& textures);

  /// Reads and packs all of them, in parallel, into table.images and table.decode. Notes
  /// files with values that are not finite.
  void Load(TextureTable& table, std::vector<Note>* notes);

  /// Index into table.images for an image texture of the list.
  std::int32_t ImageIndex(const Texture& texture) const;

 private:
  struct File {
    const Texture* first_use;
    Image image;
    std::size_t repaired = 0;  // values that are not finite
  };
  void NoteRepaired(std::vector<Note>& notes) const;
  int DecodeOffset(const ImageKey& key, TextureTable& table);

  std::map<std::string, File> files_;
  std::map<ImageKey, std::size_t> index_;
  std::vector<ImageKey> keys_;
  std::set<std::size_t> filtered_;  // those that a texture filters: they get a pyramid
  std::map<std::pair<Encoding, double>, int> decode_;
};

/// Appends the levels to the image's array and fills level_width, level_height and
/// level_begin. Averages are of decoded values. Byte images keep bytes, each the nearest
/// of `decode` (256 increasing values). Levels are computed from each other before
/// rounding, so each has an error of half a step and the mean of the image. A pyramid
/// adds a third of the image's bytes.
void AddMipLevels(const float* decode, TextureImage& image);

}  // namespace lanelight

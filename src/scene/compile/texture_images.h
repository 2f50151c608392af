// Image files of textures, loaded once each and packed for the kernels.
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

}  // namespace lanelight

#include "src/scene/compile/texture_programs.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/base/image/image.h"
#include "src/scene/description/description.h"

namespace lanelight {
namespace {

ImageKey KeyOf(const Texture& t) {
  return {t.path, t.encoding, t.encoding == Encoding::kGamma ? t.gamma : 0, t.is_float};
}

// Which channels of the file a texture reads: a grey value, a colour, or the alpha
// channel.
struct ChannelChoice {
  std::array<int, 3> rgb;
  bool mean = false;  // of the three
};

bool HasAlpha(const Image& image, int alpha) {
  if (alpha < 0) return false;
  for (std::size_t i = alpha; i < image.Offset(0, image.height, 0); i += image.channels) {
    if (image.is_bytes() ? image.bytes[i] != 255 : image.pixels[i] != 1) return true;
  }
  return false;
}

ChannelChoice ChooseChannels(const Image& image, const ImageKey& key) {
  if (image.channels == 1) return {{0, 0, 0}};  // alpha alone as well, as in pbrt
  const auto rgb = ColorChannels(image);
  if (!rgb) throw InputError(key.path + ": " + NoColorChannels(image));
  const int a = image.FindChannel("A");
  const bool color = (*rgb)[0] != (*rgb)[1];
  if (key.is_float && color && HasAlpha(image, a)) return {{a, a, a}};
  return {*rgb, key.is_float && color};
}

// Packs four bytes into a word.
TextureImage PackBytes(const Image& image, const ChannelChoice& channel, int decode) {
  TextureImage out;
  out.decode = decode;
  out.rgba8.resize(static_cast<std::size_t>(image.width) * image.height);
  const std::uint8_t* texel = image.bytes.data();
  for (std::uint32_t& word : out.rgba8) {
    word = texel[channel.rgb[0]] | std::uint32_t{texel[channel.rgb[1]]} << 8 |
           std::uint32_t{texel[channel.rgb[2]]} << 16 | 0xff000000u;
    texel += image.channels;
  }
  return out;
}

TextureImage PackFloats(const Image& image, const ChannelChoice& channel,
                        const ImageKey& key) {
  std::array<float, 256> decoded;
  for (int i = 0; i < 256; ++i) {
    decoded[i] = static_cast<float>(DecodeByte(i, key.encoding, key.gamma));
  }
  TextureImage out;
  const std::size_t texels = static_cast<std::size_t>(image.width) * image.height;
  out.rgb.resize(3 * texels);
  for (std::size_t i = 0; i < texels; ++i) {
    float rgb[3];
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = i * image.channels + channel.rgb[c];
      rgb[c] = image.is_bytes() ? decoded[image.bytes[at]] : image.pixels[at];
    }
    const float mean = (rgb[0] + rgb[1] + rgb[2]) / 3;
    for (int c = 0; c < 3; ++c) out.rgb[3 * i + c] = channel.mean ? mean : rgb[c];
  }
  return out;
}

TextureImage PackImage(const Image& image, const ImageKey& key, int decode) {
  const ChannelChoice channel = ChooseChannels(image, key);
  TextureImage out = image.is_bytes() && !channel.mean ? PackBytes(image, channel, decode)
                                                       : PackFloats(image, channel, key);
  out.width = image.width;
  out.height = image.height;
  return out;
}

// Adds the texture's location to errors of the image reader.
template <class F>
void AtPlace(const Texture& texture, F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    throw InputError(texture.where, fmt::format("texture \"{}\": {}", texture.name,
                                                WithoutPrefix(error)));
  }
}

}  // namespace

TextureImageLoader::TextureImageLoader(const std::vector<Texture>& textures) {
  for (const Texture& t : textures) {
    if (t.kind != TextureKind::kImage) continue;
    files_.try_emplace(t.path, File{&t, {}});
    if (index_.try_emplace(KeyOf(t), keys_.size()).second) keys_.push_back(KeyOf(t));
    if (t.filter >= ImageFilter::kTrilinear) filtered_.insert(index_.at(KeyOf(t)));
  }
}

void TextureImageLoader::Load(TextureTable& table, std::vector<Note>* notes) {
  std::vector<File*> files;
  for (auto& [path, file] : files_) files.push_back(&file);
  ParallelFor(files.size(), [&](std::size_t i) {
    File& file = *files[i];
    AtPlace(*file.first_use, [&] { file.image = ReadImage(file.first_use->path); });
    file.repaired = ReplaceNotFinite(&file.image);
  });
  if (notes != nullptr) NoteRepaired(*notes);
  std::vector<int> decode(keys_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i)
    decode[i] = DecodeOffset(keys_[i], table);
  table.images.resize(keys_.size());
  ParallelFor(keys_.size(), [&](std::size_t i) {
    const File& file = files_.at(keys_[i].path);
    AtPlace(*file.first_use,
            [&] { table.images[i] = PackImage(file.image, keys_[i], decode[i]); });
    if (filtered_.count(i) > 0) {
      AddMipLevels(table.decode.data() + decode[i], table.images[i]);
    }
  });
  files_.clear();  // the packed tables are all that is needed from here on
}

void TextureImageLoader::NoteRepaired(std::vector<Note>& notes) const {
  for (const auto& [path, file] : files_) {
    if (file.repaired == 0) continue;
    notes.push_back(
        {file.first_use->where,
         fmt::format("texture \"{}\": {} of {} values of {} are not finite; what is not "
                     "a number counts as 0, what is infinite as {}",
                     file.first_use->name, file.repaired, file.image.pixels.size(), path,
                     kLargestHalf)});
  }
}

std::int32_t TextureImageLoader::ImageIndex(const Texture& texture) const {
  return static_cast<std::int32_t>(index_.at(KeyOf(texture)));
}

int TextureImageLoader::DecodeOffset(const ImageKey& key, TextureTable& table) {
  const auto [it, is_new] = decode_.try_emplace(std::pair(key.encoding, key.gamma),
                                                static_cast<int>(table.decode.size()));
  for (int b = 0; is_new && b < 256; ++b) {
    table.decode.push_back(static_cast<float>(DecodeByte(b, key.encoding, key.gamma)));
  }
  return it->second;
}

double DecodeByte(int b, Encoding encoding, double gamma) {
  const double v = b / 255.0;
  switch (encoding) {
    case Encoding::kSrgb:
      return SrgbToLinear(v);
    case Encoding::kLinear:
      return v;
    case Encoding::kGamma:
      return std::pow(v, gamma);
  }
  return v;
}

}  // namespace lanelight

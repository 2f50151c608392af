#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "src/render/job.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// FNV-1a, eight bytes a step: meshes are tens of megabytes.
class Hash {
 public:
  void Add(std::string_view bytes) {
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
      std::uint64_t word;
      std::memcpy(&word, bytes.data() + i, 8);
      Mix(word);
    }
    for (; i < bytes.size(); ++i) Mix(static_cast<unsigned char>(bytes[i]));
    Mix(bytes.size());
  }
  std::uint64_t value() const { return hash_; }

 private:
  void Mix(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 0x100000001b3u;
    hash_ ^= hash_ >> 29;  // carries the high bytes of the word down
  }
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

bool ReadFile(const fs::path& path, std::string* content) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream in(path, std::ios::binary);
  content->assign(std::istreambuf_iterator<char>(in), {});
  return !in.bad();
}

// Quoted strings that could be file names: on one line, with an extension.
std::vector<std::string_view> QuotedNames(std::string_view text) {
  constexpr std::size_t kLongest = 1024;
  std::vector<std::string_view> names;
  for (std::size_t at = text.find('"'); at != text.npos; at = text.find('"', at)) {
    const std::size_t end = text.find('"', at + 1);
    if (end == text.npos) break;
    const std::size_t newline = text.find('\n', at);
    if (newline < end) {  // a lonely quote, in a comment
      at = newline;
      continue;
    }
    const std::string_view name = text.substr(at + 1, end - at - 1);
    if (name.size() < kLongest && name.find('.') != name.npos) names.push_back(name);
    at = end + 1;
  }
  return names;
}

class SceneHasher {
 public:
  explicit SceneHasher(const fs::path& scene) : directory_(scene.parent_path()) {}

  void AddFile(const fs::path& path) {
    std::string content;
    if (!seen_.insert(path.lexically_normal().string()).second) return;
    if (!ReadFile(path, &content)) return;
    hash_.Add(content);
    if (path.extension() != ".pbrt") return;
    for (std::string_view name : QuotedNames(content)) {
      AddFile(directory_ / fs::path(name));
      if (path.parent_path() != directory_) AddFile(path.parent_path() / fs::path(name));
    }
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  fs::path directory_;
  std::set<std::string> seen_;
  Hash hash_;
};

}  // namespace

std::uint64_t HashSceneFiles(const std::string& scene_path) {
  SceneHasher hasher{fs::path(scene_path)};
  hasher.AddFile(scene_path);
  return hasher.value();
}

}  // namespace lanelight

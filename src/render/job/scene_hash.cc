#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/base/core/hash.h"
#include "src/base/core/input_file.h"
#include "src/render/job/job.h"
#include "src/scene/parse/lex.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Quoted strings of scene text that could be names of files to be read: with an
// extension, and none of a Film directive, which names the output.
class QuotedNames {
 public:
  explicit QuotedNames(std::string_view text) : text_(text) {}

  std::vector<std::string_view> Find() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        ScanUntil('\n', at_);
      } else if (c == '"') {
        ScanString();
      } else if (IsLetter(c)) {
        HashWord();
      } else {
        const char* const begin = text_.data();
        const char* const next = SkipSpaces(begin + at_ + 1, begin + text_.size());
        at_ = std::size_t(next - begin);
      }
    }
    return std::move(names_);
  }

 private:
  static bool IsLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  }
  // Returns the text between `from` and the next `end`, and moves there.
  std::string_view ScanUntil(char end, std::size_t from) {
    at_ = std::min(text_.find(end, from), text_.size());
    return text_.substr(from, at_ - from);
  }
  void HashWord() {
    const std::size_t from = at_;
    while (at_ < text_.size() && IsLetter(text_[at_])) ++at_;
    directive_ = text_.substr(from, at_ - from);
  }
  void ScanString() {
    constexpr std::size_t kLongest = 1024;
    const std::string_view name = ScanUntil('"', at_ + 1);
    ++at_;
    const bool is_name = name.size() < kLongest && name.find('.') != name.npos;
    if (is_name && directive_ != "Film") names_.push_back(name);
  }

  std::string_view text_, directive_;
  std::size_t at_ = 0;
  std::vector<std::string_view> names_;
};

// Unpacks a compressed scene in place. Returns false for what is no scene file.
bool UnpackedScene(const fs::path& path, std::string& content) {
  if (path.extension() == ".pbrt") return true;
  if (path.extension() != ".gz" || path.stem().extension() != ".pbrt") return false;
  try {
    content = Gunzip(content, MaxUnpackedSize(content.size()));
  } catch (const InputError&) {
    return false;  // reported by the parser
  }
  return true;
}

class SceneHasher {
 public:
  explicit SceneHasher(const fs::path& scene) : directory_(scene.parent_path()) {}

  void AddFile(const fs::path& path) {
    if (!seen_.insert(path.lexically_normal().string()).second) return;
    std::string content;
    try {
      content = ReadWholeFile(path);
    } catch (const Unreadable&) {
      return;  // most are no names of files
    }
    hash_.AddArray(content);
    if (!UnpackedScene(path, content)) return;
    for (std::string_view name : QuotedNames(content).Find()) {
      AddFile(directory_ / fs::path(name));
      if (path.parent_path() != directory_) AddFile(path.parent_path() / fs::path(name));
    }
  }
  std::uint64_t value() const { return hash_.Digest(); }

 private:
  fs::path directory_;
  std::set<std::string> seen_;
  StreamHash hash_;
};

}  // namespace

std::uint64_t HashSceneFiles(const std::string& scene_path) {
  SceneHasher hasher{fs::path(scene_path)};
  hasher.AddFile(scene_path);
  return hasher.value();
}

}  // namespace lanelight

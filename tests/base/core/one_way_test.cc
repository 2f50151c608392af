// What is done in one place only: where another place does it too, what was learned in
// the first is missing there.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace lanelight {
namespace {

namespace fs = std::filesystem;

struct Way {
  const char* what;
  std::regex pattern;
  std::set<std::string> places;
};

const std::vector<Way>& Ways() {
  static const std::vector<Way> ways = {
      // Names that are not UTF-8 end nlohmann's own way out in an exception.
      {"JSON is written by DumpJson()",
       std::regex(R"(\.dump\()"),
       {"src/base/core/json_text.cc"}},
      {"JSON is read by ParseJson()",
       std::regex(R"([Jj]son::parse\()"),
       {"src/base/core/json_text.cc"}},
      // A FIFO would be waited for, and a device has no end. What Linux says of the
      // machine and the folders of outputs are no inputs; of a grid's file only a part is
      // read, by a stream, once that has been opened.
      {"inputs are opened by OpenInputFile()",
       std::regex(R"(\bifstream\b|\bfopen\(|\bO_RDONLY\b)"),
       {"src/base/core/input_file.cc", "src/base/core/machine_info.cc",
        "src/base/core/hardware_counters.cc", "src/base/image/atomic_file.cc",
        "src/base/image/sparse_grid.cc"}},
  };
  return ways;
}

}  // namespace

TEST_CASE("each task has a single implementation", "[core]") {
  const fs::path root = LANELIGHT_SOURCE_DIR;
  std::map<std::string, std::set<std::string>> found;
  for (const char* top : {"src", "kernels"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc") continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      for (const Way& way : Ways()) {
        if (!std::regex_search(text.str(), way.pattern)) continue;
        found[way.what].insert(fs::relative(entry.path(), root).generic_string());
      }
    }
  }
  for (const Way& way : Ways()) {
    INFO(way.what);
    CHECK(found[way.what] == way.places);
  }
}

}  // namespace lanelight

// Every line of docs/pbrt-format.md is what the program does, and the program knows
// nothing that the document does not have.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "src/scene/parse/parse.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/scene/parse/format_faults.h"

namespace lanelight {
namespace {

std::string ReadText(const std::string& path) {
  std::ifstream file(std::string(LANELIGHT_SOURCE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

const FormatTable& Document() {
  static const FormatTable kTable = ReadFormat(std::string(FormatDocument()));
  return kTable;
}

std::size_t Count(const FormatTable& table, bool objects) {
  return static_cast<std::size_t>(
      std::count_if(table.begin(), table.end(),
                    [&](const auto& o) { return HasObject(o) == objects; }));
}

// The objects of the document with this directive and type.
FormatTable Only(const std::string& directive, const std::string& type) {
  FormatTable table = Document();
  std::erase_if(table, [&](const FormatObject& object) {
    return object.directive != directive || object.type != type;
  });
  REQUIRE(table.size() == 1);
  return table;
}

}  // namespace

TEST_CASE("every statement of docs/pbrt-format.md agrees with the parser",
          "[parse][format]") {
  const TemporaryFolder folder;
  WriteFormatFiles(folder.File(""));
  CHECK(Count(Document(), true) > 60);
  CHECK(Count(Document(), false) > 25);
  FormatFaults faults(folder.File(""));
  faults.FindFalse(Document());
  for (const std::string& fault : faults.all()) FAIL_CHECK(fault);
}

TEST_CASE("docs/pbrt-format.md has every parameter of the parser", "[parse][format]") {
  const TemporaryFolder folder;
  WriteFormatFiles(folder.File(""));
  FormatFaults faults(folder.File(""));
  faults.FindMissing(Document());
  for (const std::string& fault : faults.all()) FAIL_CHECK(fault);
}

TEST_CASE("docs/pbrt-format.md has every type and directive of the parser",
          "[parse][format]") {
  const TemporaryFolder folder;
  CHECK(Supported(RunFormatScene(kUnknown, folder.File("")).error).size() >= 40);
  FormatFaults faults(folder.File(""));
  faults.FindMissingTypes(Document());
  for (const std::string& fault : faults.all()) FAIL_CHECK(fault);
}

TEST_CASE("faults of a format document are detected", "[parse][format]") {
  const TemporaryFolder folder;
  WriteFormatFiles(folder.File(""));
  const auto count = [&](auto find, const FormatTable& table) {
    FormatFaults faults(folder.File(""));
    (faults.*find)(table);
    return faults.all().size();
  };
  FormatTable sphere = Only("Shape", "sphere"), realistic = Only("Camera", "realistic");
  CHECK(count(&FormatFaults::FindFalse, sphere) == 0);
  sphere[0].lines[0].status = FormatStatus::kNoted;
  CHECK(count(&FormatFaults::FindFalse, sphere) == 1);
  FormatTable ptex = Only("Texture", "ptex");
  ptex[0].why = "no reason";
  ptex[0].lines.clear();
  CHECK(count(&FormatFaults::FindFalse, ptex) == 2);  // of numbers and of colours
  CHECK(count(&FormatFaults::FindMissing, realistic) == 0);
  realistic[0].lines.pop_back();  // once for each line, and once without
  CHECK(count(&FormatFaults::FindMissing, realistic) == realistic[0].lines.size() + 1);
  FormatTable all = Document();
  CHECK(std::erase_if(all, [](const auto& o) { return o.type == "cylinder"; }) == 1);
  CHECK(std::erase_if(all, [](const auto& o) { return o.directive == "Import"; }) == 1);
  CHECK(count(&FormatFaults::FindMissingTypes, all) == 2);
}

TEST_CASE("docs/pbrt-format.md equals the program's output and has correct totals",
          "[parse][format]") {
  INFO("the build has another docs/pbrt-format.md than there is now");
  CHECK((ReadText("docs/pbrt-format.md") == FormatDocument()));
  const std::string document(FormatDocument()), summary = FormatSummary(Document());
  INFO("\"In short\" is to be:\n" << summary);
  CHECK_THAT(document, Catch::Contains("## In short\n\n" + summary + "\n## "));
}

}  // namespace lanelight

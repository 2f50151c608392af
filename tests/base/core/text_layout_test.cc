// Text that fits a width.
#include "src/base/core/text_layout.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

namespace lanelight {
namespace {

std::size_t Widest(const std::string& text) {
  std::istringstream in(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(in, line);) {
    widest = std::max(widest, TextWidth(line));
  }
  return widest;
}

}  // namespace

TEST_CASE("lines break between words and after commas of lists", "[core]") {
  CHECK(Wrapped("one two three", 8) == "one two\nthree");
  CHECK(Wrapped("one two three", 7, 2) == "one\n  two\n  three");
  CHECK(Wrapped("a=1,b=2,c=3", 8) == "a=1,b=2,\nc=3");
  CHECK(Wrapped("1,234 units", 6) == "1,234\nunits");  // a number stays whole
  CHECK(Wrapped("incompressible", 4) == "incompressible");
  CHECK(Wrapped("", 4).empty());
  CHECK(TextWidth("±1") == 2);
  CHECK(Wrapped("±± ±±", 5) == "±± ±±");
}

TEST_CASE("continued rows are indented below their text", "[core]") {
  CHECK(LabelledRow("error", "1 %", 80) == "error      1 %\n");
  CHECK(LabelledRow("error", "one two", 15) == "error      one\n           two\n");
  CHECK(LabelledRow("stage_longer", "one two", 22, 6) == "stage_longer one two\n");
  CHECK(LabelledRow("stage_longer", "one two", 18, 6) ==
        "stage_longer one\n       two\n");
  CHECK(LabelledRow("stage_longer", "one two", 17, 6) ==
        "stage_longer\n       one two\n");
}

TEST_CASE("tables fit their width and keep all columns", "[core]") {
  const std::vector<std::vector<std::string>> lines = {
      {"scene", "first", "second", "third"}, {"box", "1", "22", "±3"}};
  const std::string wide = TextTable(lines, {80, 1, 0});
  CHECK(wide == "scene  first  second  third\nbox        1      22     ±3\n");
  const std::string narrow = TextTable(lines, {20, 1, 0});
  CHECK(narrow ==
        "scene  first  second\nbox        1      22\n\nscene  third\nbox       ±3\n");
  CHECK(Widest(TextTable(lines, {13, 1, 0})) == 13);
  // Words at the end are flush left; a column wider than all is there all the same.
  CHECK(TextTable({{"a", "b"}, {"x", "word"}}, {80, 1, 1}) == "a  b\nx  word\n");
  CHECK(TextTable(lines, {1, 1, 0}).find("second") != std::string::npos);
}

TEST_CASE("a list names so many and counts the others", "[core]") {
  CHECK(ListText({"a"}, 2) == "a");
  CHECK(ListText({"a", "b"}, 2) == "a and b");
  CHECK(ListText({"a", "b", "c"}, 3) == "a, b and c");
  CHECK(ListText({"a", "b", "c", "d"}, 2) == "a, b and 2 more");
}

}  // namespace lanelight

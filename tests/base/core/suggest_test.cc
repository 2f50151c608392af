#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"

#include <catch2/catch.hpp>

namespace lanelight {
namespace {

TEST_CASE("edit distance counts single edits", "[parse]") {
  CHECK(EditDistance("", "") == 0);
  CHECK(EditDistance("sphere", "sphere") == 0);
  CHECK(EditDistance("Sphere", "sphere") == 0);  // letter case is free
  CHECK(EditDistance("sphere", "spere") == 1);
  CHECK(EditDistance("sphere", "spheree") == 1);
  CHECK(EditDistance("sphere", "sphare") == 1);
  CHECK(EditDistance("sphree", "sphere") == 1);  // neighbours swapped
  CHECK(EditDistance("abc", "") == 3);
  CHECK(EditDistance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is suggested, a far one is not", "[parse]") {
  const std::vector<std::string> known = {"diffuse", "conductor", "mix"};
  CHECK(NearestName("difuse", known) == "diffuse");
  CHECK(NearestName("Conductor", known) == "conductor");
  CHECK(NearestName("matte", known) == "");
  CHECK(NearestName("duct", known) == "conductor");
  CHECK(NearestName("x", known) == "");
  CHECK(NearestName(std::string(100000, 'a'), known) == "");
}

TEST_CASE("quoted text is shortened and printable", "[parse]") {
  CHECK(Quoted("a\nb") == "\"a?b\"");
  CHECK(Quoted(std::string(1000, 'x')).size() < 80);
  CHECK(QuotedList({"a", "b"}) == "\"a\", \"b\"");
}

TEST_CASE("names that the scene must define are not listed as supported", "[parse]") {
  const auto message = [](const std::vector<std::string>& defined) -> std::string {
    try {
      ThrowNotDefined({}, "named material", "later", defined);
    } catch (const InputError& error) {
      return error.what();
    }
  };
  CHECK_THAT(message({}),
             Catch::EndsWith("unknown named material \"later\": no named material is "
                             "defined"));
  CHECK_THAT(message({"latter", "x"}),
             Catch::EndsWith("unknown named material \"later\"; did you mean \"latter\"? "
                             "the scene defines: \"latter\", \"x\""));
}

}  // namespace
}  // namespace lanelight

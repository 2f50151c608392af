// Words of the command line choose cases; the table of cases is as it should be.
#include "src/measure/stress/select.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "src/base/core/error.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/suite.h"

namespace lanelight::stress {
namespace {

using Catch::Contains;

std::vector<Case> Some() {
  std::vector<Case> cases(4);
  const char* names[] = {"ggx-alpha", "ggx-glass", "tiny-light", "many-lights"};
  for (int i = 0; i < 4; ++i) {
    cases[i].name = names[i];
    cases[i].group = i < 2 ? "materials" : "lights";
  }
  return cases;
}

std::string Chosen(const std::vector<std::string>& words) {
  std::string text;
  for (const Case& about : SelectCases(Some(), words)) text += about.name + " ";
  return text;
}

}  // namespace

TEST_CASE("stress: cases are chosen by name, group and pattern", "[stress]") {
  CHECK(Chosen({}) == "ggx-alpha ggx-glass tiny-light many-lights ");
  CHECK(Chosen({"tiny-light", "ggx-alpha"}) == "ggx-alpha tiny-light ");
  CHECK(Chosen({"lights"}) == "tiny-light many-lights ");
  CHECK(Chosen({"*light*"}) == "tiny-light many-lights ");
  CHECK(Chosen({"ggx-?lass", "ggx-*"}) == "ggx-alpha ggx-glass ");
}

TEST_CASE("stress: cases of a group are listed together", "[stress]") {
  std::vector<Case> cases = Some();
  std::swap(cases[1], cases[2]);
  std::string text;
  for (const Case& about : SelectCases(cases, {})) text += about.name + " ";
  CHECK(text == "ggx-alpha ggx-glass tiny-light many-lights ");
}

TEST_CASE("stress: an unknown name is reported with the nearest name", "[stress]") {
  CHECK_THROWS_WITH(Chosen({"ggx-alhpa"}), Contains("did you mean \"ggx-alpha\"?"));
  CHECK_THROWS_WITH(Chosen({"lights", "material"}), Contains("\"materials\""));
  CHECK_THROWS_WITH(Chosen({"xyz*"}), Contains("--list"));
}

TEST_CASE("stress: the table of cases is complete", "[stress]") {
  const std::regex name("[a-z0-9]+(-[a-z0-9]+)*");
  std::set<std::string> names, groups;
  for (const Case& about : AllCases()) {
    INFO(about.name);
    CHECK(std::regex_match(about.name, name));
    CHECK(std::regex_match(about.group, name));
    CHECK(names.insert(about.name).second);
    groups.insert(about.group);
    CHECK_FALSE(about.extreme.empty());
    CHECK_FALSE(about.must.empty());
    REQUIRE(about.measure);
    for (const bool full : {false, true}) {
      const std::vector<double> values = ValuesOf(about, full);
      CHECK(std::is_sorted(values.begin(), values.end()));
      CHECK(std::any_of(values.begin(), values.end(),
                        [&](double x) { return about.axis.Promised(x); }));
      CHECK((values.size() == 1 || !about.axis.name.empty()));
    }
  }
  for (const std::string& group : groups) CHECK(names.count(group) == 0);
}

}  // namespace lanelight::stress

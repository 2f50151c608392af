// Mistakes in what a run leaves: it must end elsewhere then, or say what is wrong.
#include <catch2/catch.hpp>
#include <functional>

#include "tests/render/run/resume_fixture.h"
#include "tests/support/input_error.h"

namespace lanelight::resume {
namespace {

using Catch::Contains;

constexpr std::size_t kPerPixel = 3 * kWidth * kHeight;  // 7770

// Half a run, and what is left of it.
Rest HalfOf(const Request& request, int max_calls = 7) {
  Rest rest;
  InterruptingCheckpointer interrupter(rest, max_calls, true);
  Request half = request;
  half.checkpointer = &interrupter;
  half.stop = &interrupter.stop();
  CHECK(Render(half).result.stop_reason == StopReason::kInterrupted);
  return rest;
}

FilmAccumulator RestOf(Request request, Rest rest) {
  InterruptingCheckpointer interrupter(rest, 1 << 30, true);
  request.checkpointer = &interrupter;
  return Render(request).film;
}

// Returns the error of resuming from a state; empty if a run resumes.
std::string ErrorOf(const Request& request, const Rest& rest) {
  return InputErrorOf([&] { RestOf(request, rest); });
}

}  // namespace

TEST_CASE("planted: losing the decision changes the image", "[resume]") {
  Request request;
  request.strategy = "points=sobol,decide=pilot";
  request.spp = 21;
  const FilmAccumulator whole = Render(request).film;
  Rest rest = HalfOf(request);
  CHECK(Identical(RestOf(request, rest), whole));
  rest.training.changes = "roulette=none,decide=none";
  CHECK_FALSE(Identical(RestOf(request, rest), whole));
  rest.training.changes = "roulette=nonesuch";
  CHECK_THROWS_AS(RestOf(request, rest), InputError);
}

TEST_CASE("planted: losing any part of the checkpoint changes the image", "[resume]") {
  for (const char* strategy :
       {"points=sobol", "points=independent,pairs=antithetic", "roulette=adjoint"}) {
    Request request;
    request.strategy = strategy;
    request.spp = 21;
    const FilmAccumulator whole = Render(request).film;
    const Rest rest = HalfOf(request);
    CHECK(Identical(RestOf(request, rest), whole));
    for (std::size_t i = 0; i < rest.columns.size(); ++i) {
      Rest damaged = rest;
      // Open pairs are few: tasks hold whole ones.
      if (rest.columns[i].name == "open") continue;
      std::vector<char>& bytes = damaged.columns[i].bytes;
      std::fill(bytes.begin(), bytes.end(), 0);
      INFO(strategy << ", " << rest.columns[i].name);
      CHECK_FALSE(Identical(RestOf(request, damaged), whole));
    }
    for (std::size_t i = 0; i < rest.tables.size(); ++i) {
      INFO(rest.tables[i].name);
      Rest damaged = rest;
      std::vector<double>& values = damaged.tables[i].values;
      if (values.empty()) continue;
      values.pop_back();
      CHECK_THROWS_AS(RestOf(request, damaged), InputError);
      values = rest.tables[i].values;
      damaged.tables[i].name += "_";
      CHECK_THROWS_AS(RestOf(request, damaged), InputError);
      damaged.tables[i].name = rest.tables[i].name;
      if (rest.tables[i].name == "path_values") continue;
      for (double& v : values) v *= 1.5;
      CHECK_FALSE(Identical(RestOf(request, damaged), whole));
    }
  }
}

TEST_CASE("a state whose tables do not fit the image is refused", "[resume]") {
  Request request;
  request.strategy = "roulette=adjoint";
  request.spp = 21;
  const Rest rest = HalfOf(request);
  CHECK(ErrorOf(request, rest) == "");
  int per_pixel = 0;
  for (std::size_t i = 0; i < rest.tables.size(); ++i) {
    if (rest.tables[i].values.empty()) continue;
    INFO(rest.tables[i].name);
    Rest damaged = rest;
    damaged.tables[i].values.clear();
    CHECK_THAT(ErrorOf(request, damaged), Contains("table"));
    if (rest.tables[i].values.size() != kPerPixel) continue;
    ++per_pixel;
    damaged.tables[i].values.resize(kPerPixel - 3);
    CHECK_THAT(ErrorOf(request, damaged),
               Contains("'" + rest.tables[i].name + "' has 7767 values; expected 7770:"));
  }
  CHECK(per_pixel == 1);
}

}  // namespace lanelight::resume

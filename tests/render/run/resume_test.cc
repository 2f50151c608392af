// A run that stops anywhere and resumes, with other threads, tasks and another end, is
// bit-identical to one that never stopped.
#include <catch2/catch.hpp>

#include "tests/render/run/resume_fixture.h"

namespace lanelight::resume {
namespace {

const char* const kStrategies[] = {
    "points=independent",
    "points=sobol",
    "points=independent,pairs=antithetic",
    "points=independent,control=regression",
    "points=stratified,control=regression,pairs=antithetic",
    "points=sobol,control=regression",
    "points=independent,control=regression,pairs=antithetic",
    "points=halton,roulette=adjoint",
    "points=sobol,decide=pilot",
    "points=halton,pairs=antithetic",
    "points=sobol,reuse=block:16",
    "points=independent,pairs=antithetic,reuse=block:32:compact",
    "points=sobol,light-paths=splats:3",
    "points=sobol,light-selection=learned",
};

}  // namespace

TEST_CASE("a resumed render is bit-identical, also with a higher sample count",
          "[resume]") {
  for (const char* strategy : kStrategies) {
    INFO(strategy);
    Request request;
    request.strategy = strategy;
    request.spp = 45;
    const Rendered whole = Render(request);
    std::vector<Request> ends;
    // Fewer samples are other tiles, and tasks that end anywhere.
    for (std::uint64_t spp : {1, 5, 8, 21, 45}) {
      ends.push_back(request);
      ends.back().spp = spp;
    }
    int pauses = 0;
    Rest rest;
    const Rendered parts = RenderInParts(request, ends, rest, pauses, 7);
    CHECK(pauses >= 3);
    CHECK(rest.counts.samples == whole.result.samples);
    CHECK(rest.counts.samples == 45 * kWidth * kHeight);
    CHECK(Identical(parts.film, whole.film));
    CHECK(Same(parts.result, whole.result));
    CHECK(whole.film.Variance(kWidth / 2, kHeight - 1).x > 0);
    request.seed = 2;
    CHECK_FALSE(Identical(Render(request).film, whole.film));
  }
}

TEST_CASE("a resumed render may lower its error target", "[resume]") {
  for (const char* strategy : {"points=sobol", "points=independent,pairs=antithetic",
                               "points=halton,control=regression"}) {
    for (double finest : {0.0004, 0.002}) {
      INFO(strategy << ", " << finest);
      Request request;
      request.strategy = strategy;
      request.target = finest;
      const Rendered whole = Render(request);
      CHECK(whole.result.stop_reason == StopReason::kTarget);
      if (finest < 0.001) CHECK(whole.result.num_checks > 1);
      std::vector<Request> ends;
      for (double target : {25 * finest, 5 * finest, 2 * finest, finest}) {
        ends.push_back(request);
        ends.back().target = target;
      }
      int pauses = 0;
      Rest rest;
      const Rendered parts = RenderInParts(request, ends, rest, pauses, 8);
      CHECK(parts.result.stop_reason == StopReason::kTarget);
      CHECK(Identical(parts.film, whole.film));
      CHECK(Same(parts.result, whole.result));
      // Finished samples are not rendered again.
      InterruptingCheckpointer interrupter(rest, 1 << 30, true);
      request.checkpointer = &interrupter;
      CHECK(Same(Render(request).result, whole.result));
    }
  }
}

TEST_CASE("a resumed render keeps its decision", "[resume]") {
  Request request;
  request.strategy = "points=sobol,decide=pilot";
  request.spp = 12;
  const Rendered whole = Render(request);
  CHECK_THAT(whole.result.training.changes, Catch::Contains("decide=none"));
  CHECK(whole.result.training.samples > 0);
  int pauses = 0;
  Rest rest;
  const Rendered parts = RenderInParts(request, {}, rest, pauses, 10);
  CHECK(pauses > 0);
  CHECK(Identical(parts.film, whole.film));
  CHECK(Same(parts.result, whole.result));
  CHECK(parts.result.training.changes == whole.result.training.changes);
}

}  // namespace lanelight::resume

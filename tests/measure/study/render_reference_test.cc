// An interrupted reference resumes.
#include <catch2/catch.hpp>
#include <filesystem>

#include "src/base/core/error.h"
#include "src/measure/study/reference.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

using Catch::Contains;

constexpr const char* kScene = R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 40 "integer yresolution" 32 "string filename" "x.exr"
WorldBegin
LightSource "infinite" "rgb L" [0.5 0.6 0.8]
Material "diffuse" "rgb reflectance" [0.7 0.5 0.3]
Shape "sphere" "float radius" 1
)";

}  // namespace

TEST_CASE("an interrupted reference render resumes", "[study]") {
  const TemporaryFolder folder;
  Job job = PrepareJob(folder.Write("scene.pbrt", kScene), {});
  ReferenceOptions options;
  options.spp = 2048;
  options.seed = 7;
  options.state = folder.File("whole.state");
  const Reference whole = RenderReference(job, options);

  options.state = folder.File("reference.state");
  std::atomic<bool> stop = false;
  std::uint64_t rendered = 0;
  options.stop = &stop;
  options.on_progress = [&](const Progress& p) {
    stop = true;
    rendered = p.samples;
  };
  RenderReference(job, options);
  REQUIRE(stop);
  REQUIRE(std::filesystem::exists(options.state));

  std::uint64_t first = 0;
  options.stop = nullptr;
  options.on_progress = [&](const Progress& p) {
    if (first == 0) first = p.samples;
  };
  const Reference resumed = RenderReference(job, options);
  CHECK(first >= rendered);  // nothing is rendered twice
  CHECK(resumed.mean == whole.mean);
  CHECK(resumed.variance == whole.variance);
}

TEST_CASE("a damaged checkpoint of a reference is refused with a remedy", "[study]") {
  const TemporaryFolder folder;
  Job job = PrepareJob(folder.Write("scene.pbrt", kScene), {});
  ReferenceOptions options;
  options.spp = 1;
  options.state = folder.Write("reference.state", "something else");
  CHECK_THROWS_WITH(RenderReference(job, options),
                    Contains(options.state) && Contains("remove"));
}

}  // namespace lanelight

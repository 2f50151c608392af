// A picture of what guiding=radiance learns around the point that a pixel sees.
//
//   bench_guide SCENE X Y PICTURE.png [--samples N]
//
// Two hemispheres above the surface, in projected solid angle: left the density of the
// guide's cell, right what rays of the pixel bring since then, both over that of the
// cosine. Black is a quarter of it or less, white 64 times as much or more.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "src/core/error.h"
#include "src/image/png.h"
#include "src/render/saving.h"
#include "tests/support/guide_picture.h"

namespace lanelight::bench {
namespace {

struct Flags {
  std::string scene, output;
  GuidePictureOptions picture;
};

void DrawGuide(const Flags& flags) {
  const Job job = PrepareJob(flags.scene, {});
  CheckOutputPaths({{flags.output}}, job.loaded->files);
  const GuidePicture p = PictureOfGuide(job, flags.picture);
  WritePng(flags.output, ColoredGuide(p));
  std::printf(
      "point      %.6g %.6g %.6g, normal %.3f %.3f %.3f\n"
      "guide      proposes %.0f %% of the directions there; its brightest square has "
      "%.3g times the density of the cosine\n"
      "training   %s\n",
      double{p.point.x}, double{p.point.y}, double{p.point.z}, double{p.normal.x},
      double{p.normal.y}, double{p.normal.z}, 100 * p.fraction, p.bright_cosine,
      p.note.c_str());
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  using namespace lanelight;
  bench::Flags flags;
  CLI::App app("Draws what guiding=radiance learns around the point that a pixel sees");
  app.add_option("SCENE", flags.scene)->required();
  app.add_option("X", flags.picture.x, "The pixel, from 0 0 at the top left")->required();
  app.add_option("Y", flags.picture.y)->required();
  app.add_option("PICTURE", flags.output, "The picture (.png)")->required();
  app.add_option("--samples", flags.picture.samples,
                 "Of the render that the guide is trained for");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::DrawGuide(flags);
    return 0;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

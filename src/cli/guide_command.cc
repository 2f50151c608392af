// `lanelight guide SCENE --pixel X,Y -o FILE`: what guiding=radiance learns around the
// point that a pixel sees.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "kernels/simd/target.h"
#include "src/advise/guide_picture.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/defaults.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/scene_options.h"
#include "src/cli/validators.h"
#include "src/core/parallel.h"
#include "src/image/png.h"
#include "src/render/saving.h"

namespace lanelight {
namespace {

struct GuideCommandOptions {
  SceneOptions scene;
  std::vector<int> pixel;
  double samples = 1u << 24;
  std::string output;
};

std::string Text(const GuidePicture& p, const std::string& output) {
  return fmt::format(
      "point      {:.6g} {:.6g} {:.6g}, normal {:.3f} {:.3f} {:.3f}\n"
      "guide      proposes {:.0f} % of the directions there; its brightest square has "
      "{:.3g} "
      "times the density of the cosine\n"
      "training   {}\n"
      "picture    {}: left what the guide has learned, right what rays of this pixel "
      "bring\n",
      p.point.x, p.point.y, p.point.z, p.normal.x, p.normal.y, p.normal.z,
      100 * p.fraction, p.bright_cosine, p.note, output);
}

int RunGuide(const GuideCommandOptions& options) {
  ForceTarget(options.scene.target);
  const ThreadLimit threads(options.scene.threads);
  const OutputPaths outputs = {{options.output}};
  CheckOutputPaths(outputs, {options.scene.scene});
  const Job job = PrepareJob(options.scene.scene, options.scene.settings);
  CheckOutputPaths(outputs, job.files);
  const InterruptGuard interrupt;
  GuidePictureOptions picture;
  picture.x = options.pixel[0], picture.y = options.pixel[1];
  picture.samples = static_cast<std::uint64_t>(options.samples);
  picture.stop = &interrupt.stop();
  const GuidePicture found = PictureOfGuide(job, picture);
  WritePng(options.output, ColoredGuide(found));
  Print(Text(found, options.output));
  return kExitGood;
}

}  // namespace

void AddGuideCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "guide", "Draw what guiding=radiance learns around the point that a pixel sees");
  auto options = std::make_shared<GuideCommandOptions>();
  command->add_option("--pixel", options->pixel, "The pixel, from 0,0 at the top left")
      ->required()
      ->expected(2)
      ->delimiter(',')
      ->type_name("X,Y");
  command
      ->add_option("--samples", options->samples,
                   WithDefault("Samples of the render that the guide is trained for",
                               options->samples))
      ->check(FiniteRange(1e5, 1e12))
      ->type_name("N");
  command->add_option("-o,--output", options->output, "The picture")
      ->required()
      ->type_name("FILE.png");
  AddSeedOption(*command, options->scene.settings);
  AddSceneOptions(*command, options->scene);
  command->footer(
      "\nTwo hemispheres above the surface, in projected solid angle: left the density "
      "of\n"
      "the guide's cell, right what rays of the pixel bring since then, both over that "
      "of the\n"
      "cosine. Black is a quarter of it or less, white 64 times as much or more.\n"
      "\nExample:\n"
      "  lanelight guide scene.pbrt --pixel 320,200 -o guide.png");
  command->callback(
      [options, &chosen] { chosen = [options] { return RunGuide(*options); }; });
}

}  // namespace lanelight

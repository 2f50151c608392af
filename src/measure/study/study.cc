#include "src/measure/study/study.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/base/image/atomic_file.h"
#include "src/measure/report/page.h"
#include "src/render/films/colors.h"

namespace lanelight {

std::vector<SceneStudy> Study(const StudyOptions& options, const StudyHooks& hooks) {
  const ThreadLimit threads(options.settings.threads);
  const Stopwatch watch;
  std::vector<SceneStudy> studies;
  std::vector<ReportImage> images;
  for (SceneRuns& runs : RunStudy(options, hooks)) {
    SceneStudy study = {std::move(runs), {}};
    if (study.runs.error.empty()) {
      study.analysis = AnalyseScene(study.runs, options, images);
    }
    studies.push_back(std::move(study));
  }
  const auto failed = [](const SceneStudy& study) { return !study.runs.error.empty(); };
  if (std::ranges::all_of(studies, failed)) {
    throw std::runtime_error(studies.front().runs.error);
  }
  const int scale = ShrinkImages(images, kReportValues);
  for (SceneStudy& study : studies) study.analysis.report_scale = scale;
  const nlohmann::json json = StudyJson(studies, options, watch.Seconds());
  WriteFileAtomically(options.out + "/study.json", DumpJson(json, 2) + "\n");
  WriteFileAtomically(options.out + "/study.csv", StudyCsv(studies));
  WriteFileAtomically(options.out + "/report.html",
                      ReportPage(PageKind::kStudy, json, images));
  if (options.paper) {
    WriteFileAtomically(options.out + "/index.html",
                        ReportPage(PageKind::kPaper, json, images));
  }
  return studies;
}

namespace {

constexpr std::size_t kLongestSlug = 60;

class ImageWriter {
 public:
  ImageWriter(const SceneRuns& runs, std::vector<ReportImage>& images)
      : runs_(runs), images_(images) {}

  // Adds an image to the report only.
  std::string AddImage(const std::string& name, const std::vector<Rgb>& colors) {
    ReportImage image;
    image.name = runs_.name + "/" + name;
    image.width = runs_.window.width();
    image.height = runs_.window.height();
    image.channels = 3;
    for (const Rgb& color : colors) {
      for (int c = 0; c < 3; ++c) image.values.push_back(float(color[c]));
    }
    images_.push_back(std::move(image));
    return images_.back().name;
  }

  std::string Write(const std::string& name, const std::vector<Rgb>& colors) {
    WriteColors(runs_.folder + "/" + name + ".exr", runs_.window.width(),
                runs_.window.height(), {{"", &colors}});
    return AddImage(name, colors);
  }

 private:
  const SceneRuns& runs_;
  std::vector<ReportImage>& images_;
};

}  // namespace

void AddStrategyImages(const SceneRuns& runs, std::size_t index, const Cells& cells,
                       StrategyAnalysis& strategy, std::vector<ReportImage>& images) {
  const Moments& moments = cells.moments;
  std::vector<Rgb> mean, variance, bias;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    mean.push_back(moments.Mean(i));
    variance.push_back(moments.Variance(i));
    bias.push_back(mean[i] - runs.reference.mean[i]);
  }
  ImageWriter writer(runs, images);
  const std::string prefix =
      fmt::format("{:02}-{}.", index + 1, Slug(runs.strategies[index].named.name));
  strategy.mean = writer.Write(prefix + "mean", mean);
  strategy.one = writer.Write(prefix + "one", cells.first);
  strategy.bias = writer.Write(prefix + "bias", bias);
  if (moments.count() >= 2) {
    strategy.variance = writer.Write(prefix + "variance", variance);
  }
}

std::set<std::size_t> PicturedStrategies(const SceneRuns& runs) {
  std::set<std::size_t> pictured;
  for (std::size_t i = 0; i < runs.strategies.size(); ++i) {
    const StrategyRuns& s = runs.strategies[i];
    if (PaperFigure(s.named.name) > 0) pictured.insert(s.same_as.value_or(i));
  }
  if (pictured.empty()) return pictured;
  const auto rendered = [](const StrategyRuns& s) { return s.status == RunStatus::kOk; };
  const auto first = std::ranges::find_if(runs.strategies, rendered);
  if (first != runs.strategies.end()) {
    pictured.insert(std::size_t(first - runs.strategies.begin()));
  }
  return pictured;
}

void AddLevelImages(const SceneRuns& runs, const LevelFirsts& firsts,
                    StrategyAnalysis& strategy, std::vector<ReportImage>& images) {
  ImageWriter writer(runs, images);
  if (firsts.images.empty()) return;
  std::size_t left = kLevelValues / firsts.pictured;
  for (std::size_t i = 0; i < firsts.images.size(); ++i) {
    LevelAnalysis& level = strategy.levels[i];
    const std::size_t values = 3 * firsts.images[i].size();
    if (i == strategy.at) {
      level.image = strategy.one;
    } else if (values <= left) {
      left -= values;
      level.image = writer.AddImage(
          fmt::format("{:02}.{}spp", firsts.strategy + 1, level.spp), firsts.images[i]);
    }
  }
}

void AddSceneImages(const SceneRuns& runs, SceneAnalysis& analysis,
                    std::vector<ReportImage>& images) {
  ImageWriter writer(runs, images);
  if (!runs.reference.mean.empty()) {
    analysis.reference_image = runs.reference.rendered()
                                   ? writer.AddImage("reference", runs.reference.mean)
                                   : writer.Write("reference", runs.reference.mean);
  }
  for (const DiffuseModel& model : runs.diffuse) {
    analysis.diffuse_images.push_back(
        writer.AddImage("diffuse-" + model.name, model.image));
  }
}

std::string Slug(const std::string& text) {
  std::string slug;
  for (unsigned char c : text) {
    if (std::isalnum(c)) {
      slug += static_cast<char>(c);
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  slug.resize(std::min(slug.size(), kLongestSlug));
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return slug.empty() ? "strategy" : slug;
}

}  // namespace lanelight

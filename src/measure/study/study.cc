#include "src/measure/study/study.h"

#include <algorithm>
#include <stdexcept>
#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/base/image/atomic_file.h"
#include "src/measure/report/page.h"
#include "src/measure/study/study_images.h"

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
  if (std::all_of(studies.begin(), studies.end(), failed)) {
    throw std::runtime_error(studies.front().runs.error);
  }
  const int scale = ShrinkImages(images, kReportValues);
  for (SceneStudy& study : studies) study.analysis.report_scale = scale;
  const nlohmann::json json = StudyJson(studies, options, watch.Seconds());
  WriteFileAtomically(options.out + "/study.json", DumpJson(json, 2) + "\n");
  WriteFileAtomically(options.out + "/study.csv", StudyCsv(studies));
  WriteFileAtomically(options.out + "/report.html", ReportPage(json, images));
  if (options.paper) {
    WriteFileAtomically(options.out + "/index.html", PaperReportPage(json, images));
  }
  return studies;
}

}  // namespace lanelight

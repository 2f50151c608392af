#include "src/measure/compare/comparison.h"

#include <nlohmann/json.hpp>

#include "src/measure/compare/linear_image.h"
#include "src/measure/report/page.h"

namespace lanelight {
namespace {

// Images of a page. Their names do not depend on names of files, of which two may be
// equal.
class PagePictures {
 public:
  std::string Add(const std::string& name, const LinearImage& image) {
    images_.push_back({name, image.width, image.height, 3, image.Interleaved()});
    return name;
  }

  std::string Add(const std::string& name, const LinearImage& like, const Plane& plane) {
    images_.push_back({name, like.width, like.height, 1, plane});
    return name;
  }

  std::vector<ReportImage>& images() { return images_; }

 private:
  std::vector<ReportImage> images_;
};

nlohmann::json MapsJson(const std::string& name, const LinearImage& test,
                        const LinearImage& reference, const ImageComparison& comparison,
                        PagePictures& pictures) {
  const ErrorMaps maps = ErrorMapsOf(test, reference);
  nlohmann::json out = {
      {"difference", pictures.Add(name + "/difference", test, maps.difference)},
      {"relative", pictures.Add(name + "/relative", test, maps.relative)},
      {"absolute", pictures.Add(name + "/absolute", test, maps.absolute)},
      {"flip-ldr", pictures.Add(name + "/flip-ldr", test, comparison.flip->ldr)}};
  if (!comparison.flip->hdr.empty()) {
    out["flip-hdr"] = pictures.Add(name + "/flip-hdr", test, comparison.flip->hdr);
  }
  return out;
}

}  // namespace

std::string ComparisonPage(const std::vector<NamedImage>& tests,
                           const NamedImage& reference,
                           const std::vector<ImageComparison>& comparisons) {
  PagePictures pictures;
  const LinearImage base = LinearOf(reference.image);
  nlohmann::json out = {
      {"reference",
       {{"name", reference.name}, {"image", pictures.Add("reference", base)}}},
      {"width", base.width},
      {"height", base.height},
      {"comparisons", nlohmann::json::array()}};
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const std::string name = std::to_string(i);
    const LinearImage test = LinearOf(tests[i].image);
    nlohmann::json one = ToJson(comparisons[i]);
    one["image"] = pictures.Add(name, test);
    one["maps"] = MapsJson(name, test, base, comparisons[i], pictures);
    out["comparisons"].push_back(std::move(one));
  }
  out["report_scale"] = ShrinkImages(pictures.images(), kReportValues);
  return ReportPage(PageKind::kComparison, out, pictures.images());
}

}  // namespace lanelight

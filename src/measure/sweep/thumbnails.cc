#include "src/measure/sweep/thumbnails.h"

#include <set>

#include "src/base/image/exr.h"
#include "src/measure/compare/linear_image.h"
#include "src/measure/report/shrink.h"

namespace lanelight {
namespace {

constexpr std::size_t kValuesOfOne = 3 * 160 * 90, kValuesOfAll = 3'000'000;

ReportImage ThumbnailOf(const std::string& name, const std::string& path) {
  const LinearImage image = LinearOf(ReadExr(path));
  std::vector<ReportImage> one = {{name, image.width, image.height, 3, {}}};
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    for (const Plane& plane : image.planes) one[0].values.push_back(plane[i]);
  }
  ShrinkImages(one, kValuesOfOne);
  return std::move(one[0]);
}

}  // namespace

std::vector<ReportImage> Thumbnails(const Sweep& sweep, const SweepFolder& folder,
                                    const std::vector<CellGroup>& groups) {
  std::vector<ReportImage> images;
  std::set<std::size_t> shown;
  for (const CellGroup& group : groups) {
    if (images.size() == kMostThumbnails) break;
    if (group.cells.empty() || !shown.insert(group.cells[0]).second) continue;
    const SweepCell& cell = sweep.cells[group.cells[0]];
    try {
      images.push_back(ThumbnailOf(cell.name, folder.File(cell, "image.exr")));
    } catch (const InputError&) {  // the page says that it is missing
    }
  }
  ShrinkImages(images, kValuesOfAll);
  return images;
}

}  // namespace lanelight

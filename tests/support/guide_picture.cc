#include "tests/support/guide_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/plan/plan_features.h"
#include "src/core/error.h"
#include "src/prepare/guide_records.h"
#include "src/prepare/guide_square.h"
#include "src/train/training.h"
#include "src/train/training_pass.h"

namespace lanelight {
namespace {

using Squares = std::array<double, kGuideSquares>;

std::size_t SquareOf(double u, double v) {
  const auto part = [](double x) {
    return std::min(static_cast<std::size_t>(x * kGuideGrid),
                    std::size_t{kGuideGrid - 1});
  };
  return part(v) * kGuideGrid + part(u);
}

// A guide, and rays of a pixel that it has not learned from.
class Study {
 public:
  Study(const Job& job, const GuidePictureOptions& options)
      : job_(job), options_(options) {
    plan_ = MakePlan(job.scene, WithChanges(job.scene, job.plan.options,
                                            "guiding=radiance,decide=none"));
    if (!plan_.features.Has(Feature::kGuided)) {
      throw InputError("nothing in this scene can be guided: no surface scatters light");
    }
    tables_ = MakeStrategyTables(job.scene);
  }

  std::string Learn() {
    TrainingOptions training;
    training.planned_samples = options_.samples;
    training.stop = options_.stop;
    const TrainingOutcome outcome = Train({job_.scene, plan_, Seed(), training, tables_});
    if (options_.stop != nullptr && *options_.stop) throw InputError("interrupted");
    return outcome.note;
  }

  // The first rays of the pixel's paths.
  std::vector<GuideRecord> Rays() const {
    TrainingPass pass = {job_.scene, plan_.options, &tables_, Seed()};
    pass.options.training = FeatureSet{Feature::kRecordsGuide};
    TrainingWork work;
    const int width = job_.loaded->description.film.width;
    work.pixels = {static_cast<std::uint32_t>(options_.y * width + options_.x)};
    work.spp = static_cast<std::uint32_t>(options_.rays);
    const TrainingSamples found = RunTrainingPass(pass, work);
    std::vector<float> first;
    for (std::size_t at = 0; at < found.recorded.size(); at += kGuidePlanes) {
      const auto sample = found.recorded.begin() + static_cast<std::ptrdiff_t>(at);
      std::vector<float> planes(sample, sample + kGuidePlanes);
      // Of the rays after it, nothing: a density of 0 is no ray.
      for (int k = 1; k < kRecordedVertices; ++k) {
        planes[static_cast<std::size_t>(k * kGuideRayPlanes) + 5] = 0;
      }
      first.insert(first.end(), planes.begin(), planes.end());
    }
    std::vector<GuideRecord> rays;
    ReadGuideRecords(first, tables_.guide, rays);
    if (rays.empty()) {
      throw InputError(fmt::format(
          "pixel {},{} sees no surface whose directions a guide could choose: choose one "
          "that shows neither background nor mirror nor clear glass",
          options_.x, options_.y));
    }
    return rays;
  }

  const Guide& guide() const { return tables_.guide; }

 private:
  std::uint32_t Seed() const { return static_cast<std::uint32_t>(job_.seed); }

  const Job& job_;
  const GuidePictureOptions& options_;
  Plan plan_;
  StrategyTables tables_;
};

// Relative to the cosine: what arrives through each square.
Squares Arrived(const std::vector<GuideRecord>& rays) {
  Squares squares{};
  double sum = 0;
  for (const GuideRecord& r : rays) {
    if (!(r.cosine > 0)) continue;
    squares[SquareOf(r.u / 65536.0, r.v / 65536.0)] += r.Mass();
    sum += r.Mass();
  }
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    squares[s] = sum > 0 ? squares[s] / (sum * CosineMasses()[s]) : 0;
  }
  return squares;
}

Squares Learned(const Guide& guide, std::uint32_t cell) {
  Squares squares;
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    const double density = double{guide.density[cell * kGuideSquares + s]};
    squares[s] = density * 4 / kGuideSquares / CosineMasses()[s];
  }
  return squares;
}

void Draw(const Squares& squares, int left, int side, Image& image) {
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = (2 * i + 1.0) / side - 1, y = 1 - (2 * j + 1.0) / side;
      if (x * x + y * y >= 1) continue;
      const auto at = ToGuideSquare({0, 0, 1}, {x, y, std::sqrt(1 - x * x - y * y)});
      image.At(left + i, j, 0) = static_cast<float>(squares[SquareOf(at.u, at.v)]);
    }
  }
}

}  // namespace

GuidePicture PictureOfGuide(const Job& job, const GuidePictureOptions& options) {
  const Film& film = job.loaded->description.film;
  if (options.x < 0 || options.y < 0 || options.x >= film.width ||
      options.y >= film.height) {
    throw InputError(fmt::format("pixel {},{} is not in the image of {}x{} pixels",
                                 options.x, options.y, film.width, film.height));
  }
  Study study(job, options);
  GuidePicture picture;
  picture.note = study.Learn();
  const std::vector<GuideRecord> rays = study.Rays();
  picture.point = rays[0].from;
  picture.normal = rays[0].normal;
  const Guide& guide = study.guide();
  const std::uint32_t cell = GuideCellAt(guide, picture.point, picture.normal);
  picture.fraction = double{guide.fraction[cell]};
  picture.cells = guide.cells();
  const Squares learned = Learned(guide, cell);
  picture.bright_cosine = *std::max_element(learned.begin(), learned.end());
  const int side = options.side, gap = side / 16;
  picture.image = MakeImage(2 * side + gap, side, {"Y"});
  Draw(learned, 0, side, picture.image);
  Draw(Arrived(rays), side + gap, side, picture.image);
  return picture;
}

Image ColoredGuide(const GuidePicture& picture) {
  const Image& values = picture.image;
  Image colors = MakeImage(values.width, values.height, {"R", "G", "B"});
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      const double value = double{values.At(x, y, 0)};
      // 1/4 to 64 are eight doublings.
      const double at = value > 0 ? std::clamp(std::log2(4 * value) / 8, 0.0, 1.0) : 0;
      for (int c = 0; c < 3; ++c) {
        colors.At(x, y, c) = static_cast<float>(std::clamp(3 * at - c, 0.0, 1.0));
      }
    }
  }
  return colors;
}

}  // namespace lanelight

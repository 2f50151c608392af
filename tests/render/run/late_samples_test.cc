// Samples whose indices are larger than those of kernels.
#include <catch2/catch.hpp>
#include <cstring>

#include "tests/render/run/resume_fixture.h"

namespace lanelight::resume {
namespace {

// Begins a film with samples that all are 0.
class LateStart : public Checkpointer {
 public:
  explicit LateStart(std::uint64_t first) : first_(first) {}
  bool Restore(RunState& state) override {
    for (const MutableStateColumn& column : state.films.Columns()) {
      if (column.name != "samples") continue;
      auto* const samples = static_cast<std::uint64_t*>(column.data);
      std::fill(samples, samples + column.rows, first_);
    }
    state.counts.samples = first_ * kWidth * kHeight;
    return true;
  }
  bool IsDue() const override { return false; }
  void Save(RunState& state) override { columns = CopyColumns(state.films); }

  std::vector<ColumnCopy> columns;

 private:
  std::uint64_t first_;
};

// Sums of samples [first, last), by replicate, of all pixels.
std::vector<double> SumsOf(const std::string& strategy, std::uint64_t first,
                           std::uint64_t last, int threads = 2) {
  LateStart checkpointer(first);
  Request request;
  request.strategy = strategy;
  request.spp = last;
  request.threads = threads;
  request.checkpointer = &checkpointer;
  const Rendered out = Render(request);
  CHECK(out.result.samples == last * kWidth * kHeight);
  CHECK(out.result.stop_reason == StopReason::kSamples);
  const ColumnCopy& sums = checkpointer.columns[1];
  std::vector<double> values(sums.bytes.size() / sizeof(double));
  std::memcpy(values.data(), sums.bytes.data(), sums.bytes.size());
  return values;
}

double Difference(const std::vector<double>& a, const std::vector<double>& b) {
  double maximum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    maximum = std::max(maximum, std::abs(a[i] - b[i]));
  return maximum;
}

}  // namespace

TEST_CASE("samples beyond 32-bit indices continue under another seed", "[resume]") {
  const std::uint64_t end = kSamplesPerSeed;
  for (const char* strategy : {"points=sobol", "points=halton", "points=independent",
                               "points=stratified,pairs=antithetic"}) {
    INFO(strategy);
    const std::vector<double> before = SumsOf(strategy, end - 8, end);
    const std::vector<double> after = SumsOf(strategy, end, end + 8);
    const std::vector<double> across = SumsOf(strategy, end - 8, end + 8);
    std::vector<double> both = before;
    for (std::size_t i = 0; i < both.size(); ++i) both[i] += after[i];
    CHECK(Difference(across, both) < 1e-10);
    CHECK(SumsOf(strategy, end - 8, end + 8, 1) == across);
    // None of these are the same samples.
    const std::vector<double> first = SumsOf(strategy, 0, 8);
    const std::vector<double> next = SumsOf(strategy, 2 * end, 2 * end + 8);
    const std::vector<double> last =
        SumsOf(strategy, kMaxSamplesPerPixel - 8, kMaxSamplesPerPixel);
    const std::vector<double>* const all[] = {&before, &after, &first, &next, &last};
    for (const auto* a : all) {
      for (const auto* b : all) CHECK((Difference(*a, *b) > 0.1) == (a != b));
    }
  }
}

}  // namespace lanelight::resume

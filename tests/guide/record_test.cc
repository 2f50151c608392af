// What training passes of a guide record, where it is known.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/prepare/guide_square.h"
#include "tests/guide/prepared.h"

namespace lanelight {

TEST_CASE("records of a closed room are its radiance", "[guide]") {
  // Walls emit 1 and reflect 0.6: the ray from the vertex of depth k meets emission and
  // what k + 1, ... bring, all known: nothing is random. A record of the vertex before or
  // after, or one that counts the vertex's own light, would be off by a term.
  constexpr int kDepth = 6;
  const Prepared room(test::ClosedRoom(0.6, kDepth),
                      "guiding=radiance,directions=bsdf,roulette=none");
  const std::vector<GuideRecord> records = room.Records(64);
  REQUIRE(records.size() == 64 * kRecordedVertices);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const int rest = kDepth - 1 - static_cast<int>(i % kRecordedVertices);
    double radiance = 0;
    for (int k = 0; k <= rest; ++k) radiance += std::pow(0.6, k);
    CHECK(double(records[i].radiance) == Approx(radiance).epsilon(1e-4));
    // On the sphere, whatever the unit; on the side that the path sees: inwards.
    const float radius = Length(records[0].from);
    CHECK(Length(records[i].from) == Approx(radius).epsilon(1e-4));
    CHECK(Dot(records[i].from, records[i].normal) == Approx(-radius).epsilon(1e-3));
    // All above the surface, distributed like the cosine: q is its density.
    CHECK(records[i].cosine == Approx(1).epsilon(1e-2));
  }
}

TEST_CASE("roulette leaves the mean of the records as it is", "[guide]") {
  const Prepared room(test::ClosedRoom(0.5, 12),
                      "guiding=radiance,directions=bsdf,roulette=throughput");
  double sum = 0, squares = 0, n = 0;
  const std::vector<GuideRecord> records = room.Records(80'000);
  for (const GuideRecord& r : records) {
    sum += double(r.radiance), squares += double(r.radiance) * double(r.radiance), n += 1;
  }
  // Rays of four depths, of which roulette ends some before they are sent: the radiance
  // that arrives is 2 within 2^-8 for each. False alarms: 6 sigma, 2e-9.
  const double mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
  CHECK(std::abs(mean - 2) < 6 * error + 2.0 / 256);
  CHECK(error < 0.01);
}

TEST_CASE("light samples leave the rest to the records", "[guide]") {
  // With directions=light scattered rays find no light by themselves: what is left is
  // what light samples gather after them.
  const Prepared direct(test::ClosedRoom(0.6, 1), "guiding=radiance,directions=light");
  for (const GuideRecord& r : direct.Records(64)) CHECK(r.radiance == 0);
  const Prepared mis(test::ClosedRoom(0.6, 1), "guiding=radiance");
  double sum = 0;
  const std::vector<GuideRecord> records = mis.Records(4096);
  for (const GuideRecord& r : records) {
    CHECK(r.radiance <= 1.0001f);
    sum += double(r.radiance);
  }
  CHECK(sum > 0);
  CHECK(sum < 0.999 * double(records.size()));
}

TEST_CASE("mirrors and glass are no records", "[guide]") {
  const Prepared slab(test::GlassSlab(4), "guiding=none");
  CHECK(slab.Records(64).empty());
}

}  // namespace lanelight

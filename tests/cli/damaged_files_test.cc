// Damaged files, and outputs that are links or pipes: an error that names the file, at
// once, and no result is lost.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/stat.h>

#include "src/base/image/atomic_file.h"
#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/cli/exit_codes.h"
#include "src/render/job/saving.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

std::string DamagedBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

// A run-length encoded HDR image of 16 x 16 equal pixels.
std::string HdrFile() {
  std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 16\n";
  for (int row = 0; row < 16; ++row) {
    file += std::string("\x02\x02\x00\x10", 4);
    for (int c = 0; c < 4; ++c) file += std::string("\x90\x80", 2);
  }
  return file;
}

ProcessResult Info(const std::string& path) {
  ProcessOptions options;
  options.timeout = 10;
  return RunLanelight({"info", path}, options);
}

Image Gradient() {
  Image image = MakeImage(16, 16, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<float>(i % 31) / 31;
  }
  return image;
}

}  // namespace

TEST_CASE("a truncated HDR image is refused wherever it is cut", "[cli]") {
  TempDirectory directory;
  const std::string whole = HdrFile(), path = directory / "cut.hdr";
  WriteText(path, whole);
  REQUIRE(ReadImage(path).width == 16);
  for (std::size_t size = 5; size < whole.size(); size += 7) {
    WriteText(path, whole.substr(0, size));
    INFO("cut to " << size);
    CHECK_THROWS_WITH(ReadImage(path), Contains("cut.hdr"));
  }
  const ProcessResult r = Info(path);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("truncated"));
}

TEST_CASE("a PNG with a flipped bit is refused", "[cli]") {
  TempDirectory directory;
  const std::string path = directory / "flip.png";
  WritePng(path, Gradient(), 0);
  const std::string good = DamagedBytes(path);
  const std::size_t data = good.find("IDAT") + 4;
  const std::size_t end = good.find("IEND");
  for (std::size_t at = data; at + 4 < end; at += 5) {
    std::string flipped = good;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    WriteText(path, flipped);
    CHECK_THROWS_WITH(ReadImage(path), Contains("damaged"));
  }
  WriteText(path, good);
  CHECK(ReadImage(path).width == 16);
}

TEST_CASE("an EXR header that claims more than the file has is refused", "[cli]") {
  TempDirectory directory;
  const std::string path = directory / "claims.exr";
  const Image image = Gradient();
  std::vector<ExrPlane> planes;
  for (const char* name : {"R", "G", "B"}) {
    planes.push_back({name, std::vector<float>(256, 0.5f), false});
  }
  WriteExr(path, 16, 16, planes);
  const std::string good = DamagedBytes(path);
  REQUIRE(ReadImage(path).width == 16);
  // The size of an attribute stands behind its name and type.
  const std::string attribute = std::string("compression\0compression\0", 24);
  std::string claims = good;
  const std::size_t at = claims.find(attribute) + attribute.size();
  REQUIRE(at > attribute.size());
  claims.replace(at, 4, "\xff\xff\xff\x7f");
  WriteText(path, claims);
  CHECK_THROWS_WITH(ReadImage(path), Contains("truncated"));
  CHECK(Info(path).exit_code == kExitBadInput);
}

TEST_CASE("control characters of files do not reach the terminal", "[cli]") {
  TempDirectory directory;
  const std::string path = directory / "c.pfm";
  WriteText(path, "PF\n2 \x1b[31m2\n-1.0\n");
  const ProcessResult r = RunLanelight({"compare", path, path});
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("\\x1b") && !Contains("\x1b["));
}

TEST_CASE("a motion that flattens space is an error with its place", "[cli]") {
  TempDirectory directory;
  const std::string path = directory / "flat.pbrt";
  WriteText(path,
            "WorldBegin\nActiveTransform EndTime\nScale 1e-10 1 1\n"
            "ActiveTransform All\nShape \"sphere\"\n");
  const ProcessResult r = RunLanelight({"plan", path});
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("flat.pbrt:5:") && !Contains("internal"));
}

TEST_CASE("an output that is a link is written through it", "[cli]") {
  TempDirectory directory;
  const std::string link = directory / "link.txt", target = directory / "target.txt";
  fs::create_symlink("target.txt", link);  // leads nowhere yet
  WriteFileAtomically(link, "first");
  WriteFileAtomically(link, "second");
  CHECK(fs::is_symlink(link));
  CHECK_FALSE(fs::is_symlink(target));
  CHECK(DamagedBytes(target) == "second");
  CHECK(directory.Files().size() == 2);
}

TEST_CASE("a pipe is refused instead of waiting for a reader", "[cli]") {
  TempDirectory directory;
  const std::string path = directory / "pipe";
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  CHECK_THROWS_WITH(WriteFileAtomically(path, "x"), Contains("pipe"));
}

TEST_CASE("results that cannot be written are all kept, whatever their names", "[cli]") {
  const std::string first = FallbackPath("/a/image.exr");
  WriteText(first, "one");
  const std::string second = FallbackPath("/b/image.exr");
  CHECK(second != first);
  fs::remove(first);
}

TEST_CASE("an empty name of a checkpoint is refused", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const ProcessResult r = RunLanelight(
      {"render", scene, "-o", directory / "o.exr", "--spp", "1", "--checkpoint", ""});
  CHECK(r.exit_code == kExitUsage);
  CHECK_THAT(r.err, Contains("empty"));
}

}  // namespace lanelight

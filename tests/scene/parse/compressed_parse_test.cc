// Scenes, includes and meshes that are compressed by gzip.
#include <catch2/catch.hpp>
#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "src/base/core/input_file.h"
#include "src/render/job/job.h"
#include "src/scene/parse/parse.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// A folder that is removed at the end of the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / "lanelight_compressed_test";
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
  }
  // `mode` "wb" or, for another member of the same file, "ab".
  void Compress(const std::string& name, const std::string& text,
                const char* mode = "wb") const {
    const gzFile file = gzopen((path / name).c_str(), mode);
    REQUIRE(gzwrite(file, text.data(), static_cast<unsigned>(text.size())) ==
            static_cast<int>(text.size()));
    REQUIRE(gzclose(file) == Z_OK);
  }
  std::string Path(const std::string& name) const { return (path / name).string(); }
};

const std::string kMesh =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
    "end_header\n0 0 0 1 0 0 0 1 0 3 0 1 2\n";

std::string MessageOf(const std::string& scene) {
  return InputErrorOf([&] { ParseScene(scene); });
}

TEST_CASE("compressed scenes, includes, imports and meshes are read", "[parse]") {
  const Folder folder;
  folder.Compress("main.pbrt.gz",
                  "WorldBegin Include \"a.pbrt.gz\" Import \"b.pbrt.gz\"\n"
                  "Shape \"plymesh\" \"string filename\" \"m.ply.gz\"");
  folder.Compress("a.pbrt.gz", "Shape \"sphere\" \"float radius\" 2 ");
  folder.Compress("a.pbrt.gz", "Shape \"sphere\" \"float radius\" 3", "ab");
  folder.Compress("b.pbrt.gz", "Shape \"sphere\" \"float radius\" 4");
  folder.Compress("m.ply.gz", kMesh);
  const SceneDescription scene = ParseScene(folder.Path("main.pbrt.gz"));
  REQUIRE(scene.shapes.size() == 4);
  CHECK(scene.shapes[0].radius == 2);
  CHECK(scene.shapes[1].radius == 3);
  CHECK(scene.shapes[2].radius == 4);
  CHECK(scene.shapes[3].mesh->indices.size() == 3);
}

TEST_CASE("a file in UTF-16 is refused in one sentence", "[parse]") {
  const Folder folder;
  folder.Write("utf16.pbrt", std::string("\xff\xfeW\0o\0", 6));
  CHECK_THAT(MessageOf(folder.Path("utf16.pbrt")),
             Catch::Contains("it is UTF-16; save it as UTF-8"));
}

TEST_CASE("damaged compressed files are refused with the reason", "[parse]") {
  const Folder folder;
  folder.Write("main.pbrt", "WorldBegin\nInclude \"a.pbrt.gz\"");
  folder.Compress("a.pbrt.gz", std::string(1000, ' ') + "Shape \"sphere\"");
  const std::string whole = ReadWholeFile(folder.Path("a.pbrt.gz"));
  const std::string place = folder.Path("main.pbrt") + ":2:9: error: ";
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    folder.Write("a.pbrt.gz", whole.substr(0, size));
    const std::string message = MessageOf(folder.Path("main.pbrt"));
    CHECK(message.starts_with(place));
    CHECK(message.find("truncated") != std::string::npos);
  }
  std::string flipped = whole;
  flipped[whole.size() - 6] ^= 1;  // of the checksum
  folder.Write("a.pbrt.gz", flipped);
  CHECK(MessageOf(folder.Path("main.pbrt")).find("damaged") != std::string::npos);
  folder.Write("a.pbrt.gz", "Shape \"sphere\"");
  CHECK(MessageOf(folder.Path("main.pbrt")).find("damaged") != std::string::npos);
}

TEST_CASE("unpacking stops at the limit", "[parse]") {
  const Folder folder;
  folder.Compress("zeros.gz", std::string(1 << 20, '\0'));
  const std::string packed = ReadWholeFile(folder.Path("zeros.gz"));
  CHECK(Gunzip(packed, 1 << 20).size() == 1 << 20);
  CHECK_THROWS_AS(Gunzip(packed, (1 << 20) - 1), InputError);
  CHECK(MaxUnpackedSize(100) == std::size_t{256} << 20);
  CHECK(MaxUnpackedSize(std::size_t{10} << 20) == std::size_t{1000} << 20);
  CHECK(MaxUnpackedSize(std::size_t{1} << 40) == std::size_t{4} << 30);
}

TEST_CASE("the hash of a compressed scene covers what it includes", "[parse]") {
  const Folder folder;
  folder.Compress("main.pbrt.gz", "WorldBegin Include \"a.pbrt\"");
  folder.Write("a.pbrt", "Shape \"sphere\"");
  const std::uint64_t before = HashSceneFiles(folder.Path("main.pbrt.gz"));
  folder.Write("a.pbrt", "Shape \"disk\"");
  CHECK(HashSceneFiles(folder.Path("main.pbrt.gz")) != before);
}

}  // namespace
}  // namespace lanelight

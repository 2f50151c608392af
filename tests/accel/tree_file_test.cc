// Trees in files: what comes back is what was written, and anything else is refused.
#include "src/core/input_file.h"
#include "src/accel/tree_file.h"

#include <xxhash.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cstring>
#include <thread>

#include "src/accel/tree_parts.h"
#include "src/core/error.h"
#include "src/image/atomic_file.h"
#include "tests/image/temporary_folder.h"
#include "tests/support/brute_force.h"

namespace lanelight {
namespace {

using Catch::Contains;

constexpr TreeKey kSomeKey = {0x0123456789abcdefu, 0xfedcba9876543210u};
// Of the header, as src/accel/tree_file.h describes it.
constexpr std::size_t kLayoutAt = 24, kKeyAt = 32, kPartsAt = 64,
                      kHeaderHashAt = kPartsAt + 32 * 32;

// Everything that a tree consists of.
std::vector<std::string> PartBytes(const Accel& accel) {
  std::vector<std::string> parts;
  VisitParts(accel, [&](const auto& member) {
    const TreePart part = PartOf(member);
    parts.emplace_back(static_cast<const char*>(part.data), part.bytes());
  });
  return parts;
}

Geometry Instanced(brute::Random& random) {
  Geometry g = brute::Soup(random, 700, 1, 0.1f);
  g.groups = {{0, 200}, {200, 700}};
  for (const float x : {0.0f, 3.0f, 6.0f}) {
    g.instances.push_back(
        {{1, 0, 0, -x, 0, 1, 0, 0, 0, 0, 1, 0}, {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0}});
    g.instance_group.push_back(1);
  }
  return g;
}

Geometry Round(int spheres, int disks) {
  Geometry g;
  for (int i = 0; i < spheres; ++i) {
    g.spheres.push_back(
        {{float(i), 1, 2}, 0.5f, 0, -1, 0, 1, {1, 0, 0}, {0, 0, 1}, 1, 0});
  }
  for (int i = 0; i < disks; ++i) {
    g.disks.push_back(
        {{1, float(i), 2}, 0.5f, {0, 0, 1}, 0.1f, {1, 0, 0}, 0, -1, 0, 1, 0});
  }
  return g;
}

std::vector<Geometry> Shapes() {
  brute::Random random(62);
  return {Geometry(),    brute::Soup(random, 5, 1, 0.1f),
          Round(100, 0), brute::Soup(random, 20000, 1, 0.1f),
          Round(0, 100), brute::Soup(random, 3000, 1, 1.0f),
          Round(3, 2),   Instanced(random)};
}

Accel SomeTree() {
  brute::Random random(63);
  return MakeScene(brute::Soup(random, 3000, 1, 0.1f)).accel;
}

std::string Refusal(const std::string& path, const TreeKey& key = kSomeKey) {
  try {
    ReadTreeFile(path, key);
  } catch (const InputError& error) {
    const std::string text = error.what();
    CHECK(text.find("error: " + path + ": ") == 0);
    CHECK(text.find('\n') == text.npos);
    return text;
  }
  return "";
}

// The file with some bytes replaced.
void Patch(const std::string& path, std::size_t at, const std::string& bytes) {
  std::string content = ReadWholeFile(path);
  content.replace(at, bytes.size(), bytes);
  WriteFileAtomically(path, content);
}

}  // namespace

TEST_CASE("a tree comes back from its file bit by bit", "[accel][tree-file]") {
  const TemporaryFolder folder;
  int n = 0;
  for (const Geometry& geometry : Shapes()) {
    for (const auto quality : {BuildQuality::kHigh, BuildQuality::kFast}) {
      CAPTURE(n);
      const Accel tree = MakeScene(geometry, {.quality = quality}).accel;
      const std::string path = folder.File(std::to_string(n++));
      WriteTreeFile(path, kSomeKey, tree);
      const Accel read = ReadTreeFile(path, kSomeKey);
      CHECK(PartBytes(read) == PartBytes(tree));
      CHECK(read.Bytes() == tree.Bytes());
      CHECK(reinterpret_cast<std::uintptr_t>(read.nodes.data()) % kCacheLine == 0);
      CHECK(reinterpret_cast<std::uintptr_t>(read.triangle_blocks.data()) % kCacheLine ==
            0);
    }
  }
}

TEST_CASE("a tree outlives its file", "[accel][tree-file]") {
  const TemporaryFolder folder;
  const Accel tree = SomeTree();
  const std::string path = folder.File("a");
  WriteTreeFile(path, kSomeKey, tree);
  Accel read = ReadTreeFile(path, kSomeKey);
  const Accel copy = read;
  read = Accel();
  WriteTreeFile(path, kSomeKey, Accel());
  CHECK(PartBytes(copy) == PartBytes(tree));
  CHECK(ReadTreeFile(path, kSomeKey).nodes.empty());
  std::filesystem::remove(path);
  CHECK(PartBytes(copy) == PartBytes(tree));
}

TEST_CASE("a tree file cut anywhere is refused", "[accel][tree-file]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  WriteTreeFile(path, kSomeKey, SomeTree());
  const std::string whole = ReadWholeFile(path);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{100}, std::size_t{4095},
        std::size_t{4096}, whole.size() / 2, whole.size() - 1}) {
    WriteFileAtomically(path, whole.substr(0, size));
    const std::string reason = size < 4096 ? "is too short for a tree" : "is torn";
    CHECK_THAT(Refusal(path), Contains(reason));
  }
  WriteFileAtomically(path, whole + "x");
  CHECK_THAT(Refusal(path), Contains("is torn"));
}

TEST_CASE("a tree file with a wrong bit is refused", "[accel][tree-file]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  const Accel tree = SomeTree();
  WriteTreeFile(path, kSomeKey, tree);
  const std::string whole = ReadWholeFile(path);
  std::size_t refused = 0, harmless = 0;
  for (std::size_t at = 0; at < whole.size(); at += at < 4096 ? 13 : 997) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    folder.Write("a", damaged);
    if (!Refusal(path).empty()) {
      ++refused;
    } else {  // between the parts, where nobody looks
      ++harmless;
      CHECK(damaged[at] == 0x10);
      CHECK(PartBytes(ReadTreeFile(path, kSomeKey)) == PartBytes(tree));
    }
  }
  CHECK(refused > (whole.size() - 8192) / 997);
  CHECK(harmless < 400);  // most of the first page
}

TEST_CASE("files of something else are refused with what they are",
          "[accel][tree-file]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  WriteTreeFile(path, kSomeKey, SomeTree());
  CHECK(Refusal(path) == "");
  CHECK_THAT(Refusal(path, {1, 2}),
             Contains("is of other shapes (fedcba98765432100123456789abcdef)"));
  Patch(path, kLayoutAt, std::string("\x2a"));
  CHECK_THAT(Refusal(path), Contains("layout 42; this program reads layout 1"));
  Patch(path, 16, std::string("\1\2\3\4\5\6\7\10", 8));
  CHECK_THAT(Refusal(path), Contains("another byte order"));
  Patch(path, kKeyAt, "x");  // the checks before come first
  CHECK_THAT(Refusal(path), Contains("another byte order"));
  WriteFileAtomically(path, std::string(10000, 'x'));
  CHECK_THAT(Refusal(path), Contains("is not a tree file"));
  std::filesystem::create_directory(folder.File("directory"));
  CHECK_THAT(Refusal(folder.File("directory")), Contains("it is a directory"));
  CHECK_THAT(Refusal(folder.File("absent")), Contains("No such file"));
}

TEST_CASE("parts that this program has not are refused though every hash is right",
          "[accel][tree-file]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  WriteTreeFile(path, kSomeKey, SomeTree());
  const std::string whole = ReadWholeFile(path);
  const auto refusal = [&](std::size_t at, std::uint64_t value) {
    std::string content = whole;
    std::memcpy(&content[at], &value, sizeof(value));
    const std::uint64_t hash = XXH3_64bits(content.data(), kHeaderHashAt);
    std::memcpy(&content[kHeaderHashAt], &hash, sizeof(hash));
    folder.Write("a", content);
    return Refusal(path);
  };
  const std::size_t nodes = kPartsAt + 32, top = kPartsAt + 8 * 32;
  const std::uint64_t most = ~std::uint64_t{0};
  for (const std::uint64_t offset : {most, most - 63, std::uint64_t{whole.size()}}) {
    CHECK_THAT(refusal(nodes, offset), Contains("part 2 of the tree is not as"));
  }
  CHECK_THAT(refusal(nodes, 4096 + 8), Contains("part 2 of the tree is not as"));
  for (const std::uint64_t count : {most, most / 256 + 1, most / 256 - 1}) {
    CHECK_THAT(refusal(nodes + 8, count), Contains("part 2 of the tree is not as"));
  }
  CHECK_THAT(refusal(nodes + 16, sizeof(WideNode) + 64), Contains("part 2 of the tree"));
  CHECK_THAT(refusal(top + 8, 2), Contains("part 9 of the tree is not as"));
  CHECK_THAT(refusal(kPartsAt - 8, 12), Contains("part 13 of the tree is not as"));
  CHECK_THAT(refusal(kPartsAt - 8, 16), Contains("more parts than this program"));
  CHECK(refusal(kPartsAt - 8, 15) == "");
}

TEST_CASE("many that write one tree file leave a whole one", "[accel][tree-file]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  const Accel tree = SomeTree();
  WriteTreeFile(path, kSomeKey, tree);
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (int i = 0; i < 200; ++i) WriteTreeFile(path, kSomeKey, tree);
    done = true;
  });
  int wrong = 0;
  do {
    WriteTreeFile(path, kSomeKey, tree);
    wrong += PartBytes(ReadTreeFile(path, kSomeKey)) != PartBytes(tree);
  } while (!done);
  writer.join();
  CHECK(wrong == 0);
  CHECK(folder.Count() == 1);
}

}  // namespace lanelight

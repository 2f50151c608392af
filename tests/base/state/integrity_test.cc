// A file that is not exactly what was written is refused.
#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <catch2/catch.hpp>

#include "src/base/core/input_file.h"
#include "src/base/state/seal.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/base/state/random_film.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

using Catch::Contains;

std::string SmallState() {
  const RandomFilm film = RandomFilm::Make({0, 0, 2, 2}, 1);
  return StateBytes(film.Content({film.window}));
}

// The error, or "" if the file opens.
std::string ErrorOf(const std::string& path) {
  return InputErrorOf([&] { const StateFile file(path); });
}

std::uint64_t NumberAt(const std::string& bytes, std::size_t offset) {
  std::uint64_t number;
  std::memcpy(&number, bytes.data() + offset, 8);
  return number;
}

void SetNumberAt(std::string& bytes, std::size_t offset, std::uint64_t number) {
  std::memcpy(bytes.data() + offset, &number, 8);
}

}  // namespace

TEST_CASE("the checksum is computed as documented", "[state]") {
  const std::string bytes = SmallState();
  CHECK(bytes.substr(0, 16) == "lanelight state\n");
  CHECK(NumberAt(bytes, 16) == kStateSchema);
  CHECK(NumberAt(bytes, 24) == bytes.size());
  CHECK(NumberAt(bytes, 32) == XXH3_64bits(bytes.data() + 512, bytes.size() - 512));
  CHECK(bytes.substr(40, 464) == std::string(464, '\0'));
  CHECK(NumberAt(bytes, 504) == XXH3_64bits(bytes.data(), 504));
  CHECK(bytes.substr(512, 8) == "\x89HDF\r\n\x1a\n");
}

TEST_CASE("a state truncated at any byte is refused", "[state]") {
  const TemporaryFolder folder;
  const std::string bytes = SmallState(), path = folder.Write("state", bytes);
  REQUIRE(ErrorOf(path).empty());
  for (std::size_t size = bytes.size(); size-- > 0;) {
    REQUIRE(truncate(path.c_str(), static_cast<off_t>(size)) == 0);
    const std::string error = ErrorOf(path);
    if (error.find(size > 0 ? "truncated" : "empty") != error.npos) continue;
    FAIL_CHECK(size << " bytes: " << error);
  }
  folder.Write("state", bytes + '\0');
  CHECK_THAT(ErrorOf(path), Contains("truncated"));
}

// All content has one hash, which any bit of a byte changes; the seal has fields.
TEST_CASE("a state with any bit of the seal or any byte changed is refused", "[state]") {
  const TemporaryFolder folder;
  const std::string bytes = SmallState(), path = folder.Write("state", bytes);
  const FileDescriptor file(open(path.c_str(), O_WRONLY));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const int first = static_cast<int>(i % 8), bits = i < kSealBytes ? 8 : 1;
    for (int bit = first; bit < first + bits; ++bit) {
      const char flipped = static_cast<char>(bytes[i] ^ (1 << bit % 8));
      REQUIRE(pwrite(file.get(), &flipped, 1, static_cast<off_t>(i)) == 1);
      const std::string error = ErrorOf(path);
      if (error.find("damaged") != error.npos) continue;
      FAIL_CHECK("byte " << i << ", bit " << bit % 8 << ": " << error);
    }
    REQUIRE(pwrite(file.get(), &bytes[i], 1, static_cast<off_t>(i)) == 1);
  }
  CHECK(ErrorOf(path).empty());
}

TEST_CASE("a state of another schema is refused with both numbers", "[state]") {
  const TemporaryFolder folder;
  std::string bytes = SmallState();
  SetNumberAt(bytes, 16, kStateSchema + 6);
  SetNumberAt(bytes, 504, XXH3_64bits(bytes.data(), 504));
  CHECK_THAT(ErrorOf(folder.Write("state", bytes)),
             Contains("is of schema 7; this program reads schema 1"));
}

TEST_CASE("a file that is not a state is reported as such", "[state]") {
  const TemporaryFolder folder;
  CHECK_THAT(ErrorOf(folder.File("absent")),
             Contains("absent") && Contains("No such file"));
  CHECK_THAT(ErrorOf(folder.Write("empty", "")), Contains("is empty"));
  CHECK_THAT(ErrorOf(folder.Write("text", std::string(2000, 'x'))),
             Contains("not a state file"));
  CHECK_THAT(ErrorOf(folder.File("")), Contains("is a directory"));
  REQUIRE(mkfifo(folder.File("pipe").c_str(), 0600) == 0);
  CHECK_THAT(ErrorOf(folder.File("pipe")), Contains("a FIFO"));
  CHECK_THAT(ErrorOf("/dev/zero"), Contains("a device"));
  const std::string foreign = folder.File("foreign.h5");
  H5Fclose(H5Fcreate(foreign.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  CHECK_THAT(ErrorOf(foreign), Contains("not a state file"));
}

TEST_CASE("a sealed file with missing content is an input error", "[state]") {
  const TemporaryFolder folder;
  std::string noise(5000, 'x');
  Seal(noise.data(), noise.size(), kStateSchema);
  CHECK_THAT(ErrorOf(folder.Write("noise", noise)), Contains("open"));
  const std::string empty = folder.File("empty");
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, kSealBytes);
  H5Fclose(H5Fcreate(empty.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT));
  H5Pclose(creation);
  std::string bytes = ReadWholeFile(empty);
  Seal(bytes.data(), bytes.size(), kStateSchema);
  CHECK_THAT(ErrorOf(folder.Write("empty", bytes)), Contains("identity"));
}

TEST_CASE("a state that claims more than it stores is refused", "[state]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("claims");
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE), type = H5Tcopy(H5T_C_S1);
  H5Pset_userblock(creation, kSealBytes);
  H5Tset_size(type, 1000000001);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  const hid_t space = H5Screate(H5S_SCALAR);
  // The content would come with the first write.
  H5Dclose(
      H5Dcreate2(file, "identity", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Sclose(space), H5Fclose(file), H5Tclose(type), H5Pclose(creation);
  std::string bytes = ReadWholeFile(path);
  Seal(bytes.data(), bytes.size(), kStateSchema);
  CHECK_THAT(ErrorOf(folder.Write("claims", bytes)),
             Contains("identity should have 1000000001 bytes"));
}

TEST_CASE("rows that do not expand are an error of their file", "[state]") {
  const TemporaryFolder folder;
  const PixelRect window = {0, 0, 50, 50};
  const RandomFilm film = RandomFilm::Make(window, 1);
  std::string bytes = StateBytes(film.Content({window}));
  bytes[bytes.size() / 2] ^= 1;  // of a sum: these take most of the file
  Seal(bytes.data(), bytes.size(), kStateSchema);
  const StateFile file(folder.Write("state", bytes));
  RandomFilm read(window);
  CHECK_THROWS_WITH(file.ReadPixels(read.Columns(), window),
                    Contains(folder.File("state")) && Contains("sums"));
}

TEST_CASE("an open state is unchanged when its path is replaced", "[state]") {
  const TemporaryFolder folder;
  const PixelRect window = {0, 0, 50, 50};
  const RandomFilm old_film = RandomFilm::Make(window, 1),
                   new_film = RandomFilm::Make(window, 2);
  const std::string path = folder.File("state");
  WriteState(old_film.Content({window}), path);
  const StateFile file(path);
  WriteState(new_film.Content({window}), path);
  RandomFilm read(window);
  file.ReadPixels(read.Columns(), window);
  CHECK(HoldsTiles(read, old_film, {window}));
  std::filesystem::remove(path);
  file.ReadPixels(read.Columns(), window);
  CHECK(HoldsTiles(read, old_film, {window}));
}

}  // namespace lanelight

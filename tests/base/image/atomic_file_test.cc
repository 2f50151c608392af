// A failed write leaves the old file and no rubbish.
#include "src/base/core/input_file.h"
#include "src/base/image/atomic_file.h"

#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "tests/base/image/file_size_limit.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
TEST_CASE("a file is replaced as a whole", "[image][file]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a");
  WriteFileAtomically(path, "first");
  CHECK(ReadWholeFile(path) == "first");
  WriteFileAtomically(path, std::string(300000, 'x'));
  CHECK(ReadWholeFile(path) == std::string(300000, 'x'));
  WriteFileAtomically(path, "");
  CHECK(ReadWholeFile(path).empty());
  CHECK(folder.Count() == 1);
}

TEST_CASE("a temporary file left by a killed process is no obstacle", "[image][file]") {
  const TemporaryFolder folder;
  // Of a process with this number, which may have been another one, or on another
  // machine.
  for (int i = 0; i < 100; ++i) {
    folder.Write("a." + std::to_string(getpid()) + "." + std::to_string(i) + ".tmp", "?");
  }
  WriteFileAtomically(folder.File("a"), "whole");
  CHECK(ReadWholeFile(folder.File("a")) == "whole");
  CHECK(folder.Count() == 101);
}

TEST_CASE("a write that fails keeps the old file and removes its own", "[image][file]") {
  const TemporaryFolder folder;
  const std::string path = folder.Write("a", "old");
  {
    const FileSizeLimit limit(1000);
    CHECK_THROWS_WITH(WriteFileAtomically(path, std::string(5000, 'x')),
                      Catch::Contains(path) && Catch::Contains("File too large"));
  }
  CHECK(ReadWholeFile(path) == "old");
  CHECK(folder.Count() == 1);
}

TEST_CASE("unwritable paths are input errors with the reason", "[image][file]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(WriteFileAtomically(folder.File("no/a"), "x"),
                    Catch::Contains("No such file or directory"));
  CHECK_THROWS_AS(WriteFileAtomically(folder.File(""), "x"), InputError);
  std::filesystem::create_directory(folder.File("directory"));
  CHECK_THROWS_WITH(WriteFileAtomically(folder.File("directory"), "x"),
                    Catch::Contains("directory"));
  CHECK(folder.Count() == 1);
  CHECK_THROWS_WITH(ReadWholeFile(folder.File("absent")),
                    Catch::Contains("absent") && Catch::Contains("No such file"));
  CHECK_THROWS_WITH(ReadWholeFile(folder.File("directory")),
                    Catch::Contains("it is a directory"));
}

TEST_CASE("devices are written, not replaced", "[image][file]") {
  WriteFileAtomically("/dev/null", "gone");
  CHECK(std::filesystem::is_character_file("/dev/null"));
  CHECK_THROWS_WITH(WriteFileAtomically("/dev/full", "x"),
                    Catch::Contains("No space left on device"));
  CHECK(std::filesystem::is_character_file("/dev/full"));
}

}  // namespace lanelight

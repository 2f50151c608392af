#include <algorithm>
#include <cstring>
#include <set>
#include <span>

#include "src/base/core/aligned.h"
#include "src/base/core/parallel.h"
#include "src/base/image/atomic_file.h"
#include "src/base/state/columns.h"
#include "src/base/state/seal.h"
#include "src/base/state/state_file.h"

namespace lanelight {
namespace {

// HDF5 allocates and clears memory in these steps; small, so that it stays in the cache.
constexpr std::size_t kIncrement = 1 << 20;

void CheckColumns(const std::vector<StateColumn>& columns) {
  std::set<std::string> names;
  for (const StateColumn& c : columns) {
    LL_CHECK(!c.name.empty());
    LL_CHECK_EQ(c.name.find_first_of("/."), std::string::npos);
    LL_CHECK(names.insert(c.name).second);
    LL_CHECK_GT(c.RowBytes(), 0u);
    LL_CHECK(c.rows == 0 || c.data != nullptr);
  }
}

void CheckContent(const StateContent& content) {
  LL_CHECK_EQ(TileProblem(content.tiles, content.window), "");
  CheckColumns(content.pixels);
  CheckColumns(content.tables);
  for (const StateColumn& c : content.pixels) {
    LL_CHECK_EQ(c.rows, content.window.pixels());
  }
}

// Creates a file in memory, after space for the seal, so that a full disk cannot
// interrupt HDF5.
hdf5::Handle NewFile() {
  const hdf5::Handle access = hdf5::NewProperties(H5P_FILE_ACCESS),
                     creation = hdf5::NewProperties(H5P_FILE_CREATE);
  hdf5::Check(H5Pset_fapl_core(access.get(), kIncrement, false), "a file in memory");
  hdf5::Check(H5Pset_userblock(creation.get(), kSealBytes), "the user block");
  return hdf5::Handle(H5Fcreate("state", H5F_ACC_TRUNC, creation.get(), access.get()),
                      H5Fclose, "a file in memory");
}

// Returns the complete bytes, valid until the file is closed.
std::span<char> BytesOf(const hdf5::Handle& file) {
  hdf5::Check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "flush");
  // The memory is longer than HDF5's part of the file.
  const ssize_t size =
      hdf5::Check(H5Fget_file_image(file.get(), nullptr, 0), "the size of the file");
  void* handle = nullptr;  // of this driver: where it keeps the address
  hdf5::Check(H5Fget_vfd_handle(file.get(), H5P_DEFAULT, &handle), "its memory");
  return {*static_cast<char**>(handle), kSealBytes + static_cast<std::size_t>(size)};
}

void WriteContent(hid_t file, const StateContent& content) {
  hdf5::SetText(file, "meaning", "the state of a render by lanelight");
  hdf5::SetNumber(file, "schema", kStateSchema);
  hdf5::WriteText(file, {"identity", "identity of the render (JSON)"}, content.identity);
  hdf5::WriteText(file, {"report", "progress of the render (JSON)"}, content.report);
  const auto write = [&](hid_t group, const StateColumn& column, const TileRows* tiles) {
    WriteColumn(group, column, tiles, content.compress);
  };
  const PixelRect window[] = {content.window};
  write(file,
        MakeStateColumn<std::int32_t>(
            "window", "the film: pixels [x0, x1) x [y0, y1), as x0 y0 x1 y1", window),
        nullptr);
  write(file,
        MakeStateColumn<std::int32_t>("tiles",
                                      "tiles whose pixels are in /pixels, one after the "
                                      "other, row by row: x0 y0 x1 y1",
                                      content.tiles),
        nullptr);
  const TileRows tiles(content.tiles, content.window);
  const hdf5::Handle pixels = hdf5::NewGroup(file, "pixels"),
                     tables = hdf5::NewGroup(file, "tables");
  for (const StateColumn& c : content.pixels) write(pixels.get(), c, &tiles);
  for (const StateColumn& c : content.tables) write(tables.get(), c, nullptr);
}

// Returns a copy of the rows, to which the column then refers. In large pages, because
// small ones take ten times as long to create as to fill.
UntouchedVector<char> MakeOwn(StateColumn& column) {
  const char* const from = static_cast<const char*>(column.data);
  UntouchedVector<char> copy;
  copy.reserve(column.Bytes());
  AdviseHugePages(copy.data(), column.Bytes());
  copy.resize(column.Bytes());
  ParallelForRange(copy.size(), 1 << 21, [&](std::size_t begin, std::size_t end) {
    std::memcpy(copy.data() + begin, from + begin, end - begin);
  });
  column.data = copy.data();
  return copy;
}

}  // namespace

void WriteState(const StateContent& content, const std::string& path) {
  CheckContent(content);
  const hdf5::Session session;
  try {
    const hdf5::Handle file = NewFile();
    WriteContent(file.get(), content);
    const std::span<char> bytes = BytesOf(file);
    Seal(bytes.data(), bytes.size(), kStateSchema);
    WriteFileAtomically(path, {bytes.data(), bytes.size()});
  } catch (const hdf5::Failure& failure) {
    throw CheckFailure(fmt::format("HDF5 cannot make a state: {}", failure.what()));
  }
}

StateCopy::StateCopy(const StateContent& content) : content_(content) {
  for (StateColumn& c : content_.pixels) memory_.push_back(MakeOwn(c));
  for (StateColumn& c : content_.tables) memory_.push_back(MakeOwn(c));
}

}  // namespace lanelight

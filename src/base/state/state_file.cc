#include "src/base/state/state_file.h"

#include <optional>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/state/columns.h"
#include "src/base/state/hdf5.h"
#include "src/base/state/seal.h"
#include "src/base/state/tiles.h"

namespace lanelight {
namespace {

// Opens the file that was checked, even if its path now names another. The driver "stdio"
// does not need the path, which may be gone.
hdf5::Handle OpenHdf5(int fd) {
  const hdf5::Handle access = hdf5::NewProperties(H5P_FILE_ACCESS);
  hdf5::Check(H5Pset_fapl_stdio(access.get()), "the driver stdio");
  hdf5::Check(H5Pset_file_locking(access.get(), false, true), "no locking");
  return hdf5::Handle(
      H5Fopen(fmt::format("/proc/self/fd/{}", fd).c_str(), H5F_ACC_RDONLY, access.get()),
      H5Fclose, "open");
}

// Limit of coordinates, so that differences do not overflow.
constexpr std::int32_t kFarthest = 1 << 30;

std::vector<PixelRect> ReadRects(hid_t file, const char* name) {
  std::vector<PixelRect> rects(ColumnRows(file, "", name));
  ReadColumns(file, "", {MakeStateColumn<std::int32_t>(name, "", rects)}, nullptr);
  for (const PixelRect& r : rects) {
    for (int value : {r.x0, r.y0, r.x1, r.y1}) {
      if (value >= -kFarthest && value <= kFarthest) continue;
      throw hdf5::Failure(fmt::format("{} has a coordinate {}", name, value));
    }
  }
  return rects;
}

}  // namespace

// The descriptor is closed after HDF5's file.
struct StateFile::Impl {
  const std::string path;
  const FileDescriptor fd;
  const std::uint64_t bytes;
  std::optional<hdf5::Handle> file;
  std::string identity, report;
  PixelRect window;
  std::vector<PixelRect> tiles;

  // Turns failures of HDF5 in action() into errors of this file.
  template <class Action>
  auto Do(const Action& action) const {
    const hdf5::Session session;
    try {
      return action();
    } catch (const hdf5::Failure& failure) {
      throw InputError("{}: {}", path, failure.what());
    }
  }

  explicit Impl(const std::string& p)
      : path(p), fd(OpenInputFile(p).fd), bytes(CheckSeal(fd.get(), p, kStateSchema)) {
    Do([this] {
      file.emplace(OpenHdf5(fd.get()));
      ReadHead(file->get());
    });
  }

  ~Impl() {
    const hdf5::Session session;
    file.reset();
  }

  void ReadHead(hid_t f) {
    identity = hdf5::ReadText(f, "identity");
    report = hdf5::ReadText(f, "report");
    const std::vector<PixelRect> windows = ReadRects(f, "window");
    if (windows.size() != 1) throw hdf5::Failure("window is not a single rectangle");
    window = windows[0];
    tiles = ReadRects(f, "tiles");
    const std::string problem = TileProblem(tiles, window);
    if (!problem.empty()) throw hdf5::Failure(problem);
  }
};

StateFile::StateFile(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
StateFile::~StateFile() = default;
StateFile::StateFile(StateFile&&) noexcept = default;
StateFile& StateFile::operator=(StateFile&&) noexcept = default;

const std::string& StateFile::path() const { return impl_->path; }
const std::string& StateFile::identity() const { return impl_->identity; }
const std::string& StateFile::report() const { return impl_->report; }
PixelRect StateFile::window() const { return impl_->window; }
const std::vector<PixelRect>& StateFile::tiles() const { return impl_->tiles; }

void StateFile::ReadPixels(const std::vector<MutableStateColumn>& into,
                           PixelRect window) const {
  for (const MutableStateColumn& column : into) {
    LL_CHECK_EQ(column.rows, window.pixels());
  }
  impl_->Do([&] {
    const std::string problem = TileProblem(impl_->tiles, window);
    if (!problem.empty()) throw hdf5::Failure(problem);
    const TileRows tiles(impl_->tiles, window);
    ReadColumns(impl_->file->get(), "pixels", into, &tiles);
  });
}

bool StateFile::HasPixels(const std::string& name) const {
  return impl_->Do([&] { return HasColumn(impl_->file->get(), "pixels", name); });
}

bool StateFile::HasTable(const std::string& name) const {
  return impl_->Do([&] { return HasColumn(impl_->file->get(), "tables", name); });
}

std::size_t StateFile::TableRows(const std::string& name) const {
  return impl_->Do([&] { return ColumnRows(impl_->file->get(), "tables", name); });
}

void StateFile::ReadTable(const MutableStateColumn& into) const {
  impl_->Do([&] { ReadColumns(impl_->file->get(), "tables", {into}, nullptr); });
}

}  // namespace lanelight

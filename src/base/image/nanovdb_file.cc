#include "src/base/image/nanovdb_file.h"

#include <fmt/format.h>

#include <blosc.h>
#include <zlib.h>

#include <algorithm>
#include <iostream>  // NanoVDB uses it and does not include it
#include <new>
#include <optional>
#include <vector>

#include "src/base/core/error.h"

// Layout of headers (NanoVDB 32). Its own reader does not check them.
#include <nanovdb/util/IO.h>

namespace lanelight {
namespace {

namespace io = nanovdb::io;

// Most bytes from one compressed byte: 1032 for zip, 255 for blosc's LZ4.
constexpr std::uint64_t kMaxExpansion = 1032;
// Bytes of a grid that blosc compresses at a time.
constexpr std::uint64_t kBloscChunk = std::uint64_t{1} << 30;

// Reads a file sequentially, never past its end.
class Reader {
 public:
  explicit Reader(std::istream& file) : file_(file) {
    const auto end = file_.seekg(0, std::ios::end).tellg();
    if (end < 0 || !file_.seekg(0))
      throw InputError("has an unknown size; it must be a regular file");
    size_ = static_cast<std::uint64_t>(end);
  }
  std::uint64_t place() const { return place_; }
  std::uint64_t left() const { return size_ - place_; }

  template <class... Args>
  [[noreturn]] static void Fail(std::uint64_t place, fmt::format_string<Args...> format,
                                Args&&... args) {
    throw InputError("byte {}: {}", place,
                     fmt::format(format, std::forward<Args>(args)...));
  }
  void RequireBytes(std::uint64_t count, const char* what) const {
    if (count <= left()) return;
    Fail(place_, "{} of {} bytes, but the file ends at byte {}", what, count, size_);
  }
  void Read(std::uint64_t count, const char* what, void* to) {
    RequireBytes(count, what);
    if (!file_.read(static_cast<char*>(to), static_cast<std::streamsize>(count))) {
      Fail(place_, "{} of {} bytes cannot be read", what, count);
    }
    place_ += count;
  }
  template <typename T>
  T Read(const char* what) {
    T value;
    Read(sizeof value, what, &value);
    return value;
  }
  void Skip(std::uint64_t count, const char* what) {
    RequireBytes(count, what);
    place_ += count;
    file_.seekg(static_cast<std::streamoff>(place_));
  }

 private:
  std::istream& file_;
  std::uint64_t size_ = 0, place_ = 0;
};

io::Header ReadHeader(Reader& reader) {
  const std::uint64_t place = reader.place();
  const auto header = reader.Read<io::Header>("the header of a segment");
  if (header.magic != NANOVDB_MAGIC_NUMBER) {
    reader.Fail(place, "{}",
                header.magic == io::reverseEndianness(NANOVDB_MAGIC_NUMBER)
                    ? "written on a machine with the other byte order"
                    : "wrong magic number of a NanoVDB file");
  }
  const auto version = header.version.getMajor();
  if (version != NANOVDB_MAJOR_VERSION_NUMBER) {
    reader.Fail(place + 8, "version {} of the format; supported: {}", version,
                NANOVDB_MAJOR_VERSION_NUMBER);
  }
  if (header.codec >= io::Codec::END) {
    reader.Fail(place + 14, "compression {}; supported: 0 (none), 1 (zip), 2 (blosc)",
                static_cast<int>(header.codec));
  }
  return header;
}

// Compressed bytes, after their number.
std::vector<std::uint8_t> ReadPacked(Reader& reader) {
  const auto size = reader.Read<std::uint64_t>("the size of a compressed grid");
  reader.RequireBytes(size, "a compressed grid");
  std::vector<std::uint8_t> packed(size);
  reader.Read(size, "a compressed grid", packed.data());
  return packed;
}

void Unzip(Reader& reader, GridBytes* bytes) {
  const std::uint64_t place = reader.place();
  const auto packed = ReadPacked(reader);
  uLongf size = bytes->size();
  const int status = uncompress(bytes->data(), &size, packed.data(), packed.size());
  if (status != Z_OK || size != bytes->size()) {
    reader.Fail(place, "the zip-compressed data is damaged");
  }
}

void Unblosc(Reader& reader, GridBytes* bytes) {
  for (std::size_t done = 0; done < bytes->size();) {
    const std::uint64_t place = reader.place();
    const auto packed = ReadPacked(reader);
    const std::size_t chunk = std::min<std::uint64_t>(kBloscChunk, bytes->size() - done);
    std::size_t size = 0;
    // Decompression does not check the sizes in the file.
    if (blosc_cbuffer_validate(packed.data(), packed.size(), &size) != 0 ||
        size != chunk ||
        blosc_decompress_ctx(packed.data(), bytes->data() + done, chunk, 1) !=
            static_cast<int>(chunk)) {
      reader.Fail(place, "the blosc-compressed data is damaged");
    }
    done += chunk;
  }
}

// Allocates no more than the rest of the file can unpack to.
GridBytes MakeRoom(const Reader& reader, io::Codec codec, std::uint64_t size) {
  if (codec == io::Codec::NONE) {
    reader.RequireBytes(size, "a grid");
  } else if (size / kMaxExpansion > reader.left()) {
    reader.Fail(reader.place(), "a grid of {} bytes cannot come from {} compressed bytes",
                size, reader.left());
  }
  try {
    return GridBytes(size);
  } catch (const std::bad_alloc&) {
    reader.Fail(reader.place(), "not enough memory for a grid of {} bytes", size);
  }
}

GridBytes Unpack(Reader& reader, io::Codec codec, std::uint64_t size) {
  auto bytes = MakeRoom(reader, codec, size);
  if (codec == io::Codec::ZIP) {
    Unzip(reader, &bytes);
  } else if (codec == io::Codec::BLOSC) {
    Unblosc(reader, &bytes);
  } else {
    reader.Read(size, "a grid", bytes.data());
  }
  return bytes;
}

}  // namespace

std::optional<StoredGrid> ReadStoredGrid(std::istream& file, const std::string& name) {
  Reader reader(file);
  do {
    const io::Header header = ReadHeader(reader);
    // The descriptions of all grids precede the grids.
    std::optional<std::uint64_t> size;  // of the grid that is looked for
    std::uint64_t before = 0;           // it, or before the next segment
    for (int i = 0; i < header.gridCount; ++i) {
      const auto meta = reader.Read<io::MetaData>("the description of a grid");
      reader.RequireBytes(meta.nameSize, "the name of a grid");
      std::string found(meta.nameSize, '\0');
      reader.Read(meta.nameSize, "the name of a grid", found.data());
      if (size) continue;
      if (found.c_str() == name) {
        size = meta.gridSize;
      } else {
        reader.RequireBytes(meta.fileSize, "a grid");
        before += meta.fileSize;
      }
    }
    reader.Skip(before, "grids");
    const std::uint64_t place = reader.place();
    if (size) return StoredGrid{Unpack(reader, header.codec, *size), place};
  } while (reader.left() > 0);
  return std::nullopt;
}

}  // namespace lanelight

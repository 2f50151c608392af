#include "src/accel/tree_file.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

#include "src/accel/tree_parts.h"
#include "src/core/check.h"
#include "src/core/error.h"
#include "src/core/hash.h"
#include "src/core/input_file.h"
#include "src/core/mapped_file.h"
#include "src/core/parallel.h"
#include "src/image/atomic_file.h"

namespace lanelight {
namespace {

constexpr std::string_view kTreeMagic("lanelight tree\n\0", 16);
constexpr std::uint64_t kByteOrder = 0x0102030405060708u;
constexpr std::size_t kPageBytes = 4096;
constexpr std::size_t kMostParts = 32;

struct PartPlace {
  std::uint64_t offset, count, element, hash;
};

struct TreeHeader {
  char magic[16];
  std::uint64_t byte_order, layout;
  TreeKey key;
  std::uint64_t length, parts;
  PartPlace part[kMostParts];
  std::uint64_t hash;  // of everything before
};
static_assert(sizeof(TreeHeader) <= kPageBytes &&
              std::is_trivially_copyable_v<TreeHeader>);

std::uint64_t HashOfHeader(const TreeHeader& header) {
  return Hash64(&header, offsetof(TreeHeader, hash));
}

std::uint64_t HashOfPart(const char* data, std::size_t bytes) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::vector<std::uint64_t> hashes((bytes + kBlock - 1) / kBlock);
  ParallelFor(hashes.size(), [&](std::size_t i) {
    const std::size_t begin = i * kBlock;
    hashes[i] = Hash64(data + begin, std::min(kBlock, bytes - begin));
  });
  return Hash64(hashes.data(), hashes.size() * sizeof(hashes[0]));
}

std::size_t RoundUp(std::size_t value, std::size_t unit) {
  return (value + unit - 1) / unit * unit;
}

// Where a part of `bytes` bytes begins, and what comes behind it may.
std::size_t PlaceOf(std::size_t end, std::size_t bytes) {
  return RoundUp(end, bytes >= kPageBytes ? kPageBytes : kCacheLine);
}
std::size_t EndOf(std::size_t offset, std::size_t bytes) {
  return RoundUp(offset + bytes + kCacheLine, kCacheLine);
}

[[noreturn]] void Refuse(const std::string& path, const std::string& why) {
  throw InputError(path + ": " + why);
}

void CheckHeader(const TreeHeader& header, std::size_t size, const TreeKey& key,
                 const std::string& path) {
  if (std::string_view(header.magic, sizeof(header.magic)) != kTreeMagic) {
    Refuse(path, "is not a tree file of lanelight, or its beginning is damaged");
  }
  if (header.byte_order != kByteOrder) {
    Refuse(path, "the tree is of a machine with another byte order");
  }
  if (header.layout != kTreeFileLayout) {
    Refuse(path, fmt::format("the tree is of layout {}; this program reads layout {}",
                             header.layout, kTreeFileLayout));
  }
  if (HashOfHeader(header) != header.hash) {
    Refuse(path, "the tree is damaged: its header does not have its checksum");
  }
  if (header.key != key) {
    Refuse(path, fmt::format("the tree is of other shapes ({})", header.key.Hex()));
  }
  if (header.length != size) {
    Refuse(path, fmt::format("the tree is torn: it has {} bytes and was written with {}",
                             size, header.length));
  }
}

MappedFile MapChecked(const std::string& path, const TreeKey& key, TreeHeader& header) {
  const InputFile file = OpenInputFile(path);
  if (file.size < kPageBytes) {
    Refuse(path, fmt::format("is too short for a tree: {} bytes", file.size));
  }
  MappedFile mapped = MapFile(file.fd.get(), path, file.size);
  std::memcpy(&header, mapped.data, sizeof(header));
  CheckHeader(header, file.size, key, path);
  return mapped;
}

template <typename T>
void Assign(const T* data, std::size_t count, const MappedFile& file,
            SharedArray<T>& array) {
  array = SharedArray<T>(data, count, file.owner);
}
template <typename T, typename Allocator>
void Assign(const T* data, std::size_t count, const MappedFile&,
            std::vector<T, Allocator>& array) {
  array.assign(data, data + count);
}
template <typename T>
void Assign(const T* data, std::size_t, const MappedFile&, T& value) {
  value = *data;
}

// Hands the members of an Accel what the file holds of them, in turn.
class PartReader {
 public:
  PartReader(const MappedFile& file, const TreeHeader& header, const std::string& path)
      : file_(file), header_(header), path_(path) {}

  template <typename Member>
  void Read(Member& member) {
    const TreePart now = PartOf(member);
    const PartPlace& place = header_.part[next_++];
    const bool is_array = requires { member.data(); };
    if (next_ > header_.parts || place.element != now.element || !Fits(place) ||
        (!is_array && place.count != 1)) {
      Refuse(path_,
             fmt::format("part {} of the tree is not as this program has it", next_));
    }
    const char* const data = file_.data + place.offset;
    if (HashOfPart(data, place.count * place.element) != place.hash) {
      Refuse(path_, fmt::format("the tree is damaged: part {} does not have its checksum",
                                next_));
    }
    Take(data, place.count, member);
  }
  bool AtEnd() const { return next_ == header_.parts; }

 private:
  bool Fits(const PartPlace& p) const {
    return p.offset % kCacheLine == 0 && p.offset <= header_.length &&
           p.count <= header_.length / p.element &&
           p.count * p.element + kCacheLine <= header_.length - p.offset;
  }
  template <typename Member>
  void Take(const char* data, std::size_t count, Member& member) const {
    if constexpr (requires { member.data(); }) {
      using T = std::remove_cvref_t<decltype(*member.data())>;
      Assign(reinterpret_cast<const T*>(data), count, file_, member);
    } else {
      Assign(reinterpret_cast<const Member*>(data), count, file_, member);
    }
  }

  const MappedFile& file_;
  const TreeHeader& header_;
  const std::string& path_;
  std::size_t next_ = 0;
};

}  // namespace

void WriteTreeFile(const std::string& path, const TreeKey& key, const Accel& accel) {
  TreeHeader header = {};
  std::memcpy(header.magic, kTreeMagic.data(), kTreeMagic.size());
  header.byte_order = kByteOrder;
  header.layout = kTreeFileLayout;
  header.key = key;
  char first[kPageBytes] = {}, zeros[kPageBytes + kCacheLine] = {};
  std::vector<std::string_view> content = {{first, sizeof(first)}};
  std::size_t end = sizeof(first);
  const auto fill = [&](std::size_t to) {
    content.emplace_back(zeros, to - end);
    end = to;
  };
  VisitParts(accel, [&](const auto& member) {
    const TreePart part = PartOf(member);
    const char* const data = static_cast<const char*>(part.data);
    fill(PlaceOf(end, part.bytes()));
    LL_CHECK_LT(header.parts, kMostParts);
    header.part[header.parts++] = {end, part.count, part.element,
                                   HashOfPart(data, part.bytes())};
    if (part.count > 0) content.emplace_back(data, part.bytes());
    end += part.bytes();
    fill(EndOf(end - part.bytes(), part.bytes()));
  });
  header.length = end;
  header.hash = HashOfHeader(header);
  std::memcpy(first, &header, sizeof(header));
  WriteCacheFile(path, content);
}

Accel ReadTreeFile(const std::string& path, const TreeKey& key) {
  TreeHeader header;
  const MappedFile file = MapChecked(path, key, header);
  Accel accel;
  PartReader reader(file, header, path);
  VisitParts(accel, [&](auto& member) { reader.Read(member); });
  if (!reader.AtEnd()) Refuse(path, "the tree has more parts than this program knows");
  return accel;
}

}  // namespace lanelight

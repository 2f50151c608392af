#include "src/scene/parse/ply.h"

#include <array>
#include <cmath>
#include <limits>

#include "src/scene/parse/bilinear_patch.h"
#include "src/scene/parse/ply_reader.h"

namespace lanelight {
namespace {

// Targets of vertex properties; others are skipped.
enum Slot { kX, kY, kZ, kNx, kNy, kNz, kU, kV, kSlots, kSkip = kSlots };

struct VertexLayout {
  std::vector<int> slots;  // per property
  std::array<bool, kSlots + 1> present{};

  bool has_normals() const { return present[kNx] && present[kNy] && present[kNz]; }
  bool has_uvs() const { return present[kU] && present[kV]; }
};

int SlotOf(const PlyProperty& property) {
  static constexpr const char* kNames[kSlots] = {"x",  "y",  "z", "nx",
                                                 "ny", "nz", "u", "v"};
  if (property.is_list) return kSkip;
  const std::string& name = property.name;
  if (name == "s" || name == "texture_u" || name == "texture_s") return kU;
  if (name == "t" || name == "texture_v" || name == "texture_t") return kV;
  for (int slot = 0; slot < kSlots; ++slot) {
    if (name == kNames[slot]) return slot;
  }
  return kSkip;
}

// Quads, by the position of their two triangles in the index list.
struct Faces {
  std::vector<std::size_t> quads;
  std::size_t others = 0;  // of neither 3 nor 4 corners
  bool found = false;
};

template <typename Reader>
class BodyReader {
 public:
  BodyReader(Reader reader, const PlyHeader& header) : reader_(reader), header_(header) {}

  PlyMesh Run() {
    for (const PlyElement& element : header_.elements) {
      CheckCount(element);
      if (element.name == "vertex") {
        ReadVertices(element);
      } else if (element.name == "face") {
        ReadFaces(element);
      } else {
        for (std::uint64_t i = 0; i < element.count; ++i) Skip(element);
      }
    }
    CheckIndices();
    return Finish();
  }

 private:
  template <class... Args>
  [[noreturn]] void Fail(fmt::format_string<Args...> format, Args&&... args) const {
    reader_.Fail(fmt::format(format, std::forward<Args>(args)...));
  }

  // Checks before anything is allocated whether the rest of the file can hold that many.
  void CheckCount(const PlyElement& element) {
    if (element.count == 0) return;
    if (element.properties.empty() ||
        element.count > std::numeric_limits<std::uint32_t>::max() ||
        element.count > reader_.Left(element.min_bytes())) {
      Fail(
          "the PLY header declares {} of element {}, more than the rest of the file can "
          "hold",
          element.count, Quoted(element.name));
    }
  }

  std::uint64_t ReadCount(const PlyProperty& list) {
    const double count = reader_.Read(list.count_type);
    if (!(count >= 0) || count != std::floor(count)) {
      Fail("{} is no length of the PLY list {}", count, Quoted(list.name));
    }
    if (count > static_cast<double>(reader_.Left(PlySize(list.type)))) {
      Fail("the PLY list {} has {} values, more than the rest of the file holds",
           Quoted(list.name), count);
    }
    return static_cast<std::uint64_t>(count);
  }

  void SkipProperty(const PlyProperty& property) {
    const std::uint64_t n = property.is_list ? ReadCount(property) : 1;
    for (std::uint64_t i = 0; i < n; ++i) reader_.Read(property.type);
  }

  void Skip(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) SkipProperty(property);
  }

  VertexLayout Layout(const PlyElement& element) {
    VertexLayout layout;
    for (const PlyProperty& property : element.properties) {
      int slot = SlotOf(property);
      if (slot != kSkip && layout.present[slot]) slot = kSkip;  // the first one counts
      layout.present[slot] = true;
      layout.slots.push_back(slot);
    }
    if (!layout.present[kX] || !layout.present[kY] || !layout.present[kZ]) {
      Fail("the PLY element \"vertex\" needs the properties x, y and z");
    }
    return layout;
  }

  void ReadVertices(const PlyElement& element) {
    if (!mesh_.positions.empty()) Fail("two PLY elements \"vertex\"");
    const VertexLayout layout = Layout(element);
    mesh_.positions.reserve(element.count);
    if (layout.has_normals()) mesh_.normals.reserve(element.count);
    if (layout.has_uvs()) mesh_.uvs.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      const std::array<double, kSlots + 1> v = ReadVertex(element, layout);
      mesh_.positions.push_back({v[kX], v[kY], v[kZ]});
      if (layout.has_normals()) mesh_.normals.push_back({v[kNx], v[kNy], v[kNz]});
      if (layout.has_uvs()) mesh_.uvs.push_back({v[kU], v[kV]});
    }
  }

  std::array<double, kSlots + 1> ReadVertex(const PlyElement& element,
                                            const VertexLayout& layout) {
    std::array<double, kSlots + 1> v{};
    for (std::size_t p = 0; p < layout.slots.size(); ++p) {
      if (layout.slots[p] == kSkip) {
        SkipProperty(element.properties[p]);
        continue;
      }
      v[layout.slots[p]] = reader_.Read(element.properties[p].type);
    }
    return v;
  }

  void ReadFaces(const PlyElement& element) {
    if (faces_.found) Fail("two PLY elements \"face\"");
    faces_.found = true;
    const PlyProperty* corners = nullptr;
    for (const PlyProperty& property : element.properties) {
      const bool named =
          property.name == "vertex_indices" || property.name == "vertex_index";
      if (named && property.is_list && corners == nullptr) corners = &property;
    }
    if (corners == nullptr) {
      Fail("the PLY element \"face\" needs the list vertex_indices");
    }
    mesh_.indices.reserve(element.count * 3);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property == corners) {
          ReadCorners(property, i);
        } else {
          SkipProperty(property);
        }
      }
    }
  }

  void ReadCorners(const PlyProperty& list, std::uint64_t face) {
    const std::uint64_t n = ReadCount(list);
    if (n != 3 && n != 4) {
      ++faces_.others;
      for (std::uint64_t i = 0; i < n; ++i) reader_.Read(list.type);
      return;
    }
    std::array<std::uint32_t, 4> corner{};
    for (std::uint64_t i = 0; i < n; ++i) {
      const double index = reader_.Read(list.type);
      if (!(index >= 0) || index != std::floor(index) || index > 4294967295.0) {
        Fail("{} in PLY face {} is not an index", index, face);
      }
      corner[i] = static_cast<std::uint32_t>(index);
    }
    if (n == 4) faces_.quads.push_back(mesh_.indices.size());
    mesh_.indices.insert(mesh_.indices.end(), corner.begin(), corner.begin() + 3);
    if (n == 4) {
      mesh_.indices.insert(mesh_.indices.end(), {corner[0], corner[2], corner[3]});
    }
  }

  // Runs last, because faces may precede vertices.
  void CheckIndices() {
    if (mesh_.positions.empty()) Fail("the PLY file has no vertices");
    if (mesh_.indices.empty()) {
      Fail("the PLY file has no faces of 3 or 4 corners");
    }
    for (std::uint32_t index : mesh_.indices) {
      if (index < mesh_.positions.size()) continue;
      Fail("a PLY face has the vertex index {}, but there are {} vertices", index,
           mesh_.positions.size());
    }
  }

  // Gives every face its own vertices with the default uvs (0,0) (1,0) (1,1) (0,1), so
  // that the two halves of a quad share their corners.
  void DuplicateVertices() {
    static constexpr std::array<double, 2> kUv[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    TriangleMesh out;
    auto quad = faces_.quads.begin();
    for (std::size_t i = 0; i < mesh_.indices.size();) {
      const bool is_quad = quad != faces_.quads.end() && *quad == i;
      const auto base = static_cast<std::uint32_t>(out.positions.size());
      for (int c = 0; c < (is_quad ? 4 : 3); ++c) {
        const std::uint32_t vertex = mesh_.indices[i + (c == 3 ? 5 : c)];
        out.positions.push_back(mesh_.positions[vertex]);
        if (!mesh_.normals.empty()) out.normals.push_back(mesh_.normals[vertex]);
        out.uvs.push_back(kUv[c]);
      }
      if (is_quad) *quad++ = out.indices.size();
      for (std::uint32_t c : {0u, 1u, 2u}) out.indices.push_back(base + c);
      if (is_quad) {
        for (std::uint32_t c : {0u, 2u, 3u}) out.indices.push_back(base + c);
      }
      i += is_quad ? 6 : 3;
    }
    mesh_ = std::move(out);
  }

  PlyMesh Finish() {
    if (!faces_.quads.empty() && mesh_.uvs.empty()) DuplicateVertices();
    PlyMesh result;
    if (!faces_.quads.empty()) mesh_.continues.resize(mesh_.indices.size() / 3);
    for (std::size_t first : faces_.quads) {
      mesh_.continues[first / 3 + 1] = true;
      std::uint32_t* index = mesh_.indices.data() + first;
      const std::array<std::uint32_t, 4> ring = {index[0], index[1], index[2], index[5]};
      std::array<Vec3d, 4> corners;
      for (int i = 0; i < 4; ++i) corners[i] = mesh_.positions[ring[i]];
      const QuadSplit split = SplitQuad(corners);
      if (!split.is_flat || !split.is_simple) ++result.bent_quads;
      for (int i = 0; i < 6; ++i) index[i] = ring[split.corners[i]];
    }
    result.mesh = std::move(mesh_);
    result.other_faces = faces_.others;
    RepairPly(&result);
    if (result.mesh.indices.empty()) {
      Fail("no face of the PLY file has corners with finite coordinates");
    }
    return result;
  }

  Reader reader_;
  const PlyHeader& header_;
  TriangleMesh mesh_;
  Faces faces_;
};

}  // namespace

PlyMesh ParsePly(std::string_view bytes, const std::string& name) {
  static_assert(std::endian::native == std::endian::little);
  const PlyHeader header = ParsePlyHeader(bytes, name);
  switch (header.format) {
    case PlyFormat::kAscii:
      return BodyReader(PlyTextReader(bytes, header, name), header).Run();
    case PlyFormat::kBinaryLittle:
      return BodyReader(PlyBinaryReader<false>(bytes, header, name), header).Run();
    case PlyFormat::kBinaryBig:
      return BodyReader(PlyBinaryReader<true>(bytes, header, name), header).Run();
  }
  return {};
}

}  // namespace lanelight

#include "src/scene/accel/build.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

ReusedBvh FindBvh(const Geometry& geometry, const AccelOptions& options,
                  const CachedBvh* known) {
  const Stopwatch watch;
  ReusedBvh tree;
  tree.report.shared = known != nullptr && known->key == KeyOf(geometry, options);
  tree.accel = tree.report.shared ? known->accel : BuildAccel(geometry, options);
  tree.report.seconds = watch.Seconds();
  tree.report.bytes = tree.accel.Bytes();
  return tree;
}

namespace {

// Collects the data to hash: values, and hashes of long arrays.
class KeyText {
 public:
  template <typename T>
  void Add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T>);
    text_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  // Adds `floats` floats of each record, copied by take(record, to). Parts of a fixed
  // size are hashed, so that the result does not depend on the number of threads.
  template <typename Records, typename Take>
  void AddFloats(const Records& records, std::size_t floats, const Take& take) {
    constexpr std::size_t kPart = 8192;
    const std::size_t parts = (records.size() + kPart - 1) / kPart;
    std::vector<Hash128> hashes(parts);
    ParallelFor(parts, [&](std::size_t p) {
      const std::size_t begin = p * kPart, end = std::min(begin + kPart, records.size());
      std::vector<float> values(floats * (end - begin));
      for (std::size_t i = begin; i < end; ++i) {
        take(records[i], &values[floats * (i - begin)]);
      }
      hashes[p] = HashTo128(values.data(), values.size() * sizeof(float));
    });
    Add(records.size());
    AddBytes(hashes);
  }
  template <typename Array>
  void AddBytes(const Array& array) {
    const std::size_t size = array.size() * sizeof(array[0]);
    Add(size);
    text_.append(reinterpret_cast<const char*>(array.data()), size);
  }

  BvhKey Key() const { return HashTo128(text_.data(), text_.size()); }

 private:
  std::string text_;
};

template <std::size_t n>
float* Copy(const float (&from)[n], float* to) {
  return std::copy(from, from + n, to);
}

void AddShapes(const Geometry& g, KeyText& text) {
  text.AddFloats(g.triangles, 9, [](const TriangleRecord& r, float* to) {
    for (const auto& corner : r.p) to = Copy(corner, to);
  });
  text.AddFloats(g.spheres, 4, [](const SphereRecord& r, float* to) {
    *Copy(r.center, to) = r.radius;
  });
  text.AddFloats(g.disks, 8, [](const DiskRecord& r, float* to) {
    to = Copy(r.normal, Copy(r.center, to));
    to[0] = r.radius;
    to[1] = r.inner_radius;
  });
  text.AddFloats(g.curves, 14, [](const CurveRecord& r, float* to) {
    for (const auto& point : r.p) to = Copy(point, to);
    Copy(r.width, to);
  });
  text.AddFloats(g.curve_spaces, 18, [](const CurveSpace& r, float* to) {
    Copy(r.scene_from_object, Copy(r.object_from_scene, to));
  });
  text.AddFloats(g.instances, 24, [](const InstanceRecord& r, float* to) {
    Copy(r.scene_from_object, Copy(r.object_from_scene, to));
  });
  text.AddBytes(g.motions);
}

}  // namespace

BvhKey KeyOf(const Geometry& geometry, const AccelOptions& options) {
  KeyText text;
  text.Add(options.few_triangles);
  text.Add(options.few_round);
  text.Add(options.quality);
  text.Add(options.leaf_triangles);
  text.Add(geometry.ranges);
  AddShapes(geometry, text);
  text.AddBytes(geometry.groups);
  text.AddBytes(geometry.instance_group);
  return text.Key();
}

}  // namespace lanelight

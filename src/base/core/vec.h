// Small fixed vectors for host code (double while describing a scene, float after
// compiling it). Kernels use hn:: vectors instead (kernels/simd/vec3-inl.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace lanelight {

template <typename T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vec3 operator*(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
  }
  friend constexpr Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, Vec3 a) { return a * s; }
  friend constexpr Vec3 operator/(Vec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  Vec3& operator*=(T s) { return *this = *this * s; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

template <typename T>
constexpr T Dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
constexpr Vec3<T> Cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T>
T Length(Vec3<T> a) {
  return std::sqrt(Dot(a, a));
}
/// Unit vector along `a`; the zero vector stays zero.
template <typename T>
Vec3<T> Normalize(Vec3<T> a) {
  const T length = Length(a);
  return length > T(0) ? a / length : a;
}
/// Largest absolute value of a component.
template <typename T>
T LargestComponent(Vec3<T> a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}
template <typename T>
constexpr Vec3<T> Min(Vec3<T> a, Vec3<T> b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <typename T>
constexpr Vec3<T> Max(Vec3<T> a, Vec3<T> b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
template <typename To, typename T>
constexpr Vec3<To> VecCast(Vec3<T> a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

/// Reads three floats.
inline Vec3d ToVec(const float* v) { return {v[0], v[1], v[2]}; }

/// Linear sRGB (Rec. 709 primaries, D65), scene-referred.
using Rgb = Vec3<double>;

/// Relative luminance (CIE Y) of a linear sRGB colour.
constexpr double Luminance(Rgb c) {
  return 0.212671 * c.x + 0.715160 * c.y + 0.072169 * c.z;
}

}  // namespace lanelight

// Environment images: look-up and sampling by texel.
#ifndef LANELIGHT_LIGHTS_ENVIRONMENT_INL_H_
#define LANELIGHT_LIGHTS_ENVIRONMENT_INL_H_

#include "kernels/lights/light-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

/// A direction drawn from a map of what lies infinitely far away.
struct MapSample {
  V3 direction, radiance;
  VF pdf_sa;  // excludes the selection of the light
};

LANELIGHT_INLINE V3 ByRows(const float* m, V3 v) {
  return {Dot(Splat3(m[0], m[1], m[2]), v), Dot(Splat3(m[3], m[4], m[5]), v),
          Dot(Splat3(m[6], m[7], m[8]), v)};
}

/// Converts a density per solid angle of a stretched environment to one of the scene. A
/// matrix of determinant 1 that makes unit vectors `length` long scales solid angles
/// around them by 1 / length^3.
LANELIGHT_INLINE VF Stretched(VF pdf, VF length) {
  return hn::Div(pdf, hn::Mul(hn::Mul(length, length), length));
}

LANELIGHT_INLINE void TexelValues(const Environment& e, const EnvironmentTable& table,
                                  VI row, VI column, MapSample* out) {
  const float inv_four_pi = 0.0795774715459476679f;
  const VI texel = hn::Add(hn::Mul(row, hn::Set(DI(), e.size)), column);
  out->radiance = Gather3(e.rgb.data(), texel);
  const float texels = static_cast<float>(e.size) * static_cast<float>(e.size);
  out->pdf_sa =
      hn::Mul(Gather(table.probability.data(), texel), Splat(texels * inv_four_pi));
}

/// Returns radiance and density of an environment in scene direction d.
LANELIGHT_INLINE MapSample LookUpEnvironment(const Environment& e,
                                             const EnvironmentTable& table, V3 d) {
  const DI di;
  V3 local = ByRows(e.light_from_scene, d);
  VF length = Splat(1.0f);
  if (e.stretched) {
    length = hn::Sqrt(Dot(local, local));
    local = Mul(local, hn::Div(Splat(1.0f), length));
  }
  VF s, t;
  OctahedralSquare(local, &s, &t);
  const VF size = Splat(static_cast<float>(e.size));
  const VI zero = hn::Zero(di), last = hn::Set(di, e.size - 1);
  const auto texel = [&](VF x) HWY_ATTR {
    return hn::Min(hn::Max(hn::ConvertTo(di, hn::Mul(x, size)), zero), last);
  };
  MapSample out;
  out.direction = d;
  TexelValues(e, table, texel(t), texel(s), &out);
  if (e.stretched) out.pdf_sa = Stretched(out.pdf_sa, length);
  return out;
}

LANELIGHT_INLINE MapSample LookUpEnvironment(const Wave& wave, std::size_t index, V3 d) {
  return LookUpEnvironment(wave.lights->environments[index],
                           *wave.chances->environments[index], d);
}

/// A distribution per lane: the begin of its values and of its guide.
struct Distribution {
  const float* cdf;
  const int32_t* guide;
  VI cdf_base, guide_base;
};

/// Returns the largest i in [0, size) with cdf[i] <= u in [0, 1), and u's position inside
/// that step.
LANELIGHT_INLINE VI InvertCdf(const Distribution& d, int32_t bits, VF u, VF* inside) {
  const DI di;
  const VI one = hn::Set(di, 1), last_part = hn::Set(di, (1 << bits) - 1);
  const VF scaled = hn::Mul(u, Splat(static_cast<float>(1 << bits)));
  const VI part = hn::Add(d.guide_base, hn::Min(hn::ConvertTo(di, scaled), last_part));
  VI low = Gather(d.guide, part), high = Gather(d.guide + 1, part);
  for (;;) {
    const auto open = hn::Lt(low, high);
    if (hn::AllFalse(di, open)) break;
    const VI middle = hn::ShiftRight<1>(hn::Add(hn::Add(low, high), one));
    const VF value = Gather(d.cdf, hn::Add(d.cdf_base, middle));
    const auto right = hn::RebindMask(di, hn::Le(value, u));
    low = hn::IfThenElse(right, middle, low);
    high = hn::IfThenElse(right, high, hn::Max(low, hn::Sub(middle, one)));
  }
  const VI at = hn::Add(d.cdf_base, low);
  const VF a = Gather(d.cdf, at), b = Gather(d.cdf + 1, at);
  const VF width = hn::Sub(b, a);
  *inside =
      hn::IfThenElse(hn::Gt(width, Splat(0)), hn::Div(hn::Sub(u, a), width), Splat(0.5f));
  return low;
}

/// Draws a direction of an environment with density proportional to the luminance of its
/// texel.
LANELIGHT_INLINE MapSample SampleEnvironment(const Environment& e,
                                             const EnvironmentTable& table, VF u0,
                                             VF u1) {
  const DI di;
  VF inside_row, inside_column;
  const VI zero = hn::Zero(di);
  const Distribution rows = {table.row_cdf.data(), table.row_guide.data(), zero, zero};
  const VI row = InvertCdf(rows, table.guide_bits, u1, &inside_row);
  const Distribution columns = {table.column_cdf.data(), table.column_guide.data(),
                                hn::Mul(row, hn::Set(di, e.size + 1)),
                                hn::Mul(row, hn::Set(di, (1 << table.guide_bits) + 1))};
  const VI column = InvertCdf(columns, table.guide_bits, u0, &inside_column);
  const VF inv_size = Splat(1.0f / static_cast<float>(e.size));
  const VF s = hn::Mul(hn::Add(hn::ConvertTo(DF(), column), inside_column), inv_size);
  const VF t = hn::Mul(hn::Add(hn::ConvertTo(DF(), row), inside_row), inv_size);
  const V3 w = OctahedralDirection(s, t);
  MapSample out;
  out.direction = ByRows(e.scene_from_light, w);
  TexelValues(e, table, row, column, &out);
  if (e.stretched) {
    const VF one = Splat(1.0f), length = hn::Sqrt(Dot(out.direction, out.direction));
    out.direction = Mul(out.direction, hn::Div(one, length));
    out.pdf_sa = Stretched(out.pdf_sa, hn::Div(one, length));
  }
  return out;
}
LANELIGHT_INLINE MapSample SampleEnvironment(const Wave& wave, std::size_t index, VF u0,
                                             VF u1) {
  return SampleEnvironment(wave.lights->environments[index],
                           *wave.chances->environments[index], u0, u1);
}

LANELIGHT_END_KERNELS

#endif

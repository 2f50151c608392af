// Curves: nearest hits and shadow rays against the recursion of the reference tracer, in
// double precision, and the surfaces there.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "src/scene/accel/curve_pieces.h"
#include "tests/kernels/intersect/trace.h"
#include "tests/reference/curves.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

constexpr float kFarAway = std::numeric_limits<float>::infinity();

struct CurveSet {
  std::vector<Curve> curves;  // as rounded to float

  void Add(const std::array<Vec3f, 4>& p, float width0, float width1,
           CurveType type = CurveType::kFlat) {
    Curve curve;
    for (int k = 0; k < 4; ++k)
      curve.p[k] = VecCast<double>(p[static_cast<std::size_t>(k)]);
    curve.width[0] = width0, curve.width[1] = width1;
    curve.type = type;
    curves.push_back(curve);
  }

  Geometry Records() const {
    Geometry g;
    for (const Curve& curve : curves) {
      CurveRecord record{};
      RibbonRecord ribbon{};
      for (int k = 0; k < 4; ++k) {
        for (int a = 0; a < 3; ++a) record.p[k][a] = static_cast<float>(curve.p[k][a]);
      }
      for (int end = 0; end < 2; ++end) {
        record.width[end] = static_cast<float>(curve.width[end]);
        for (int a = 0; a < 3; ++a) {
          ribbon.normal[end][a] = static_cast<float>(curve.normal[end][a]);
        }
      }
      record.type = static_cast<std::uint32_t>(curve.type);
      const double angle =
          std::acos(std::clamp(Dot(curve.normal[0], curve.normal[1]), -1.0, 1.0));
      if (curve.type == CurveType::kRibbon && angle > 0) {
        ribbon.angle = static_cast<float>(angle);
        ribbon.inverse_sine = static_cast<float>(1 / std::sin(angle));
      }
      g.curves.push_back(record);
      g.ribbons.push_back(ribbon);
    }
    return g;
  }
};

// Numbers for curves and rays.
struct CurveRandom {
  std::mt19937 engine;
  float operator()(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine);
  }
  Vec3f Point(float size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }
  Vec3f Direction() {
    for (;;) {
      const Vec3f d = Point(1);
      if (Dot(d, d) > 0.01f && Dot(d, d) < 1) return Normalize(d);
    }
  }
};

// Curly, straight and degenerate ones, of all types and widths over three decades.
CurveSet RandomCurves(int count, unsigned seed) {
  CurveRandom random{std::mt19937(seed)};
  CurveSet set;
  for (int i = 0; i < count; ++i) {
    const Vec3f at = random.Point(1), step = 0.3f * random.Direction();
    const float curl = i % 3 == 0 ? 0.0f : random(0, 0.4f);
    std::array<Vec3f, 4> p;
    for (int k = 0; k < 4; ++k) {
      p[static_cast<std::size_t>(k)] =
          at + static_cast<float>(k) * step + curl * random.Direction();
    }
    if (i % 11 == 0) p[1] = p[0];
    if (i % 13 == 0) p[2] = p[3];
    if (i % 17 == 0) p[2] = p[1] = p[0];
    const float width = 0.1f * std::pow(10.0f, -random(0, 3));
    set.Add(p, width, width * random(0, 1), static_cast<CurveType>(i % 3));
    Curve& curve = set.curves.back();
    if (curve.type != CurveType::kRibbon) continue;
    for (Vec3d& n : curve.normal) n = VecCast<double>(random.Direction());
    if (i % 2 == 0) curve.normal[1] = curve.normal[0];
    for (Vec3d& n : curve.normal) n = Normalize(n);
  }
  return set;
}

// Rays through places near curves, from outside and from among them; some along them.
std::vector<TestRay> RaysAtCurves(const CurveSet& set, int count, unsigned seed) {
  CurveRandom random{std::mt19937(seed)};
  std::vector<TestRay> rays;
  for (int i = 0; i < count; ++i) {
    const Curve& curve = set.curves[random.engine() % set.curves.size()];
    const double u = random(-0.02f, 1.02f), w = 1 - u;
    const Vec3d at = w * w * w * curve.p[0] + 3 * w * w * u * curve.p[1] +
                     3 * w * u * u * curve.p[2] + u * u * u * curve.p[3];
    const Vec3d aside = VecCast<double>(random.Direction()) * (0.6 * curve.width[0]);
    Vec3f d = random.Direction();
    if (i % 10 == 0) {
      const Vec3d chord = curve.p[3] - curve.p[0];
      d = Normalize(VecCast<float>(chord) + 0.02f * random.Direction());
    }
    const Vec3f target = VecCast<float>(at + aside);
    rays.push_back({target - random(0.01f, 2) * d, d});
    rays.back().d = Normalize(rays.back().d);
  }
  return rays;
}

// The nearest hit by the reference, widths times `factor`, of the ray moved by `shift`.
reference::Hit CurveTruth(const CurveSet& set, const TestRay& ray, double factor,
                          Vec3d shift = {}) {
  reference::Hit nearest;
  const reference::Ray exact = {VecCast<double>(ray.o) + shift,
                                Normalize(VecCast<double>(ray.d))};
  for (std::size_t i = 0; i < set.curves.size(); ++i) {
    Curve curve = set.curves[i];
    for (double& width : curve.width) width *= factor;
    reference::Hit hit = nearest;
    if (reference::IntersectCurve(curve, exact, hit) == 1) {
      nearest = hit;
      nearest.primitive = static_cast<int>(i);
    }
  }
  return nearest;
}

bool AgreesOnCurve(const KernelHit& hit, const reference::Hit& truth) {
  if (truth.primitive == kNone) return std::isinf(hit.t);
  return !std::isinf(hit.t) && hit.prim == static_cast<std::uint32_t>(truth.primitive) &&
         std::abs(hit.t - truth.t) < 2e-4 && std::abs(hit.b1 - truth.b1) < 2e-3;
}

// Bound on the error of a curve's place across a ray, at distance t. In units of 2^-24,
// to first order: p - o rounds by t, its products with the frame by 3 t, and the frame is
// off by 10 (5.4 of its entries, 4 of the length of d); the points of pieces round by |p|
// < 2, and the cubic of a piece shorter than 1 by 10. Without fused operations.
double PlaceError(double t) { return 26 * 0x1p-24 * std::max(t, 1.0); }

// Returns whether the hit is right for a ray within PlaceError. A ribbon seen from its
// side may be narrower than that.
bool AgreesBeside(const CurveSet& set, const TestRay& ray, const KernelHit& hit) {
  const reference::Hit truth = CurveTruth(set, ray, 1);
  const double t = truth.primitive == kNone ? hit.t : truth.t;
  const Vec3d d = Normalize(VecCast<double>(ray.d));
  const Vec3d x =
      Normalize(Cross(d, std::abs(d.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
  const Vec3d y = Cross(d, x);
  constexpr int kDirections = 8;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * std::numbers::pi * k / kDirections;
    const Vec3d shift = PlaceError(t) * (std::cos(angle) * x + std::sin(angle) * y);
    if (AgreesOnCurve(hit, CurveTruth(set, ray, 1, shift))) return true;
  }
  return false;
}

// What is decided by roundings: the edge of a curve, and its ends.
bool IsOnEdge(const CurveSet& set, const TestRay& ray, const KernelHit& hit) {
  if (AgreesOnCurve(hit, CurveTruth(set, ray, 0.99)) ||
      AgreesOnCurve(hit, CurveTruth(set, ray, 1.01)) || AgreesBeside(set, ray, hit))
    return true;
  const auto near_end = [](double u) { return u < 1e-3 || u > 1 - 1e-3; };
  const reference::Hit truth = CurveTruth(set, ray, 1);
  return (!std::isinf(hit.t) && near_end(hit.b1)) ||
         (truth.primitive != kNone && near_end(truth.b1));
}

std::vector<KernelHit> TraceStrands(const CompiledScene& scene,
                                    const std::vector<TestRay>& rays) {
  return TraceClosest(scene, rays, {IntersectCurvesStage});
}

// Computes the surface points of the rays that hit a curve.
Queue& FindSurfaces(WaveFixture& fixture, const std::vector<TestRay>& rays) {
  fixture.SetRays(rays);
  fixture.Run(IntersectCurvesStage, {});
  Queue& surface = fixture.wave.queue(QueueId::kSurface);
  surface.size = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (!std::isinf(fixture.wave.path.t[i])) surface.items[surface.size++] = i;
  }
  fixture.Run(SurfaceCurveStage, {});
  return surface;
}

}  // namespace

TEST_CASE("curves are hit where the reference hits them", "[intersect][curves]") {
  const CurveSet set = RandomCurves(60, 1);
  const CompiledScene scene = MakeScene(set.Records());
  const std::vector<TestRay> rays = RaysAtCurves(set, 20000, 2);
  const EachTarget target;
  const std::vector<KernelHit> hits = TraceStrands(scene, rays);
  int hit = 0, close = 0, wrong = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hit += !std::isinf(hits[i].t);
    if (AgreesOnCurve(hits[i], CurveTruth(set, rays[i], 1))) continue;
    ++close;
    wrong += !IsOnEdge(set, rays[i], hits[i]);
  }
  INFO(hit << " hits, " << close << " decided by roundings");
  CHECK(hit > 8000);
  CHECK(close < 100);
  CHECK(wrong == 0);
}

TEST_CASE("shadow rays are blocked by curves as others hit them", "[intersect][curves]") {
  const CurveSet set = RandomCurves(60, 3);
  const CompiledScene scene = MakeScene(set.Records());
  std::vector<TestRay> rays = RaysAtCurves(set, 20000, 4);
  const std::vector<KernelHit> hits = TraceStrands(scene, rays);
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    // Up to just before the hit, just behind it, and all the way.
    rays[i].t_max = i % 3 == 0 ? hits[i].t * 0.999f : hits[i].t * 1.001f;
    if (i % 3 == 2) rays[i].t_max = 10;
    if (!(hits[i].t < rays[i].t_max)) open.push_back(i);
  }
  CHECK(open.size() > 5000);
  CHECK(open.size() < 18000);
  CHECK(Unoccluded(scene, rays, {ShadowCurvesStage}) == open);
}

TEST_CASE("rays beyond the ends of curves miss", "[intersect][curves]") {
  // Ends cut straight across; where points coincide too.
  const std::array<Vec3f, 4> ends[] = {{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}},
                                       {{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {3, 0, 0}}},
                                       {{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {3, 0, 0}}},
                                       {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {3, 0, 0}}},
                                       {{{0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {3, 0, 0}}}};
  for (const float width : {0.2f, 0.01f, 1.8f}) {
    for (const auto& p : ends) {
      CurveSet set;
      set.Add(p, width, width);
      const CompiledScene scene = MakeScene(set.Records());
      std::vector<TestRay> rays;
      for (const float x : {-0.001f, 0.001f, 1.5f, 2.999f, 3.001f}) {
        for (const float y : {-0.51f, -0.49f, 0.0f, 0.49f, 0.51f}) {
          rays.push_back({{x, y * width, 1}, {0, 0, -1}});
        }
      }
      const std::vector<KernelHit> hits = TraceStrands(scene, rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool along = i / 5 > 0 && i / 5 < 4, across = i % 5 > 0 && i % 5 < 4;
        INFO("width " << width << ", x " << rays[i].o.x << ", y " << rays[i].o.y);
        CHECK(std::isinf(hits[i].t) == !(along && across));
        if (along && across) CHECK(hits[i].t == Approx(1).margin(1e-5));
      }
    }
  }
}

TEST_CASE("curves are hit in front of a ray only; ties go to the smaller index",
          "[intersect][curves]") {
  CurveSet set;
  for (int i = 0; i < 3; ++i) {
    set.Add({{{-1.5f, 0, 0}, {-0.5f, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}}}, 0.2f, 0.2f);
  }
  const CompiledScene scene = MakeScene(set.Records());
  const auto hits = TraceStrands(scene, {{{0.1f, 0, 1}, {0, 0, -1}},
                                         {{0.1f, 0, 1}, {0, 0, 1}},
                                         {{0.1f, 0, 1}, {0, 0, -1}, 0.9f},
                                         {{-3, 0, 0}, {1, 0, 0}}});
  CHECK(hits[0].prim == 0);
  CHECK(hits[0].t == Approx(1));
  CHECK(hits[0].b1 == Approx(1.6 / 3));
  CHECK(std::isinf(hits[1].t));
  CHECK(hits[2].t == 0.9f);  // what there was
  CHECK(std::isinf(hits[3].t));
}

TEST_CASE("curves with numbers that are not finite are left out", "[intersect][curves]") {
  CurveSet set;
  set.Add({{{-1, 0, 0}, {0, NAN, 0}, {0, 0, 0}, {1, 0, 0}}}, 0.2f, 0.2f);
  set.Add({{{-1, 0, -1}, {0, 0, -1}, {0, 0, -1}, {1, 0, -1}}}, 0.2f, 0.2f);
  set.Add({{{-1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {kFarAway, 0, 0}}}, 0.2f, 0.2f);
  const CompiledScene scene = MakeScene(set.Records());
  const auto hits = TraceStrands(scene, {{{0.1f, 0, 1}, {0, 0, -1}}});
  CHECK(hits[0].prim == 1);
}

TEST_CASE("bounding boxes of pieces cover their curve", "[accel][curves]") {
  const Geometry g = RandomCurves(200, 5).Records();
  const std::vector<CurvePiece> pieces = PiecesOf(g, 7);
  std::size_t begin = 0;
  for (std::uint32_t i = 0; i < g.curves.size(); ++i) {
    const std::size_t count = std::size_t{1} << (pieces.at(begin).part >> 24);
    CHECK(count <= 64);
    for (std::size_t k = 0; k < count; ++k) {
      const CurvePiece& piece = pieces.at(begin + k);
      CHECK(piece.prim == 7 + i);
      CHECK((piece.part & 0xffffff) == k);
      if (k + 1 == count) continue;
      const CurvePiece& next = pieces.at(begin + k + 1);
      CHECK(std::equal(piece.p[3], piece.p[3] + 3, next.p[0]));
      CHECK(piece.radius[1] == next.radius[0]);
    }
    CHECK(std::equal(pieces[begin].p[0], pieces[begin].p[0] + 3, g.curves[i].p[0]));
    begin += count;
  }
  CHECK(begin == pieces.size());
}

TEST_CASE("surfaces of curves are those of the reference", "[surface][curves]") {
  const CurveSet set = RandomCurves(60, 6);
  CompiledScene scene = MakeScene(set.Records());
  for (std::uint32_t i = 0; i < scene.geometry.curves.size(); ++i) {
    scene.geometry.curves[i].material = i;
  }
  const std::vector<TestRay> rays = RaysAtCurves(set, 20000, 7);
  const EachTarget target;
  WaveFixture fixture(scene, static_cast<std::uint32_t>(rays.size()));
  const Queue& surface = FindSurfaces(fixture, rays);
  const PathColumns& p = fixture.wave.path;
  CHECK(surface.size > 8000);
  double worst_p = 0, worst_n = 0, worst_v = 0, worst_u = 0, worst_tangent = 0;
  int wrong = 0;
  for (std::uint32_t k = 0; k < surface.size; ++k) {
    const std::uint32_t i = surface.items[k];
    const Curve& curve = set.curves[p.prim[i]];
    reference::Hit hit;
    hit.t = p.t[i];
    hit.b1 = p.b1[i];
    const reference::Ray ray = {VecCast<double>(rays[i].o),
                                Normalize(VecCast<double>(rays[i].d))};
    const auto want = reference::DescribeCurve(curve, ray, hit);
    wrong += p.material[i] != p.prim[i];
    const Vec3d tg = {p.tg_x[i], p.tg_y[i], p.tg_z[i]};
    const Vec3d tv = {p.tv_x[i], p.tv_y[i], p.tv_z[i]};
    const Vec3d ng = VecCast<double>(fixture.Ng(i));
    worst_p = std::max(worst_p, Length(VecCast<double>(fixture.P(i)) - want.p));
    worst_u = std::max(worst_u, std::abs(p.uv_u[i] - want.u));
    worst_tangent = std::max(worst_tangent, Length(tg - want.dpdu));
    wrong += ng != VecCast<double>(fixture.Ns(i));
    // A tangent along the ray, or one that vanishes, leaves the side open.
    const Vec3d along = Normalize(want.dpdu);
    const bool ribbon = curve.type == CurveType::kRibbon;
    if (!ribbon && std::abs(Dot(along, ray.d)) > 0.99) continue;
    if (ribbon && std::abs(Dot(along, want.ng)) > 0.01) continue;
    if (Length(want.dpdu) < 0.01 || Length(want.dpdv) < 2e-5) continue;
    worst_n = std::max(worst_n, Length(ng - want.ng));
    worst_v = std::max(worst_v, std::abs(p.uv_v[i] - want.v));
    const double width = Length(want.dpdv);
    wrong += !(Length(tv - want.dpdv) < 0.05 * width + 1e-6);
    wrong += !(p.p_error[i] > 0 && p.p_error[i] < 2e-6);
  }
  CHECK(wrong == 0);
  CHECK(worst_p < 1e-6);
  CHECK(worst_u == 0);
  CHECK(worst_tangent < 1e-5);
  CHECK(worst_n < 0.05);
  CHECK(worst_v < 0.02);
}

TEST_CASE("rays that leave a straight curve do not hit it again", "[surface][curves]") {
  CurveRandom random{std::mt19937(8)};
  CurveSet set;
  const Vec3f d = random.Direction();
  for (int i = 0; i < 3; ++i) {
    const Vec3f at = 4.0f * random.Direction();
    set.Add({{at, at + 0.3f * d, at + 0.6f * d, at + 0.9f * d}}, 0.05f, 0.05f,
            static_cast<CurveType>(i));
    for (Vec3d& n : set.curves.back().normal) {
      n = Normalize(Cross(VecCast<double>(d), Vec3d{1, 2, 3}));
    }
  }
  const CompiledScene scene = MakeScene(set.Records());
  const std::vector<TestRay> rays = RaysAtCurves(set, 5000, 9);
  WaveFixture fixture(scene, static_cast<std::uint32_t>(rays.size()));
  const Queue& surface = FindSurfaces(fixture, rays);
  const PathColumns& p = fixture.wave.path;
  std::vector<TestRay> leaving;
  std::vector<std::uint32_t> from;
  for (std::uint32_t k = 0; k < surface.size; ++k) {
    const std::uint32_t i = surface.items[k];
    for (int j = 0; j < 20; ++j) {
      const Vec3f next = random.Direction(), n = fixture.Ng(i);
      const float side = std::copysign(p.p_error[i], Dot(n, next));
      leaving.push_back({fixture.P(i) + side * n, next});
      from.push_back(p.prim[i]);
    }
  }
  const std::vector<KernelHit> hits = TraceStrands(scene, leaving);
  int again = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    again += !std::isinf(hits[i].t) && hits[i].prim == from[i];
  }
  CHECK(hits.size() > 20000);
  CHECK(again == 0);
}

}  // namespace lanelight

// Files of measured reflectance: what is read of them, and what is wrong with damaged
// ones.
#include "src/base/image/measured_reflectance.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "tests/fuzz/measured_fuzz.h"
#include "tests/reference/measured.h"
#include "tests/reference/random.h"
#include "tests/support/input_error.h"

namespace lanelight::test {
namespace {

using reference::TensorField;

reference::MeasuredModel SmallModel() {
  reference::MeasuredModel model = reference::ChalkModel(0.5);
  model.thetas = 3, model.size = 3, model.normals_size = 5;
  return model;
}

std::shared_ptr<const MeasuredReflectance> ReadBytes(const std::string& bytes) {
  std::istringstream file(bytes);
  return ReadMeasuredReflectance(file, "x.bsdf");
}

std::string ErrorOfFile(const std::string& bytes) {
  return InputErrorOf([&] { ReadBytes(bytes); });
}

TensorField& FieldOf(std::vector<TensorField>& fields, const std::string& name) {
  return *std::find_if(fields.begin(), fields.end(),
                       [&](const TensorField& f) { return f.name == name; });
}

// The error after a change to one field of the small model.
template <typename Change>
std::string ErrorWith(const std::string& name, const Change& change) {
  std::vector<TensorField> fields = reference::MeasuredFields(SmallModel());
  change(FieldOf(fields, name));
  return ErrorOfFile(reference::TensorFileOf(fields));
}

// Means over the hemisphere of f cos and of its error, relative to the model's.
double MeanError(const MeasuredReflectance& m, const reference::MeasuredModel& model,
                 Vec3d known) {
  reference::Random random(3);
  double off = 0, sum = 0;
  for (int i = 0; i < 2000; ++i) {
    const double z = random.Uniform(), phi = 6.283185307179586 * random.Uniform();
    const double r = std::sqrt(1 - z * z);
    const Vec3d other = {r * std::cos(phi), r * std::sin(phi), z};
    const double want = model.f_cos(550, known, other);
    const double found = reference::EvaluateMeasuredCos(m, known, other).y;
    off += std::abs(found - want), sum += want;
  }
  return off / sum;
}

}  // namespace

TEST_CASE("measured files: values and metadata are read", "[image][measured]") {
  const auto m = ReadBytes(reference::MeasuredFile(SmallModel()));
  CHECK(m->isotropic());
  CHECK(m->parts() == 1);
  CHECK(m->theta.size() == 3);
  CHECK(m->ndf.width == 5);
  CHECK(m->luminance.height == 3);
  CHECK(m->reflectance.values.size() == 3 * 3 * 9);
  reference::MeasuredModel half = reference::MetalModel(0.5, 0.2);
  half.thetas = 3, half.size = 3, half.normals_size = 5, half.phis = 4, half.parts = 2;
  CHECK(ReadBytes(reference::MeasuredFile(half))->parts() == 2);
  CHECK_FALSE(ReadBytes(reference::MeasuredFile(half))->isotropic());
}

TEST_CASE("measured files: spectra become colours", "[image][measured]") {
  // A grey of one half is one half in all channels; red is redder than blue.
  const auto grey = ReadBytes(reference::MeasuredFile(SmallModel()));
  const Rgb f = reference::EvaluateMeasuredCos(*grey, {0, 0, 1}, {0.6, 0, 0.8});
  CHECK(f.x == Approx(f.y).epsilon(1e-5));
  CHECK(f.z == Approx(f.y).epsilon(1e-5));
  reference::MeasuredModel model = reference::MetalModel(0.5, 0.5, 0.1, 0.9);
  model.thetas = 3, model.size = 3, model.normals_size = 9;
  const auto red = ReadBytes(reference::MeasuredFile(model));
  const Rgb r = reference::EvaluateMeasuredCos(*red, {0, 0, 1}, {0.28, 0, 0.96});
  CHECK(r.x > 1.5 * r.y);
  CHECK(r.y > 1.5 * r.z);
}

TEST_CASE("measured files: models round-trip", "[image][measured]") {
  for (const bool chalk : {true, false}) {
    const auto model =
        chalk ? reference::ChalkModel(0.5) : reference::MetalModel(0.4, 0.4, 0.6, 0.6);
    const auto m = ReadBytes(reference::MeasuredFile(model));
    for (const double z : {1.0, 0.8, 0.4}) {
      INFO("chalk " << chalk << ", z " << z);
      CHECK(MeanError(*m, model, {std::sqrt(1 - z * z), 0, z}) < 0.06);
    }
  }
  // A density of one known direction for all of them is seen.
  auto wrong = *ReadBytes(reference::MeasuredFile(reference::MetalModel(0.4, 0.4)));
  const auto size = wrong.vndf.values.size() / wrong.theta.size();
  for (std::size_t i = size; i < wrong.vndf.values.size(); ++i) {
    wrong.vndf.values[i] = wrong.vndf.values[i % size];
  }
  CHECK(MeanError(wrong, reference::MetalModel(0.4, 0.4), {0.9, 0, std::sqrt(0.19)}) >
        0.12);
}

TEST_CASE("measured files: errors say where and what", "[image][measured]") {
  using Catch::Contains;
  const std::string good = reference::MeasuredFile(SmallModel());
  CHECK_THAT(ErrorOfFile("PK\3\4"),
             Contains("\"x.bsdf\": byte 0: does not start with \"tensor_file\""));
  CHECK_THAT(ErrorOfFile(good.substr(0, 15)), Contains("the file ends within"));
  std::string version = good;
  version[12] = 2;
  CHECK_THAT(ErrorOfFile(version), Contains("version 2.0; supported: 1.0"));
  CHECK_THAT(ErrorOfFile(good.substr(0, good.size() - 1)),
             Contains("but the file ends at byte"));
  CHECK_THAT(ErrorWith("ndf", [](TensorField& f) { f.name = "rgb"; }),
             Contains("has no field \"ndf\""));
  CHECK_THAT(ErrorWith("ndf", [](TensorField& f) { f.name = "sigma"; }),
             Contains("a second field \"sigma\""));
  CHECK_THAT(ErrorWith("sigma", [](TensorField& f) { f.shape = {25, 1}; }),
             Contains("field \"sigma\" has the shape [25, 1]"));
  CHECK_THAT(ErrorWith("vndf", [](TensorField& f) { f.shape = {3, 5, 5}; }),
             Contains("expected [1, 3, height, width]"));
  CHECK_THAT(ErrorWith("vndf", [](TensorField& f) { f.numbers[7] = NAN; }),
             Contains("number 7 of \"vndf\" is nan"));
  CHECK_THAT(
      ErrorWith("vndf",
                [](TensorField& f) { std::fill_n(f.numbers.begin() + 25, 25, 0.0f); }),
      Contains("slice 1 of \"vndf\" is 0 everywhere"));
  CHECK_THAT(ErrorWith("theta_i", [](TensorField& f) { f.numbers[2] = 0.1f; }),
             Contains("\"theta_i\" does not increase"));
  CHECK_THAT(ErrorWith("theta_i", [](TensorField& f) { f.numbers[2] = 2; }),
             Contains("not within 0 and 1.571"));
  CHECK_THAT(ErrorWith("theta_i",
                       [](TensorField& f) {
                         f.shape = {5000}, f.numbers.clear();
                         for (int i = 0; i < 5000; ++i) f.numbers.push_back(1e-4f * i);
                       }),
             Contains("has the shape [5000]; expected [count], at most 4096"));
  CHECK_THAT(ErrorWith("jacobian", [](TensorField& f) { f.bytes[0] = 0; }),
             Contains("\"jacobian\" is not one uint8 other than 0"));
  CHECK_THAT(ErrorWith("ndf",
                       [](TensorField& f) {
                         f.numbers.clear();
                         f.bytes.assign(25, '\1');
                       }),
             Contains("field \"ndf\" of type uint8; supported: float32"));
}

TEST_CASE("measured files: a file with any byte changed loads or is an input error",
          "[image][measured]") {
  const std::string good = reference::MeasuredFile(SmallModel());
  CHECK(FuzzMeasuredFile(good));
  int loads = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const int flip : {0xff, 0x80, 0x01}) {
      std::string changed = good;
      changed[at] = static_cast<char>(changed[at] ^ flip);
      loads += FuzzMeasuredFile(changed) ? 1 : 0;
    }
  }
  CHECK(loads > 0);
  for (std::size_t size = 0; size < good.size(); size += 7) {
    CHECK_FALSE(FuzzMeasuredFile(good.substr(0, size)));
  }
}

}  // namespace lanelight::test

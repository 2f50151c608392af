// What pages ask for, and what they are sent.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <half.h>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/measure/live/session.h"
#include "tests/measure/live/live_scene.h"

namespace lanelight::live {
namespace {

class NoObserver : public PassObserver {
 public:
  bool IsDue() const override { return false; }
  void Observe() override {}
};

struct ReadPicture {
  nlohmann::json head;
  std::vector<half> values;
};

ReadPicture Read(const std::string& message) {
  std::uint32_t length = 0;
  for (int i = 0; i < 4; ++i) {
    length |= static_cast<std::uint32_t>(static_cast<unsigned char>(message[i])) << 8 * i;
  }
  REQUIRE((length + 4) % 8 == 0);
  ReadPicture picture = {nlohmann::json::parse(message.substr(4, length)), {}};
  const std::string rest = message.substr(4 + length);
  REQUIRE(rest.size() % 2 == 0);
  picture.values.resize(rest.size() / 2);
  std::memcpy(picture.values.data(), rest.data(), rest.size());
  return picture;
}

}  // namespace

TEST_CASE("invalid messages are refused with a remedy", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  Session session(live_scene, "", [](const std::string&, bool) {});
  const auto obey = [&](const std::string& text) { session.Do(ParseMessage(text)); };
  const std::string deep(100000, '[');
  for (const std::string& text :
       {std::string(""), std::string("{"), std::string("[]"), std::string("{}"),
        std::string(R"({"do": 1})"), std::string(R"({"do": "camera"})"),
        std::string(R"({"do": "camera", "eye": {"position": [1, 2]}})"),
        std::string(R"({"do": "strategy", "slot": 2, "name": ""})"),
        std::string(R"({"do": "strategy", "slot": 0.5, "name": ""})"),
        std::string(R"({"do": "strategy", "slot": 1e300, "name": ""})"),
        std::string(R"({"do": "ask", "x": -1, "y": 0})"),
        std::string(R"({"do": "pause", "on": 1})"), deep, std::string("\xff\xfe")}) {
    INFO(text.substr(0, 60));
    CHECK_THROWS_AS(obey(text), InputError);
  }
  CHECK_THROWS_WITH(obey(R"({"do": "camara"})"),
                    Catch::Contains("did you mean \"camera\""));
  CHECK_THROWS_WITH(obey(R"({"do": "layer", "name": "ray"})"),
                    Catch::Contains("\"rays\""));
}

TEST_CASE("a picture message has all values once, then only changed ones", "[live]") {
  LiveScene live_scene = SmallLiveScene(80, 70);
  PassRenderer renderer(live_scene, MakeView(live_scene, live_scene.pose, 1), Strategy{});
  NoObserver observer;
  const std::atomic<bool> never{false};
  renderer.Pass(8, observer, never);
  SentPicture sent;
  sent.layer = Layer::kError;
  const ReadPicture picture = Read(EncodePicture(renderer, {{"slot", 1}}, sent));
  CHECK(picture.head.at("slot") == 1);
  CHECK(picture.head.at("layer") == "error");
  REQUIRE(picture.head.at("squares").size() == 4);
  CHECK(picture.head.at("squares")[3] == nlohmann::json({64, 64, 16, 6}));
  CHECK(picture.values.size() == 80u * 70 * 5);
  // The first pixel of the last square.
  const std::size_t at = picture.values.size() - 16 * 6 * 5;
  const Rgb mean = renderer.film().Mean(64, 64);
  const Rgb variance = renderer.film().Variance(64, 64);
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(float(picture.values[at + c]) == Approx(mean[int(c)]).epsilon(1e-3));
  }
  CHECK(float(picture.values[at + 3]) == 8);
  CHECK(float(picture.values[at + 16 * 6 * 4]) ==
        Approx(std::sqrt((variance[0] + variance[1] + variance[2]) / 3)).epsilon(1e-3));
  CHECK(EncodePicture(renderer, {{"slot", 1}}, sent).empty());
  renderer.Pass(9, observer, never);
  CHECK(Read(EncodePicture(renderer, {}, sent)).head.at("squares").size() == 4);
}

TEST_CASE("pixel values are exact, or null where unknown", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  PassRenderer renderer(live_scene, MakeView(live_scene, live_scene.pose, 1), Strategy{});
  NoObserver observer;
  const std::atomic<bool> never{false};
  renderer.Pass(1, observer, never);
  CHECK(PixelJson(renderer, 3, 4).at("error").is_null());
  renderer.Pass(8, observer, never);
  const nlohmann::json pixel = PixelJson(renderer, 3, 4);
  CHECK(pixel.at("value")[1] == renderer.film().Mean(3, 4)[1]);
  CHECK(pixel.at("error")[2] == std::sqrt(renderer.film().Variance(3, 4)[2]));
  CHECK(pixel.at("samples") == 8);
  CHECK(PixelJson(renderer, 32, 4).is_null());
  CHECK(PixelJson(renderer, 0, 24).is_null());
}

}  // namespace lanelight::live

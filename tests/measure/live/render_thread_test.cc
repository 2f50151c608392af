// Pages that come, ask and go, without sockets.
#include "src/measure/live/render_thread.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/measure/live/live_scene.h"

namespace lanelight::live {
namespace {

// A page that draws all that it is sent at once.
class PretendedPage {
 public:
  explicit PretendedPage(RenderThread& render_thread) : render_thread_(render_thread) {
    number_ = render_thread.Enter([this](std::string message, bool binary) {
      const std::lock_guard lock(mutex_);
      if (binary) {
        ++pictures_;
      } else {
        const auto json = nlohmann::json::parse(message);
        last_[json.at("kind")] = json;
        texts_ += message.size();
      }
      come_.notify_all();
    });
  }
  ~PretendedPage() { RemoveSession(); }

  void Send(const std::string& message) { render_thread_.Receive(number_, message); }
  void RemoveSession() {
    if (number_ != 0) render_thread_.RemoveSession(number_);
    number_ = 0;
  }
  std::size_t Received() {
    const std::lock_guard lock(mutex_);
    return texts_ + pictures_;
  }
  int Pictures() {
    const std::lock_guard lock(mutex_);
    return pictures_;
  }
  nlohmann::json Last(const std::string& kind) {
    const std::lock_guard lock(mutex_);
    return last_[kind];
  }
  // Draws until it is so; a minute at most.
  bool Until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      for (const char* what : {"0", "1", "2"}) {
        Send(std::string(R"({"do": "seen", "what": )") + what + "}");
      }
      std::unique_lock lock(mutex_);
      come_.wait_for(lock, std::chrono::milliseconds(20));
    }
    return true;
  }
  bool UntilSpp(int slot, int spp) {
    return Until([&] {
      const nlohmann::json state = Last("state");
      return state.is_object() &&
             state["slots"][std::size_t(slot)].value("spp", 0) >= spp;
    });
  }

 private:
  RenderThread& render_thread_;
  int number_ = 0;
  std::mutex mutex_;
  std::condition_variable come_;
  std::map<std::string, nlohmann::json> last_;
  std::size_t texts_ = 0;
  int pictures_ = 0;
};

std::string ChooseText(int slot, const std::string& name) {
  return nlohmann::json{{"do", "strategy"}, {"slot", slot}, {"name", name}}.dump();
}

}  // namespace

TEST_CASE("a page receives a greeting, pictures, states and pixel values", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  RenderThread render_thread(live_scene, "lanelight render box.pbrt");
  PretendedPage page(render_thread);
  REQUIRE(page.Until([&] { return page.Last("hello").is_object(); }));
  CHECK(page.Last("hello").at("width") == 32);
  CHECK(page.Last("hello").at("strategies").at("presets").size() == AllPresets().size());
  page.Send(ChooseText(0, "default"));
  REQUIRE(page.UntilSpp(0, 16));
  CHECK(page.Pictures() > 1);
  const nlohmann::json slot = page.Last("state").at("slots")[0];
  CHECK(slot.at("strategy") == ToText(Strategy{}));
  CHECK(slot.at("command").get<std::string>().rfind("lanelight render box.pbrt -o ", 0) ==
        0);
  CHECK(slot.at("looks").size() > 0);
  CHECK(slot.at("omitted").size() > 0);
  page.Send(R"({"do": "ask", "x": 1, "y": 2})");
  REQUIRE(page.Until([&] { return page.Last("pixel").is_object(); }));
  CHECK(page.Last("pixel").at("slots")[0].at("samples") >= 16);
}

TEST_CASE("two strategies alternate at equal sample counts", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  RenderThread render_thread(live_scene, "");
  PretendedPage page(render_thread);
  page.Send(R"({"do": "pace", "by": "samples"})");
  page.Send(ChooseText(0, "paper-plain"));
  page.Send(ChooseText(1, "paper-roulette"));
  REQUIRE(page.UntilSpp(0, 64));
  REQUIRE(page.UntilSpp(1, 64));
  page.Send(R"({"do": "pause", "on": true})");
  REQUIRE(page.Until([&] { return page.Last("state").value("paused", false); }));
  const nlohmann::json state = page.Last("state");
  const double a = state["slots"][0]["spp"], b = state["slots"][1]["spp"];
  CHECK(std::max(a, b) <= 2 * std::min(a, b));
  CHECK(state["ratio"]["value"].get<double>() > 0);
}

TEST_CASE("refused requests are reported, and rendering continues", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  RenderThread render_thread(live_scene, "");
  PretendedPage page(render_thread);
  page.Send("no JSON");
  REQUIRE(page.Until([&] { return page.Last("refused").is_object(); }));
  CHECK_THAT(page.Last("refused")["text"].get<std::string>(), Catch::Contains("JSON"));
  page.Send(ChooseText(0, "reuse=block,roulette=adjoint"));
  page.Send(ChooseText(1, "default"));
  REQUIRE(page.UntilSpp(1, 4));
  const nlohmann::json slots = page.Last("state")["slots"];
  CHECK_THAT(slots[0]["refused"].get<std::string>(),
             Catch::Contains("reuse=block does not support"));
  page.Send(R"({"do": "exr", "slot": 0})");
  CHECK(page.Until([&] {
    return page.Last("refused")["text"].get<std::string>().find("no complete image") !=
           std::string::npos;
  }));
}

TEST_CASE("a strategy selected again resumes", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  RenderThread render_thread(live_scene, "");
  PretendedPage page(render_thread);
  page.Send(ChooseText(0, "default"));
  REQUIRE(page.UntilSpp(0, 32));
  page.Send(ChooseText(0, "paper-plain"));
  REQUIRE(page.Until(
      [&] { return page.Last("state")["slots"][0]["name"] == "paper-plain"; }));
  page.Send(R"({"do": "pause", "on": true})");
  page.Send(ChooseText(0, "default"));
  REQUIRE(page.Until([&] {
    const nlohmann::json slot = page.Last("state")["slots"][0];
    return slot["name"] == "default" && slot.contains("spp");
  }));
  CHECK(page.Last("state")["slots"][0]["spp"] >= 32);
}

TEST_CASE("a moved camera restarts the render and is sent to the page", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  RenderThread render_thread(live_scene, "");
  PretendedPage page(render_thread);
  page.Send(ChooseText(0, "default"));
  REQUIRE(page.UntilSpp(0, 4));
  CHECK(page.Last("state").at("moved") == false);
  CameraPose pose = live_scene.pose;
  pose.fov = 50;
  page.Send(nlohmann::json{{"do", "camera"}, {"eye", ToJson(pose)}}.dump());
  REQUIRE(page.Until([&] { return page.Last("state").at("moved") == true; }));
  CHECK(page.Last("state").at("eye").at("fov") == 50);
  REQUIRE(page.UntilSpp(0, 4));
  page.Send(R"({"do": "camera-text"})");
  REQUIRE(page.Until([&] { return page.Last("camera-text").is_object(); }));
  CHECK_THAT(page.Last("camera-text")["text"].get<std::string>(),
             Catch::Contains("\"float fov\" [ 50 ]"));
}

TEST_CASE("closed pages receive no messages, others do", "[live]") {
  LiveScene live_scene = SmallLiveScene();
  RenderThread render_thread(live_scene, "");
  PretendedPage leaves(render_thread), stays(render_thread);
  leaves.Send(ChooseText(0, "default"));
  stays.Send(ChooseText(0, "paper-plain"));
  REQUIRE(leaves.UntilSpp(0, 4));
  leaves.RemoveSession();
  const std::size_t before = leaves.Received();
  REQUIRE(stays.UntilSpp(0, 32));
  CHECK(leaves.Received() == before);
}

}  // namespace lanelight::live

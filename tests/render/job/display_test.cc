// A viewer of tev's protocol, played by a server that decodes what it gets by itself.
#include "src/render/job/display.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <thread>

#include "src/base/core/value_types.h"
#include "src/base/image/exr.h"
#include "src/render/job/render.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

using Catch::Contains;

// What a client may do to the server: be read, or not, for some bytes.
class Viewer {
 public:
  /// Reads this many bytes, then ends the connection; `reads` false: keeps it, unread.
  explicit Viewer(std::size_t max_bytes = ~std::size_t{0}, bool reads = true)
      : max_bytes_(max_bytes) {
    listener_ = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0);
    REQUIRE(listen(listener_, 1) == 0);
    socklen_t size = sizeof(address);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    if (reads) thread_ = std::thread([this] { Read(); });
  }
  ~Viewer() {
    shutdown(listener_, SHUT_RDWR);
    Join();
    close(listener_);
  }

  Endpoint endpoint() const { return {"127.0.0.1", port_}; }
  /// All that came, once the client has closed its end.
  const std::string& Bytes() {
    Join();
    return bytes_;
  }

 private:
  void Join() {
    if (thread_.joinable()) thread_.join();
  }
  void Read() {
    const int client = accept(listener_, nullptr, nullptr);
    if (client < 0) return;
    char buffer[4096];
    while (bytes_.size() < max_bytes_) {
      const ssize_t n = read(client, buffer, std::min(sizeof(buffer), max_bytes_));
      if (n <= 0) break;
      bytes_.append(buffer, static_cast<std::size_t>(n));
    }
    // Unread bytes reset the connection.
    close(client);
  }

  const std::size_t max_bytes_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::string bytes_;
  std::thread thread_;
};

// Reads fields as the protocol's description says, one after the other.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T Number() {
    REQUIRE(bytes_.size() >= sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data(),
                sizeof(T));  // little-endian, as the test's machine
    bytes_.remove_prefix(sizeof(T));
    return value;
  }
  std::string Text() {
    const std::size_t end = bytes_.find('\0');
    REQUIRE(end != bytes_.npos);
    const std::string text(bytes_.substr(0, end));
    bytes_.remove_prefix(end + 1);
    return text;
  }
  bool AtEnd() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

// The images of a viewer. As tev does, it knows an image once it is created, and only its
// user closes it.
struct Shown {
  std::string name;
  int width = 0, height = 0, updates = 0;
  std::uint64_t pixels = 0;  // of all updates
  std::vector<float> rgb;
};

void ReadUpdate(Fields& packet, Shown& shown) {
  ++shown.updates;
  CHECK(packet.Number<std::uint8_t>() == 0);
  CHECK(packet.Text() == shown.name);
  REQUIRE(packet.Number<std::int32_t>() == 3);
  for (const char* channel : {"R", "G", "B"}) CHECK(packet.Text() == channel);
  const int x0 = packet.Number<std::int32_t>(), y0 = packet.Number<std::int32_t>();
  const int width = packet.Number<std::int32_t>(), height = packet.Number<std::int32_t>();
  REQUIRE((x0 >= 0 && y0 >= 0 && x0 + width <= shown.width));
  REQUIRE(y0 + height <= shown.height);
  std::int64_t offsets[3], strides[3];
  for (std::int64_t& offset : offsets) offset = packet.Number<std::int64_t>();
  for (std::int64_t& stride : strides) stride = packet.Number<std::int64_t>();
  REQUIRE((width > 0 && height > 0));
  // tev takes as many values as the furthest one needs, and ignores what is behind.
  std::int64_t furthest = 0;
  for (int c = 0; c < 3; ++c) {
    REQUIRE((offsets[c] >= 0 && strides[c] > 0));
    furthest =
        std::max(furthest, offsets[c] + (std::int64_t{width} * height - 1) * strides[c]);
  }
  std::vector<float> values(static_cast<std::size_t>(furthest) + 1);
  for (float& value : values) value = packet.Number<float>();
  for (int p = 0; p < width * height; ++p) {
    for (int c = 0; c < 3; ++c) {
      const int x = x0 + p % width, y = y0 + p / width;
      shown.rgb[3 * std::size_t(y * shown.width + x) + std::size_t(c)] =
          values[std::size_t(offsets[c] + p * strides[c])];
    }
  }
  shown.pixels += std::uint64_t(width) * std::uint64_t(height);
}

Shown Decode(std::string_view bytes) {
  Shown shown;
  while (!bytes.empty()) {
    const auto size = Fields(bytes).Number<std::uint32_t>();
    REQUIRE(size <= bytes.size());
    Fields packet(bytes.substr(4, size - 4));
    bytes.remove_prefix(size);
    const int type = packet.Number<std::uint8_t>();
    if (type == 4) {
      REQUIRE(shown.name.empty());  // once
      CHECK(packet.Number<std::uint8_t>() == 1);
      shown.name = packet.Text();
      shown.width = packet.Number<std::int32_t>();
      shown.height = packet.Number<std::int32_t>();
      REQUIRE(packet.Number<std::int32_t>() == 3);
      for (const char* channel : {"R", "G", "B"}) CHECK(packet.Text() == channel);
      shown.rgb.assign(3 * std::size_t(shown.width) * std::size_t(shown.height), 0);
    } else {
      REQUIRE(type == 6);
      REQUIRE_FALSE(shown.name.empty());
      ReadUpdate(packet, shown);
    }
    CHECK(packet.AtEnd());
  }
  return shown;
}

struct ShownRender {
  Rendering rendering;
  Image image;
  std::vector<std::string> problems;
};

ShownRender RenderShown(const Endpoint& endpoint, const std::string& exr) {
  RenderSettings settings;
  settings.resolution = {64, 48};
  settings.crop = {8, 8, 56, 48};
  settings.spp = 8;
  const Job job = PrepareJob(
      std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt", settings);
  RenderTargets targets;
  targets.exr = exr;
  targets.display = endpoint;
  ShownRender out;
  std::mutex mutex;
  RenderHooks hooks;
  hooks.on_problem = [&](const std::string& problem) {
    const std::lock_guard lock(mutex);
    out.problems.push_back(problem);
  };
  out.rendering = RenderToFiles(job, "box", targets, hooks);
  out.image = ReadExr(exr);
  return out;
}

// The film of a scene that shows one colour, with one sample a pixel.
FilmAccumulator OneSample(int width, int height, float value) {
  FilmAccumulator film(0, 0, width, height, {}, Auxiliary::kNone);
  const float* planes[] = {&value, &value, &value};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) film.AddSamples(x, y, planes, 1);
  }
  return film;
}

}  // namespace

TEST_CASE("a viewer receives the image that is written", "[render]") {
  Viewer viewer;
  const TemporaryFolder folder;
  const std::string exr = folder.File("shown.exr");
  const ShownRender render = RenderShown(viewer.endpoint(), exr);
  CHECK(render.problems.empty());
  const Shown shown = Decode(viewer.Bytes());
  CHECK(shown.name == exr);
  REQUIRE((shown.width == 48 && shown.height == 40));
  const std::size_t channels = render.image.names.size();
  for (const std::size_t c : {0, 1, 2}) {
    const std::string name(1, "RGB"[c]);
    const auto found =
        std::find(render.image.names.begin(), render.image.names.end(), name);
    REQUIRE(found != render.image.names.end());
    const auto plane = std::size_t(found - render.image.names.begin());
    for (std::size_t p = 0; p < std::size_t{48} * 40; ++p) {
      REQUIRE(shown.rgb[3 * p + c] == render.image.pixels[channels * p + plane]);
    }
  }
}

TEST_CASE("only tiles that have changed are sent", "[render]") {
  Viewer viewer;
  const FilmAccumulator film = OneSample(40, 20, 0.5f);
  {
    Display display(viewer.endpoint(), "film", film, "srgb", [](const std::string&) {});
    display.Changed(film, {16, 0, 32, 16});
    // So that it has been sent, and is not only waiting to be.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    display.Changed(film, {16, 0, 32, 16});  // which it knows
    display.Finish(film);                    // all others
  }
  const Shown shown = Decode(viewer.Bytes());
  CHECK(shown.updates == 6);
  CHECK(shown.pixels == 40 * 20);
  CHECK(shown.rgb == std::vector<float>(3 * 40 * 20, 0.5f));
}

TEST_CASE("localhost connects to a viewer that listens on IPv4 only, as tev does",
          "[render]") {
  Viewer viewer;
  const FilmAccumulator film = OneSample(8, 8, 2);
  std::string problem;
  {
    Display display({"localhost", viewer.endpoint().port}, "film", film, "srgb",
                    [&](const std::string& message) { problem = message; });
    display.Finish(film);
  }
  CHECK(problem.empty());
  CHECK(Decode(viewer.Bytes()).rgb == std::vector<float>(3 * 8 * 8, 2.0f));
}

TEST_CASE(
    "without a listening viewer a warning is printed once and the image is rendered",
    "[render]") {
  Endpoint unused_port;
  {
    unused_port = Viewer(0, false).endpoint();  // whose port is free again
  }
  const TemporaryFolder folder;
  const std::string exr = folder.File("shown.exr");
  const ShownRender render = RenderShown(unused_port, exr);
  CHECK(render.image.width == 48);
  REQUIRE(render.problems.size() == 1);
  CHECK_THAT(render.problems[0], Contains("no display server at 127.0.0.1:") &&
                                     Contains("Connection refused") &&
                                     Contains("the render continues"));
}

TEST_CASE("a viewer that disconnects or stalls is reported once", "[render]") {
  const FilmAccumulator film = OneSample(2048, 2048, 0.25f);  // 50 MB: more than buffers
  std::vector<std::string> problems;
  const auto on_problem = [&](const std::string& problem) {
    problems.push_back(problem);
  };
  SECTION("goes away") {
    Viewer viewer(16);
    Display display(viewer.endpoint(), "film", film, "srgb", on_problem);
    display.Finish(film);
  }
  SECTION("does not read") {
    Viewer viewer(0, false);
    Display display(viewer.endpoint(), "film", film, "srgb", on_problem);
    display.Finish(film);  // does not wait for it
  }
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0], (Contains("went away") || Contains("too slow")) &&
                              Contains("the display server 127.0.0.1:"));
}

TEST_CASE("server addresses are parsed strictly", "[core]") {
  const EndpointType type{14158};
  CHECK(ReadValue(type, "here").Text() == "here:14158");
  CHECK(ReadValue(type, "here:99").Text() == "here:99");
  CHECK(ReadValue(type, "[::1]:99").Text() == "[::1]:99");
  CHECK(ReadValue(type, "[::1]").Text() == "[::1]:14158");
  for (const char* text : {"", ":99", "here:", "here:0", "here:65536", "here:x", "::1"}) {
    INFO(text);
    CHECK_THROWS_WITH(ReadValue(type, text), Contains("is not HOST:PORT"));
  }
}

}  // namespace lanelight

// Reading returns what was written.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/base/state/random_film.h"

namespace lanelight {
namespace {

using Catch::Contains;

// Writes the tiles of a random film, compressed and not, and reads them into one of
// zeros.
void CheckRoundTrip(const PixelRect& window, const std::vector<PixelRect>& tiles) {
  const TemporaryFolder folder;
  const RandomFilm film = RandomFilm::Make(window, 1);
  for (bool compress : {true, false}) {
    StateContent content = film.Content(tiles);
    content.compress = compress;
    WriteState(content, folder.File("state"));
    const StateFile file(folder.File("state"));
    RandomFilm read(window);
    file.ReadPixels(read.Columns(), window);
    CHECK(HoldsTiles(read, film, tiles));
    CHECK(file.tiles().size() == tiles.size());
  }
}

}  // namespace

TEST_CASE("columns of all types round-trip bit by bit", "[state]") {
  CheckRoundTrip({0, 0, 1, 1}, {{0, 0, 1, 1}});
  CheckRoundTrip({-3, 5, 14, 12}, {{-3, 5, 14, 12}});
  CheckRoundTrip({0, 0, 211, 173}, {{0, 0, 211, 173}});  // several chunks, in parts
}

TEST_CASE("tiles can be read in any order, other pixels are unchanged", "[state]") {
  CheckRoundTrip({0, 0, 9, 7}, {});
  CheckRoundTrip({2, 3, 40, 31},
                 {{30, 20, 40, 31}, {2, 3, 3, 4}, {3, 3, 9, 20}, {2, 30, 30, 31}});
  CheckRoundTrip({0, 0, 300, 200},
                 {{150, 100, 300, 200}, {0, 0, 150, 100}, {7, 101, 140, 199}});
}

TEST_CASE("texts, crop window and tiles round-trip", "[state]") {
  const TemporaryFolder folder;
  StateContent content;
  content.identity = std::string(200000, 'x') + "\u00e9";
  content.window = {-7, 1, 3, 9};
  content.tiles = {{0, 2, 3, 4}, {-7, 1, 0, 9}};
  WriteState(content, folder.File("state"));
  const StateFile file(folder.File("state"));
  CHECK(file.identity() == content.identity);
  CHECK(file.report().empty());
  CHECK((file.window() == content.window));
  REQUIRE(file.tiles().size() == 2);
  CHECK((file.tiles()[0] == content.tiles[0]));
  CHECK((file.tiles()[1] == content.tiles[1]));
}

TEST_CASE("tables round-trip, including empty ones", "[state]") {
  const TemporaryFolder folder;
  std::vector<double> many(100003), few = {1.5}, none;
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = 1 / (1.0 + double(i));
  few.push_back(std::numeric_limits<double>::quiet_NaN());
  StateContent content;
  content.tables = {MakeStateColumn<double>("many", "", many),
                    MakeStateColumn<double>("few", "a meaning", few, {1, 2}),
                    MakeStateColumn<double>("none", "", none, {7})};
  WriteState(content, folder.File("state"));
  const StateFile file(folder.File("state"));
  CHECK(file.HasTable("many"));
  CHECK_FALSE(file.HasTable("more"));
  CHECK_FALSE(file.HasTable(""));
  CHECK(file.TableRows("many") == many.size());
  CHECK(file.TableRows("few") == 1);
  CHECK(file.TableRows("none") == 0);
  std::vector<double> read(many.size()), read_few(2);
  file.ReadTable(MakeStateColumn<double>("many", "", read));
  CHECK(read == many);
  file.ReadTable(MakeStateColumn<double>("few", "", read_few, {1, 2}));
  CHECK(read_few[0] == 1.5);
  CHECK(std::isnan(read_few[1]));
  file.ReadTable(MakeStateColumn<double>("none", "", none, {7}));
  CHECK_THROWS_WITH(file.TableRows("more"), Contains("no tables \"more\""));
}

TEST_CASE("the parts of a film add up to the whole", "[state]") {
  const TemporaryFolder folder;
  const PixelRect window = {0, 0, 60, 40};
  const RandomFilm film = RandomFilm::Make(window, 2);
  const std::vector<PixelRect> left = {{0, 0, 17, 40}}, right = {{17, 9, 60, 40}};
  WriteState(film.Content(left), folder.File("left"));
  WriteState(film.Content(right), folder.File("right"));
  RandomFilm merged(window);
  for (const char* part : {"left", "right"}) {
    StateFile(folder.File(part)).ReadPixels(merged.Columns(), window);
  }
  CHECK(HoldsTiles(merged, film, {left[0], right[0]}));
}

TEST_CASE("a part can be added to a film that contains its pixels", "[state]") {
  const TemporaryFolder folder;
  const PixelRect part = {5, 6, 12, 11}, whole = {-2, 0, 20, 30};
  const RandomFilm film = RandomFilm::Make(whole, 3);
  WriteState(film.Content({part}), folder.File("state"));
  const StateFile file(folder.File("state"));
  RandomFilm cut(part), away({5, 6, 11, 11});
  file.ReadPixels(cut.Columns(), part);
  for (int y = part.y0; y < part.y1; ++y) {
    for (int x = part.x0; x < part.x1; ++x) {
      const auto index = [&](const PixelRect& w) {
        return static_cast<std::size_t>((y - w.y0) * w.width() + x - w.x0);
      };
      CHECK(cut.Pixel(index(part)) == film.Pixel(index(whole)));
    }
  }
  CHECK_THROWS_WITH(file.ReadPixels(away.Columns(), away.window),
                    Contains("[5, 12) x [6, 11)") && Contains("[5, 11) x [6, 11)"));
}

TEST_CASE("equal content gives equal bytes", "[state]") {
  const RandomFilm film = RandomFilm::Make({0, 0, 120, 110}, 4);
  const StateContent content = film.Content({film.window});
  const std::string first = StateBytes(content);
  CHECK(StateBytes(content) == first);
}

TEST_CASE("a column that does not fit is an error with its name", "[state]") {
  const TemporaryFolder folder;
  const PixelRect window = {0, 0, 8, 8};
  const RandomFilm film = RandomFilm::Make(window, 5);
  StateContent content = film.Content({window});
  std::vector<float> table(6);
  content.tables = {MakeStateColumn<float>("table", "", table, {3})};
  WriteState(content, folder.File("state"));
  const StateFile file(folder.File("state"));
  CHECK(file.HasPixels("sums"));
  CHECK_FALSE(file.HasPixels("sum"));

  // None of the columns is touched if one does not fit.
  RandomFilm read(window);
  std::vector<MutableStateColumn> columns = read.Columns();
  SECTION("no such column") {
    columns[1].name = "sum";
    CHECK_THROWS_WITH(file.ReadPixels(columns, window),
                      Contains(folder.File("state")) && Contains("no pixels \"sum\""));
  }
  SECTION("another type") {
    columns[2].type = StateType::kFloat64;
    CHECK_THROWS_WITH(
        file.ReadPixels(columns, window),
        Contains("pixels \"samples\" is uint64 [64]; this render has float64"));
  }
  SECTION("another shape") {
    columns[1].shape = {3, 4};
    CHECK_THROWS_WITH(file.ReadPixels(columns, window),
                      Contains("[64 x 4 x 3]") && Contains("[64 x 3 x 4]"));
  }
  SECTION("other rows of a table") {
    std::vector<float> more(9);
    CHECK_THROWS_WITH(file.ReadTable(MakeStateColumn<float>("table", "", more, {3})),
                      Contains("[2 x 3]") && Contains("[3 x 3]"));
  }
  CHECK(HoldsTiles(read, film, {}));
}

TEST_CASE("content that contradicts itself fails a check", "[state]") {
  const RandomFilm film = RandomFilm::Make({0, 0, 8, 8}, 6);
  StateContent content = film.Content({film.window});
  SECTION("tiles that overlap") { content.tiles.push_back({7, 7, 8, 8}); }
  SECTION("a tile outside") { content.tiles = {{0, 0, 9, 8}}; }
  SECTION("a name twice") { content.pixels[0].name = content.pixels[1].name; }
  SECTION("too few rows") { --content.pixels[0].rows; }
  SECTION("a name of a path") { content.pixels[0].name = "a/b"; }
  CHECK_THROWS_AS(StateBytes(content), CheckFailure);
}

}  // namespace lanelight

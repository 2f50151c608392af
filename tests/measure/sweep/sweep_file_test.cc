// Sweep files: what they say, and what is said of mistakes in them.
#include <catch2/catch.hpp>
#include <set>

#include "src/measure/sweep/sweep_file.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

using Catch::Contains;

// Beside scenes "a.pbrt" and "b.pbrt".
Sweep Parse(const std::string& text) {
  const TemporaryFolder folder;
  folder.Write("a.pbrt", "");
  folder.Write("b.pbrt", "");
  return ParseSweep(folder.File("sweep.toml"), text);
}

std::string Mistake(const std::string& text) {
  try {
    Parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Of the cell's values, by axis.
std::string Value(const SweepCell& cell, Axis axis) {
  return Get(cell.values, axis).value_or("-");
}

struct Broken {
  const char *text, *place;           // "line:column"
  std::vector<const char*> messages;  // parts
};

}  // namespace

TEST_CASE("sweep: a grid has every combination, the last axis fastest", "[sweep]") {
  const Sweep sweep = Parse(R"(
[grid]
seed = [3, 1]
scene = ["b.pbrt", "a.pbrt"]
strategy = ["default", "points=stratified"]
spp = 16
)");
  REQUIRE(sweep.cells.size() == 8);
  CHECK(sweep.excluded == 0);
  std::string order;
  for (const SweepCell& cell : sweep.cells) {
    order += Value(cell, Axis::kScene)[0] + Value(cell, Axis::kStrategy).substr(0, 1) +
             Value(cell, Axis::kSeed) + " ";
    CHECK(Value(cell, Axis::kSpp) == "16");
    CHECK(Value(cell, Axis::kThreads) == "-");
  }
  CHECK(order == "bd3 bd1 bp3 bp1 ad3 ad1 ap3 ap1 ");
  CHECK(sweep.UsedAxes() ==
        std::vector<Axis>{Axis::kScene, Axis::kStrategy, Axis::kSpp, Axis::kSeed});
}

TEST_CASE("sweep: exclusions and further grids", "[sweep]") {
  const Sweep sweep = Parse(R"(
[grid]
scene = ["a.pbrt", "b.pbrt"]
strategy = ["default", "points=stratified", "points=halton"]
spp = [1, 4, 16]
[[exclude]]
scene = "b.pbrt"
spp = [4, 16]
[[exclude]]
strategy = "points=stratified"
spp = 1
[[include]]
scene = "a.pbrt"
strategy = "default"
time = [0.5, 2]
[[include]]
scene = "a.pbrt"
strategy = "default"
spp = [16, 64]
)");
  // 18, less 6 of b and 2 of stratified; 2 times; 64 is new and 16 is not.
  CHECK(sweep.cells.size() == 18 - 6 - 2 + 2 + 1);
  CHECK(sweep.excluded == 8);
  std::set<std::string> names;
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    CHECK(sweep.cells[i].index == i);
    names.insert(sweep.cells[i].name);
  }
  CHECK(names.size() == sweep.cells.size());
}

TEST_CASE("sweep: cell names depend on the values only", "[sweep]") {
  const auto first = [](const char* text) { return Parse(text).cells.front(); };
  const SweepCell a = first("[grid]\nscene = 'a.pbrt'\nspp = 16\nseed = [1]");
  const SweepCell b = first("[grid]\nseed = 1\nscene = ['./a.pbrt']\nspp = [16, 4]");
  const SweepCell c = first("[grid]\nseed = [1, 2]\nscene = ['a.pbrt']\nspp = [16, 4]");
  CHECK_THAT(a.name, Catch::StartsWith("a_16spp_seed1-"));
  CHECK(a.name == c.name);
  CHECK(a.name != b.name);  // another text for the scene
  const SweepCell d = first(
      "[grid]\nscene = 'a.pbrt'\nstrategy = 'points=stratified,roulette=constant:0.5'\n"
      "simd = 'avx2'\nresolution = '064x48'\ntarget-relmse = 1e-3");
  CHECK_THAT(d.name,
             Catch::StartsWith(
                 "a_64x48_AVX2_points=stratified-roulette=constant-0.5_relmse0.001-"));
}

TEST_CASE("sweep: scenes of equal file names are named by their folder", "[sweep]") {
  const auto named = [](const char* scene) {
    AxisValues values;
    values[static_cast<std::size_t>(Axis::kScene)] = scene;
    return CellName(values);
  };
  CHECK_THAT(named("rooms/bath/reference.pbrt"), Catch::StartsWith("bath-"));
  CHECK_THAT(named("../reference.pbrt"), Catch::StartsWith("reference-"));
  CHECK_THAT(named("reference.pbrt"), Catch::StartsWith("reference-"));
  CHECK_THAT(named("rooms/box.v2.pbrt"), Catch::StartsWith("box.v2-"));
}

TEST_CASE("sweep: amounts have units, and are known by their values", "[sweep]") {
  const auto first = [](const char* text) { return Parse(text).cells.front(); };
  const SweepCell units =
      first("[grid]\nscene = 'a.pbrt'\nspp = '1k'\ntime = '5m'\ntarget = '1%'");
  const SweepCell plain =
      first("[grid]\nscene = 'a.pbrt'\nspp = 1000\ntime = 300\ntarget-relmse = 1e-4");
  CHECK(units.values == plain.values);
  CHECK(units.name == plain.name);
}

TEST_CASE("sweep: settings", "[sweep]") {
  const SweepSettings s = Parse(R"(
[grid]
scene = "a.pbrt"
[settings]
crop = [1, 2, 30, 40]
aov = true
gbuffer = "world"
depth = "half"
png = true
exposure = -1
scattering = "insphere"
wavefront = 512
copied-triangles = 5
skip-unsupported = false
)")
                              .settings;
  CHECK(s.render.crop == std::array<int, 4>{1, 2, 30, 40});
  CHECK(s.render.gbuffer == Gbuffer::kWorld);
  CHECK((s.render.aov && s.render.image.half && s.render.image.png));
  CHECK_FALSE(s.render.skip_unsupported);
  CHECK(s.render.image.exposure == -1);
  CHECK(s.render.copied_triangles == 5);
  CHECK(s.render.scattering == Scattering::kInSphere);
  CHECK(s.render.wavefront == 512);
  CHECK(s.texts.size() == 10);
  CHECK(s.texts.at("crop") == "1,2,30,40");
  CHECK(s.texts.at("skip-unsupported") == "false");
}

TEST_CASE("sweep: a cell's values set the options of its render", "[sweep]") {
  const Sweep sweep = Parse(R"(
[grid]
scene = "a.pbrt"
resolution = "64x48"
max-depth = 0
build = "fast"
threads = 3
simd = "rvv"
spp = 2
time = 3
target-relmse = 0.5
target-rmse = 0.25
seed = 7
)");
  REQUIRE(sweep.cells.size() == 1);
  RenderSettings s;
  ApplyValues(sweep.cells[0].values, s);
  CHECK(s.resolution == std::array<int, 2>{64, 48});
  CHECK(s.max_depth == 0);
  CHECK(s.build == BuildQuality::kFast);
  CHECK(s.threads == 3);
  CHECK(s.target == "RVV");
  CHECK(s.spp == 2u);
  CHECK(s.seconds == 3.0);
  CHECK(s.target_relmse == 0.5);
  CHECK(s.target_rmse == 0.25);
  CHECK(s.seed == 7u);
}

TEST_CASE("sweep: mistakes are named with their place and a remedy", "[sweep]") {
  const std::vector<Broken> kBroken = {
      {"[grid\n", "1:", {"invalid TOML"}},
      {"[grid]\nscene = 'a.pbrt'\nscene = 'b.pbrt'\n", "3:9", {"invalid TOML", "scene"}},
      {"", "1:1", {"no [grid]"}},
      {"grid = 3", "1:8", {"grid is the integer 3", "[grid] on a line"}},
      {"[gird]\nscene = 'a.pbrt'", "1:2", {"unknown table \"gird\"", "mean \"grid\""}},
      {"spp = 4\n[grid]", "1:1", {"spp is an axis", "below [grid]"}},
      {"[grid]\nspp = 4", "1:1", {"no scene", "scene = \"box.pbrt\""}},
      {"[grid]\nscene = 'c.pbrt'",
       "2:9",
       {"scene file", "does not exist", "c.pbrt", "relative"}},
      {"[grid]\nscene = ''", "2:9", {"is not the name of a scene"}},
      {"[grid]\nscene = 3", "2:9", {"scene is the integer 3", "text in quotes"}},
      {"[grid]\nscene = []", "2:9", {"no values", "remove the line"}},
      {"[grid]\nscene = 'a.pbrt'\nsp = 4", "3:1", {"axis \"sp\"", "mean \"spp\""}},
      {"[grid]\nscene = 'a.pbrt'\nspp = 0", "3:7", {"spp 0 is not an integer from 1"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = -4", "3:7", {"spp -4 is not"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = 4.0", "3:7", {"the number 4", "an integer"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = '4'", "3:7", {"the text \"4\"", "an integer"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = [4, 1, 4]",
       "3:14",
       {"\"4\" is a duplicate", "line 3"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = 99999999999999", "3:7", {"to 1099511627776"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = '10q'", "3:7", {"spp \"10q\" is not", "10k"}},
      {"[grid]\nscene = 'a.pbrt'\ntarget = 0.01",
       "3:10",
       {"target is the number 0.01", "a text in quotes"}},
      {"[grid]\nscene = 'a.pbrt'\ntarget = '1%'\ntarget-relmse = 0.1",
       "4:1",
       {"set the same axis"}},
      {"[grid]\nscene = 'a.pbrt'\ntime = nan", "3:8", {"time is the number nan"}},
      {"[grid]\nscene = 'a.pbrt'\ntime = inf", "3:8", {"time is the number inf"}},
      {"[grid]\nscene = 'a.pbrt'\ntime = 0", "3:8", {"time 0 is not a time of 0.001 to"}},
      {"[grid]\nscene = 'a.pbrt'\ntime = 1\nspp = 4",
       "3:8",
       {"time excludes spp", "[[include]]"}},
      {"[grid]\nscene = 'a.pbrt'\ntarget-relmse = -1", "3:17", {"target-relmse -1"}},
      {"[grid]\nscene = 'a.pbrt'\nseed = -1", "3:8", {"seed -1"}},
      {"[grid]\nscene = 'a.pbrt'\nmax-depth = 9999999", "3:13", {"max-depth 9999999"}},
      {"[grid]\nscene = 'a.pbrt'\nthreads = 2000", "3:11", {"from 0 to 1024"}},
      {"[grid]\nscene = 'a.pbrt'\nresolution = '64*48'", "3:14", {"WIDTHxHEIGHT"}},
      {"[grid]\nscene = 'a.pbrt'\nresolution = '0x48'", "3:14", {"\"0x48\" is not"}},
      {"[grid]\nscene = 'a.pbrt'\nresolution = '64x48x3'", "3:14", {"640x480"}},
      {"[grid]\nscene = 'a.pbrt'\nresolution = '99999x1'", "3:14", {"1 to 65536"}},
      {"[grid]\nscene = 'a.pbrt'\nbuild = 'fats'", "3:9", {"build", "mean \"fast\""}},
      {"[grid]\nscene = 'a.pbrt'\nsimd = 'avx9'",
       "3:8",
       {"simd \"avx9\" is not", "\"AVX2\""}},
      {"[grid]\nscene = 'a.pbrt'\nstrategy = 'points=sobbol'",
       "3:12",
       {"sobbol", "sobol"}},
      {"[grid]\nscene = 'a.pbrt'\nstrategy = ['default', 'points=sobol']",
       "3:24",
       {"it equals \"default\""}},
      {"[grid]\nscene = 'a.pbrt'\nseed = 1979-05-27", "3:8", {"a date or time"}},
      {"[grid]\nscene = 'a.pbrt'\nseed = [[1]]", "3:9", {"seed is an array"}},
      {"[grid]\nscene = 'a.pbrt'\n[[exclude]]\nspp = 4",
       "4:7",
       {"no cell of the grid has spp \"4\"", "the grid has no such axis"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = [1, 2]\n[[exclude]]\nspp = 4",
       "5:7",
       {"no cell of the grid has spp \"4\"", "\"1\", \"2\""}},
      {"[grid]\nscene = 'a.pbrt'\n[[exclude]]\n", "3:1", {"names no axis"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = [1, 2]\n[[exclude]]\nspp = [1, 2]",
       "1:1",
       {"leave no cell"}},
      {"[grid]\nscene = 'a.pbrt'\nspp = 1\n[[include]]\nscene = 'a.pbrt'\nspp = 2\n"
       "seed = 5\n[[exclude]]\nspp = 1\nseed = 5",
       "8:1",
       {"all of these values together"}},
      {"[grid]\nscene = 'a.pbrt'\n[exclude]\nspp = 4", "3:1", {"[[exclude]]"}},
      {"[grid]\nscene = 'a.pbrt'\n[[include]]\nspp = 4", "3:1", {"no scene"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\nspp = 4", "4:1", {"axis", "[grid]"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\naovs = true", "4:1", {"mean \"aov\""}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\ngbuffer = 'eye'",
       "4:11",
       {"camera", "world"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\naov = 1", "4:7", {"true or false"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\ncrop = '0,0,1,1'", "4:8", {"[x0, y0"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\ncopied-triangles = 1e9",
       "4:20",
       {"copied-triangles is the number", "an integer"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\ncopied-triangles = 2000000000",
       "4:20",
       {"copied-triangles 2000000000 is not an integer from 0 to"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\ncrop = [4, 0, 4, 2]", "4:8", {"x0 < x1"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\ndepth = 'full'", "4:9", {"\"half\""}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\nexposure = 1000", "4:12", {"-100 to 100"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\nwavefront = -1", "4:13", {"wavefront -1"}},
      {"[grid]\nscene = 'a.pbrt'\n[settings]\nscattering = 'lambert'",
       "4:14",
       {"mean \"lambertian\""}},
  };
  for (const Broken& broken : kBroken) {
    const std::string message = Mistake(broken.text);
    INFO(broken.text << "\n" << message);
    CHECK_THAT(message, Contains(std::string("sweep.toml:") + broken.place));
    for (const char* part : broken.messages) CHECK_THAT(message, Contains(part));
  }
}

TEST_CASE("sweep: an oversized grid is refused before it is built", "[sweep]") {
  std::string list;
  for (int i = 0; i < 2000; ++i) list += std::to_string(i + 1) + ",";
  CHECK_THAT(Mistake("[grid]\nscene = 'a.pbrt'\nspp = [" + list + "]\nseed = [" + list +
                     "]\nmax-depth = [" + list + "]\n"),
             Contains("1:1") && Contains("more than 1000000 cells"));
}

TEST_CASE("sweep: a file nested too deeply is refused with its location", "[sweep]") {
  const auto many = [](const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  constexpr int kMany = 1000000;
  const std::string keys = many("a.", kMany) + "a";
  const std::string bushes = many("{" + many("a . ", 5000) + "a = ", 200);
  // Strings that end where one who reads hastily takes them to go on.
  const std::string strings = R"(a = ['''\''', "\\", """\"""""", ''])"
                              "\n";
  for (const std::string& deep :
       {keys + " = 1", "[" + keys + "]", "[[" + keys + "]]", "a = " + many("[", kMany),
        "a = " + many("{a=", kMany), "a = " + bushes, "a = [1, {b.b = 2, " + keys,
        many("'a' . ", kMany) + "a = 1", strings + keys + " = 1"}) {
    const std::string message = Mistake("[grid] # [[[[\n" + deep);
    CHECK_THAT(message, Contains("sweep.toml:") && Contains("more than 32 deep"));
  }
  CHECK_THAT(Mistake("\na = " + many("[", 33)), Contains("sweep.toml:2:37: "));
}

TEST_CASE("sweep: dots and brackets of texts and comments do not nest", "[sweep]") {
  const std::string many(100, '['), dots(100, '.');
  CHECK_THAT(Mistake("# " + many + dots + "\n[grid]\nscene = 'a.pbrt'\n[settings]\n" +
                     "depth = '''" + many + "\n''" + dots + "'''"),
             Contains("\"half\""));
  std::string times = "1.5";
  for (int i = 0; i < 100; ++i) times += ", 2." + std::to_string(100 + i);
  CHECK(Parse("[grid]\nscene = 'a.pbrt'\ntime = [" + times + "]").cells.size() == 101);
}

TEST_CASE("sweep: the example in scenes/ can be parsed", "[sweep]") {
  const Sweep sweep = ReadSweep(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/sweep.toml");
  CHECK(sweep.cells.size() == 2 * 3 * 4 * 2 - 2 + 2);
}

}  // namespace lanelight

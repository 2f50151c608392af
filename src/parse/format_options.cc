// What stands before WorldBegin: camera, film, filter, sampler, integrator, accelerator,
// options.
#include "src/parse/format.h"

namespace lanelight {
namespace {

using enum FormatStatus;
using Lines = std::vector<FormatLine>;

constexpr const char* kOther = "no path integrator has it";
constexpr const char* kPath = "replaced by `path`";

Lines With(Lines more, const Lines& common) {
  more.insert(more.end(), common.begin(), common.end());
  return more;
}

void AddCameras(FormatTable& table) {
  constexpr const char* kNoWindow = "it has neither lens nor window";
  const Lines shutter = {{"float shutteropen", kRendered, "", "0.5"},
                         {"float shutterclose", kRendered, "", "2"}};
  const Lines frame = With({{"float frameaspectratio", kRendered, "", "1.5"},
                            {"float screenwindow", kRendered, "", "[ -1 1 -0.5 1 ]"},
                            {"float lensradius", kRendered, "", "0.1"},
                            {"float focaldistance", kRendered, "", "5"}},
                           shutter);
  table.push_back({"Camera", "perspective", kRendered, "",
                   With({{"float fov", kRendered, "", "40"}}, frame)});
  table.push_back({"Camera", "orthographic", kRendered, "", frame});
  table.push_back({"Camera", "spherical", kRendered, "",
                   With({{"string mapping", kRendered, "", "\"equirectangular\""},
                         {"float frameaspectratio", kNoted, kNoWindow, "1.5"},
                         {"float screenwindow", kNoted, kNoWindow, "[ -1 1 -0.5 1 ]"},
                         {"float lensradius", kNoted, kNoWindow, "0.1"},
                         {"float focaldistance", kNoted, kNoWindow, "5"}},
                        shutter)});
  table.push_back({"Camera", "realistic", kRendered, "",
                   With({{"string lensfile", kRendered, "", "\"format-lens.dat\"", true},
                         {"float aperturediameter", kRendered, "", "5"},
                         {"float focusdistance", kRendered, "", "5"},
                         {"string aperture", kRendered, "", "\"gaussian\""}},
                        shutter)});
}

void AddFilms(FormatTable& table) {
  const Lines rgb = {
      {"integer xresolution", kRendered, "", "3"},
      {"integer yresolution", kRendered, "", "3"},
      {"float cropwindow", kRendered, "", "[ 0 0.5 0 1 ]"},
      {"integer pixelbounds", kRendered, "", "[ 0 2 0 2 ]"},
      {"string filename", kRendered, "", "\"image.exr\""},
      {"float iso", kRendered, "", "200"},
      {"float diagonal", kRendered},
      {"bool savefp16", kNoted, "`--depth` chooses half or float", "false"},
      {"string sensor", kRendered, "", "\"cie1931\""},
      {"string sensor", kNoted,
       "as `cie1931`, balanced: saturated colours differ a little", "\"canon_eos_5d\""},
      {"float whitebalance", kRendered, "", "5000"},
      {"float maxcomponentvalue", kRendered, "", "10"},
  };
  table.push_back({"Film", "rgb", kRendered, "", rgb});
  table.push_back(
      {"Film", "gbuffer", kRendered, "as `--gbuffer`",
       With({{"string coordinatesystem", kRendered, "", "\"camera\""}}, rgb)});
  table.push_back(
      {"Film",
       "spectral",
       kRefused,
       "light is transported as linear sRGB, so there are no spectra to write",
       {{"integer nbuckets", kRefused},
        {"float lambdamin", kRefused, "", "360"},
        {"float lambdamax", kRefused, "", "830"}}});
}

void AddFilters(FormatTable& table) {
  const Lines radii = {{"float xradius", kRendered}, {"float yradius", kRendered}};
  table.push_back({"PixelFilter", "box", kRendered, "", radii});
  table.push_back({"PixelFilter", "triangle", kRendered, "", radii});
  table.push_back({"PixelFilter", "gaussian", kRendered, "",
                   With(radii, {{"float sigma", kRendered}})});
  table.push_back({"PixelFilter", "mitchell", kRendered, "",
                   With(radii, {{"float B", kRendered}, {"float C", kRendered}})});
  table.push_back({"PixelFilter", "sinc", kRendered, "",
                   With(radii, {{"float tau", kRendered, "", "2"}})});
}

void AddSamplers(FormatTable& table) {
  const Lines count = {{"integer pixelsamples", kRendered}, {"integer seed", kRendered}};
  const Lines random = With(count, {{"string randomization", kNoted,
                                     "points are always randomised", "\"none\""}});
  for (const char* type : {"zsobol", "paddedsobol", "sobol", "halton", "pmj02bn"}) {
    table.push_back({"Sampler", type, kRendered, "", random});
  }
  table.push_back({"Sampler", "independent", kRendered, "", count});
  table.push_back({"Sampler",
                   "stratified",
                   kRendered,
                   "",
                   {{"integer xsamples", kRendered},
                    {"integer ysamples", kRendered},
                    {"bool jitter", kNoted, "strata are always jittered", "false"},
                    {"integer seed", kRendered}}});
}

void AddIntegrators(FormatTable& table) {
  const FormatLine depth = {"integer maxdepth", kRendered};
  const FormatLine regularize = {"bool regularize", kNoted, kOther};
  const FormatLine lights = {"string lightsampler", kRendered, "", "\"uniform\""};
  table.push_back({"Integrator",
                   "path",
                   kRendered,
                   "",
                   {depth,
                    lights,
                    {"string lightsampler", kNoted, "\"exhaustive\": by a tree instead",
                     "\"exhaustive\""},
                    {"string strategy", kRendered, "", "\"points=cmj\""},
                    regularize}});
  table.push_back({"Integrator",
                   "volpath",
                   kRendered,
                   "",
                   {depth,
                    lights,
                    regularize,
                    {"string strategy", kRendered, "", "\"points=cmj\""}}});
  table.push_back({"Integrator",
                   "simplepath",
                   kNoted,
                   kPath,
                   {depth,
                    {"bool samplebsdf", kNoted, kOther},
                    {"bool samplelights", kNoted, kOther}}});
  for (const char* type : {"simplevolpath", "randomwalk", "lightpath"}) {
    table.push_back({"Integrator", type, kNoted, kPath, {depth}});
  }
  table.push_back({"Integrator",
                   "bdpt",
                   kNoted,
                   kPath,
                   {depth,
                    regularize,
                    {"string lightsampler", kNoted, kOther, "\"power\""},
                    {"bool visualizestrategies", kNoted, kOther},
                    {"bool visualizeweights", kNoted, kOther}}});
  table.push_back({"Integrator",
                   "mlt",
                   kNoted,
                   kPath,
                   {depth,
                    regularize,
                    {"integer bootstrapsamples", kNoted, kOther},
                    {"integer chains", kNoted, kOther},
                    {"integer mutationsperpixel", kNoted, kOther},
                    {"float largestepprobability", kNoted, kOther},
                    {"float sigma", kNoted, kOther}}});
  table.push_back({"Integrator",
                   "sppm",
                   kNoted,
                   kPath,
                   {depth,
                    regularize,
                    {"integer iterations", kNoted, kOther},
                    {"integer photonsperiteration", kNoted, kOther},
                    {"float radius", kNoted, kOther},
                    {"integer seed", kNoted, kOther}}});
  table.push_back({"Integrator",
                   "ambientocclusion",
                   kNoted,
                   kPath,
                   {depth,
                    {"bool cossample", kNoted, kOther},
                    {"float maxdistance", kNoted, kOther}}});
  table.push_back({"Integrator",
                   "function",
                   kNoted,
                   kPath,
                   {depth,
                    {"string function", kNoted, kOther, "\"step\""},
                    {"bool skipbad", kNoted, kOther},
                    {"string imagefilename", kNoted, kOther, "\"image.exr\""}}});
}

void AddAccelerators(FormatTable& table) {
  constexpr const char* kOne = "there is one kind of tree";
  table.push_back({"Accelerator",
                   "bvh",
                   kNoted,
                   kOne,
                   {{"integer maxnodeprims", kNoted, kOne},
                    {"string splitmethod", kNoted, kOne, "\"middle\""}}});
  table.push_back({"Accelerator",
                   "kdtree",
                   kNoted,
                   kOne,
                   {{"integer intersectcost", kNoted, kOne},
                    {"integer traversalcost", kNoted, kOne},
                    {"float emptybonus", kNoted, kOne},
                    {"integer maxprims", kNoted, kOne},
                    {"integer maxdepth", kNoted, kOne}}});
}

void AddOptions(FormatTable& table) {
  table.push_back(
      {"Option",
       "",
       kRendered,
       "",
       {{"integer seed", kRendered},
        {"bool disablepixeljitter", kRendered},
        {"bool disabletexturefiltering", kRendered, "of images; bumps keep their steps"},
        {"bool disablewavelengthjitter", kNoted, "there are no wavelengths"},
        {"float displacementedgescale", kRendered},
        {"bool forcediffuse", kRendered},
        {"string msereferenceimage", kNoted, "`lanelight compare` does it", "\"a.exr\""},
        {"string msereferenceout", kNoted, "`lanelight compare` does it", "\"a.txt\""},
        {"bool pixelstats", kNoted, "`lanelight profile` does it"},
        {"string rendercoordsys", kNoted, "the program chooses its own", "\"world\""},
        {"bool stats", kNoted, "`--json` writes them"},
        {"bool wavefront", kNoted, "everything is a wavefront here"}}});
}

}  // namespace

FormatTable OptionFormat() {
  FormatTable table;
  AddCameras(table);
  AddFilms(table);
  AddFilters(table);
  AddSamplers(table);
  AddIntegrators(table);
  AddAccelerators(table);
  AddOptions(table);
  return table;
}

}  // namespace lanelight

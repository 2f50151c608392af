// Names of scenes where paths would be too long.
#include <catch2/catch.hpp>

#include "src/scene/description/scene_names.h"

namespace lanelight {

TEST_CASE("scene names: file names, or folder names for generic files", "[scene]") {
  CHECK(SceneNames({"a/box.pbrt", "kitchen/reference.pbrt", "attic/scene-v4.pbrt",
                    "b/box.pbrt", "b/kitchen.pbrt"}) ==
        std::vector<std::string>{"box", "kitchen", "attic", "box-2", "kitchen-2"});
}

}  // namespace lanelight

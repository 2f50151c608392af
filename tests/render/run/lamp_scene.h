// A small scene for tests of how runs are cut: a lamp and a ball over a plane, under a
// sky.
#pragma once

#include <fmt/format.h>

#include <string>

namespace lanelight {

inline std::string LampScene(int width, int height, int max_depth) {
  return fmt::format(R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" {} "integer yresolution" {}
Integrator "path" "integer maxdepth" {}
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Translate -2 3 0
  Shape "sphere" "float radius" 0.3
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.4 ]
AttributeBegin
  Rotate -90 1 0 0
  Shape "plane"
AttributeEnd
Shape "sphere" "float radius" 0.8
)",
                     width, height, max_depth);
}

}  // namespace lanelight

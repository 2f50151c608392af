// What kernel files include of others, compiled once before all of them. Nothing of
// Highway's own that differs by target may be here.
#pragma once

#include "kernels/targets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hwy/base.h"
#include "src/scene/accel/accel.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/stage.h"

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
#include "src/accel/accel.h"
#include "src/compiled/scene.h"
#include "src/path/stage.h"
#include "src/prepare/tables.h"

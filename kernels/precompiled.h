// Precompiled headers for all kernel files. Headers of Highway that differ by target must
// not be here, nor tables of the scene, whose changes compile only the kernels that read
// them.
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
#include "src/base/core/aligned.h"
#include "src/base/core/vec.h"
#include "src/vocabulary/path/stage.h"

// Precompiled headers of other projects for all kernel files. Nothing of
// Highway's own that differs by target may be here, and no table of the scene: a change
// of one compiles only the kernels that read it.
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

# Writes OUTPUT, a source file with VERSION and the commit of SOURCE, anew only if that
# changes something: then a build recompiles one file after a commit, and none without one.
# cmake -DSOURCE=FOLDER -DVERSION=1.2.3 -DOUTPUT=version.cc -P write_version.cmake
set(commit unknown)
find_program(GIT git)
if(GIT)
  # The sources may lie unpacked inside of another project's checkout.
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel
    OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${SOURCE}" source)
  if(top STREQUAL source)
    execute_process(
      COMMAND ${GIT} --no-optional-locks -C ${SOURCE}
              describe --always --dirty --abbrev=10 --exclude=*
      OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(found)
      set(commit ${found})
    endif()
  endif()
endif()

file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "src/base/core/version.h"

namespace lanelight {

const char* Version() { return "@VERSION@"; }
const char* Commit() { return "@commit@"; }

}  // namespace lanelight
]])

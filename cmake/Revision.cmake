# cmake -D SOURCE=... -D OUT=... -P Revision.cmake: writes the commit that is built into a source file, which is touched only
# when it changes.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 OUTPUT_VARIABLE revision
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [=[
#include "src/app/build_revision.h"

namespace promenade::app {

std::string buildRevision() {
  return "@revision@";
}

}  // namespace promenade::app
]=])

# cmake -DNUMBER=0.2.0 -DSOURCE=folder -DOUTPUT=build_version.cpp -P BuildVersion.cmake
#   Writes the source that defines swiftlet::flight::buildVersion(): the number of the release, the commit of the checkout
#   in SOURCE, and whether its sources differ from it. Without git, or where SOURCE is no checkout of its own (an
#   unpacked archive, even inside of another checkout), there is no commit. An unchanged file is left alone.
cmake_policy(VERSION 3.25)
find_program(GIT_PROGRAM git)

# The output of git in SOURCE into `result`, empty if it fails. The checkout may belong to another user, as in a
# container; a lock on the index would be in the way of others.
function(ask_git result)
  set(output "")
  if(GIT_PROGRAM)
    execute_process(COMMAND "${GIT_PROGRAM}" -c "safe.directory=*" --no-optional-locks -C "${SOURCE}" ${ARGN}
                    OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE code)
    if(NOT code EQUAL 0)
      set(output "")
    endif()
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

ask_git(top rev-parse --show-toplevel)
file(REAL_PATH "${SOURCE}" source)
set(commit "")
if(top)
  file(REAL_PATH "${top}" top)
  if(top STREQUAL source)
    ask_git(commit rev-parse --verify HEAD)
    string(SUBSTRING "${commit}" 0 12 commit)
  endif()
endif()

set(dirty "std::nullopt")
if(NOT commit)
  set(commit "unknown")
else()
  ask_git(changed status --porcelain --untracked-files=no)
  # The build takes every source it finds, whether git knows it or not.
  ask_git(added ls-files --others --exclude-standard -- "*.cpp" "*.hpp" "*.cmake" "*CMakeLists.txt")
  set(dirty "false")
  if(NOT "${changed}${added}" STREQUAL "")
    set(dirty "true")
  endif()
endif()

file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
#include "flight/build_version.hpp"

namespace swiftlet::flight {

const common::BuildVersion& buildVersion() {
  static const common::BuildVersion kVersion{"@NUMBER@", "@commit@", @dirty@};
  return kVersion;
}

}  // namespace swiftlet::flight
]])

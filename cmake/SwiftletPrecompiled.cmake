# Headers from outside that most sources read, compiled once for all of them. No header of this project is among them, so
# that an edit recompiles no more than before. SWIFTLET_PCH=OFF (preset dev) finds sources that do not name what they
# use.

set(SWIFTLET_PCH_STANDARD
  <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <cstdint> <deque> <filesystem> <fstream> <functional> <limits>
  <map> <memory> <mutex> <numbers> <numeric> <optional> <queue> <set> <span> <sstream> <string> <string_view> <tuple>
  <unordered_map> <utility> <variant> <vector>)
set(SWIFTLET_PCH_LIBRARY ${SWIFTLET_PCH_STANDARD} <Eigen/Dense> <fmt/format.h> <tl/expected.hpp>)
set(SWIFTLET_PCH_WEB ${SWIFTLET_PCH_LIBRARY} <boost/beast/core.hpp> <boost/beast/http.hpp> <nlohmann/json.hpp>)
set(SWIFTLET_PCH_PROGRAM ${SWIFTLET_PCH_LIBRARY} <nlohmann/json.hpp>)
set(SWIFTLET_PCH_TEST ${SWIFTLET_PCH_LIBRARY} <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>)

# swiftlet_precompile(TARGET HEADER...)
#   The target precompiles these headers for itself and for those that share them.
function(swiftlet_precompile target)
  if(SWIFTLET_PCH)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# swiftlet_share_precompiled(TARGET OWNER)
#   The target uses what the owner precompiles. Both must be compiled with the same options, and both be libraries or
#   both programs; g++ refuses it otherwise.
function(swiftlet_share_precompiled target owner)
  if(SWIFTLET_PCH)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

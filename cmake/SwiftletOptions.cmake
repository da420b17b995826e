# Language, warnings, and options that give the same results on every machine.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}")

option(SWIFTLET_TESTS "Build the tests and the benchmarks" ON)
option(SWIFTLET_PCH "Precompile the headers from outside" ON)
option(SWIFTLET_FUZZ "Build the fuzzers (clang)" OFF)
option(SWIFTLET_WARNINGS_AS_ERRORS "Stop at a warning" ON)
set(SWIFTLET_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize= takes them")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  if(SWIFTLET_PCH)
    # ccache caches sources with a precompiled header only with this sloppiness setting.
    set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
    add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endif()

# Same seed, same bytes: no contraction to fused multiply-add, no instruction set beyond the platform's baseline.
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # False alarms inside Eigen at -O2 with g++ 12.
  add_compile_options(-Wno-maybe-uninitialized -Wno-stringop-overread)
endif()
if(SWIFTLET_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
if(SWIFTLET_SANITIZE MATCHES "thread")
  # The thread sanitizer does not know fences, and g++ refuses them with it; asio's locks are enough for one thread.
  add_compile_definitions(BOOST_ASIO_DISABLE_FENCED_BLOCK=1)
endif()
if(SWIFTLET_SANITIZE)
  add_compile_options(-fsanitize=${SWIFTLET_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SWIFTLET_SANITIZE})
  # Eigen aligns by itself where it sees the address sanitizer. The installed PCL was compiled without it, and the two
  # hand memory to each other: both use malloc, which is aligned enough.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Compiles several sources of a target as one, which halves the time of a first build: scripts/demo and scripts/test do
# so where nothing is built yet. Off by default: a single edited source compiles faster alone.
option(SWIFTLET_UNITY "Compile several sources of a target as one" OFF)
if(SWIFTLET_UNITY)
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)  # It takes sources in a unity source for headers.
endif()

function(swiftlet_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SWIFTLET_UNITY} UNITY_BUILD_BATCH_SIZE 12)
endfunction()

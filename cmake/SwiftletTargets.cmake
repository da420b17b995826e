# swiftlet_library(NAME [FOLDER path] [DEPENDS targets...] [PRIVATE targets...] [EXCLUDE regex]
#                  [PRECOMPILE headers... | PRECOMPILED_BY library])
#   A static library of every .cpp below its folder (default: the one that calls): target swiftlet_NAME, alias
#   swiftlet::NAME. DEPENDS are public (they stand in headers), PRIVATE stay in the sources. Libraries from outside are
#   included as system headers. Those that most libraries read are precompiled by swiftlet_common for all; a library that
#   is compiled with other options, or reads others, precompiles its own.
function(swiftlet_library name)
  cmake_parse_arguments(ARG "" "EXCLUDE;FOLDER;PRECOMPILED_BY" "DEPENDS;PRIVATE;PRECOMPILE" ${ARGN})
  set(folder "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER}")
  cmake_path(NORMAL_PATH folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${folder}/*.cpp")
  if(ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCLUDE}")
  endif()
  add_library(swiftlet_${name} STATIC ${sources})
  target_compile_features(swiftlet_${name} PUBLIC cxx_std_20)
  target_include_directories(swiftlet_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/swiftlet>)
  target_link_libraries(swiftlet_${name} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE})
  if(ARG_PRECOMPILE)
    swiftlet_precompile(swiftlet_${name} ${ARG_PRECOMPILE})
  elseif(ARG_PRECOMPILED_BY)
    swiftlet_share_precompiled(swiftlet_${name} swiftlet_${ARG_PRECOMPILED_BY})
  else()
    swiftlet_share_precompiled(swiftlet_${name} swiftlet_common)
  endif()
  swiftlet_unity(swiftlet_${name})
  swiftlet_publish(${name} "${folder}")
endfunction()

# swiftlet_link_opencv(NAME [MODULE...])
#   Links OpenCV by its smallest part, of 4 packages, in the sources, and further modules: what find_package(OpenCV) reads
#   comes with 58.
function(swiftlet_link_opencv name)
  find_path(SWIFTLET_OPENCV_HEADERS opencv2/imgproc.hpp PATH_SUFFIXES opencv4 REQUIRED)
  target_link_libraries(swiftlet_${name} PRIVATE ${ARGN} opencv_imgproc opencv_core)
  target_include_directories(swiftlet_${name} SYSTEM PRIVATE "${SWIFTLET_OPENCV_HEADERS}")
endfunction()

# swiftlet_link_apriltag(NAME)
#   Links libapriltag in the sources. What Debian installs for CMake names no folder of headers.
function(swiftlet_link_apriltag name)
  find_path(SWIFTLET_APRILTAG_HEADERS apriltag/apriltag.h REQUIRED)
  target_link_libraries(swiftlet_${name} PRIVATE apriltag)
  target_include_directories(swiftlet_${name} SYSTEM PRIVATE "${SWIFTLET_APRILTAG_HEADERS}")
endfunction()

# swiftlet_link_ompl(TARGET)
#   Links OMPL in the sources. What Debian installs for pkg-config names libraries that it does not install with it.
function(swiftlet_link_ompl target)
  find_path(SWIFTLET_OMPL_HEADERS ompl/geometric/planners/rrt/RRTConnect.h PATH_SUFFIXES ompl-1.5 REQUIRED)
  target_link_libraries(${target} PRIVATE ompl)
  target_include_directories(${target} SYSTEM PRIVATE "${SWIFTLET_OMPL_HEADERS}")
endfunction()

# swiftlet_rooms(NAME ROOM...)
#   The interface target swiftlet_NAME, alias swiftlet::NAME, over the libraries of the rooms of a folder.
function(swiftlet_rooms name)
  add_library(swiftlet_${name} INTERFACE)
  list(TRANSFORM ARGN PREPEND swiftlet:: OUTPUT_VARIABLE rooms)
  target_link_libraries(swiftlet_${name} INTERFACE ${rooms})
  swiftlet_publish(${name} "")
endfunction()

# Names a library swiftlet::NAME inside and outside of the project; its headers, those of `folder`, are installed.
function(swiftlet_publish name folder)
  add_library(swiftlet::${name} ALIAS swiftlet_${name})
  set_target_properties(swiftlet_${name} PROPERTIES EXPORT_NAME ${name} SWIFTLET_FOLDER "${folder}")
  set_property(GLOBAL APPEND PROPERTY SWIFTLET_LIBRARIES swiftlet_${name})
endfunction()

# swiftlet_tests(NAME [DEPENDS targets...] [SLOW filter | QUICK filter] [TIMEOUT seconds])
#   One GoogleTest program test_NAME of every *_test.cpp in tests/NAME; each test of it is a ctest test. What most test
#   programs read is precompiled by test_precompiled (tests/CMakeLists.txt). Each test has the label NAME and one of two
#   more: `slow` what SLOW names (or all that QUICK does not), `quick` the others; all quick ones take about a minute on
#   two cores: no whole flight, no program of its own, no recording.
function(swiftlet_tests name)
  cmake_parse_arguments(ARG "" "QUICK;SLOW;TIMEOUT" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/${name}/*.cpp")
  add_executable(test_${name} ${sources})
  swiftlet_unity(test_${name})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE SWIFTLET_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                             SWIFTLET_BINARY_DIR="${PROJECT_BINARY_DIR}")
  swiftlet_share_precompiled(test_${name} test_precompiled)
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  math(EXPR timeout "${ARG_TIMEOUT} * ${SWIFTLET_TEST_PATIENCE}")
  if(ARG_QUICK)
    set(quick "${ARG_QUICK}")
    set(slow "-${ARG_QUICK}")
  elseif(ARG_SLOW)
    set(quick "-${ARG_SLOW}")
    set(slow "${ARG_SLOW}")
  else()
    set(quick "*")
    set(slow "")
  endif()
  foreach(pace quick slow)
    if(${pace})
      gtest_discover_tests(test_${name} TEST_PREFIX "${name}." TEST_FILTER "${${pace}}" TEST_LIST ${name}_${pace}
                           DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                           PROPERTIES TIMEOUT ${timeout})
    endif()
  endforeach()
  # gtest_discover_tests takes no list as the value of a property, so the labels are set when ctest has the tests. What
  # is slow costs more, so that ctest starts it first.
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/labels.cmake" @ONLY CONTENT [[
set(cost_quick 1)
set(cost_slow 20)
foreach(pace quick slow)
  if(@name@_${pace})
    set_tests_properties(${@name@_${pace}} PROPERTIES LABELS "@name@;${pace}" COST ${cost_${pace}})
  endif()
endforeach()
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${CMAKE_CURRENT_BINARY_DIR}/labels.cmake")
endfunction()

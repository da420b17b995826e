# Installs and exports every library of ours (find_package(swiftlet COMPONENTS ...)), the program and its data, and packs
# them as Debian packages: swiftlet (program, data) and swiftlet-dev (libraries, headers).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# How a consumer finds each library from outside that ours link: a target, and the arguments of find_package, or
# "pkg-config PREFIX MODULE" for what only pkg-config knows.
set(SWIFTLET_FOUND_BY
  "Boost::headers|Boost"
  "Ceres::ceres|Ceres"
  "EXPAT::EXPAT|EXPAT"
  "Eigen3::Eigen|Eigen3 NO_MODULE"
  "LibArchive::LibArchive|LibArchive"
  "PNG::PNG|PNG"
  "Threads::Threads|Threads"
  "ZLIB::ZLIB|ZLIB"
  "assimp::assimp|assimp"
  "embree|embree 3"
  "fmt::fmt|fmt"
  "nlohmann_json::nlohmann_json|nlohmann_json"
  "sdformat12::sdformat12|sdformat12"
  "yaml-cpp|yaml-cpp"
  "PkgConfig::PCL|pkg-config PCL pcl_common"
  "PkgConfig::TURBOJPEG|pkg-config TURBOJPEG libturbojpeg"
  "PkgConfig::ZMQ|pkg-config ZMQ libzmq"
  "PkgConfig::ZSTD|pkg-config ZSTD libzstd")

# The libraries from outside that `library` links, itself and through others of ours, into `result`.
function(swiftlet_outside_libraries library result)
  set(seen "")
  set(outside "")
  set(waiting ${library})
  while(waiting)
    list(POP_FRONT waiting name)
    if(name IN_LIST seen)
      continue()
    endif()
    list(APPEND seen ${name})
    # Imported targets are known only in the folder that found them, so a name that is no target here is from outside.
    if(TARGET ${name})
      get_target_property(ours ${name} ALIASED_TARGET)
      if(NOT ours)
        set(ours ${name})
      endif()
      get_target_property(type ${ours} TYPE)
      if(type STREQUAL "INTERFACE_LIBRARY")
        get_target_property(links ${ours} INTERFACE_LINK_LIBRARIES)
      else()
        get_target_property(links ${ours} LINK_LIBRARIES)
      endif()
      if(links)
        list(APPEND waiting ${links})
      endif()
    else()
      list(APPEND outside ${name})
    endif()
  endwhile()
  set(${result} ${outside} PARENT_SCOPE)
endfunction()

# Lines of the package's configuration that name what each component needs, into `result`.
function(swiftlet_component_lines libraries result)
  set(lines "")
  foreach(library ${libraries})
    get_target_property(component ${library} EXPORT_NAME)
    swiftlet_outside_libraries(${library} outside)
    set(needs "")
    foreach(name ${outside})
      set(found_by ${SWIFTLET_FOUND_BY})
      list(FILTER found_by INCLUDE REGEX "^${name}\\|")
      if(found_by)
        string(REGEX REPLACE "^[^|]*\\|" "" found_by "${found_by}")
        list(APPEND needs "${found_by}")
      elseif(name MATCHES "::" AND NOT name MATCHES "^swiftlet::")
        message(FATAL_ERROR "swiftlet_${component} links ${name}; say in cmake/SwiftletInstall.cmake how a consumer of "
                            "the installed library finds it (SWIFTLET_FOUND_BY).")
      endif()
    endforeach()
    list(REMOVE_DUPLICATES needs)
    string(APPEND lines "set(swiftlet_${component}_needs \"${needs}\")\n")
    list(APPEND components ${component})
  endforeach()
  set(${result} "set(swiftlet_components ${components})\n${lines}" PARENT_SCOPE)
endfunction()

get_property(libraries GLOBAL PROPERTY SWIFTLET_LIBRARIES)
swiftlet_component_lines("${libraries}" SWIFTLET_COMPONENTS)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/swiftlet")
configure_package_config_file(cmake/swiftlet-config.cmake.in "${PROJECT_BINARY_DIR}/swiftlet-config.cmake"
                              INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/swiftlet-config-version.cmake" COMPATIBILITY SameMinorVersion)

install(TARGETS ${libraries} EXPORT swiftlet-targets ARCHIVE COMPONENT development)
install(EXPORT swiftlet-targets NAMESPACE swiftlet:: DESTINATION "${package_dir}" COMPONENT development)
install(FILES "${PROJECT_BINARY_DIR}/swiftlet-config.cmake" "${PROJECT_BINARY_DIR}/swiftlet-config-version.cmake"
        DESTINATION "${package_dir}" COMPONENT development)
foreach(library ${libraries})
  get_target_property(folder ${library} SWIFTLET_FOLDER)
  if(NOT folder)
    continue()
  endif()
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${folder}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/swiftlet/${folder}"
          COMPONENT development FILES_MATCHING PATTERN "*.hpp" PATTERN "node_modules" EXCLUDE)
endforeach()

if(TARGET swiftlet)
  install(TARGETS swiftlet RUNTIME COMPONENT program)
endif()
if(TARGET swiftlet AND NOT SWIFTLET_SANITIZE)  # What a sanitizer reports would end the build.
  set(man_page "${PROJECT_BINARY_DIR}/swiftlet.1.gz")
  add_custom_command(OUTPUT "${man_page}" DEPENDS swiftlet cmake/man_page.sh VERBATIM
    COMMAND bash -o pipefail -c "\"$1\" \"$2\" \"$3\" | gzip -9n >\"$4\"" man_page
            "${PROJECT_SOURCE_DIR}/cmake/man_page.sh" "$<TARGET_FILE:swiftlet>" ${PROJECT_VERSION} "${man_page}"
    COMMENT "Making the man page from --help")
  add_custom_target(swiftlet_man_page ALL DEPENDS "${man_page}")
  install(FILES "${man_page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
endif()
foreach(folder missions worlds config trials)
  if(EXISTS "${PROJECT_SOURCE_DIR}/${folder}")
    install(DIRECTORY ${folder} DESTINATION "${CMAKE_INSTALL_DATADIR}/swiftlet" COMPONENT program)
  endif()
endforeach()
install(FILES README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The Swiftlet authors")
set(CPACK_PACKAGE_CONTACT "The Swiftlet authors <swiftlet@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME swiftlet)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME swiftlet-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The libraries are static: a program that links them needs their dependencies, the -dev packages of section [build].
file(READ "${PROJECT_SOURCE_DIR}/scripts/packages.txt" packages)
string(REGEX MATCH "\n\\[build\\][^[]*" packages "${packages}")
string(REGEX MATCHALL "\n[a-z0-9.+-]+-dev" packages "${packages}")
list(TRANSFORM packages STRIP)
list(JOIN packages ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
include(CPack)

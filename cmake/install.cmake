# What others get of a build: `cmake --install`, `find_package(abbe)` and the packages of `cpack`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The program looks for share/abbe/stdlib in the folders above its own: a build is no different.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/abbe)
foreach(folder IN ITEMS stdlib examples)
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${folder} ${CMAKE_BINARY_DIR}/share/abbe/${folder} SYMBOLIC)
endforeach()

# libabbe.a: all that src/abbe.hpp needs, in one archive.
set(objects)
foreach(part IN ITEMS base simd field grammar optics geometry texture image font scene lang plan surface transport
    render job library)
  list(APPEND objects $<TARGET_OBJECTS:abbe_${part}>)
endforeach()
add_library(abbe_archive STATIC ${objects})
set_target_properties(abbe_archive PROPERTIES OUTPUT_NAME abbe EXPORT_NAME abbe LINKER_LANGUAGE CXX)
target_include_directories(abbe_archive INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/src>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(abbe_archive INTERFACE cxx_std_17)
target_link_libraries(abbe_archive INTERFACE fmt::fmt OpenEXR::OpenEXR PNG::PNG TIFF::TIFF JPEG::JPEG Freetype::Freetype TBB::tbb
  Threads::Threads ${CMAKE_DL_LIBS})

set(config ${CMAKE_INSTALL_LIBDIR}/cmake/abbe)
install(TARGETS abbe COMPONENT program)
install(DIRECTORY stdlib examples DESTINATION ${CMAKE_INSTALL_DATADIR}/abbe COMPONENT program)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program FILES_MATCHING PATTERN "*.md")
install(TARGETS abbe_archive EXPORT abbe COMPONENT development)
install(FILES src/abbe.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT abbe NAMESPACE abbe:: FILE abbe-targets.cmake DESTINATION ${config} COMPONENT development)
configure_package_config_file(cmake/abbe-config.cmake.in abbe-config.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(abbe-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/abbe-config.cmake ${CMAKE_BINARY_DIR}/abbe-config-version.cmake
  DESTINATION ${config} COMPONENT development)

# cpack -G DEB: abbe (the program) and libabbe-dev.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME abbe)
set(CPACK_PACKAGE_CONTACT "The abbe authors <abbe@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Ray tracer for scenes in POV-Ray's manner, exact about glass")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME abbe)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libabbe-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The library needs the program's stdlib, and who links it the libraries behind it.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "abbe (= ${PROJECT_VERSION}), libfmt-dev, libopenexr-dev, libpng-dev, libtiff-dev, libjpeg-dev, libfreetype-dev, libtbb-dev")
include(CPack)

# The middleware as an installed CMake package: find_package(liena) gives liena::liena.
include(CMakePackageConfigHelpers)

set(LIENA_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/liena")

install(TARGETS liena EXPORT liena ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY "${PROJECT_SOURCE_DIR}/liena/include/liena" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES "${PROJECT_BINARY_DIR}/liena/include/liena/version.hpp" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/liena)
install(EXPORT liena NAMESPACE liena:: FILE liena-targets.cmake DESTINATION ${LIENA_CMAKE_DIR})

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/liena-config.cmake.in" "${PROJECT_BINARY_DIR}/liena-config.cmake"
  INSTALL_DESTINATION ${LIENA_CMAKE_DIR})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/liena-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/liena-config.cmake" "${PROJECT_BINARY_DIR}/liena-config-version.cmake" DESTINATION ${LIENA_CMAKE_DIR})

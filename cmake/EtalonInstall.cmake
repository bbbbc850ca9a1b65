# Installation: headers under include/etalon, libraries, and the package files for find_package(etalon).
include(CMakePackageConfigHelpers)

set(etalon_installed_targets etalon_numeric_flags etalon_numeric etalon_truth etalon_raster etalon_probes etalon_lighting etalon_shadows
                             etalon_bitcheck)
set(etalon_installed_folders numeric raster probes lighting shadows bitcheck)
if(ETALON_APP)
  list(APPEND etalon_installed_targets etalon_files etalon_golden etalon_scene etalon_ar)
  list(APPEND etalon_installed_folders files golden scene ar)
  install(TARGETS etalon etalon_image_io RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/etalon)
endif()
install(TARGETS ${etalon_installed_targets} EXPORT etalonTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(folder ${etalon_installed_folders})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/etalon
          FILES_MATCHING PATTERN "*.h" PATTERN "*.inc" PATTERN "*.glsl")
endforeach()
install(EXPORT etalonTargets NAMESPACE etalon:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/etalon)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/etalonConfig.cmake.in
  ${CMAKE_BINARY_DIR}/etalonConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/etalon)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/etalonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/etalonConfig.cmake ${CMAKE_BINARY_DIR}/etalonConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/etalon)

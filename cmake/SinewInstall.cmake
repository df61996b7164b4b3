# Install and export: find_package(Sinew) gives sinew::Segmentation ... sinew::Pipeline.
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Sinew)
install(EXPORT SinewTargets NAMESPACE sinew:: DESTINATION ${config_dir})
configure_package_config_file(cmake/SinewConfig.cmake.in ${PROJECT_BINARY_DIR}/SinewConfig.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/SinewConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/SinewConfig.cmake ${PROJECT_BINARY_DIR}/SinewConfigVersion.cmake
              cmake/FindISAL.cmake cmake/FindOpenVDB.cmake cmake/SinewDependencies.cmake
        DESTINATION ${config_dir})

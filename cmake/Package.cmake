# What `cmake --install` puts in place: the program, and the metric as a library for find_package(Promenade COMPONENTS aqm).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS promenade COMPONENT program)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Promenade)
install(TARGETS promenade_core promenade_aqm EXPORT PromenadeAqm COMPONENT aqm
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/promenade)
install(EXPORT PromenadeAqm NAMESPACE promenade:: FILE PromenadeAqm.cmake DESTINATION ${package_folder} COMPONENT aqm)
configure_package_config_file(cmake/PromenadeConfig.cmake.in ${PROJECT_BINARY_DIR}/PromenadeConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PromenadeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PromenadeConfig.cmake ${PROJECT_BINARY_DIR}/PromenadeConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT aqm)

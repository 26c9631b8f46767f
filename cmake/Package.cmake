# What `cmake --install` puts in place: the program, and the metric as a library for find_package(Promenade COMPONENTS aqm).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS promenade COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Promenade)
install(TARGETS promenade_core promenade_aqm EXPORT PromenadeAqm COMPONENT aqm
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/promenade)
install(EXPORT PromenadeAqm NAMESPACE promenade:: FILE PromenadeAqm.cmake DESTINATION ${package_folder} COMPONENT aqm)
configure_package_config_file(cmake/PromenadeConfig.cmake.in ${PROJECT_BINARY_DIR}/PromenadeConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PromenadeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PromenadeConfig.cmake ${PROJECT_BINARY_DIR}/PromenadeConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT aqm)

# `cpack` in the build folder: a Debian package of the program.
find_program(GZIP gzip REQUIRED)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/changelog.gz
                   COMMAND ${GZIP} -9nc ${PROJECT_SOURCE_DIR}/packaging/changelog > ${PROJECT_BINARY_DIR}/changelog.gz
                   DEPENDS ${PROJECT_SOURCE_DIR}/packaging/changelog)
add_custom_target(package_changelog ALL DEPENDS ${PROJECT_BINARY_DIR}/changelog.gz)
install(FILES ${PROJECT_BINARY_DIR}/changelog.gz ${PROJECT_SOURCE_DIR}/packaging/copyright
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/promenade COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_NAME promenade)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "walkthrough animations of static scenes")
set(CPACK_PACKAGE_CONTACT "The Promenade authors <promenade@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME promenade)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Promenade ray traces a few frames of a walk through a glTF scene, warps them
to all the others, ray traces only what cannot be warped, and asks a model of
human vision at every step whether a viewer could tell the difference.
.
It needs a processor with AVX2.")
include(CPack)

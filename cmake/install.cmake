# What `cmake --install` puts where: headers, libraries, and the two ways to find them again,
# find_package(tamias2d) and pkg-config. tests/packaging builds a user of each.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(libraries tamias2d tamias2d_f64)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tamias2d)
set(header_filter "")
if(TARGET tamias2d_scene)
    list(APPEND libraries tamias2d_scene tamias2d_scene_f64)
else()
    set(header_filter PATTERN scene EXCLUDE)
endif()

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/tamias2d DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${header_filter})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(TARGETS ${libraries} EXPORT tamias2d)
install(EXPORT tamias2d NAMESPACE tamias2d:: FILE tamias2dTargets.cmake DESTINATION ${config_dir})
if(TARGET tamias2d_cli)
    install(TARGETS tamias2d_cli)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/tamias2dConfig.cmake.in tamias2dConfig.cmake
    INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(tamias2dConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tamias2dConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/tamias2dConfigVersion.cmake
    DESTINATION ${config_dir})

# The .pc files name their prefix relative to themselves, so that a moved tree still works.
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_prefix /${pc_dir} /)
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
foreach(name tamias2d tamias2d_f64)
    set(pc_name ${name})
    set(pc_definition "")
    if(name STREQUAL tamias2d_f64)
        set(pc_definition " -DTAMIAS_F64")
    endif()
    configure_file(${PROJECT_SOURCE_DIR}/cmake/tamias2d.pc.in ${name}.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${pc_dir})
endforeach()

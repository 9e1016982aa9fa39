# `cmake --install`, after either command of the README: the program, the shared library with its headers and CMake package, and the Lua homes.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/stampede)

set_target_properties(stampede_shared PROPERTIES EXPORT_NAME stampede)
target_include_directories(stampede_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(stampede_shared INTERFACE cxx_std_20)

install(TARGETS stampede_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS stampede_shared EXPORT stampede LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT stampede NAMESPACE stampede:: FILE stampede-targets.cmake DESTINATION ${package_folder})

file(WRITE ${PROJECT_BINARY_DIR}/stampede-config.cmake "include(\${CMAKE_CURRENT_LIST_DIR}/stampede-targets.cmake)\n")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stampede-config-version.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stampede-config.cmake ${PROJECT_BINARY_DIR}/stampede-config-version.cmake
  DESTINATION ${package_folder})

install(DIRECTORY engine/include/stampede db/include/stampede scripting/include/stampede
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" PATTERN error.h EXCLUDE)
install(FILES engine/base/error.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stampede)
install(DIRECTORY tasks skills worlds DESTINATION ${CMAKE_INSTALL_DATADIR}/stampede
  FILES_MATCHING PATTERN "*.lua" PATTERN "*.urdf" PATTERN "*.obj" PATTERN "*.mtl" PATTERN "*.stl"
  PATTERN "*.dae" PATTERN "*.glb" PATTERN "*.ply" PATTERN "*.png" PATTERN "*.jpg" PATTERN "*.json")
install(FILES scripting/commands/completion.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME stampede)

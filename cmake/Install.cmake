# `cmake --install`: the program with its robots, scenarios, completions and manual pages; with the libraries, headers and
# the package files by which another project says `find_package(umbsim)`. CPack makes a Debian package of the program.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS umbsim_program RUNTIME COMPONENT program)
install(DIRECTORY scenarios robots DESTINATION ${CMAKE_INSTALL_DATADIR}/umbsim COMPONENT program)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# Completions and manual pages come from the program's own tables of options.
set(shell_files ${PROJECT_BINARY_DIR}/shell)
add_custom_command(OUTPUT ${shell_files}/umbsim.1 ${shell_files}/umbsim.bash ${shell_files}/_umbsim
  COMMAND ${CMAKE_COMMAND} -E make_directory ${shell_files}
  COMMAND umbsim_program completion bash > ${shell_files}/umbsim.bash
  COMMAND umbsim_program completion zsh > ${shell_files}/_umbsim
  COMMAND umbsim_program completion man > ${shell_files}/umbsim.1
  DEPENDS umbsim_program VERBATIM COMMENT "Writing completions and the manual page")
add_custom_target(umbsim_shell_files ALL DEPENDS ${shell_files}/umbsim.1)
install(FILES ${shell_files}/umbsim.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME umbsim
        COMPONENT program)
install(FILES ${shell_files}/_umbsim DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${shell_files}/umbsim.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)

# Libraries for other projects: from the core to whole experiments. Import and export of logs stay with the program.
set(libraries core sim odometry effects recording umbmark calibration batch experiment)
foreach(library IN LISTS libraries)
  set_target_properties(umbsim_${library} PROPERTIES EXPORT_NAME ${library})
  install(DIRECTORY ${library} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/umbsim COMPONENT development
          FILES_MATCHING PATTERN "*.h")
endforeach()
list(TRANSFORM libraries PREPEND umbsim_ OUTPUT_VARIABLE targets)
install(TARGETS ${targets} umbsim_flags bullet_float64 EXPORT umbsim COMPONENT development)
install(EXPORT umbsim FILE umbsim-targets.cmake NAMESPACE umbsim:: COMPONENT development
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/umbsim)
configure_package_config_file(cmake/umbsim-config.cmake.in umbsim-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/umbsim)
write_basic_package_version_file(umbsim-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/umbsim-config.cmake ${PROJECT_BINARY_DIR}/umbsim-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/umbsim COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of umbsim <umbsim@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Physics testbed for honest odometry: UMBmark in simulation and on recordings")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME umbsim)
set(CPACK_DEBIAN_PACKAGE_NAME umbsim)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
include(CPack)

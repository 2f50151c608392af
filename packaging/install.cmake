# What `cmake --install` puts where, and the Debian package of it. The extras, completion
# and man pages, are made from what the program says of itself.
include(GNUInstallDirs)

set(EXTRAS ${CMAKE_BINARY_DIR}/extras)
# help2man may come after a build without it: the extras are then made anew.
find_program(HELP2MAN help2man NO_CACHE)
set(EXTRAS_MADE ${EXTRAS}.stamp)
if(HELP2MAN)
  set(EXTRAS_MADE ${EXTRAS}-with-man.stamp)
endif()
add_custom_command(OUTPUT ${EXTRAS_MADE}
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/write_extras.sh $<TARGET_FILE:lanelight> ${EXTRAS}
  COMMAND ${CMAKE_COMMAND} -E rm -f ${EXTRAS}.stamp ${EXTRAS}-with-man.stamp
  COMMAND ${CMAKE_COMMAND} -E touch ${EXTRAS_MADE}
  DEPENDS lanelight ${CMAKE_CURRENT_LIST_DIR}/write_extras.sh
  COMMENT "Writing completion and man pages" VERBATIM)
add_custom_target(lanelight_extras ALL DEPENDS ${EXTRAS_MADE})

# Otherwise each install would build the tests first.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(SHARE ${CMAKE_INSTALL_DATADIR})
install(TARGETS lanelight)
# Only where it is asked for by name: cmake --install ... --component mpi.
if(LANELIGHT_MPI)
  install(TARGETS lanelight_mpi COMPONENT mpi EXCLUDE_FROM_ALL)
endif()
install(DIRECTORY ${EXTRAS}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} OPTIONAL)
install(FILES ${EXTRAS}/bash/lanelight DESTINATION ${SHARE}/bash-completion/completions)
install(FILES ${EXTRAS}/fish/lanelight.fish DESTINATION ${SHARE}/fish/vendor_completions.d)
# zsh of Debian looks into site-functions below /usr/local only.
install(CODE "set(extras \"${EXTRAS}\")\nset(share \"${SHARE}\")")
install(CODE [[
  set(folder site-functions)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(folder vendor-completions)
  endif()
  file(INSTALL "${extras}/zsh/_lanelight" TYPE FILE
       DESTINATION "${CMAKE_INSTALL_PREFIX}/${share}/zsh/${folder}")]])
install(DIRECTORY scenes/ DESTINATION ${SHARE}/lanelight/scenes
  FILES_MATCHING PATTERN "*.pbrt" PATTERN "*.tga" PATTERN sweep.toml PATTERN stiff EXCLUDE
  PATTERN model EXCLUDE)
# Debian's folder of modules for every version of Python 3.
install(DIRECTORY python/lanelight DESTINATION lib/python3/dist-packages
  PATTERN __pycache__ EXCLUDE)
install(FILES README.md CHANGELOG.md LICENSE packaging/copyright
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN site EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lanelight)
set(CPACK_PACKAGE_VENDOR "The Lanelight authors")
set(CPACK_PACKAGE_CONTACT "The Lanelight authors <authors@lanelight.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "SIMD wavefront path tracer for pbrt-v4 scenes")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Lanelight renders pbrt-v4 scene files on the CPU. Its rays live in queues that
fit in one core's cache and move through vectorised stages. Every image comes
with the variance of each pixel and an estimate of its own error; studies
measure which sampling strategy gives the least error for the time.")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# numpy for the Python package, matplotlib for its plots and `lanelight plot`.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-numpy, python3-matplotlib")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/package)
include(CPack)

# `cpack` in the build folder: a Debian package of all that is installed. .ci/package makes it in a bare system.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stampede)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Stampede authors <stampede@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Headless scenes with robot arms in them: tasks written in Lua become demonstrations
 with ground-truth segments, predicate timelines, PDDL and language, in one SQLite
 file that answers questions in SQL. With the C++ library and its headers.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
# Loaded when a picture is drawn by OSMesa, and when a film is written.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libosmesa6")
if(LIBAV_libavformat_VERSION MATCHES "^([0-9]+)")
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", libavformat${CMAKE_MATCH_1}")
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/stampede RENAME copyright)
set(materials ${PROJECT_BINARY_DIR}/materials)  # by .ci/materials, which looks at the finished program: Debian's `copyright` is in the place of ours
install(FILES ${materials}/copyright ${materials}/THIRD_PARTY_LICENCES.txt ${materials}/stampede.cdx.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/stampede OPTIONAL)
install(FILES CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/stampede)
include(CPack)

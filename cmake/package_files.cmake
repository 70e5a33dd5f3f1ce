# Run by cpack between the installation into a staging directory and the packages: what Debian wants in each of them.
cmake_host_system_information(RESULT release QUERY DISTRIB_VERSION_CODENAME)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
find_program(GZIP gzip REQUIRED)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} COMPONENT)
  set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
  set(pages ${share}/doc/${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  if(EXISTS ${pages}/LICENSE) # Debian has the text already
    file(REMOVE ${pages}/LICENSE)
    file(CREATE_LINK ../../common-licenses/LGPL-2.1 ${pages}/LICENSE SYMBOLIC)
  endif()
  configure_file(${CMAKE_CURRENT_LIST_DIR}/copyright ${pages}/copyright COPYONLY)
  if(component STREQUAL program)
    configure_file(${CMAKE_CURRENT_LIST_DIR}/README.Debian ${pages}/README.Debian COPYONLY)
  endif()
  file(WRITE ${pages}/changelog.Debian
       "debond (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) ${release}; urgency=medium\n\n"
       "  * What is new is in /usr/share/doc/debond/CHANGELOG.md of the package debond.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  file(GLOB manuals ${share}/man/man1/*.1)
  execute_process(COMMAND ${GZIP} -9 --no-name --force ${pages}/changelog.Debian ${manuals} COMMAND_ERROR_IS_FATAL ANY)
endforeach()

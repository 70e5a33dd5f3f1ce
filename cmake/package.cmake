# Packages of Debian in build/package: cmake --workflow --preset package. Needs dpkg-dev and file.
# Each component of the install rules is a package. One more needs a name below, CPACK_DEBIAN_<COMPONENT>_...; the
# libraries that its programs and modules are linked with are added to its dependencies (dpkg-shlibdeps).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME debond)
set(CPACK_PACKAGE_VENDOR "The authors of debond")
# who builds a package answers for it
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
else()
  set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR} <authors@debond.invalid>")
endif()
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
if(DEBOND_NATIVE)
  string(APPEND CPACK_DEBIAN_PACKAGE_RELEASE +native) # for processors that have what this one has
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(summary "implants coming off bone: contact with a decaying bond")
set(description
    "Simulates the tangential debonding of osseointegrated implants from bone:"
    "finite deformation contact of two bodies with NURBS-enriched contact"
    "surfaces and a friction law whose coefficient depends on the sliding"
    "distance.\n.\n")
list(JOIN description "\n" description)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME debond)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${summary}
${description}This package has the program, its scenes in /usr/share/debond/prm and its\npages.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-jinja2, python3-debond")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "openmpi-bin, paraview, libdebond-dev")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libdebond-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libdeal.ii-dev (>= 9.4)" "libeigen3-dev (>= 3.4)" libopenblas-dev libsuitesparse-dev libpng-dev
    "nlohmann-json3-dev (>= 3.11)")
list(JOIN CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${summary} (library)
${description}This package has the static library and its headers. find_package(debond) of\nCMake finds them.")

if(TARGET debond_python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1") # the module is of one version of Python, as its name says
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-debond)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy, python3-scipy, debond (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-openpyxl")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "${summary} (Python)
${description}This package has the compiled module of import debond, which fits need.")
endif()

# What Debian wants beside the files that are installed is added to each package.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/package_files.cmake)
include(CPack)

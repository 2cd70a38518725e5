# `cpack -G DEB --config build/release/CPackConfig.cmake` makes packages of what is installed:
# assay (the program with its models, scenarios and manual, and the Python module) and assay-dev (libraries, headers and
# their CMake configuration). If OpenCASCADE is installed, it also makes assay-step (which reads STEP files).
# dpkg-shlibdeps names the packages of the libraries that are linked.
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_COMPONENT_PROGRAM_GROUP user)
if(ASSAY_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_COMPONENT_PYTHON_GROUP user)
  set(CPACK_DEBIAN_USER_PACKAGE_RECOMMENDS "python3-numpy, python3-pandas")
endif()
if(TARGET assay_opencascade)
  list(APPEND CPACK_COMPONENTS_ALL step)
  set(CPACK_DEBIAN_STEP_PACKAGE_NAME assay-step)
  set(CPACK_DEBIAN_STEP_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_STEP_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_STEP_PACKAGE_DEPENDS "assay (= ${PROJECT_VERSION})")
  set(CPACK_COMPONENT_STEP_DESCRIPTION "Reads STEP files for the program.")
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "Maintainers of assay <maintainers@assay.invalid>")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
    GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_USER_PACKAGE_NAME assay)
set(CPACK_DEBIAN_USER_PACKAGE_SECTION science)
set(CPACK_DEBIAN_USER_PACKAGE_SHLIBDEPS ON)
# Nothing links the libraries that the program opens when it needs them.
set(CPACK_DEBIAN_USER_PACKAGE_DEPENDS "libosmesa6 | libegl1")
set(CPACK_DEBIAN_USER_PACKAGE_SUGGESTS ffmpeg)
set(CPACK_COMPONENT_GROUP_USER_DESCRIPTION "The program with its models, scenarios and manual.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME assay-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Libraries and headers, for find_package(assay) in CMake.")
# The packages that the installed configuration and headers need, from packages.txt.
file(STRINGS packages.txt dev_packages REGEX "^[a-z0-9+-]+-dev ")
list(FILTER dev_packages EXCLUDE REGEX "# (tests|benchmarks)")
list(TRANSFORM dev_packages REPLACE " .*" "")
list(JOIN dev_packages ", " dev_packages)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "assay (= ${PROJECT_VERSION}), ${dev_packages}")
include(CPack)

# cmake -DSOURCE=... -DSCRATCH=... -P configure_test.cmake: what the configure step asks for.
# The planner configures with everything of the simulator hidden, and looks for none of it; and
# whatever else is hidden is named by its Debian package, which stands in packages.txt.

cmake_minimum_required(VERSION 3.25)

function(configure result output)
  file(REMOVE_RECURSE ${SCRATCH})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH} -G Ninja ${ARGN}
                  RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  set(${result} ${status} PARENT_SCOPE)
  set(${output} "${said}" PARENT_SCOPE)
endfunction()

set(hide_simulator -DCMAKE_DISABLE_FIND_PACKAGE_mujoco=ON -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON
                   -DCMAKE_DISABLE_FIND_PACKAGE_OpenGL=ON -DASSAY_FOUND_opencv2_core_hpp=)
configure(status said -DASSAY_SIM=OFF ${hide_simulator})
if(status)
  message(SEND_ERROR "the planner alone does not configure:\n${said}")
endif()
file(STRINGS ${SCRATCH}/CMakeCache.txt sought REGEX "^(mujoco_DIR|OpenGL|OPENGL|OSMESA|ASSAY_FOUND_opencv_)")
if(sought)
  message(SEND_ERROR "the planner alone looked for parts of the simulator:\n${sought}")
endif()

# hidden(PACKAGES DEFINITION): without what DEFINITION hides, the message names the PACKAGES.
file(STRINGS ${SOURCE}/packages.txt lines REGEX "^[^#]")
list(TRANSFORM lines REPLACE "[ #].*" "" OUTPUT_VARIABLE listed)
function(hidden packages definition)
  configure(status said -DASSAY_SIM=ON ${definition})
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(NOT status OR NOT said MATCHES "apt-get install ${packages}( |$)")
    message(SEND_ERROR "${definition}: expected ${packages}, got:\n${said}")
  endif()
  separate_arguments(names UNIX_COMMAND "${packages}")
  foreach(package IN LISTS names)
    if(NOT package IN_LIST listed)
      message(SEND_ERROR "${package} does not stand in packages.txt")
    endif()
  endforeach()
endfunction()

hidden("liburdfdom-dev liburdfdom-headers-dev libconsole-bridge-dev" -DASSAY_FOUND_urdfdom_model=)
hidden("libopencv-imgcodecs-dev libopencv-imgproc-dev" -DASSAY_FOUND_opencv_imgcodecs=)
hidden("libwebp-dev" -DASSAY_FOUND_webpmux=)
hidden("libfcl-dev libccd-dev" -DASSAY_FOUND_ccd=)
hidden("libompl-dev" -DASSAY_FOUND_ompl=)
hidden("libassimp-dev" -DASSAY_FOUND_assimp=)
hidden("esbuild" -DESBUILD=)
hidden("libjs-three" -DTHREE_JS=)
# Read from where the packages are asked for, so that none is forgotten.
foreach(file IN ITEMS CMakeLists.txt tests/CMakeLists.txt bench/CMakeLists.txt)
  file(STRINGS ${SOURCE}/${file} requirements REGEX "^ *assay_require\\(")
  foreach(requirement IN LISTS requirements)
    string(REGEX MATCH "assay_require\\(([^ ]+) \"?([^\")]+)" matched "${requirement}")
    hidden("${CMAKE_MATCH_2}" -DCMAKE_DISABLE_FIND_PACKAGE_${CMAKE_MATCH_1}=ON)
  endforeach()
endforeach()

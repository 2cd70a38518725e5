# cmake -DLINKED=FILE,FILE... -P licences_test.cmake: the program and its modules are linked with
# listed libraries only, none of which is under the GPL. A library that is not listed needs its
# licence looked up, and a line here and in README.md. What these libraries load in turn is the
# distribution's choice. Prints "no objdump" where the linked libraries cannot be listed.
cmake_minimum_required(VERSION 3.25)
find_program(objdump objdump)
if(NOT objdump)
  message("no objdump")
  return()
endif()
set(allowed
  "libmujoco"           # Apache-2.0
  "libopencv_[a-z]+"    # Apache-2.0
  "libtbb"              # Apache-2.0
  "libccd"              # BSD-3-Clause
  "libwebp(mux)?"       # BSD-3-Clause
  "libompl"             # BSD-3-Clause
  "libassimp"           # BSD-3-Clause
  "liburdfdom_model"    # BSD-3-Clause
  "libconsole_bridge"   # BSD-3-Clause
  "libfmt"              # MIT
  "libmimalloc"         # MIT
  "libyaml-cpp"         # MIT
  "libnlopt(_cxx)?"     # MIT, parts LGPL-2.1+
  "libgmp(xx)?"         # LGPL-3+
  "libTK[A-Za-z0-9]+"   # LGPL-2.1 (OpenCASCADE)
  "libqhull_r"          # Qhull
  "libsqlite3"          # public domain
  "libstdc\\+\\+"       # GPL-3 with the runtime exception
  "libgcc_s"            # GPL-3 with the runtime exception
  "libm" "libc" "ld-linux-[a-z0-9-]+")  # LGPL-2.1+
list(JOIN allowed "|" allowed)
string(REPLACE "," ";" files "${LINKED}")
foreach(file IN LISTS files)
  execute_process(COMMAND ${objdump} -p ${file} OUTPUT_VARIABLE headers RESULT_VARIABLE failed)
  if(failed)
    message(SEND_ERROR "${file} cannot be read")
  endif()
  string(REGEX MATCHALL "NEEDED +[^\n]+" needed "${headers}")
  if(NOT needed)
    message(SEND_ERROR "${file} is linked with nothing")
  endif()
  foreach(line IN LISTS needed)
    string(REGEX REPLACE "NEEDED +" "" library "${line}")
    if(NOT library MATCHES "^(${allowed})\\.so")
      message(SEND_ERROR "${file} is linked with ${library}, whose licence is not listed")
    endif()
  endforeach()
endforeach()

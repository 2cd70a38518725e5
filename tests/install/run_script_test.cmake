# cmake -DSOURCE=... -DSCRATCH=... -DPROGRAM=... -P run_script_test.cmake: a copy of the repository in
# which nothing is built knows the same verbs as the program, and refuses a wrong verb at once.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${SCRATCH})
file(COPY ${SOURCE}/run.sh ${SOURCE}/packages.txt ${SOURCE}/CMakeLists.txt ${SOURCE}/.ci DESTINATION ${SCRATCH})
file(COPY ${SOURCE}/sim/cli DESTINATION ${SCRATCH}/sim)

execute_process(COMMAND ${SCRATCH}/run.sh no-such-verb RESULT_VARIABLE code ERROR_VARIABLE refusal)
if(NOT code EQUAL 2)
  message(FATAL_ERROR "A wrong verb ends with ${code}, not 2: ${refusal}")
endif()
string(REGEX REPLACE ".*allowed: (.*)\n" "\\1" allowed "${refusal}")

execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*\nVerbs:(\n.*)\n\nassay VERB .*" "\\1" help "${help}")
string(REGEX MATCHALL "\n  [a-z]+ " verbs "${help}")
list(TRANSFORM verbs STRIP)
list(SORT verbs)
list(JOIN verbs " " verbs)
if(NOT allowed STREQUAL verbs)
  message(FATAL_ERROR "The script allows '${allowed}', and the program has '${verbs}'")
endif()

# cmake -D BUILD_DIR= -D SOURCE_DIR= -D CONFIG= -D GENERATOR= -D COMPILER= -D SCRATCH_DIR= -P ConsumerTest.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(prefix ${SCRATCH_DIR}/prefix)
file(REMOVE_RECURSE ${SCRATCH_DIR})
file(MAKE_DIRECTORY ${SCRATCH_DIR}/meshes)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --config ${CONFIG})

# C6: Slicer tries every program of the modules' folder, so nothing else may be there, and they are nowhere else.
file(GLOB_RECURSE modules RELATIVE ${prefix} ${prefix}/*)
set(beside ${modules})
list(FILTER modules INCLUDE REGEX "/Sinew(Mesher|Repair)$")
list(FILTER beside INCLUDE REGEX "/cli-modules/")
list(SORT modules)
list(SORT beside)
if(NOT modules STREQUAL beside OR NOT modules MATCHES "^[^;]*/sinew/cli-modules/SinewMesher;[^;]*/sinew/cli-modules/SinewRepair$")
  message(FATAL_ERROR "The Slicer modules do not stand alone in their folder: ${modules} and ${beside}")
endif()
foreach(module IN LISTS modules)
  run(${prefix}/${module} --xml)
endforeach()

# What is installed must not point back to where it was built.
file(GLOB_RECURSE installed ${prefix}/*.cmake)
if(NOT installed)
  message(FATAL_ERROR "No package files were installed below ${prefix}")
endif()
foreach(file IN LISTS installed)
  file(READ ${file} text)
  foreach(path IN ITEMS ${SOURCE_DIR} ${BUILD_DIR})
    string(FIND "${text}" "${path}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names ${path}")
    endif()
  endforeach()
endforeach()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${SCRATCH_DIR}/build -G ${GENERATOR}
    -D CMAKE_BUILD_TYPE=${CONFIG} -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${SCRATCH_DIR}/build --config ${CONFIG})
run(${SCRATCH_DIR}/build/consumer ${SCRATCH_DIR}/meshes)

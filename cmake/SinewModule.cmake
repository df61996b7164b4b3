# sinew_add_module(NAME SOURCES ... PUBLIC libs... PRIVATE libs... TESTS ... BENCHMARKS ...)
#
# One static library sinew::NAME from Modules/NAME: public headers in include/, the rest in src/,
# unit tests (one executable NAMETest; the target unit-tests builds all) and benchmarks (one executable NAMEBench).
function(sinew_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE;TESTS;TEST_LIBRARIES;BENCHMARKS" ${ARGN})
  set(target Sinew${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(sinew::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE src)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  sinew_warnings(${target})
  install(TARGETS ${target} EXPORT SinewTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

  if(SINEW_BUILD_TESTING AND ARG_TESTS)
    add_executable(${name}Test ${ARG_TESTS})
    target_include_directories(${name}Test PRIVATE src)
    target_link_libraries(${name}Test PRIVATE ${target} ${ARG_PRIVATE} ${ARG_TEST_LIBRARIES} sinew::TestSupport GTest::gtest_main)
    sinew_test_warnings(${name}Test)
    gtest_discover_tests(${name}Test DISCOVERY_TIMEOUT 60 PROPERTIES LABELS unit)
    if(NOT TARGET unit-tests)
      add_custom_target(unit-tests)
    endif()
    add_dependencies(unit-tests ${name}Test)
  endif()
  if(SINEW_BUILD_BENCHMARKS AND ARG_BENCHMARKS)
    add_executable(${name}Bench ${ARG_BENCHMARKS})
    target_include_directories(${name}Bench PRIVATE src)
    target_link_libraries(${name}Bench PRIVATE ${target} ${ARG_PRIVATE} sinew::TestSupport benchmark::benchmark_main)
    sinew_warnings(${name}Bench)
    add_test(NAME ${name}Bench COMMAND ${name}Bench --benchmark_min_time=0.01)  # only that it builds and runs
    set_tests_properties(${name}Bench PROPERTIES LABELS benchmark)
  endif()
endfunction()

# Warnings, and the sanitizers of the dev preset: what they find ends the program.
function(sinew_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic)
  if(SINEW_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${SINEW_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(SINEW_SANITIZE_WITHOUT)
      target_compile_options(${target} PRIVATE -fno-sanitize=${SINEW_SANITIZE_WITHOUT})
    endif()
    target_link_options(${target} PUBLIC -fsanitize=${SINEW_SANITIZE})
  endif()
endfunction()

# Warnings for tests. The sanitizers watch the library; its tests only have to compile fast.
function(sinew_test_warnings target)
  sinew_warnings(${target})
  if(SINEW_SANITIZE)
    target_compile_options(${target} PRIVATE -fno-sanitize=undefined -O0)
  endif()
endfunction()

# Flags that every target of the project shares.
add_library(promenade_flags INTERFACE)
target_include_directories(promenade_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_options(promenade_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wconversion -Wno-sign-conversion -Werror
  # No contraction to fused multiply-adds: swapping the two frames of a comparison must not change a bit.
  -ffp-contract=off)
# What is private to one file of a unity build is private to the translation unit that includes it.
if(CMAKE_UNITY_BUILD)
  target_compile_options(promenade_flags INTERFACE -Wno-subobject-linkage)
endif()
# x86-64-v3 (AVX2) is what Embree needs to be worth its name; every machine since 2013 has it.
target_compile_options(promenade_flags INTERFACE -march=x86-64-v3)
if(PROMENADE_SANITIZE)
  target_compile_options(promenade_flags INTERFACE -fsanitize=${PROMENADE_SANITIZE} -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  target_link_options(promenade_flags INTERFACE -fsanitize=${PROMENADE_SANITIZE})
endif()

# promenade_library(NAME SOURCES a.cpp ... [HEADERS a.h ...] [PUBLIC target ...] [PRIVATE target ...]): promenade::NAME.
# HEADERS are those that other programs get (cmake/Package.cmake).
function(promenade_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  add_library(promenade_${name} STATIC ${ARG_SOURCES})
  add_library(promenade::${name} ALIAS promenade_${name})
  set_target_properties(promenade_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(promenade_${name} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:promenade_flags> ${ARG_PRIVATE})
  target_include_directories(promenade_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  if(ARG_HEADERS)
    target_sources(promenade_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  endif()
endfunction()

# promenade_test(NAME SOURCES a_test.cpp ... LIBRARIES target ... [LABELS ...] [TIMEOUT seconds] [ALONE Suite.Test ...]
# [SLOW Suite.Test ...]): one executable, one CTest entry a test suite. ALONE and SLOW name test cases, * allowed, that are
# entries of their own: those that may be skipped, and those that take seconds. SLOW also gives them the label "slow" instead:
# the sanitizer builds leave them out.
function(promenade_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS;ALONE;SLOW" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/tests/main.cpp)
  target_link_libraries(${name} PRIVATE promenade_flags ${ARG_LIBRARIES} GTest::gmock TBB::tbb)
  target_compile_definitions(${name} PRIVATE PROMENADE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # What a test does itself takes longer to optimise than to run; the libraries that it calls are optimised fully.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1> $<$<CONFIG:RelWithDebInfo>:-Og>)

  set(single ${ARG_ALONE} ${ARG_SLOW})
  set(discovery DISCOVERY_TIMEOUT 60 DISCOVERY_MODE PRE_TEST)
  list(JOIN ARG_SLOW ":" slow)
  list(JOIN ARG_ALONE ":" alone)
  if(slow)
    # One label: of a list only the first gets through.
    gtest_discover_tests(${name} ${discovery} TEST_FILTER "${slow}" PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS slow)
  endif()
  if(alone)
    gtest_discover_tests(${name} ${discovery} TEST_FILTER "${alone}" PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}")
  endif()
  list(JOIN single ":" single)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/TestSuites.cmake.in ${name}_suites.cmake @ONLY)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
endfunction()
if(PROMENADE_TESTS)
  include(GoogleTest)
endif()

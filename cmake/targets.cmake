# Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
# The compile flags every target shares, and how a folder becomes a library target.

add_library(isotach_flags INTERFACE)
target_include_directories(isotach_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(isotach_flags INTERFACE -Wall -Wextra -Wconversion -Wshadow)
# g++ 12 warns of its own AVX-512 headers wherever Eigen is inlined (_mm512_undefined_pd, GCC bug 105593), in which files
# depends on the processor; clang has the same warnings without these false ones
target_compile_options(isotach_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-uninitialized>)
if(ISOTACH_NATIVE)
  target_compile_options(isotach_flags INTERFACE -march=native)
else()
  # octets are passed by value between functions that are always inlined, so their ABI does not matter (mpm/octet.hpp)
  target_compile_options(isotach_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>)
endif()
# Results do not depend on errno, nor on traps; nothing else of -ffast-math is allowed, so NaN stays NaN.
target_compile_options(isotach_flags INTERFACE -fno-math-errno -fno-trapping-math)
if(ISOTACH_DEVELOPER)
  target_compile_options(isotach_flags INTERFACE -Werror)
  target_compile_definitions(isotach_flags INTERFACE _GLIBCXX_ASSERTIONS)
endif()

# isotach_compile_quickly(TARGET): for tests, whose own code need not be fast, so that compiling it takes two thirds of
# the time. Not for libraries: of a template that two objects instantiate the linker keeps either.
function(isotach_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# isotach_compile_together(TARGET SOURCES...): with ISOTACH_UNITY these are compiled as one, which reads the headers once;
# of files that do little but include them, that halves the time. Groups are named one by one, so that a new file stands
# alone until it joins one, and only files of one group must not give a name of their own two meanings.
function(isotach_compile_together target)
  if(ISOTACH_UNITY)
    list(GET ARGN 0 first)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${first})
  endif()
endfunction()

# isotach_library(NAME SOURCES... LINKS...): the library isotach::NAME of the folder NAME.
function(isotach_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_library(isotach_${name} STATIC ${ARG_SOURCES})
  add_library(isotach::${name} ALIAS isotach_${name})
  target_link_libraries(isotach_${name} PUBLIC isotach_flags ${ARG_LINKS})
endfunction()

# How every folder is compiled, and stampede_room(): a folder is one static library whose link line is the rule.
find_program(CCACHE ccache)
if(CCACHE)
  # Precompiled headers are what ccache has to be told of; paths are hashed as seen from the source folder.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE})
endif()
find_program(LLD ld.lld)
if(LLD)
  add_link_options(-fuse-ld=lld)
endif()

set(STAMPEDE_SANITIZE "" CACHE STRING "Sanitizers to build with, such as address,undefined")

include(StampedeHardened)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
if(CMAKE_CXX_FLAGS_DEBUG STREQUAL "-g")  # CMake's own: nobody asked for others
  set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g")  # assertions of the standard library and of Eigen stay on
endif()

option(STAMPEDE_WERROR "Treat warnings as errors" ON)

add_library(stampede_options INTERFACE)
target_compile_options(stampede_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  # GCC 12 raises false alarms about sums of strings (its bug 105651)
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds> $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=500000>  # kB; collecting garbage earlier costs a tenth of the time
  $<$<BOOL:${STAMPEDE_WERROR}>:-Werror>
  -ffp-contract=off)  # same sums in debug and optimised builds
target_compile_definitions(stampede_options INTERFACE $<$<CONFIG:Release>:NDEBUG> $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)
target_include_directories(stampede_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/engine/include
  ${PROJECT_SOURCE_DIR}/db/include ${PROJECT_SOURCE_DIR}/scripting/include)
if(STAMPEDE_SANITIZE)
  add_compile_options(-fsanitize=${STAMPEDE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -g1)
  add_link_options(-fsanitize=${STAMPEDE_SANITIZE})
  # The checks a sanitizer weaves in hide from GCC 12 that Eigen's and the standard library's values are set.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  # Checks woven into every dereference double the build, and the address sanitizer traps a bad pointer anyway.
  add_compile_options(-fno-sanitize=null,alignment,object-size,vptr,pointer-overflow)
endif()

# The headers that nearly every file includes, compiled once. They belong to nobody: of our own there is none among them.
set(stampede_common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory>
  <optional> <set> <sstream> <string> <string_view> <unordered_map> <variant> <vector> <Eigen/Dense>)
target_compile_options(stampede_options INTERFACE -fpch-preprocess)  # for ccache
# For rooms that say INNER_LOOPS a second time with -O3, which puts Eigen's products of poses where they are used; of
# precompiled headers GCC keeps the options that they were compiled with.
function(stampede_precompile name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/engine/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE stampede_options Eigen3::Eigen)
  target_compile_options(${name} PRIVATE ${ARGN})
  target_precompile_headers(${name} PRIVATE ${stampede_common_headers})
endfunction()
set(stampede_inner_loops $<$<CONFIG:Release>:-O3>
  $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)  # false alarms about Eigen's vectors
stampede_precompile(stampede_precompiled)
stampede_precompile(stampede_precompiled_inner ${stampede_inner_loops})

# stampede_room(base SOURCES a.cpp … USES rooms and packages its headers need … INSIDE those only its sources need …)
function(stampede_room name)
  cmake_parse_arguments(ROOM "INNER_LOOPS" "" "SOURCES;USES;INSIDE" ${ARGN})
  add_library(stampede_${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(stampede_${name} PUBLIC stampede_options ${ROOM_USES} PRIVATE ${ROOM_INSIDE})
  if(ROOM_INNER_LOOPS)
    target_compile_options(stampede_${name} PRIVATE ${stampede_inner_loops})
    target_precompile_headers(stampede_${name} REUSE_FROM stampede_precompiled_inner)
  else()
    target_precompile_headers(stampede_${name} REUSE_FROM stampede_precompiled)
  endif()
endfunction()

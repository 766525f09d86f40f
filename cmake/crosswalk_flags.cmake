# cw_flags: warnings, architecture, sanitizers; every target of ours links it.
add_library(cw_flags INTERFACE)
target_include_directories(cw_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(cw_flags INTERFACE
  -march=native -fno-math-errno -fno-trapping-math -ffp-contract=fast
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wold-style-cast
  -Woverloaded-virtual -Wnon-virtual-dtor -Wdouble-promotion -Wduplicated-cond -Wlogical-op -Werror
  # wrong alarms of g++ 12 that come and go with the optimiser and the processor
  -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
target_link_libraries(cw_flags INTERFACE Eigen3::Eigen fmt::fmt OpenMP::OpenMP_CXX)

option(CROSSWALK_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
if(CROSSWALK_SANITIZE)
  # without vptr: LCM's header casts an object to a type it is not (lcm-cpp-impl.hpp, untyped handlers)
  target_compile_options(cw_flags INTERFACE -fsanitize=address,undefined -fno-sanitize=vptr
                         -fno-sanitize-recover=all
                         -fno-omit-frame-pointer
                         -Wno-uninitialized)  # false in g++ 12's avx512fintrin.h
  target_link_options(cw_flags INTERFACE -fsanitize=address,undefined)
endif()

# Headers that nearly every file reads, compiled once; not with ccache, which they would hinder.
if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/gen/headers.cpp CONTENT "// stands for the precompiled headers\n")
  add_library(cw_headers OBJECT ${PROJECT_BINARY_DIR}/gen/headers.cpp)
  target_link_libraries(cw_headers PRIVATE cw_flags)
  target_precompile_headers(cw_headers PRIVATE <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional>
                            <map> <memory> <optional> <span> <sstream> <string> <vector> <Eigen/Core> <Eigen/Geometry>
                            <fmt/format.h>)
endif()
function(cw_precompiled_headers target)
  if(TARGET cw_headers)
    target_precompile_headers(${target} REUSE_FROM cw_headers)
  endif()
endfunction()

# cw_library(NAME cw_xyz SOURCES ... [LINK ...]): a module folder as a static library.
function(cw_library)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LINK" ${ARGN})
  add_library(${ARG_NAME} STATIC ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PUBLIC cw_flags ${ARG_LINK})
  cw_precompiled_headers(${ARG_NAME})
endfunction()

# cw_program(NAME xyz SOURCES main.cpp LINK ...): an executable in <build>/bin.
function(cw_program)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LINK" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE cw_flags ${ARG_LINK})
  cw_precompiled_headers(${ARG_NAME})
endfunction()

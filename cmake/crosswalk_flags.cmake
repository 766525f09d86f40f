# cw_flags: warnings, architecture, sanitizers; every target of ours links it.
add_library(cw_flags INTERFACE)
target_include_directories(cw_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(cw_flags INTERFACE
  -march=native -fno-math-errno -fno-trapping-math -ffp-contract=fast
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wold-style-cast
  -Woverloaded-virtual -Wnon-virtual-dtor -Wdouble-promotion -Wduplicated-cond -Wlogical-op -Werror
  # wrong alarms of g++ 12 that come and go with the optimiser and the processor
  -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
  -Wno-restrict)
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

# Headers that nearly every file reads, compiled once. -fpch-preprocess is for ccache.
target_compile_options(cw_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/gen/headers.cpp CONTENT "// stands for the precompiled headers\n")
# cw_precompiled_headers(NAME HEADERS <more> LINK ...): for targets that say `REUSE_FROM NAME`.
function(cw_precompiled_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/gen/headers.cpp)
  target_link_libraries(${name} PRIVATE cw_flags ${ARG_LINK})
  target_precompile_headers(${name} PRIVATE <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional>
                            <map> <memory> <optional> <span> <sstream> <string> <vector> <Eigen/Core> <Eigen/Geometry>
                            <fmt/format.h> ${ARG_HEADERS})
endfunction()
cw_precompiled_headers(cw_headers)

# cw_library(NAME cw_xyz SOURCES ... [LINK ...]): a module folder as a static library.
function(cw_library)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LINK" ${ARGN})
  add_library(${ARG_NAME} STATIC ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PUBLIC cw_flags ${ARG_LINK})
  target_precompile_headers(${ARG_NAME} REUSE_FROM cw_headers)
endfunction()

# cw_program(NAME xyz SOURCES main.cpp LINK ...): an executable in <build>/bin.
function(cw_program)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LINK" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE cw_flags ${ARG_LINK})
  target_precompile_headers(${ARG_NAME} REUSE_FROM cw_headers)
endfunction()

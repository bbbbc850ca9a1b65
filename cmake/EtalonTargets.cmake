# Helpers that every folder's CMakeLists.txt uses, and the one target that carries the numeric flags.

# etalon::numeric_flags: what every object that computes must be compiled with. Contraction into fused
# multiply-adds is off for every compiler (g++ fuses by default, even with -std=c++20); fast-math never.
add_library(etalon_numeric_flags INTERFACE)
add_library(etalon::numeric_flags ALIAS etalon_numeric_flags)
set_target_properties(etalon_numeric_flags PROPERTIES EXPORT_NAME numeric_flags)
target_compile_features(etalon_numeric_flags INTERFACE cxx_std_20)
target_compile_options(etalon_numeric_flags INTERFACE -ffp-contract=off -fno-fast-math -fno-math-errno)

# g++ 12 merges neighbouring scalar conversions with -ftree-slp-vectorize and then drops a rounding to float:
# two of "to[i] = 1.0 + (float)from[i]" in a row keep the double (test: TheCompilerKeepsTheRoundingOfNeighbours).
target_compile_options(etalon_numeric_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

# A note about passing wide vectors between functions; nothing passes them across objects.
target_compile_options(etalon_numeric_flags INTERFACE -Wno-psabi)

# Objects outside the levels of EtalonLevels.cmake run on every processor of x86-64-v2.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(etalon_numeric_flags INTERFACE
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:ETALON_LEVEL>>>:-march=x86-64-v2>)
endif()

# Warnings for our own code only; not exported.
add_library(etalon_warnings INTERFACE)
target_compile_options(etalon_warnings INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wcast-align
                       $<$<BOOL:${ETALON_WERROR}>:-Werror>)

# The headers of libraries that most sources read, compiled once for each way of compiling: half of what a source takes.
# Sources include what they use all the same; scripts/check_lint reads them without it.
find_package(glm REQUIRED)
set(etalon_common_headers <algorithm> <array> <cmath> <filesystem> <functional> <memory> <optional> <span> <string>
                          <unordered_map> <vector> <glm/mat3x3.hpp> <glm/mat4x4.hpp> <glm/vec2.hpp> <glm/vec3.hpp>
                          <glm/vec4.hpp>)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND etalon_common_headers <immintrin.h>)
endif()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/etalon_headers.cpp CONTENT "")
add_library(etalon_headers OBJECT ${CMAKE_BINARY_DIR}/etalon_headers.cpp)
target_link_libraries(etalon_headers PRIVATE etalon_numeric_flags etalon_warnings glm::glm)
target_precompile_headers(etalon_headers PRIVATE ${etalon_common_headers})

# etalon_library(NAME sources...): one library target per folder, with its alias and export name.
function(etalon_library name)
  add_library(etalon_${name} STATIC ${ARGN})
  add_library(etalon::${name} ALIAS etalon_${name})
  set_target_properties(etalon_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(etalon_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/etalon>)
  target_link_libraries(etalon_${name} PUBLIC etalon_numeric_flags PRIVATE $<BUILD_INTERFACE:etalon_warnings>)
  target_precompile_headers(etalon_${name} REUSE_FROM etalon_headers)
endfunction()

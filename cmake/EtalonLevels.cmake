# Passes are compiled once per instruction set level; numeric/isa.h chooses between them at run time.
#
# The objects of one level and library are linked into one relocatable object whose only global symbols are its entries,
# etalon::level_<name>::passesOf<Table>() (numeric/door.h). Everything else becomes local, so that no inline function,
# compiled for a newer processor, can be picked by the linker for code that older ones run (test: levels).

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(etalon_all_levels scalar v2 v3 v4)
  # One of these is in every build: they run wherever the rest of the program does.
  set(etalon_baseline_levels scalar v2)
  set(etalon_default_levels v2)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64|ARM64")
  set(etalon_all_levels scalar neon)
  set(etalon_baseline_levels scalar neon)
  set(etalon_default_levels neon)
else()
  set(etalon_all_levels scalar)
  set(etalon_baseline_levels scalar)
  set(etalon_default_levels scalar)
endif()
# The widest level of the machine that builds, from what its compiler takes it for.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT CMAKE_CROSSCOMPILING)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -dM -E -x c++ /dev/null
                  OUTPUT_VARIABLE etalon_native ERROR_QUIET)
  if(etalon_native MATCHES "__AVX512VL__" AND etalon_native MATCHES "__AVX512BW__"
     AND etalon_native MATCHES "__AVX512DQ__" AND etalon_native MATCHES "__AVX512CD__")
    list(APPEND etalon_default_levels v4)
  elseif(etalon_native MATCHES "__AVX2__" AND etalon_native MATCHES "__BMI2__" AND etalon_native MATCHES "__FMA__")
    list(APPEND etalon_default_levels v3)
  endif()
endif()
set(ETALON_LEVELS "${etalon_default_levels}" CACHE STRING
    "Instruction set levels to build, of: ${etalon_all_levels}; all: each. Default: the baseline and this machine's")
set(etalon_levels ${ETALON_LEVELS})
if(etalon_levels STREQUAL "all")
  set(etalon_levels ${etalon_all_levels})
endif()
foreach(level ${etalon_levels})
  if(NOT level IN_LIST etalon_all_levels)
    message(FATAL_ERROR "ETALON_LEVELS: ${level} is not one of ${etalon_all_levels}")
  endif()
endforeach()
set(etalon_common_levels ${etalon_levels})
list(FILTER etalon_common_levels INCLUDE REGEX "^(scalar|v2|neon)$")
if(NOT etalon_common_levels)
  list(GET etalon_baseline_levels -1 level)
  list(PREPEND etalon_levels ${level})
endif()

set(etalon_flags_scalar -DETALON_SCALAR_LANES)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND etalon_flags_scalar -march=x86-64-v2)
endif()
set(etalon_flags_v2 -march=x86-64-v2)
set(etalon_flags_v3 -march=x86-64-v3)
# Lanes fill 64 bytes, also where a compiler would prefer less.
set(etalon_flags_v4 -march=x86-64-v4 -mprefer-vector-width=512)
set(etalon_flags_neon "")

# GNU's: CMake may have found LLVM's programs, whose options differ.
find_program(ETALON_OBJCOPY NAMES ${CMAKE_LIBRARY_ARCHITECTURE}-objcopy objcopy REQUIRED)

# etalon_passes(LIBRARY [OVER_LEVELS sources...] [OVER_NUMBERS sources...]): adds the sources of families of passes to
# etalon_LIBRARY, once per level; those over number types once more for truth, which has no lanes.
function(etalon_passes library)
  cmake_parse_arguments(arg "" "" "OVER_LEVELS;OVER_NUMBERS" ${ARGN})
  foreach(level ${etalon_levels})
    set(objects etalon_${library}_${level})
    add_library(${objects} OBJECT ${arg_OVER_LEVELS} ${arg_OVER_NUMBERS})
    set_target_properties(${objects} PROPERTIES ETALON_LEVEL ${level})
    target_link_libraries(${objects} PRIVATE etalon_numeric etalon_warnings)
    target_compile_definitions(${objects} PRIVATE ETALON_LEVEL=level_${level})
    target_compile_options(${objects} PRIVATE ${etalon_flags_${level}}
      $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
    set(merged ${CMAKE_CURRENT_BINARY_DIR}/${objects}${CMAKE_CXX_OUTPUT_EXTENSION})
    add_custom_command(OUTPUT ${merged}
      COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -fuse-ld=bfd -Wl,--force-group-allocation -o ${merged}
              $<TARGET_OBJECTS:${objects}>
      COMMAND ${ETALON_OBJCOPY} --wildcard "--keep-global-symbol=_ZN6etalon*level_${level}8passesOfI*" ${merged}
      DEPENDS $<TARGET_OBJECTS:${objects}>
      COMMENT "Linking level ${level} of ${library}"
      COMMAND_EXPAND_LISTS VERBATIM)
    target_sources(etalon_${library} PRIVATE ${merged})
    set_property(GLOBAL APPEND PROPERTY ETALON_LEVELED_OBJECTS "${merged}")
  endforeach()
  if(arg_OVER_NUMBERS)
    add_library(etalon_${library}_truth OBJECT ${arg_OVER_NUMBERS})
    target_link_libraries(etalon_${library}_truth PRIVATE etalon_truth etalon_warnings)
    target_compile_definitions(etalon_${library}_truth PRIVATE ETALON_LEVEL=level_truth ETALON_TRUTH)
    target_sources(etalon_${library} PRIVATE $<TARGET_OBJECTS:etalon_${library}_truth>)
  endif()
endfunction()

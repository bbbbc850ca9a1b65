# Sources that are compiled once per instruction set level; numeric/isa.h chooses between them at run time.
#
# The objects of one level and library are linked into one relocatable object whose only global symbol is its entry,
# etalon::level_<name>::<something>Passes(). Everything else becomes local, so that no inline function, compiled for a
# newer processor, can be picked by the linker for code that older ones run (test: levels).

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(etalon_all_levels scalar v2 v3 v4)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64|ARM64")
  set(etalon_all_levels scalar neon)
else()
  set(etalon_all_levels scalar)
endif()
set(ETALON_LEVELS "${etalon_all_levels}" CACHE STRING "Instruction set levels to build, of: ${etalon_all_levels}")
foreach(level ${ETALON_LEVELS})
  if(NOT level IN_LIST etalon_all_levels)
    message(FATAL_ERROR "ETALON_LEVELS: ${level} is not one of ${etalon_all_levels}")
  endif()
endforeach()

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

# etalon_knows_levels(TARGET): defines ETALON_HAS_<level> for the sources of a target that chooses between levels.
function(etalon_knows_levels target)
  foreach(level ${ETALON_LEVELS})
    target_compile_definitions(${target} PRIVATE ETALON_HAS_${level})
  endforeach()
endfunction()

# etalon_leveled_sources(LIBRARY sources...): adds the sources to etalon_LIBRARY, once per level.
function(etalon_leveled_sources library)
  etalon_knows_levels(etalon_${library})
  foreach(level ${ETALON_LEVELS})
    set(objects etalon_${library}_${level})
    add_library(${objects} OBJECT ${ARGN})
    set_target_properties(${objects} PROPERTIES ETALON_LEVEL ${level})
    target_link_libraries(${objects} PRIVATE etalon_numeric etalon_warnings)
    target_compile_definitions(${objects} PRIVATE ETALON_LEVEL=level_${level})
    target_compile_options(${objects} PRIVATE ${etalon_flags_${level}}
      $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
    set(merged ${CMAKE_CURRENT_BINARY_DIR}/${objects}${CMAKE_CXX_OUTPUT_EXTENSION})
    add_custom_command(OUTPUT ${merged}
      COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -fuse-ld=bfd -Wl,--force-group-allocation -o ${merged}
              $<TARGET_OBJECTS:${objects}>
      COMMAND ${ETALON_OBJCOPY} --wildcard "--keep-global-symbol=_ZN6etalon*level_${level}*PassesEv" ${merged}
      DEPENDS $<TARGET_OBJECTS:${objects}>
      COMMENT "Linking level ${level} of ${library}"
      COMMAND_EXPAND_LISTS VERBATIM)
    target_sources(etalon_${library} PRIVATE ${merged})
    set_property(GLOBAL APPEND PROPERTY ETALON_LEVELED_OBJECTS "${merged}")
  endforeach()
endfunction()

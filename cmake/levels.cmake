# Sets LEVELS to the x86-64 levels to build the core for: "baseline", "v3" and "v4", or one of them.

set(SNAPSPACE_LEVELS all CACHE STRING
  "all: a build for each x86-64 level, chosen at import. native: only the one for this machine.")
set_property(CACHE SNAPSPACE_LEVELS PROPERTY STRINGS all native)
if(NOT SNAPSPACE_LEVELS MATCHES "^(all|native)$")
  message(FATAL_ERROR "SNAPSPACE_LEVELS is '${SNAPSPACE_LEVELS}': give 'all' or 'native'")
endif()

# The flag fails for other processors, for universal macOS builds and with compilers older than GCC 11.
# These make only the baseline, and import uses it.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=x86-64-v4 SNAPSPACE_HAS_X86_LEVELS)
if(NOT SNAPSPACE_HAS_X86_LEVELS OR MSVC)
  set(LEVELS baseline)
elseif(SNAPSPACE_LEVELS STREQUAL "all")
  set(LEVELS baseline v3 v4)
else()
  # The same test as at import.
  set(program "${CMAKE_CURRENT_BINARY_DIR}/native_level.cpp")
  file(WRITE "${program}" "#include \"bindings/cpu_level.h\"\nint main() { return snapspace::cpu_level(); }\n")
  try_run(NATIVE_LEVEL compiled "${CMAKE_CURRENT_BINARY_DIR}/native_level" "${program}"
    CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${CMAKE_SOURCE_DIR}/core")
  if(NOT compiled OR NOT NATIVE_LEVEL MATCHES "^[0-4]$")
    message(FATAL_ERROR "the level of this processor is not known (${NATIVE_LEVEL}): use SNAPSPACE_LEVELS=all")
  endif()
  if(NATIVE_LEVEL GREATER_EQUAL 3)
    set(LEVELS v${NATIVE_LEVEL})
  else()
    set(LEVELS baseline)
  endif()
endif()
list(JOIN LEVELS ", " shown)
message(STATUS "Builds of the core: ${shown}")

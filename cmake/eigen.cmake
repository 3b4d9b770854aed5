# Eigen's headers, in EIGEN_INCLUDE: those of the package cmeel-eigen from PyPI, else the system's.

# The distribution's own record finds them under pip's isolated builds, where sysconfig's paths do not.
execute_process(COMMAND "${Python_EXECUTABLE}" -c
  "from importlib.metadata import distribution as d; print(d('cmeel-eigen').locate_file('cmeel.prefix/include/eigen3').as_posix())"
  OUTPUT_STRIP_TRAILING_WHITESPACE OUTPUT_VARIABLE EIGEN_INCLUDE RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  # No version is asked for: Eigen 5 calls itself incompatible with 3.4, but serves as well.
  find_package(Eigen3 QUIET NO_MODULE)
  if(NOT Eigen3_FOUND)
    message(FATAL_ERROR "Eigen is missing: pip install cmeel-eigen, or the system's package (libeigen3-dev, eigen)")
  endif()
  if(Eigen3_VERSION VERSION_LESS 3.4)
    message(FATAL_ERROR "Eigen ${Eigen3_VERSION} in ${Eigen3_DIR} is too old: 3.4 is needed")
  endif()
  get_target_property(EIGEN_INCLUDE Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
endif()
message(STATUS "Eigen: ${EIGEN_INCLUDE}")

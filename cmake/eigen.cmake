# Sets EIGEN_INCLUDE to Eigen's headers: those of cmeel-eigen from PyPI, or the system's.

# The distribution's own record finds them in pip's isolated builds too, where sysconfig's paths fail.
execute_process(COMMAND "${Python_EXECUTABLE}" -c
  "from importlib.metadata import distribution as d; print(d('cmeel-eigen').locate_file('cmeel.prefix/include/eigen3').as_posix())"
  OUTPUT_STRIP_TRAILING_WHITESPACE OUTPUT_VARIABLE EIGEN_INCLUDE RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  # No version is requested: Eigen 5 declares itself incompatible with 3.4, but works as well.
  find_package(Eigen3 QUIET NO_MODULE)
  if(NOT Eigen3_FOUND)
    message(FATAL_ERROR "Eigen is missing: run `pip install cmeel-eigen`, or install the system's package (libeigen3-dev, eigen)")
  endif()
  if(Eigen3_VERSION VERSION_LESS 3.4)
    message(FATAL_ERROR "Eigen ${Eigen3_VERSION} in ${Eigen3_DIR} is too old: 3.4 is needed")
  endif()
  get_target_property(EIGEN_INCLUDE Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
endif()
message(STATUS "Eigen: ${EIGEN_INCLUDE}")

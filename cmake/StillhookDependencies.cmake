# The packages that each room needs beside those of the rooms left of it (sim, results, problems, tuning, planner). Used by
# this project's own build, and installed for stillhookConfig.cmake, so that a foreign build finds the same.
#
# stillhook_find(PACKAGE ...) must be defined before: find_package(... REQUIRED) here, find_dependency(...) there.

macro(stillhook_find_sim)
  stillhook_find(Eigen3 3.4 NO_MODULE)
  stillhook_find(OpenMP)
  stillhook_find(PkgConfig)
  pkg_check_modules(hdf5 REQUIRED IMPORTED_TARGET hdf5)
  # Of Ceres the simulation uses a header alone, the dual numbers.
  find_path(CERES_INCLUDE ceres/jet.h REQUIRED)
endmacro()

macro(stillhook_find_results)
  stillhook_find(nlohmann_json)
  stillhook_find(fmt)
  stillhook_find(ZLIB)
  pkg_check_modules(netcdf REQUIRED IMPORTED_TARGET netcdf)
  pkg_check_modules(xlsxwriter REQUIRED IMPORTED_TARGET xlsxwriter)
  pkg_check_modules(fcl REQUIRED IMPORTED_TARGET fcl)
endmacro()

macro(stillhook_find_problems)
  stillhook_find(NLopt)
  stillhook_find(SQLite3)
  pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
  # Ipopt alone: Debian's pkg-config file adds MUMPS's stand-in for MPI, which breaks programs that use MPI.
  find_path(IPOPT_INCLUDE IpTNLP.hpp PATH_SUFFIXES coin coin-or REQUIRED)
  find_library(IPOPT_LIBRARY ipopt REQUIRED)
  if(NOT TARGET Ipopt::ipopt)
    add_library(Ipopt::ipopt UNKNOWN IMPORTED)
    set_target_properties(Ipopt::ipopt PROPERTIES IMPORTED_LOCATION "${IPOPT_LIBRARY}")
  endif()
endmacro()

macro(stillhook_find_tuning)
  stillhook_find(Ceres)
endmacro()

macro(stillhook_find_planner)
  stillhook_find(spdlog)
  stillhook_find(CLI11)
endmacro()

macro(stillhook_find_dependencies)
  foreach(stillhook_room_needed ${ARGN})
    cmake_language(CALL stillhook_find_${stillhook_room_needed})
  endforeach()
endmacro()

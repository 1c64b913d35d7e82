# The direction of includes: sim -> results -> problems -> tuning -> planner. A room may include itself and those left of
# it; nobody includes tests; and the headers of solvers and of the TOML reader stay in the few files that wrap them.
#   cmake -DSOURCE_DIR=... -P include_rule.cmake        fails and names every line that breaks the rule
set(rooms sim results problems tuning planner)
set(violations "")

# Which files may see the headers of a wrapped library: "pattern of the header|pattern of the file|name".
set(wrapped
  "<nlopt|^problems/search/nlopt_search\\.cpp$|NLopt"
  "<Ip[A-Z]|^problems/search/ipopt_search\\.cpp$|Ipopt"
  "toml\\+\\+|^problems/case_document\\.cpp$|toml++"
  "<sqlite3|^problems/search/store\\.cpp$|SQLite"
  "<ceres/ceres|^tuning/fit\\.cpp$|Ceres"
  "<glog|^tuning/fit\\.cpp$|glog"
  "<ceres/jet|^sim/|the dual numbers of Ceres"
  "<fcl|^results/clearance\\.cpp$|FCL"
  "<netcdf|^results/netcdf_file\\.(h|cpp)$|NetCDF"
  "<hdf5|^(sim/hull/coefficients/hdf5_file|sim/guarded_read|results/netcdf_file)\\.cpp$|HDF5"
  "<xlsxwriter|^results/export_xlsx\\.cpp$|libxlsxwriter"
  "<CLI/|^planner/cli/(command_line|command_tree|usage_fault)\\.cpp$|CLI11"
  "<spdlog/|^planner/(cli/|verbs/[a-z]+/verb\\.cpp)|spdlog"
  "<nlohmann/|^(results|problems|planner)/|nlohmann-json")

foreach(room IN LISTS rooms)
  list(FIND rooms ${room} position)
  math(EXPR next "${position} + 1")
  list(LENGTH rooms count)
  set(forbidden tests)
  if(next LESS count)
    list(SUBLIST rooms ${next} -1 right)
    list(APPEND forbidden ${right})
  endif()
  file(GLOB_RECURSE sources "${SOURCE_DIR}/${room}/*.h" "${SOURCE_DIR}/${room}/*.cpp")
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH name "${SOURCE_DIR}" "${source}")
    file(STRINGS "${source}" includes REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS includes)
      foreach(other IN LISTS forbidden)
        if(line MATCHES "\"${other}/")
          list(APPEND violations "${name}: ${line}: ${room} may not see ${other}")
        endif()
      endforeach()
      foreach(rule IN LISTS wrapped)
        string(REPLACE "|^" ";^" parts "${rule}")
        list(GET parts 0 header)
        list(GET parts 1 rest)
        string(REGEX REPLACE ".*[|]" "" label "${rest}")
        string(REGEX REPLACE "[|][^|]*$" "" allowed "${rest}")
        if(line MATCHES "${header}" AND NOT name MATCHES "${allowed}")
          list(APPEND violations "${name}: ${line}: may not see ${label}")
        endif()
      endforeach()
      if(line MATCHES "\"\\.\\./" OR line MATCHES "\"\\./")
        list(APPEND violations "${name}: ${line}: include from the root of the project")
      endif()
    endforeach()
  endforeach()
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "include rule broken:\n  ${text}")
endif()

# `cmake --install`: the program, one static library and export set a room, their headers, and what find_package and
# pkg-config read.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/stillhook)

set(options stillhook_options)  # goes with the first room
foreach(room ${STILLHOOK_ROOMS})
  set_target_properties(stillhook_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS stillhook_${room} ${options} EXPORT stillhook-${room}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT stillhook-${room} FILE stillhook-${room}-targets.cmake NAMESPACE stillhook:: DESTINATION ${package}
    COMPONENT development)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stillhook COMPONENT development
    FILES_MATCHING PATTERN "*.h" PATTERN "viewer" EXCLUDE)
  set(options)
endforeach()
if("planner" IN_LIST STILLHOOK_ROOMS)
  # The front door: #include <stillhook.h>.
  install(FILES ${PROJECT_SOURCE_DIR}/planner/library/stillhook.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stillhook
    COMPONENT development)
endif()
if(TARGET stillhook)
  install(TARGETS stillhook RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/stillhookConfig.cmake.in ${PROJECT_BINARY_DIR}/stillhookConfig.cmake
  INSTALL_DESTINATION ${package})
# Before 1.0 a new minor number may break what was there.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stillhookConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stillhookConfig.cmake ${PROJECT_BINARY_DIR}/stillhookConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/StillhookDependencies.cmake DESTINATION ${package} COMPONENT development)
if(TARGET stillhook_planner)
  set(stillhook_pc_flags "")
  if(STILLHOOK_NATIVE)
    set(stillhook_pc_flags " -march=native -mno-avx512f")
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/stillhook.pc.in ${PROJECT_BINARY_DIR}/stillhook.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/stillhook.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()
if(STILLHOOK_NATIVE)
  # Eigen's alignment follows the instruction set, so users of this library must be compiled with the same one.
  install(CODE "message(WARNING \"This stillhook was built with -march=native: it runs on machines like this one alone, and \
programs that use its libraries are compiled with the same option. Configure with -DSTILLHOOK_NATIVE=OFF for others.\")"
    COMPONENT development)
endif()

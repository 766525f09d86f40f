# cw_msg: C++ types generated from lcmtypes/*.lcm, exposed as SYSTEM headers `crosswalk/msg/<type>.hpp`.
file(GLOB CW_LCM_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lcmtypes/*.lcm)
set(CW_MSG_DIR ${PROJECT_BINARY_DIR}/gen)
set(CW_MSG_STAMP ${CW_MSG_DIR}/stamp)
add_custom_command(
  OUTPUT ${CW_MSG_STAMP}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CW_MSG_DIR}
  COMMAND ${LCM_GEN} --cpp --cpp-std=c++11 --cpp-hpath=${CW_MSG_DIR} ${CW_LCM_FILES}
  COMMAND ${CMAKE_COMMAND} -E touch ${CW_MSG_STAMP}
  DEPENDS ${CW_LCM_FILES}
  COMMENT "Generating message types" VERBATIM)
add_custom_target(cw_msg_gen DEPENDS ${CW_MSG_STAMP})
add_library(cw_msg INTERFACE)
add_dependencies(cw_msg cw_msg_gen)
target_include_directories(cw_msg SYSTEM INTERFACE ${CW_MSG_DIR})
target_link_libraries(cw_msg INTERFACE lcm::lcm)

# share/crosswalk_types.jar: our message types for lcm-spy (`crosswalk spy`). Left out where Java is not
# installed; nothing else needs it.
find_program(JAVAC javac)
find_program(JAR jar)
find_file(LCM_JAR lcm.jar PATHS /usr/share/java)
if(JAVAC AND JAR AND LCM_JAR)
  set(CW_JAVA_DIR ${PROJECT_BINARY_DIR}/java)
  set(CW_TYPES_JAR ${PROJECT_BINARY_DIR}/share/crosswalk_types.jar)
  set(CW_JAVA_FILES "")
  foreach(message ${CW_LCM_FILES})
    get_filename_component(type ${message} NAME_WE)
    list(APPEND CW_JAVA_FILES ${CW_JAVA_DIR}/source/crosswalk/msg/${type}.java)
  endforeach()
  add_custom_command(
    OUTPUT ${CW_TYPES_JAR}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${CW_JAVA_DIR}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CW_JAVA_DIR}/source ${CW_JAVA_DIR}/classes
            ${PROJECT_BINARY_DIR}/share
    COMMAND ${LCM_GEN} --java --jpath ${CW_JAVA_DIR}/source ${CW_LCM_FILES}
    COMMAND ${JAVAC} -nowarn -cp ${LCM_JAR} -d ${CW_JAVA_DIR}/classes ${CW_JAVA_FILES}
    COMMAND ${JAR} --create --file ${CW_TYPES_JAR} -C ${CW_JAVA_DIR}/classes .
    DEPENDS ${CW_LCM_FILES}
    COMMENT "Message types for lcm-spy" VERBATIM)
  add_custom_target(spy_types DEPENDS ${CW_TYPES_JAR})
endif()

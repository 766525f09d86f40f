# The interactive part of the report: three.js and uPlot by the committed lock file, bundled by
# esbuild into one script. Optional: without npm, or without a network at the first build, the
# report keeps its static drawings.
set(CW_PAGE_SCRIPT ${CMAKE_CURRENT_BINARY_DIR}/page/page.js)
set(CW_PAGE_STYLE ${CMAKE_CURRENT_BINARY_DIR}/page/page.css)
set(CW_PAGE_DEPENDS "")
find_program(NPM npm)
if(NPM)
  set(page_source ${CMAKE_CURRENT_SOURCE_DIR}/page)
  file(GLOB page_files CONFIGURE_DEPENDS ${page_source}/*.js ${page_source}/*.json)
  set(page_stamp ${CMAKE_CURRENT_BINARY_DIR}/page/stamp)
  add_custom_command(
    OUTPUT ${page_stamp}
    COMMAND ${CMAKE_COMMAND} -DNPM=${NPM} -DSOURCE=${page_source}
            -DBUILD=${CMAKE_CURRENT_BINARY_DIR}/page -P ${CMAKE_CURRENT_SOURCE_DIR}/bundle.cmake
    COMMAND ${CMAKE_COMMAND} -E touch ${page_stamp}
    DEPENDS ${page_files} bundle.cmake
    COMMENT "Bundling the report's charts and 3-D view" VERBATIM)
  set(CW_PAGE_DEPENDS ${page_stamp})
else()
  message(STATUS "npm not found: reports get static charts and pictures only "
                 "(apt-get install npm and configure again for interactive ones)")
endif()

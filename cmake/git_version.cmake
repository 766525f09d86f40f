# Writes OUTPUT (a header) with the commit and whether files were changed since; untouched when equal.
# cmake -DSOURCE_DIR=... -DOUTPUT=... -DVERSION=... -P git_version.cmake
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse --short=10 HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=no
                OUTPUT_VARIABLE changes ERROR_QUIET)
set(state "")
if(commit)
  set(state " (${commit})")
  if(changes)
    set(state " (${commit}, changed)")
  endif()
endif()
set(text "#pragma once\n#define CROSSWALK_VERSION_TEXT \"${VERSION}${state}\"\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT text STREQUAL old)
  file(WRITE ${OUTPUT} "${text}")
endif()

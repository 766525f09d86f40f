# npm ci and esbuild in the build tree; a failure leaves no script and says so, the build goes on.
# cmake -DNPM=... -DSOURCE=page folder -DBUILD=folder -P bundle.cmake
file(MAKE_DIRECTORY ${BUILD})
file(REMOVE ${BUILD}/page.js ${BUILD}/page.css)
file(GLOB sources ${SOURCE}/*.js ${SOURCE}/*.json)
file(COPY ${sources} DESTINATION ${BUILD}/source)
set(modules ${BUILD}/source/node_modules)
file(SHA256 ${SOURCE}/package-lock.json lock)
set(installed "")
if(EXISTS ${modules}/installed)
  file(READ ${modules}/installed installed)
endif()
if(NOT installed STREQUAL lock)
  execute_process(
    COMMAND ${NPM} ci --prefer-offline --no-audit --no-fund --ignore-scripts --loglevel=error
            --fetch-retries=1 --fetch-timeout=20000
    WORKING_DIRECTORY ${BUILD}/source TIMEOUT 180 RESULT_VARIABLE failed
    OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    message(NOTICE "Report: npm ci failed (no network?); reports get static charts and pictures "
                   "only. Touch ${SOURCE}/main.js and build again to retry.\n${said}")
    return()
  endif()
  file(WRITE ${modules}/installed ${lock})
endif()
execute_process(
  COMMAND ${modules}/.bin/esbuild main.js --bundle --minify --format=iife --target=es2020
          --legal-comments=inline --log-level=warning --outfile=${BUILD}/page.js
  WORKING_DIRECTORY ${BUILD}/source RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  file(REMOVE ${BUILD}/page.js ${BUILD}/page.css)
  message(NOTICE "Report: esbuild failed; reports get static charts and pictures only.\n${said}")
endif()

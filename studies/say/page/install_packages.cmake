# Installs the packages of FROM/package-lock.json into TO/node_modules. Install scripts are off: none is needed.

file(MAKE_DIRECTORY ${TO})
file(COPY ${FROM}/package.json ${FROM}/package-lock.json DESTINATION ${TO})
execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
  WORKING_DIRECTORY ${TO} RESULT_VARIABLE result ERROR_VARIABLE errors OUTPUT_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "npm could not fetch the report's libraries (plotly.js, three.js); check the network or npm's "
    "registry setting and build again; behind a proxy with a certificate of its own, name that with npm config set "
    "cafile FILE. npm said:\n${errors}${output}")
endif()

# cmake -DSOURCE=DIR -DHEADER=FILE -P git_commit.cmake: writes FILE, which defines FM_GIT_COMMIT,
# unless it says so already. Without git, or outside a repository, the commit is "unknown".
execute_process(COMMAND git --no-optional-locks describe --always --dirty --abbrev=40 --exclude=*
  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
  RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define FM_GIT_COMMIT \"${commit}\"\n")

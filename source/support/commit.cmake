# cmake -D SOURCE=DIR -D HEADER=FILE -P commit.cmake: writes the commit of the sources into a header, if it has changed.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=10
                OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define DEBOND_COMMIT \"${COMMIT}\"\n")

# Debian 13 links deal.II with the linker mold, says so in the flags that deal.II hands on, but does not install it. The
# default linker does as well.
find_program(MOLD_LINKER mold)
mark_as_advanced(MOLD_LINKER)
if(NOT MOLD_LINKER)
  string(REPLACE "-fuse-ld=mold" "" DEAL_II_LINKER_FLAGS "${DEAL_II_LINKER_FLAGS}")
endif()
